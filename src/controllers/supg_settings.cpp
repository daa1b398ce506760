#include "amble/controllers/supg_settings.hpp"

#include <cmath>

#include "amble/core/check.hpp"
#include "amble/core/error.hpp"

namespace amble::controllers {

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

}  // namespace amble::controllers
