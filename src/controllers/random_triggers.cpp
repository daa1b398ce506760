#include "amble/controllers/random_triggers.hpp"

#include "amble/core/index.hpp"
#include "amble/core/random.hpp"

namespace amble::controllers {

RandomTriggers::RandomTriggers(int period_ticks, int legs, int lanes)
    : period_ticks_(period_ticks),
      legs_(legs),
      lanes_(lanes),
      left_ticks_(to_index(legs * lanes)),
      number_(to_index(legs * lanes)),
      masks_(to_index(lanes)) {
  for (int lane = 0; lane < lanes; ++lane) load(lane);
}

void RandomTriggers::load(int lane) {
  for (int leg = 0; leg < legs_; ++leg) {
    const std::size_t i = to_index(leg * lanes_ + lane);
    number_[i] = 0;
    left_ticks_[i] = gap_ticks(leg, 0);
  }
}

const std::int32_t* RandomTriggers::advance(int leg) {
  for (int lane = 0; lane < lanes_; ++lane) {
    const std::size_t i = to_index(leg * lanes_ + lane);
    const bool triggered = --left_ticks_[i] == 0;
    masks_[to_index(lane)] = -static_cast<std::int32_t>(triggered);
    if (triggered) left_ticks_[i] = gap_ticks(leg, ++number_[i]);
  }
  return masks_.data();
}

std::int32_t RandomTriggers::gap_ticks(int leg, std::uint32_t number) const {
  constexpr std::uint64_t seed = 1;
  const auto half = static_cast<std::uint32_t>(period_ticks_ / 2);
  Stream stream(seed, Purpose::random_triggers, number, static_cast<std::uint32_t>(leg));
  return period_ticks_ - static_cast<std::int32_t>(half) +
         static_cast<std::int32_t>(stream.below(2 * half + 1));
}

}  // namespace amble::controllers
