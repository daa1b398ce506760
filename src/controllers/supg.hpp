#pragma once

#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "amble/controllers/controller.hpp"
#include "amble/controllers/joint_range.hpp"
#include "amble/controllers/modulation.hpp"
#include "amble/controllers/sensing.hpp"
#include "amble/controllers/supg_contact.hpp"
#include "amble/controllers/supg_settings.hpp"
#include "amble/substrate/layout.hpp"

namespace amble::controllers {

class SupgBatch;

/// The property of a SUPG's node that sets its leg's offset, −1 … 1; SupgArchitecture says what it means.
inline constexpr std::string_view offset_property = "offset";

/// A decoded SUPG controller: for each joint the target angle at each value of its leg's timer, and the
/// offset of each leg. The CPPN is queried once for all of them and not again while the robot walks.
class SupgParameters : public Parameters {
 public:
  SupgParameters(int legs, int types, int period_ticks);

  int legs() const { return legs_; }
  int types() const { return types_; }
  int period_ticks() const { return period_ticks_; }
  /// 1 … period_ticks − 1.
  int offset_ticks(int leg) const { return offset_ticks_[static_cast<std::size_t>(leg)]; }
  void set_offset_ticks(int leg, int ticks) { offset_ticks_[static_cast<std::size_t>(leg)] = ticks; }

  /// Target angles (rad) of the leg's joints, type by type (unused where the leg has none of the type), at a
  /// value of its timer: 0 … period_ticks, or `stopped`.
  static constexpr int stopped = -1;
  const float* targets_rad(int leg, int timer) const { return targets_rad_.data() + index(leg, timer); }
  float* targets_rad(int leg, int timer) { return targets_rad_.data() + index(leg, timer); }

 private:
  std::size_t index(int leg, int timer) const {
    return static_cast<std::size_t>((leg * (period_ticks_ + 2) + timer + 1) * types_);
  }

  int legs_, types_, period_ticks_;
  std::vector<int> offset_ticks_;
  std::vector<float> targets_rad_;  ///< by leg, timer (from `stopped` on) and type: what a leg needs in one
                                    ///< tick lies together; 3 more behind them, to be read four at a time
};

/// The same with what sensors change, which begins with the same targets.
class ModulatedParameters : public SupgParameters {
 public:
  ModulatedParameters(SupgParameters targets, int sensors, int channels);
  const Modulation& modulation() const { return modulation_; }
  Modulation& modulation() { return modulation_; }

 private:
  Modulation modulation_;
};

/// Which joint of RobotSpec::joints each entry of a SupgParameters is for.
struct SupgJoints {
  /// One that belongs to no leg, so that no SUPG drives it.
  struct Held {
    int joint = 0;
    float target_rad = 0.0f;
  };

  std::vector<int> of_legs;        ///< leg by leg, type by type; −1: the leg has none of that type
  std::vector<JointRange> ranges;  ///< joint by joint in control order
  std::vector<Held> others;
};

/// What a batch of modulated SUPGs needs to know beside its parameters.
struct ModulatedSupgs {
  SupgSettings settings;
  double timestep_s = 0.01;
  std::vector<std::string> leg_names;
  SupgJoints joints;
  std::vector<std::vector<LegSensor>> sensors;  ///< leg by leg
  std::vector<LegSensor> loads = {};            ///< of the legs' feet; empty without load_feedback
  std::optional<ContactEstimate> contact = std::nullopt;
};

/// Single-unit pattern generators: one per driven joint, each with a pattern over one period that its leg's
/// trigger starts anew (Morse et al. 2013, sec. 3).
///
/// Each node of the substrate is a SUPG with two properties. Its `pattern` becomes the command
/// (pattern + 1)/2, clamped to 0 … 1, and is scaled to the joint's range; SeamSettings::detrend takes the
/// pattern's trend away before. Its `offset` a becomes
/// ceil((a + 1)/2 × period) ticks, clamped to 1 … period − 1, and is the same for the SUPGs of a leg.
///
/// The SUPGs of a leg share one timer, in ticks; −1 means stopped. In each tick, in this order:
/// 1. Touch is read, or what SupgSettings::contact has in its place. It is a trigger with Trigger::level;
///    with Trigger::edge only if the foot was off the ground in at least the trigger_debounce_ticks ticks
///    before. All feet count as touching before tick 1. With Trigger::none there are no triggers; with
///    Trigger::random they come when RandomTriggers says.
/// 2. The timer is set. Offset::phase: before tick 1 its value is the offset, from which it grows; a trigger
///    in tick 1 is ignored. Offset::delay: it is stopped for `offset` ticks and starts at start_tick in the
///    next. From the tick after this first start on, a trigger sets it to start_tick; triggers before are
///    ignored. Otherwise it grows by 1; when that reaches the period, Idle::mid stops it, Idle::hold keeps it
///    at the period, and Idle::wrap sets it to 0.
/// 3. The targets are the patterns at time timer / period; while the timer is stopped, the middle of each
///    joint's range. SupgSettings::seam may smooth them. A timer jumps where it is set, stops or begins
///    again; without the jump a timer that runs would be one more, at most the period, and a stopped one
///    stopped. The start with Offset::phase is no jump.
///
/// SupgSettings::modulation adds sensors s (LegSensor) of each leg:
/// - rate: in a tick a timer that runs grows by 2^ρ, ρ = Σ a s limited to ± 1. It counts in parts of 2^−14
///   ticks (advance_parts), and Idle::wrap takes the period off it. Waits are not modulated.
/// - shape: a target is P(timer) + Σ G(timer) s, limited to the joint's range; between ticks P and G are
///   linear. With ShapeBy::reading G is a function of s: P(timer) + Σ D(timer, s), linear between readings of
///   −1, −½, 0, ½ and 1; D is 0 at 0.
/// - reset: a trigger moves a timer, after its growth, by this share of the shorter way round to start_tick
///   (reset_timer); one that stands starts, unless the share is 0.
/// - load_feedback σ: a timer that runs grows by 2^ρ − σ n cos 2πφ ticks, from 0 to 2; n is the load of the
///   leg's foot by the robot's weight, at most 1, φ the timer's whole ticks before the tick by the period.
///   Where σ n cos 2πφ is 2^ρ or more it stands until the foot bears less: one that climbs stops behind three
///   quarters (held_advance). Owaki & Ishiguro 2017 have φ̇ = ω − σ N cos φ, which may also run backwards.
/// - refractory_ticks: in so many ticks after a trigger there is no other.
/// The CPPN has one more input, `sensor`, which is 0 for patterns and offsets and (i + 1)/n for sensor i of
/// n, and two more outputs, both limited to ± 1: `gain`, at the node's coordinates and each time, times
/// ModulationSettings::shape times half the joint's range is G; `rate`, at the coordinates of the leg's first
/// node with those at 0 that its offset has at 0, and time 0, times ModulationSettings::rate is a. They are
/// there whatever rate and shape are, so that these can be 0 for comparison.
/// With ShapeBy::reading there is no output `gain`, and an input for each sensor, `sensed.pitch`, in place of
/// `sensor`: D(t, s) is ModulationSettings::shape times what the targets of the node's pattern become where
/// the sensor's input is s and all others are 0; for a that input is 1.
class SupgArchitecture : public Architecture {
 public:
  /// Throws UserError: a period that is not a whole number of ticks; a substrate that does not fit the robot,
  /// or in which the SUPGs of a leg could get different offsets.
  SupgArchitecture(const SupgSettings& settings, const substrate::Settings& substrate,
                   const robot::RobotSpec& robot, double timestep_s, const SensingSettings& sensing = {})
      : SupgArchitecture(settings, substrate, robot, timestep_s, sensing, {}) {}

