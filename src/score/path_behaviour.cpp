#include "amble/score/path_behaviour.hpp"

#include "amble/core/check.hpp"

namespace amble::score {

std::size_t path_behaviour_length(int steps, const record::PathSampling& sampling) {
  return 2 * static_cast<std::size_t>(sampling.count(steps));
}

std::vector<float> path_behaviour(const record::Trajectory& trajectory, std::size_t length) {
  AMBLE_CHECK(trajectory.com_path_m.size() <= length && length % 2 == 0, "paths are no longer than trials");
  std::vector<float> behaviour = trajectory.com_path_m;
  behaviour.reserve(length);
  const Vec3 moved = trajectory.com_end_m - trajectory.com_start_m;
  while (behaviour.size() < length) {
    behaviour.push_back(static_cast<float>(moved.x));
    behaviour.push_back(static_cast<float>(moved.y));
  }
  return behaviour;
}

}  // namespace amble::score
