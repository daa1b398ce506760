#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "amble/controllers/lane_rows.hpp"
#include "amble/controllers/modulation.hpp"
#include "amble/controllers/supg.hpp"
#include "amble/controllers/supg_batch.hpp"
#include "amble/controllers/supg_kernel.hpp"

namespace amble::controllers {

/// Modulated SUPG controllers stepping together; what they do is documented at SupgArchitecture, its loops
/// are in supg_kernel.hpp. Timers are updated over the lanes; targets are interpolated lane by lane, four
/// joints at a time, as an entry's numbers lie together. Without sensors, with reset 1 and no refractory time
/// it does to the bit what SupgBatch does.
class ModulatedSupgBatch : public Batch {
 public:
  /// `parked` is what runs in lanes that have not been loaded.
  ModulatedSupgBatch(ModulatedSupgs supgs, ModulatedParameters parked, int lanes);

  int lanes() const override { return lanes_; }
  void load(int lane, const Parameters& parameters) override;
  void step(const robot::SensorFrame& sensors, LaneArray& targets_rad) override;
  std::vector<std::string> state_names() const override;
  void state(int lane, std::span<float> values) const override;
  std::vector<std::size_t> events() const override;

 protected:
  // What a derived kind of controller adds; nothing here.
  /// At the beginning of a tick, before any timer is updated.
  virtual void begin_tick(const robot::SensorFrame& /*sensors*/) {}
  /// Sets advances(), by how much the timers of a leg grow in this tick.
  virtual void set_rates(int leg);
  /// Changes the targets of a SUPG (index in SupgJoints::of_legs), by lane, before they are limited.
  virtual void reshape(int /*supg*/, float* /*targets_rad*/) {}
  /// What its targets have become.
  virtual void end_target(int /*supg*/, const float* /*targets_rad*/) {}

  const std::int32_t* timers(int leg) const { return timer_.data() + index(leg, 0); }
  std::int32_t* advances() { return advance_.data(); }
  std::int32_t period_parts() const { return period_; }
  const JointRange& range_of(int supg) const {
    return supgs_.joints
        .ranges[static_cast<std::size_t>(supgs_.joints.of_legs[static_cast<std::size_t>(supg)])];
  }

 private:
  std::size_t index(int leg, int lane) const { return static_cast<std::size_t>(leg * lanes_ + lane); }
  void sense(int leg, const robot::SensorFrame& sensors);
  void weigh_levels();
  void set_sensed_rates(int leg);
  void hold_by_load(int leg);
  void update_timers(int leg, const float* contact, const std::int32_t* by_chance);
  void pull(int leg);
  void write_targets(int leg, LaneArray& targets_rad);
  void start_filters(int row, const float* present_rad);
  void interpolate(int leg, const std::int32_t* timers, int first, int end, float* targets_rad) const;
  void limit_joint(int row, float* continued_rad, float* present_rad, LaneArray& targets_rad);
  void end_joint(int row, const float* continued_rad, const float* present_rad, LaneArray& targets_rad);

  ModulatedSupgs supgs_;
  ModulatedParameters parked_;
  int lanes_;
  std::int32_t period_, start_;  ///< in parts
  TimerRules rules_;             ///< in parts; an end of a cycle at −1: stopped
  bool shapes_, by_reading_;
  std::int32_t reset_share_;

  std::vector<const float*> tables_;     ///< by lane: its controller's entries
  std::vector<std::int32_t> timer_;      ///< leg by leg over the lanes: parts, −1 stopped
  std::vector<std::int32_t> continued_;  ///< what it would be in this tick without a jump
  std::vector<std::int32_t> airborne_ticks_, wait_ticks_, first_timer_, triggered_, refractory_left_;
  std::vector<std::pair<float, float>> limits_rad_;  ///< as SupgJoints::of_legs
  std::vector<LimitedRow> limited_;                  ///< of the leg in hand
  std::vector<SensedRow> rows_;                      ///< of the leg in hand, into the next two
  LaneRows sensed_;                                  ///< of the leg in hand, sensor by sensor
  LaneRows load_;                                    ///< of the leg in hand; of load_feedback
  std::vector<float> cosines_;                       ///< phase_cosines()
  LaneRows weights_;                                 ///< the same, channel by channel; of ShapeBy::reading
  LaneRows rates_;                                   ///< leg by leg, sensor by sensor
  std::vector<std::int32_t> advance_;                ///< of the leg in hand, by lane
  std::vector<std::int32_t> no_chance_, jumped_, fresh_;  ///< by lane; the last: 1 before its first tick
  std::vector<float> continued_rad_, present_rad_;        ///< of the leg in hand, type by type
  std::optional<RandomTriggers> random_;
  std::optional<SeamSmoother> smoother_;
};

}  // namespace amble::controllers
