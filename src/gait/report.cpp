#include "amble/gait/report.hpp"

namespace amble::gait {

std::vector<Segment> segments_of(const Report& report) {
  std::vector<Segment> segments;
  for (const Window& window : report.windows) {
    if (!window.classification) continue;
    if (!segments.empty() && segments.back().classification == *window.classification) {
      segments.back().end_s = window.end_s;
    } else {
      segments.push_back({window.start_s, window.end_s, *window.classification});
    }
  }
  return segments;
}

}  // namespace amble::gait
