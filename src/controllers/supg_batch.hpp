#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "amble/controllers/lane_rows.hpp"
#include "amble/controllers/supg.hpp"
#include "amble/controllers/supg_contact.hpp"

namespace amble::controllers {

/// Trigger::random: the moments at which legs are triggered whatever their feet do. Between two triggers of a
/// leg, and before its first, lie period ± period / 2 ticks, all as likely, so a period on average. They
/// follow from the leg and the ticks since its controller was loaded: the same in every trial, in every lane.
class RandomTriggers {
 public:
  RandomTriggers(int period_ticks, int legs, int lanes);

  void load(int lane);
  /// Goes on by a tick. Leg by leg, over the lanes: all bits if the leg is triggered in this tick, else 0.
  /// Valid until the next call.
  const std::int32_t* advance();

 private:
  /// Ticks before a leg's trigger of this number, 0 for the first, after the one before it; at least 1.
  std::int32_t gap_ticks(int leg, std::uint32_t number) const;

  int period_ticks_, legs_, lanes_;
  std::vector<std::int32_t> left_ticks_;  ///< until the next trigger; leg by leg, over the lanes
  std::vector<std::uint32_t> number_;     ///< of the next trigger
  std::vector<std::int32_t> masks_;       ///< leg by leg, over the lanes
};

/// SUPG controllers stepping together; what they do is documented at SupgArchitecture. Each quantity is
/// stored leg by leg, over the lanes, and the update of a tick has no branches that depend on a lane.
class SupgBatch : public Batch {
 public:
  /// `parked` is what runs in lanes that have not been loaded.
  SupgBatch(const SupgSettings& settings, double timestep_s, std::vector<std::string> leg_names,
            SupgJoints joints, SupgParameters parked, int lanes, std::optional<ContactEstimate> contact = {});

  int lanes() const override { return lanes_; }
  void load(int lane, const Parameters& parameters) override;
  void step(const robot::SensorFrame& sensors, LaneArray& targets_rad) override;
  std::vector<std::string> state_names() const override;
  void state(int lane, std::span<float> values) const override;
  std::vector<std::size_t> events() const override;

 protected:
  /// For batches that change what a leg plays: called in each tick for each leg when all timers are set and
  /// before its targets are written. play() and begin() may be called then.
  virtual void timers_are_set(int /*leg*/) {}
  const std::vector<std::string>& leg_names() const { return leg_names_; }
  /// Whether a trigger fired in this tick.
  bool triggered(int leg, int lane) const { return triggered_[index(leg, lane)] != 0; }
  /// Whether its cycle has ended in this tick, or its timer stands.
  bool at_end(int leg, int lane) const {
    const std::int32_t timer = timer_[index(leg, lane)];
    return timer == end_of_cycle_ || timer == SupgParameters::stopped;
  }
  /// From now on the leg plays the patterns of `supg`, its timer as it is.
  void play(int leg, int lane, const SupgParameters& supg) {
    tables_[index(leg, lane)] = supg.targets_rad(leg, 0);
    plays_others_ = true;
  }
  /// The same, and the leg begins as at the start of a trial.
  void begin(int leg, int lane, const SupgParameters& supg);
  /// What smooths its targets begins with the first ones of `supg`; after begin().
  void smooth_from_start(int leg, int lane, const SupgParameters& supg);

 private:
  std::size_t index(int leg, int lane) const { return static_cast<std::size_t>(leg * lanes_ + lane); }
  /// What a timer that runs becomes in the next tick.
  std::int32_t after(std::int32_t timer) const {
    return timer + 1 >= period_ticks_ ? end_of_cycle_ : timer + 1;
  }
  void update_timers(const float* touch);
  void write_targets(LaneArray& targets_rad);
  /// What timers will be without a jump; before update_timers().
  void continue_timers();
  /// The same as write_targets(), smoothed.
  void write_smoothed(LaneArray& targets_rad);
  /// Leg by leg, over the lanes: whose timers or tables jumped.
  void find_jumps();
  /// Where patterns would be without a jump, and where they are.
  void look_up_both();

  Offset offset_;
  std::int32_t start_tick_, period_ticks_;
  std::int32_t airborne_ticks_needed_ = 0;  ///< for a touch to be a trigger
  std::int32_t by_touch_ = 0;               ///< all bits if touches are triggers, else 0
  std::int32_t end_of_cycle_ = 0;           ///< what the timer becomes on reaching the period
  std::vector<std::string> leg_names_;
  SupgJoints joints_;
  SupgParameters parked_;
  int lanes_;

  std::vector<const float*> tables_;  ///< leg by leg, over the lanes: its controller's targets at timer 0
  std::vector<std::int32_t> timer_;   ///< ticks, or SupgParameters::stopped
  std::vector<std::int32_t> airborne_ticks_;  ///< ticks in a row for which the foot has been off the ground
  std::vector<std::int32_t>
      wait_ticks_;  ///< ticks before the timer starts for the first time; −1 once it has
  std::vector<std::int32_t> first_timer_;  ///< timer value of that start
  std::vector<std::int32_t> triggered_;    ///< 1 if a trigger fired in this tick
  std::vector<std::int32_t> no_chance_;    ///< 0
  std::optional<RandomTriggers> random_;

  std::optional<ContactEstimate> contact_;  ///< none: contacts are touches
  std::optional<SeamSmoother> smoother_;
  // Leg by leg, over the lanes.
  std::vector<std::int32_t> continued_;         ///< a timer
  std::vector<std::int32_t> jumped_;            ///< a mask
  std::vector<const float*> continued_tables_;  ///< its table before this tick
  bool plays_others_ = true;                    ///< whether some tables may not be those before this tick
  LaneRows continued_rad_, present_rad_;        ///< as SupgJoints::of_legs: patterns there
  std::vector<std::pair<float, float>> limits_rad_;  ///< the same
  std::vector<float*> rows_;                         ///< the same: scratch
};

}  // namespace amble::controllers
