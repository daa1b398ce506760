#include "amble/controllers/supg_settings.hpp"

#include <cmath>

#include "amble/core/check.hpp"
#include "amble/core/error.hpp"

namespace amble::controllers {

void ContactSettings::describe(io::SettingsVisitor& visitor) {
  visitor.choice(
      "source", source, contact_source_names,
      {"what a leg's contact is known from: its foot (touch), the torque of a joint's motor (torque, "
       "N m), how far a joint is from its last target (tracking, rad), or how suddenly roll and pitch "
       "change (shock, rad/s²), which is put down to the leg without a contact for longest",
       "Morse et al. 2013: touch"});
  visitor.text(
      "joint_type", joint_type,
      {"of torque and tracking: the leg's joint of this type; empty: the one with the largest number"});
  visitor.number("threshold", threshold, {0.0, 1e6},
                 {"a contact begins where that number is larger, in its unit"});
  visitor.number("release", release, {0.0, 1.0},
                 {"it ends where the number is at most this share of the threshold"});
}

void ModulationSettings::describe(io::SettingsVisitor& visitor) {
  visitor.texts(
      "sensors", sensors,
      {"what a leg's SUPGs sense: of the leg itself touch, load, and angle.TYPE, speed.TYPE, torque.TYPE by "
       "joint type; of the robot roll, pitch, yaw, yaw_rate; command_speed, command_turn, command_stop, "
       "heading_error"});
  visitor.number("rate", rate, {0.0, 1.0},
                 {"how far sensors may change a leg's rate: a factor of 2 to the power of ± this; 0: not"});
  visitor.number(
      "shape", shape, {0.0, 10.0},
      {"how far one sensor may shift a target, in halves of the joint's range (by gain), or by which "
       "share of what the pattern says (by reading); 0: not"});
  visitor.choice(
      "shape_by", shape_by, shape_by_names,
      {.what = "what is sensed shifts targets by a gain that the CPPN gives it (gain), or is an input of "
               "the CPPN, which says another pattern for each reading (reading)",
       .first_is_implied = true});
  visitor.number("reset", reset, {0.0, 1.0},
                 {"share of the way to start_tick that a trigger moves the timer: 1 all of it, 0 none",
                  "Morse et al. 2013: 1"});
  visitor.integer("refractory_ticks", refractory_ticks, {0, 100000},
                  {"ticks after a trigger in which a leg has no other", "Morse et al. 2013: 0"});
  visitor.number(
      "load_feedback", load_feedback, {0.0, 100.0},
      {"how strongly the load of a leg's foot, as a share of the robot's weight, holds the leg's timer "
       "behind three quarters of the period, until it bears less; 0: not",
       "after Owaki & Ishiguro 2017 (Tegotae); Morse et al. 2013: 0"});
}

void SupgSettings::describe(io::SettingsVisitor& visitor) {
  visitor.number("period_s", period_s, {0.001, 60.0},
                 {"length of a SUPG's pattern, s; a whole number of ticks",
                  "the authors' code; Morse et al. 2013, sec. 4"});
  visitor.choice("trigger", trigger, trigger_names,
                 {"a leg's SUPGs are triggered when its foot comes down (edge), in each tick in which it "
                  "is down (level), never (none), or, whatever the foot does, at moments drawn by chance, "
                  "a period apart on average and the same in every trial (random)",
                  "the authors' code: edge"});
  visitor.integer("trigger_debounce_ticks", trigger_debounce_ticks, {1, 1000},
                  {"ticks a foot must have been off the ground before its next touch is an edge",
                   "the authors' code: 1"});
  visitor.choice(
      "offset", offset, offset_names,
      {"the evolved offset is the timer's value before the first tick (phase) or a wait before the "
       "timer starts (delay)",
       "the authors' code: phase; Morse et al. 2013, sec. 3: delay"});
  visitor.integer(
      "start_tick", start_tick, {0, 1},
      {"timer value in the tick of a trigger, ticks", "the authors' code: 1; Morse et al. 2013, fig. 3: 0"});
  visitor.choice("idle", idle, idle_names,
                 {"at the end of the period a SUPG puts its joint to mid-range (mid), keeps its last value "
                  "(hold) or begins again (wrap)",
                  "the authors' code: mid; Morse et al. 2013 do not say"});
  visitor.table(
      "seam", seam,
      {.what = "how targets pass from one cycle to the next, at a trigger or at the end of a period",
       .source = "Morse et al. 2013, sec. 6, name it as future work",
       .defaults_are_implied = true});
  visitor.table("contact", contact,
                {.what = "what stands for the touch of a foot that triggers", .defaults_are_implied = true});
  visitor.table("modulation", modulation,
                {.what = "how sensors change period and shape of the cycles; off by default",
                 .source = "Morse et al. 2013, sec. 6, name it as future work",
                 .defaults_are_implied = true});
}

int period_ticks(const SupgSettings& settings, double timestep_s) {
  AMBLE_CHECK(timestep_s > 0.0, "a timestep is positive");
  const double ticks = settings.period_s / timestep_s, whole = std::round(ticks);
  // A period written in decimals is rarely a multiple to the last bit.
  if (!(whole >= 2.0 && whole <= 1e5) || std::fabs(ticks - whole) > 1e-9 * whole)
    fail_setting(
        {"controller.supg.period_s", "trial.timestep_s"},
        "controller.supg.period_s = {} is {} ticks of {} s: expected a whole number from 2 to 100000",
        settings.period_s, ticks, timestep_s);
  return static_cast<int>(whole);
}

CycleRule cycle_rule(const SupgSettings& settings, int period_ticks) {
  CycleRule rule;
  switch (settings.idle) {
    case Idle::mid:
      rule.end = -1;
      break;
    case Idle::hold:
      rule.end = period_ticks;
      break;
    case Idle::wrap:
      rule.end = 0;
      break;
  }
  rule.by_touch = settings.trigger == Trigger::edge || settings.trigger == Trigger::level;
  rule.airborne_ticks_needed = settings.trigger == Trigger::level ? 0 : settings.trigger_debounce_ticks;
  return rule;
}

}  // namespace amble::controllers
