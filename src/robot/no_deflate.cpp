// In place of deflate.cpp where there is no zlib (WebAssembly): there the robot's own model is left out of
// what is read.
#include "amble/core/check.hpp"
#include "amble/robot/deflate.hpp"

namespace amble::robot {

std::string deflated(const std::string&, int) {
  check_failed(__FILE__, __LINE__, "zlib", "is not in this build");
}

std::optional<std::string> inflated(const std::optional<std::string>&, std::size_t) {
  return std::nullopt;
}

}  // namespace amble::robot
