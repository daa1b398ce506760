#pragma once

#include <cstdint>
#include <vector>

namespace amble::controllers {

/// Trigger::random: the moments at which legs are triggered whatever their feet do. Between two triggers of a
/// leg, and before its first, lie period ± period / 2 ticks, all as likely, so a period on average. They
/// follow from the leg and the ticks since its controller was loaded: the same in every trial, in every lane.
class RandomTriggers {
 public:
  RandomTriggers(int period_ticks, int legs, int lanes);

  void load(int lane);
  /// Goes on by a tick. By lane: all bits if the leg is triggered in this tick, else 0. Valid until the next
  /// call.
  const std::int32_t* advance(int leg);

 private:
  /// Ticks before a leg's trigger of this number, 0 for the first, after the one before it; at least 1.
  std::int32_t gap_ticks(int leg, std::uint32_t number) const;

  int period_ticks_, legs_, lanes_;
  std::vector<std::int32_t> left_ticks_;  ///< until the next trigger; leg by leg, over the lanes
  std::vector<std::uint32_t> number_;     ///< of the next trigger
  std::vector<std::int32_t> masks_;       ///< by lane
};

}  // namespace amble::controllers
