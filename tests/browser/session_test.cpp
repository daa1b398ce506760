#include "amble/browser/session.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "amble/browser/fused_check.hpp"
#include "amble/browser/interface.hpp"
#include "amble/core/error.hpp"
#include "amble/core/hash.hpp"
#include "amble/core/index.hpp"
#include "amble/io/json_file.hpp"
#include "tests/browser/champion.hpp"

namespace amble::browser {
namespace {

using experiment::parse_champion_for;
using experiment::parse_inputs;
using experiment::replay_live;

io::Json description(const Session& session) {
  return io::parse_json(session.describe(), "description");
}

/// The value of a column of Session::state().
double value(Session& session, const std::string& column) {
  const auto names = description(session).at("columns");
  for (std::size_t i = 0; i < names.size(); ++i)
    if (names[i] == column) return session.state().at(i);
  ADD_FAILURE() << "no column " << column;
  return 0.0;
}

std::string ground_json(const Session& session, const std::string& kind, double slope_x = 0.0) {
  io::Json ground = description(session).at("ground");
  ground["kind"] = kind;
  ground["height_m"] = 0.02;
  ground["slope_x"] = slope_x;
  return ground.dump();
}

std::string damage_json(const std::string& kind, const std::string& leg, const std::string& joint = "",
                        double from_s = 0.0) {
  const io::Json part{{"kind", kind},     {"leg", leg},   {"joint", joint},  {"body", ""},
                      {"angle_rad", 0.0}, {"share", 0.5}, {"mass_kg", 0.1},  {"x_m", 0.0},
                      {"y_m", 0.0},       {"z_m", 0.0},   {"from_s", from_s}};
  return io::Json{{"parts", {part}}}.dump();
}

TEST(Session, WithoutInputsEachStepIsThatOfTheChampionsOwnTrialToTheBit) {
  const Session session(tests::champion_text());
  EXPECT_EQ(session.steps_as_recorded(), 1500);
}

TEST(Session, WhatIsLiftedFallsFromThere) {
  Session lifted(tests::champion_text()), left(tests::champion_text());
  const auto height_m = [](Session& session) {
    const auto columns =
        nlohmann::json::parse(session.describe()).at("columns").get<std::vector<std::string>>();
    return session.state().at(to_index(std::ranges::find(columns, "com.z") - columns.begin()));
  };
  lifted.step(50);
  left.step(50);
  lifted.lift(0.5);
  lifted.step(1);
  left.step(1);
  EXPECT_NEAR(height_m(lifted) - height_m(left), 0.5, 0.01);
  constexpr double fall_s = 0.2, g = 9.81;
  lifted.step(20);
  EXPECT_NEAR(height_m(lifted) - height_m(left), 0.5 - 0.5 * g * fall_s * fall_s, 0.03);
  lifted.step(100);
  EXPECT_LT(height_m(lifted), height_m(left) + 0.1) << "it is down again";
  for (const double wrong : {0.0, -1.0, 101.0, std::nan("")}) EXPECT_THROW(lifted.lift(wrong), UserError);
}

TEST(Session, WhatWasDoneIsRepeatedToTheBit) {
  const std::string champion = tests::champion_text();
  Session session(champion);
  session.step(120);
  session.push({0.1, 0.2, 0.0});
  session.step(80);
  session.lift(0.3);
  session.step(80);
  session.set_ground(ground_json(session, "rough", 0.05));
  session.step(200);
  session.set_damage(damage_json("missing", "rear_left"));
  session.step(150);
  session.set_damage(damage_json("locked", "", "front_left_hip"));
  session.step(50);
  session.push({0.0, 0.1, 0.0});  // comes before a step that is not made, and is no part of the session

  const auto record = parse_inputs(session.inputs(), "inputs");
  EXPECT_EQ(record.inputs.size(), 5u);
  EXPECT_EQ(record.champion, hex(hash_text(champion)));
  const auto again = replay_live(parse_champion_for(record.engine, champion, "champion"), record);
  EXPECT_EQ(again.steps, 680);
  EXPECT_EQ(again.first_difference, std::nullopt);
}

TEST(Session, AnotherBitIsFoundAtItsStep) {
  const std::string champion = tests::champion_text();
  Session session(champion);
  session.step(50);
  auto record = parse_inputs(session.inputs(), "inputs");
  record.trace[29] ^= 1u;
  EXPECT_EQ(replay_live(parse_champion_for(record.engine, champion, "champion"), record).first_difference,
            30);
}

TEST(Session, WhatBeganLaterGoesOnToCountWhateverTheListsOrder) {
  const auto part = [](const std::string& kind, double from_s) {
    return io::Json::parse(damage_json(kind, "", "front_left_hip", from_s)).at("parts").at(0);
  };
  const io::Json locked = part("locked", 0.1), weak = part("weak", 0.5);
  Session in_time(tests::champion_text()), turned(tests::champion_text());
  in_time.set_damage(io::Json{{"parts", {locked, weak}}}.dump());
  turned.set_damage(io::Json{{"parts", {weak, locked}}}.dump());
  for (Session* const session : {&in_time, &turned}) {
    session->step(100);
    session->lift(0.1);
    session->step(100);
  }
  EXPECT_EQ(in_time.state(), turned.state());
}

TEST(Session, GoesOnWhereItIsWhenGroundOrBodyChange) {
  Session session(tests::champion_text());
  session.step(300);
  const double x_m = value(session, "com.x"), knee_rad = value(session, "angle.front_left_knee");
  session.set_ground(ground_json(session, "plane", 0.1));
  EXPECT_NEAR(value(session, "com.x"), x_m, 1e-5);
  EXPECT_NEAR(value(session, "angle.front_left_knee"), knee_rad, 1e-6);
  session.set_damage(damage_json("missing", "rear_left"));
  EXPECT_NEAR(value(session, "com.x"), x_m, 0.05);  // a leg less has moved the centre of mass
  EXPECT_EQ(value(session, "step"), 300.0);
  EXPECT_EQ(session.step(10), 10);
}

TEST(Session, ALegThatIsLostStaysLostWhateverIsDoneAndOneThatWillBeIsLostOnTime) {
  Session session(tests::champion_text());
  session.step(50);
  session.set_damage(damage_json("missing", "rear_left", "", 1.0));
  const auto is_there = [&] { return value(session, "angle.rear_left_hip") != 0.0; };
  session.step(30);
  session.lift(0.01);
  session.step(20);
  EXPECT_TRUE(is_there());
  session.step(1);
  EXPECT_FALSE(is_there());
  session.lift(0.01);
  session.step(1);
  EXPECT_FALSE(is_there());
  session.set_ground(ground_json(session, "rough"));
  session.step(20);
  EXPECT_FALSE(is_there());
}

TEST(Session, OnNewGroundItIsLiftedOutOfIt) {
  Session session(tests::champion_text());
  session.step(300);
  const double z_m = value(session, "root.z");
  io::Json ground = description(session).at("ground");
  ground["kind"] = "hills";
  ground["height_m"] = 0.5;
  ground["start_radius_m"] = 0.1;
  EXPECT_EQ(session.heights_m(), nullptr);
  session.set_ground(ground.dump());
  EXPECT_NE(session.heights_m(), nullptr);
  EXPECT_GE(value(session, "root.z"), z_m - 1e-6);
  EXPECT_EQ(session.step(100), 100);
}

TEST(Session, WhatDoesNotFitIsRefusedAndNothingHasChanged) {
  Session session(tests::champion_text());
  session.step(10);
  EXPECT_THROW(session.set_damage(damage_json("missing", "fifth")), UserError);
  EXPECT_THROW(session.set_ground("{\"kind\": \"swamp\"}"), UserError);
  EXPECT_THROW(session.set_ground("{"), UserError);
  session.step(10);
  Session undisturbed(tests::champion_text());
  undisturbed.step(20);
  EXPECT_EQ(session.trace(), undisturbed.trace());
}

TEST(Session, StartsAgainWithWhatItHasOrAsEvolved) {
  Session session(tests::champion_text());
  session.set_damage(damage_json("numb", "rear_left"));
  session.step(200);
  const auto trace = session.trace();
  session.restart(false);
  EXPECT_EQ(value(session, "step"), 0.0);
  session.step(200);
  EXPECT_EQ(session.trace(), trace);
  session.restart(true);
  EXPECT_EQ(description(session).at("damage").at("parts").size(), 0u);
  session.step(200);
  EXPECT_NE(session.trace(), trace);
}

TEST(Session, TellsOneThatObeysAndItGoesElsewhere) {
  Session session(tests::obeying_champion_text()), other(tests::obeying_champion_text());
  EXPECT_GT(description(session).at("commands").at("most_speed_m_s").get<double>(), 0.0);
  session.step(100);
  other.step(100);
  EXPECT_EQ(session.trace(), other.trace());
  session.command({0.2f, 0.3f});
  other.command({0.2f, -0.3f});
  session.step(600);
  other.step(600);
  EXPECT_NE(session.trace(), other.trace());
  EXPECT_FLOAT_EQ(static_cast<float>(value(session, "command.speed")), 0.2f);
  EXPECT_FLOAT_EQ(static_cast<float>(value(other, "command.turn")), -0.3f);

  const auto champion = parse_champion_for(engine, tests::obeying_champion_text(), "champion");
  const auto replay = replay_live(champion, parse_inputs(session.inputs(), "inputs"));
  EXPECT_EQ(replay.first_difference, std::nullopt);
  EXPECT_EQ(replay.steps, 700);
}

TEST(Session, StartsAgainWithTheLastCommandOrAsEvolved) {
  Session session(tests::obeying_champion_text()), untold(tests::obeying_champion_text());
  session.command({0.0f, 0.3f});
  session.step(300);
  const auto trace = session.trace();
  session.restart(false);
  session.step(300);
  EXPECT_EQ(session.trace(), trace);
  session.restart(true);
  session.step(300);
  untold.step(300);
  EXPECT_EQ(session.trace(), untold.trace());
  EXPECT_NE(session.trace(), trace);
}

TEST(Session, RefusesCommandsThatNobodySensesOrThatAreNone) {
  Session deaf(tests::champion_text()), obeys(tests::obeying_champion_text());
  EXPECT_TRUE(description(deaf).at("commands").is_null());
  EXPECT_THROW(deaf.command({0.1f, 0.0f}), UserError);
  EXPECT_THROW(obeys.command({std::numeric_limits<float>::infinity(), 0.0f}), UserError);
  deaf.step(10);
  Session undisturbed(tests::champion_text());
  undisturbed.step(10);
  EXPECT_EQ(deaf.trace(), undisturbed.trace());
}

TEST(Session, RefusesPushesThatAreNoNumbersAndStepsBackwards) {
  Session session(tests::champion_text()), undisturbed(tests::champion_text());
  for (const double wrong : {std::nan(""), std::numeric_limits<double>::infinity(), 1e300})
    EXPECT_THROW(session.push({0.0, wrong, 0.0}), UserError);
  EXPECT_THROW(session.step(-1), UserError);
  session.step(10);
  undisturbed.step(10);
  EXPECT_EQ(session.trace(), undisturbed.trace());
}

TEST(Session, RefusesWhatIsNoChampion) {
  EXPECT_THROW(Session("{}"), UserError);
  EXPECT_THROW(Session("no JSON"), UserError);
  std::string altered = tests::champion_text();
  altered.replace(altered.find("\"generation\": "), 15, "\"generation\": 9");
  EXPECT_THROW(Session{altered}, UserError);
}

TEST(Interface, DoesWhatTheSessionDoes) {
  const std::string champion = tests::champion_text();
  const auto give = [](const std::string& text) {
    std::copy(text.begin(), text.end(), amble_text(text.size()));
  };
  const auto taken = [] { return std::string(amble_result(), amble_result_size()); };
  give(champion);
  amble_open();
  EXPECT_EQ(amble_step(100), 100);
  amble_push(0.05, 0.0, 0.0);
  amble_lift(0.1);
  amble_step(100);
  Session session(champion);
  session.step(100);
  session.push({0.05, 0.0, 0.0});
  session.lift(0.1);
  session.step(100);
  amble_inputs();
  EXPECT_EQ(taken(), session.inputs());
  amble_describe();
  EXPECT_EQ(taken(), session.describe());
  EXPECT_EQ(amble_state()[0], 200.0);
  EXPECT_EQ(amble_heights(), nullptr);
}

TEST(Fused, KernelsAddProductsUnrounded) {
  EXPECT_TRUE(is_fused());
}

}  // namespace
}  // namespace amble::browser
