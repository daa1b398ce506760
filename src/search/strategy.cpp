#include "amble/search/strategy.hpp"

#include "amble/core/check.hpp"

namespace amble::search {

std::string Strategy::take_log_growth(std::size_t /*i*/) {
  AMBLE_CHECK(false, "a strategy with logs writes them");
  return {};
}

std::uint64_t Strategy::restore_log(std::size_t /*i*/, io::InputFile& /*file*/, const std::string& /*what*/) {
  AMBLE_CHECK(false, "a strategy with logs reads them");
  return 0;
}

}  // namespace amble::search
