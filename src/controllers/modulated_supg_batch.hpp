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
/// are in supg_kernel.hpp and supg_targets.hpp, each over all legs and lanes at once. Without sensors, with
/// reset 1 and no refractory time it does to the bit what SupgBatch does.
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
  /// Sets advances(), by how much the timers of each leg grow in this tick.
  virtual void set_rates();
  /// Changes the targets of all SUPGs before they are limited: row() says where they are.
  virtual void reshape(float* /*targets_rad*/) {}
  /// What the joints' targets have become.
  virtual void targets_are_set(const LaneArray& /*targets_rad*/) {}

  const std::int32_t* timers(int leg) const { return timer_.data() + index(leg, 0); }
  std::int32_t* advances(int leg) { return advance_.data() + index(leg, 0); }
  /// Where a SUPG (index in SupgJoints::of_legs) has its targets, by lane, and its joint; −1: none.
  std::size_t row(int supg) const {
    const int types = parked_.types();
    return static_cast<std::size_t>(supg % types * count() + supg / types * lanes_);
  }
  int joint_of(int supg) const { return supgs_.joints.of_legs[static_cast<std::size_t>(supg)]; }
  std::int32_t period_parts() const { return period_; }
  const JointRange& range_of(int supg) const {
    return supgs_.joints.ranges[static_cast<std::size_t>(joint_of(supg))];
  }

 private:
  std::size_t index(int leg, int lane) const { return static_cast<std::size_t>(leg * lanes_ + lane); }
  int count() const { return parked_.legs() * lanes_; }
  void sense(const robot::SensorFrame& sensors);
  void set_sensed_rates();
  void hold_by_load();
  void update_timers(const float* contact);
  void pull();
  void interpolate(const std::vector<std::int32_t>& timers, int first, int end,
                   std::vector<float>& targets_rad) const;
  void write_targets(LaneArray& targets_rad);
  void limit(LaneArray& targets_rad);
  void smooth(LaneArray& targets_rad);
  void start_filters(int supg, const float* present_rad);

  ModulatedSupgs supgs_;
  ModulatedParameters parked_;
  int lanes_;
  std::int32_t period_, start_;  ///< in parts
  TimerRules rules_;             ///< in parts; an end of a cycle at −1: stopped
  bool shapes_, by_reading_;
  std::int32_t reset_share_;

  // Leg by leg over the lanes, if nothing else is said.
  std::vector<const float*> tables_;     ///< its controller's entries of the leg
  std::vector<std::int32_t> timer_;      ///< parts, −1 stopped
  std::vector<std::int32_t> continued_;  ///< what it would be in this tick without a jump
  std::vector<std::int32_t> airborne_ticks_, wait_ticks_, first_timer_, triggered_, refractory_left_;
  std::vector<std::pair<float, float>> limits_rad_;  ///< as SupgJoints::of_legs
  std::vector<LimitedRow> limited_;                  ///< scratch
  std::vector<SensedRow> rows_;                      ///< into the next two
  LaneRows sensed_;                                  ///< sensor by sensor
  LaneRows load_;                                    ///< of load_feedback
  std::vector<float> cosines_;                       ///< phase_cosines()
  LaneRows weights_;                                 ///< channel by channel; of ShapeBy::reading
  LaneRows rates_;                                   ///< sensor by sensor
  std::vector<std::int32_t> advance_, no_chance_, jumped_;
  std::vector<std::int32_t> fresh_;                 ///< by lane: 1 before its first tick
  std::vector<float> continued_rad_, present_rad_;  ///< type by type
  std::optional<RandomTriggers> random_;
  std::optional<SeamSmoother> smoother_;
};

}  // namespace amble::controllers
