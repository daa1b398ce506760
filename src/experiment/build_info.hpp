#pragma once

#include <string>

namespace amble::experiment {

/// Source and compiler of this program, for manifests and --version.
struct BuildInfo {
  std::string version;  ///< of `git describe`: "0.2.0" at the tag v0.2.0, "0.2.0-7-gabc1234" later
  std::string commit;   ///< git commit, "+" appended if the sources had changes; "unknown" outside a checkout
  std::string compiler;   ///< "GNU 12.2.0"
  std::string flags;      ///< those that affect arithmetic
  std::string libraries;  ///< physics engines that it was compiled for: "ODE 0.16.2, MuJoCo 2.2.2"
};
/// The commit's first twelve digits, followed by "+" if the sources differed from it.
std::string short_commit(const BuildInfo& build);

BuildInfo build_info();

/// The processor's name as the system reports it.
std::string cpu_name();

}  // namespace amble::experiment
