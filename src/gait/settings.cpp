#include "amble/gait/settings.hpp"

#include "amble/core/error.hpp"

namespace amble::gait {

void Settings::validate() const {
  const auto demand = [](bool fits, const char* name, double value, const char* range) {
    if (!fits) fail(ExitCode::bad_input, "gait: {} = {} s: expected {}", name, value, range);
  };
  demand(debounce_s >= 0.0 && debounce_s <= 1.0, "debounce", debounce_s, "0 to 1 s");
  demand(transient_s >= 0.0 && transient_s <= 1e6, "transient", transient_s, "0 to 1e6 s");
  demand(window_s >= 0.1 && window_s <= 3600.0, "window", window_s, "0.1 to 3600 s");
  demand(longest_stride_s > 0.0 && longest_stride_s <= 3600.0, "longest stride", longest_stride_s,
         "more than 0, at most 3600 s");
}

}  // namespace amble::gait
