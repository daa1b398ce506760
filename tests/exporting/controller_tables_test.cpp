#include "amble/exporting/controller_tables.hpp"

#include <gtest/gtest.h>

#include <variant>

#include "amble/core/error.hpp"
#include "tests/exporting/champions.hpp"

namespace amble::exporting {
namespace {

using controllers::Idle;

TEST(ControllerTables, OfAPhaseAtTheEndOfThePeriodBeginWithWhatFollowsACycle) {
  // Offsets are from 1 tick to one less than the period: with a period of 2 ticks each is 1, the last tick.
  experiment::Champion champion =
      tests::evolve({.name = "",
                     .preset = "authors/supg",
                     .assignments = {"controller.supg.offset=phase", "controller.supg.period_s=0.02"}});
  for (const auto& [idle, first_timer] : {std::pair{Idle::mid, -1}, {Idle::hold, 2}, {Idle::wrap, 0}}) {
    champion.problem.controller.supg.idle = idle;
    const auto tables = std::get<SupgTables>(controller_tables(champion.problem, champion.genome).parts);
    ASSERT_EQ(tables.period_ticks, 2);
    ASSERT_EQ(tables.legs.size(), 4u);
    for (const SupgTables::Leg& leg : tables.legs) {
      EXPECT_EQ(leg.offset_ticks, 1);
      EXPECT_EQ(leg.first_timer, first_timer);
    }
    // A target for each value of the timer, from −1 on.
    for (const auto& targets : tables.targets_rad) EXPECT_EQ(targets.size(), idle == Idle::hold ? 4u : 3u);
  }
}

TEST(ControllerTables, RefuseTriggersByChance) {
  experiment::Champion champion = tests::evolve({.name = "", .preset = "authors/supg"});
  champion.problem.controller.supg.trigger = controllers::Trigger::random;
  try {
    controller_tables(champion.problem, champion.genome);
    ADD_FAILURE() << "expected a refusal";
  } catch (const UserError& error) {
    EXPECT_EQ(error.code(), ExitCode::bad_input);
    EXPECT_STREQ(error.what(),
                 "controller.supg.trigger = \"random\" cannot be exported: it is a control for simulations; "
                 "expected \"edge\", \"level\" or \"none\"");
  }
}

}  // namespace
}  // namespace amble::exporting
