#pragma once

#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "amble/controllers/supg_seam.hpp"
#include "amble/io/settings.hpp"

namespace amble::controllers {

/// What a leg's contact is known from: its foot's touch, the torque of a joint's motor, how far a joint is
/// behind its target, or a shock that the root feels.
enum class ContactSource { touch, torque, tracking, shock };
inline constexpr std::array<std::string_view, 4> contact_source_names{"touch", "torque", "tracking", "shock"};

/// What stands for the touch of a foot, for robots without foot switches. ContactEstimate says how.
struct ContactSettings {
  ContactSource source = ContactSource::touch;
  std::string joint_type;  ///< whose torque or lag it is; empty with touch and shock
  double threshold = 1.0;  ///< a contact begins above it, 0 … 1e6; N m, rad or rad/s², by `source`
  double release = 0.5;    ///< and ends below this share of it, 0 … 1

  void describe(io::SettingsVisitor& visitor);
  friend bool operator==(const ContactSettings&, const ContactSettings&) = default;
};

/// What shifts a target: what is sensed times a gain of the CPPN, or what the pattern becomes where the CPPN
/// has the reading as an input.
enum class ShapeBy { gain, reading };
inline constexpr std::array<std::string_view, 2> shape_by_names{"gain", "reading"};

/// How sensors change the cycles of a leg's SUPGs; off by default. SupgArchitecture says what it does.
struct ModulationSettings {
  std::vector<std::string> sensors;  ///< names as in docs/CONTROLLERS.md; empty: none
  double rate = 0.0;   ///< within ± this sensors change log2 of a leg's rate, 0 … 1; 0: not at all
  double shape = 0.0;  ///< halves of the joint's range, or with ShapeBy::reading of the pattern, 0 … 10
  ShapeBy shape_by = ShapeBy::gain;
  double reset = 1.0;          ///< share of the way to start_tick that a trigger moves the timer, 0 … 1
  int refractory_ticks = 0;    ///< after a trigger in which a leg has no other, 0 … 100,000
  double load_feedback = 0.0;  ///< gain of the feedback of a leg's load, 0 … 100; 0: none

  /// Whether anything differs from the paper's SUPGs.
  bool any() const { return !sensors.empty() || reset != 1.0 || refractory_ticks > 0 || load_feedback > 0.0; }
  void describe(io::SettingsVisitor& visitor);
  friend bool operator==(const ModulationSettings&, const ModulationSettings&) = default;
};

/// What triggers the SUPGs of a leg: its foot coming down, its foot being down, nothing, or moments drawn by
/// chance (controllers/supg_batch.hpp). The last two are controls: no trigger, and one that says nothing
/// of the ground.
enum class Trigger { edge, level, none, random };
inline constexpr std::array<std::string_view, 4> trigger_names{"edge", "level", "none", "random"};

/// What the evolved offset of a leg is: the timer's value before the first tick, or how long the leg waits
/// before its timer starts.
enum class Offset { phase, delay };
inline constexpr std::array<std::string_view, 2> offset_names{"phase", "delay"};

/// What a SUPG does at the end of its period if no trigger came: stop with its joint in the middle of the
/// range, stop and hold the last value, or begin again.
enum class Idle { mid, hold, wrap };
inline constexpr std::array<std::string_view, 3> idle_names{"mid", "hold", "wrap"};

/// Single-unit pattern generators (Morse et al. 2013, sec. 3). The defaults are what the authors' code did;
/// the text leaves some of it open. controllers/supg.hpp specifies what each setting does.
struct SupgSettings {
  double period_s = 1.0;
  Trigger trigger = Trigger::edge;
  int trigger_debounce_ticks = 1;
  Offset offset = Offset::phase;
  int start_tick = 1;
  Idle idle = Idle::mid;
  SeamSettings seam = {};
  ContactSettings contact = {};
  ModulationSettings modulation = {};

  void describe(io::SettingsVisitor& visitor);
};

/// period_s in ticks; `timestep_s` > 0 (AMBLE_CHECK). Throws SettingError unless that is a whole number, 2 …
/// 100,000.
int period_ticks(const SupgSettings& settings, double timestep_s);

/// What the timer of a leg does, in ticks: the settings as batches and exports follow them.
struct CycleRule {
  int end = 0;                    ///< the timer's value where a period ends without a trigger; −1: stopped
  int airborne_ticks_needed = 0;  ///< ticks off the ground before a touch is a trigger; 0: each touch is one
  bool by_touch = true;           ///< whether touches are triggers at all
};
CycleRule cycle_rule(const SupgSettings& settings, int period_ticks);

}  // namespace amble::controllers
