#include "amble/experiment/build_info.hpp"

#include <fstream>
#include <string_view>

#include "amble_build_info.inc"

namespace amble::experiment {

std::string short_commit(const BuildInfo& build) {
  return build.commit.substr(0, 12) + (build.commit.ends_with('+') ? "+" : "");
}

BuildInfo build_info() {
  return {AMBLE_VERSION, AMBLE_COMMIT, AMBLE_COMPILER, AMBLE_FLAGS, AMBLE_LIBRARIES};
}

std::string cpu_name() {
  std::ifstream file("/proc/cpuinfo");
  for (std::string line; std::getline(file, line);) {
    const auto colon = line.find(": ");
    if (line.starts_with("model name") && colon != std::string::npos) return line.substr(colon + 2);
  }
  return "unknown";
}

}  // namespace amble::experiment
