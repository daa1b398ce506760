#include "amble/motion/footfalls.hpp"

#include "amble/record/footfall.hpp"

#include <algorithm>

namespace amble::motion {

std::vector<Stance> stances(const std::vector<bool>& touch, double frame_s) {
  std::vector<Stance> found;
  const int frames = static_cast<int>(touch.size());
  const auto time_s = [&](int frame) { return frame == 0 ? 0.0 : std::min(frame + 1, frames) * frame_s; };
  for (int k = 0; k < frames; ++k) {
    if (!touch[static_cast<std::size_t>(k)]) continue;
    const int first = k;
    while (k < frames && touch[static_cast<std::size_t>(k)]) ++k;
    found.push_back({time_s(first), time_s(k)});
  }
  return found;
}

double contact_share(const std::vector<bool>& touch) {
  if (touch.empty()) return 0.0;
  return static_cast<double>(std::ranges::count(touch, true)) / static_cast<double>(touch.size());
}

std::vector<int> touchdown_frames(const std::vector<bool>& touch) {
  std::vector<int> frames;
  int last_touch = -1;
  for (int k = 0; k < static_cast<int>(touch.size()); ++k) {
    if (!touch[static_cast<std::size_t>(k)]) continue;
    if (record::has_come_down(k, last_touch, 1.0)) frames.push_back(k);
    last_touch = k;
  }
  return frames;
}

std::vector<double> trigger_times_s(const std::vector<bool>& trigger, double frame_s) {
  std::vector<double> times;
  for (std::size_t k = 0; k < trigger.size(); ++k)
    if (trigger[k] && (k == 0 || !trigger[k - 1])) times.push_back(static_cast<double>(k) * frame_s);
  return times;
}

std::vector<std::optional<double>> timer_at_triggers(const std::vector<bool>& trigger,
                                                     const std::vector<float>& timer_ticks) {
  std::vector<std::optional<double>> reached;
  for (std::size_t k = 1; k < trigger.size(); ++k) {
    if (!trigger[k]) continue;
    const float before = timer_ticks[k - 1];
    reached.push_back(before < 0.0f ? std::nullopt : std::optional<double>(before));
  }
  return reached;
}

}  // namespace amble::motion