  std::string name() const override { return "supg"; }
  const std::vector<std::string>& cppn_inputs() const override { return layout_.input_names(); }
  const std::vector<std::string>& cppn_outputs() const override { return layout_.output_names(); }
  const substrate::Layout* substrate() const override { return &layout_; }
  const substrate::Layout& layout() const { return layout_; }
  std::unique_ptr<Parameters> decode(const cppn::Network& network) const override;
  std::unique_ptr<Batch> make_batch(int lanes) const override;
  std::string parameters_json(const Parameters& parameters) const override;

  robot::ExtraSenses extra_senses() const override;
  bool reads(const substrate::Sensor& sensor) const override;
  bool scales(const substrate::Sensor& sensor) const override;

  int period_ticks() const { return period_ticks_; }
  bool modulated() const { return settings_.modulation.any(); }
  /// With every target in the middle of its range and every offset 1.
  SupgParameters blank() const;
  /// For kinds that build on SUPGs without modulation.
  SupgBatch make_plain_batch(int lanes) const;

 protected:
  /// For a kind that has neurons beside SUPGs, with these properties (substrate::Needs); none: SUPGs alone.
  SupgArchitecture(const SupgSettings& settings, const substrate::Settings& substrate,
                   const robot::RobotSpec& robot, double timestep_s, const SensingSettings& sensing,
                   std::vector<std::string> neuron_properties);

  const SupgSettings& settings() const { return settings_; }
  const SupgJoints& joints() const { return joints_; }
  double timestep_s() const { return timestep_s_; }
  int types() const { return static_cast<int>(joint_types_.size()); }
  /// The targets and offsets that a CPPN gives.
  SupgParameters targets_of(const substrate::Decoded& decoded) const;
  ModulatedSupgs supgs(int lanes) const;

 private:
  std::optional<ContactEstimate> contact(int lanes) const;
  /// What a SUPG's pattern says: targets, rad, by tick.
  struct PatternTargets {
    JointRange range;
    const float* pattern;
    int period_ticks;
    double trend;
    float at_rad(int tick) const;
  };
  PatternTargets pattern_targets(int leg, int type, const std::vector<float>& patterns) const;

  int sensors() const { return static_cast<int>(settings_.modulation.sensors.size()); }
  int channels() const { return shape_channels(settings_.modulation); }
  // In supg_modulation.cpp.
  void add_modulation(const cppn::Network& network, ModulatedParameters& parameters) const;
  void add_rates(const cppn::Network& network, ModulatedParameters& parameters) const;
  void add_gains(const cppn::Network& network, ModulatedParameters& parameters) const;
  void add_readings(const cppn::Network& network, ModulatedParameters& parameters) const;
  std::vector<float> query_inputs(int node, int sensor) const;
  int joint(int leg, int type) const { return joints_.of_legs[to_index(leg * types() + type)]; }
  /// The node of the substrate that drives it; −1: none does.
  int driver(int leg, int type) const { return joint(leg, type) < 0 ? -1 : layout_.driver(joint(leg, type)); }
  /// The first node that drives a joint of the leg, whose offset is the leg's; −1: none does.
  int first_driver(int leg) const;
  int legs() const { return static_cast<int>(leg_names_.size()); }

  SupgSettings settings_;
  double timestep_s_;
  int period_ticks_;
  std::vector<std::string> leg_names_, joint_types_;
  SupgJoints joints_;
  std::vector<std::vector<int>> contact_joints_;
  std::vector<std::vector<LegSensor>> leg_sensors_;
  std::vector<LegSensor> leg_loads_;       ///< empty without load_feedback
  std::vector<std::size_t> offset_zeros_;  ///< coordinates that are 0 in queries of offsets and rates
  substrate::Layout layout_;
};

}  // namespace amble::controllers
