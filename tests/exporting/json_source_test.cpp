#include "amble/exporting/json_source.hpp"

#include <gtest/gtest.h>

#include <set>
#include <string>
#include <variant>
#include <vector>

#include "amble/exporting/c_source.hpp"
#include "amble/io/json_file.hpp"
#include "amble/neat/genome_json.hpp"
#include "amble/robot/json.hpp"
#include "tests/exporting/champions.hpp"

namespace amble::exporting {
namespace {

io::Json document_of(const experiment::Champion& champion) {
  const std::atomic<bool> stop{false};
  const std::string text =
      json_source(champion, controller_tables(champion.problem, champion.genome), provenance_of(champion),
                  record_trace(champion.problem, champion.genome, 20, stop));
  return io::unseal_json("amble-export", 1, text, "text").document;
}

tests::Sample sample(const std::string& name) {
  for (const tests::Sample& one : tests::twenty_samples())
    if (one.name == name) return one;
  return {};
}

TEST(JsonSource, HasTheTablesOfSupgs) {
  const experiment::Champion champion = tests::evolve(sample("quadruped_supg"));
  const io::Json json = document_of(champion);
  EXPECT_EQ(json["provenance"]["seed"], 7);
  EXPECT_EQ(json["controller"]["rate_hz"], 100.0);
  EXPECT_EQ(json["controller"]["joints"].size(), 12u);
  EXPECT_EQ(json["controller"]["joints"][0]["name"], "FL_knee");
  EXPECT_EQ(json["controller"]["joints"][0]["leg"], "FL");
  EXPECT_EQ(json["controller"]["sensors"].size(), 1u);
  const io::Json& supg = json["controller"]["supg"];
  EXPECT_EQ(supg["period_ticks"], 100);
  ASSERT_EQ(supg["targets_rad"].size(), 12u);
  EXPECT_EQ(supg["targets_rad"][0].size(), 101u);
  EXPECT_EQ(json["test"]["ticks"].size(), 20u);
  EXPECT_EQ(robot::from_json(io::JsonView(json["robot"], "text")).joints.size(), 12u);
  EXPECT_EQ(neat::genome_from_json(io::JsonView(json["genome"], "text")), champion.genome);
}

TEST(JsonSource, TellsHowAWalkerIsSteeredByHand) {
  experiment::Champion champion = tests::evolve({.name = "", .preset = "authors/supg"});
  EXPECT_FALSE(document_of(champion).contains("differential"));
  champion.problem.set_commands({.kind = trial::CommandKind::fixed, .stretches = {{0.3, 0.2}}});
  champion.problem.set_differential({.turn_gain = 4.0, .full_speed_m_s = 0.25, .heading_gain = 0.5});
  const io::Json json = document_of(champion);
  EXPECT_EQ(json["differential"]["turn_gain"], 4.0);
  EXPECT_EQ(json["differential"]["joints"].size(), 12u);
  const io::Json& tick = json["test"]["ticks"][0];
  EXPECT_TRUE(tick.contains("command") && tick.contains("heading_error_rad") &&
              tick.contains("attitude_rad"));
}

TEST(JsonSource, AndTheHeaderTellJointsWithoutAMotorAndFeetOfSeveralShapes) {
  experiment::Champion champion = tests::evolve({.name = "", .preset = "authors/supg", .robot = "sprung"});
  robot::RobotSpec& robot = champion.problem.robot;
  robot.geoms.push_back(robot.geoms[static_cast<std::size_t>(robot.legs[0].foot_geoms[0])]);
  robot.geoms.back().name = "L1_heel";
  robot.legs[0].foot_geoms.push_back(static_cast<int>(robot.geoms.size()) - 1);
  const io::Json json = document_of(champion);
  const io::Json& joints = json["controller"]["joints"];
  EXPECT_FALSE(joints[0].contains("motor"));
  EXPECT_EQ(joints[joints.size() - 1]["motor"], false);
  EXPECT_EQ(joints[joints.size() - 1]["driven"], false);
  EXPECT_EQ(json["robot"]["legs"][0]["foot_geoms"].size(), 2u);

  const std::atomic<bool> stop{false};
  const CSource c =
      c_source(controller_tables(champion.problem, champion.genome), robot, provenance_of(champion),
               record_trace(champion.problem, champion.genome, 5, stop), {.prefix = "w", .start = ""});
  EXPECT_NE(c.header.find("no motor, its target"), std::string::npos) << c.header;
  EXPECT_NE(c.header.find("the foot of 'L1': any of 'L1_foot', 'L1_heel'"), std::string::npos) << c.header;
  EXPECT_EQ(c.header.find("the foot of 'R1'"), std::string::npos);
}

TEST(JsonSource, HasWhatHoldsTimersByTheLoadOfTheirFeet) {
  const io::Json json = document_of(
      tests::evolve({"load", "authors/supg", "quadruped", {"controller.supg.modulation.load_feedback=4"}}));
  const io::Json& load = json["controller"]["supg"]["modulation"]["load_feedback"];
  EXPECT_EQ(load["strength"], 4.0);
  EXPECT_EQ(load["loads"].size(), json["controller"]["legs"].size());
  EXPECT_EQ(load["loads"][1]["reads"], "load." + json["controller"]["legs"][1].get<std::string>());
  const std::size_t period = json["controller"]["supg"]["period_ticks"];
  ASSERT_EQ(load["cosines"].size(), period + 1);
  EXPECT_EQ(load["cosines"][0], 1.0);
  EXPECT_NEAR(load["cosines"][period / 2].get<double>(), -1.0, 1e-6);
}

TEST(JsonSource, HasEachSumOfAMixedSubstrateUnderItsName) {
  const experiment::Champion champion =
      experiment::load_champion(std::string(AMBLE_SOURCE_DIR) + "/robots/hexapod/steered.json");
  const SupgTables::Mixed mixed =
      *std::get<SupgTables>(controller_tables(champion.problem, champion.genome).parts).mixed;
  const io::Json json = document_of(champion)["controller"]["supg"]["mixed"];
  std::set<std::string> different;
  const auto expect_sums = [&](const char* name, const std::vector<std::vector<WeightedLink>>& sums) {
    io::Json expected = io::Json::array();
    for (const auto& links : sums) {
      expected.push_back(io::Json::array());
      for (const WeightedLink& link : links) expected.back().push_back({link.source, link.weight});
    }
    EXPECT_EQ(json[name], expected) << name;
    different.insert(expected.dump());
  };
  expect_sums("rates", mixed.rates);
  expect_sums("amplitudes", mixed.amplitudes);
  expect_sums("shifts", mixed.shifts);
  expect_sums("pulls", mixed.pulls);
  EXPECT_EQ(different.size(), 4u) << "or two names could be confused";
}

/// What a reader of the document would compute from its tables, for one tick of a network without cycles.
TEST(JsonSource, HasNetworksThatGiveTheRecordedTargets) {
  const io::Json json = document_of(tests::evolve(sample("hexapod_sine")));
  const io::Json &controller = json["controller"], &neural = controller["neural"];
  ASSERT_EQ(neural["update"], "levels");
  const io::Json& tick = json["test"]["ticks"][0];
  std::vector<double> sensors, neurons;
  std::multiset<std::string> read;
  for (const io::Json& sensor : neural["sensors"]) {
    const std::string reads = sensor["reads"];
    read.insert(reads);
    double value = 0.0;  // of the sine at time 0, and of the attitude in the start pose
    for (std::size_t j = 0; j < controller["joints"].size(); ++j)
      if (reads == "angle." + std::string(controller["joints"][j]["name"])) value = tick["angle_rad"][j];
    for (std::size_t l = 0; l < controller["legs"].size(); ++l)
      if (reads == "touch." + std::string(controller["legs"][l])) value = tick["touch"][l];
    sensors.push_back(value);
  }
  for (const char* name : {"roll", "pitch", "yaw", "sine"}) EXPECT_EQ(read.count(name), 1u) << name;
  for (const io::Json& neuron : neural["neurons"]) {
    double sum = 0.0;
    for (const io::Json& link : neuron["from_sensors"])
      sum += double(link[1]) * sensors[std::size_t(link[0])];
    for (const io::Json& link : neuron["from_neurons"])
      sum += double(link[1]) * neurons[std::size_t(link[0])];
    neurons.push_back(1.0 / (1.0 + std::exp(-double(neural["slope"]) * sum)));
  }
  for (std::size_t j = 0; j < controller["joints"].size(); ++j) {
    const io::Json& range = controller["joints"][j]["command_rad"];
    const int driver = neural["neuron_of_joint"][j];
    ASSERT_GE(driver, 0);
    const double target_rad =
        double(range[0]) + (double(range[1]) - double(range[0])) * neurons[static_cast<std::size_t>(driver)];
    // amble's sums and logistics are float32: 6e-8 of each term, tens of terms per layer, times the slope.
    EXPECT_NEAR(target_rad, double(tick["target_rad"][j]), 1e-5) << j;
  }
}

}  // namespace
}  // namespace amble::exporting
