#pragma once

#include <array>
#include <string_view>

#include "amble/controllers/supg_modulation.hpp"
#include "amble/controllers/supg_seam.hpp"
#include "amble/io/settings.hpp"

namespace amble::controllers {

/// What triggers the SUPGs of a leg: its foot coming down, its foot being down, nothing, or moments drawn by
/// chance (controllers/random_triggers.hpp). The last two are controls: no trigger, and one that says nothing
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

/// period_s in ticks. Throws UserError unless that is a whole number of at least 2.
int period_ticks(const SupgSettings& settings, double timestep_s);

}  // namespace amble::controllers
