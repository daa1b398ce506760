#pragma once

#include <string>

namespace amble::experiment {

/// What this program was built from and with, and the machine it runs on: for manifests and --version.
struct BuildInfo {
  std::string version;   ///< "0.1.0"
  std::string commit;    ///< git commit, "+" appended if the tree had changes; "unknown" outside a checkout
  std::string compiler;  ///< "GNU 12.2.0"
  std::string flags;     ///< those that decide the arithmetic
};
/// The commit's first twelve digits, with a "+" behind them if the sources differed from it.
std::string short_commit(const BuildInfo& build);

BuildInfo build_info();

/// The processor's name as the system gives it.
std::string cpu_name();

}  // namespace amble::experiment
