#include "amble/experiment/idle_settings.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "amble/experiment/config.hpp"
#include "tests/experiment/fixture.hpp"

namespace amble::experiment {
namespace {

TEST(IdleSettings, TheSeedOfAGroundThatIsAlwaysTheSameIsNamed) {
  const auto idle = [](const std::string& kind, const std::string& place) {
    const std::vector<std::string> assignments{"ground.height_m=0.05", "ground.kind=" + kind,
                                               "ground.start_place_m=" + place, "ground.seed=7",
                                               "ground.vary=generations"};
    const Overrides overrides{.assignments = assignments, .seed = {}, .generations = {}};
    return idle_assignments(load_config(AMBLE_SOURCE_DIR "/configs/quick/quadruped.toml", overrides),
                            assignments)
        .size();
  };
  EXPECT_EQ(idle("hurdles", "0"), 2u);
  EXPECT_EQ(idle("stairs", "0"), 2u);
  EXPECT_EQ(idle("hurdles", "2"), 0u);
  EXPECT_EQ(idle("rough", "0"), 0u);
}

TEST(IdleSettings, AssignmentsThatAConfigDoesNotUseAreNamed) {
  const auto idle = [](const std::string& preset, const std::vector<std::string>& assignments) {
    const Overrides overrides{.assignments = assignments, .seed = {}, .generations = {}};
    return idle_assignments(load_config(std::string(AMBLE_SOURCE_DIR "/configs/") + preset, overrides),
                            assignments);
  };
  using testing::ElementsAre;
  EXPECT_THAT(idle("authors/supg-objective.toml",
                   {"controller.supg.offset=phase", "seed=2", "controller.ctrnn.steps_per_tick=3",
                    "search.novelty.neighbours=5", "population.size=30"}),
              ElementsAre("controller.ctrnn.steps_per_tick has no effect: controller.kind is \"supg\"",
                          "search.novelty.neighbours has no effect: search.kind is \"objective\""));
  EXPECT_THAT(idle("authors/supg-objective.toml",
                   {"controller.kind=mixed", "controller.substrate=auto", "controller.supg.idle=mid",
                    "search.kind=novelty", "search.novelty.neighbours=5"}),
              ElementsAre());
  EXPECT_THAT(idle("authors/sine-objective.toml", {"controller.supg.idle=mid"}),
              ElementsAre("controller.supg.idle has no effect: controller.kind is \"network\""));
  const std::string contact = "controller.supg.contact.", modulation = "controller.supg.modulation.";
  EXPECT_THAT(
      idle("authors/supg-objective.toml", {modulation + "rate=1", contact + "threshold=3",
                                           "controller.supg.seam.filter_order=1", "command.stretch_s=3"}),
      ElementsAre(modulation + "rate has no effect: " + modulation + "sensors is empty",
                  contact + "threshold has no effect: " + contact + "source is \"touch\"",
                  "controller.supg.seam.filter_order has no effect: controller.supg.seam.filter_s is 0",
                  "command.stretch_s has no effect: command.kind is \"none\""));
  EXPECT_THAT(idle("authors/supg-objective.toml",
                   {modulation + "sensors=['pitch']", modulation + "rate=1", modulation + "shape_by=reading",
                    contact + "source=shock", contact + "joint_type=knee", contact + "threshold=3"}),
              ElementsAre(modulation + "shape_by has no effect: " + modulation + "shape is 0",
                          contact + "joint_type has no effect: " + contact + "source is \"shock\""));
  EXPECT_THAT(idle("authors/supg-objective.toml", {"controller.supg.trigger=none", contact + "source=torque",
                                                   "search.kind=cma-es", "mutation.add_link_share=0.2"}),
              ElementsAre(contact + "source has no effect: controller.supg.trigger waits for no contact",
                          "mutation.add_link_share has no effect: search.kind is \"cma-es\""));
  EXPECT_THAT(
      idle("authors/supg-objective.toml",
           {"search.kind=cma-es", "genome.initial_link_probability=0.5", "innovations.scope=generation"}),
      ElementsAre(testing::StartsWith("genome.initial_link_probability has no effect"),
                  testing::StartsWith("innovations.scope has no effect")));
}

TEST(IdleSettings, OfCommandsAreThoseOfTheOtherKind) {
  const auto idle = [](const std::vector<std::string>& assignments) {
    const Overrides overrides{.assignments = assignments, .seed = {}, .generations = {}};
    return idle_assignments(load_config(AMBLE_SOURCE_DIR "/configs/"
                                                         "steer/supg.toml",
                                        overrides),
                            assignments);
  };
  using testing::ElementsAre;
  EXPECT_THAT(idle({"command.stretches=[{speed_m_s=0.3}]", "command.mirrored=false"}), ElementsAre())
      << "without anything by chance the stretches are commanded";
  EXPECT_THAT(idle({"command.kind=fixed", "command.stretches=[{speed_m_s=0.3}]", "command.mirrored=false"}),
              ElementsAre("command.mirrored has no effect: command.kind is \"fixed\""));
}

/// What a problem of this config does not use.
std::vector<std::string> idle_of(const std::string& config, const std::vector<std::string>& assignments) {
  const Config read = load_config(std::string(AMBLE_SOURCE_DIR "/configs/") + config,
                                  {.assignments = assignments, .seed = {}, .generations = {}});
  return idle_parts(Problem::make(read, load_robot_file(read.robot)));
}

TEST(IdleAssignments, AreThoseOfAMapThatIsNotFilledSoAndOfScoresAndGroundsThatAreNotThere) {
  const auto count = [](const std::string& config, const std::vector<std::string>& assignments) {
    const Overrides overrides{.assignments = assignments, .seed = {}, .generations = {}};
    return idle_assignments(load_config(std::string(AMBLE_SOURCE_DIR "/configs/") + config, overrides),
                            assignments)
        .size();
  };
  const std::string map = "repertoire/quadruped.toml", walk = "authors/supg-objective.toml";
  EXPECT_EQ(count(map, {"population.size=50", "search.map_elites.pool.size=5", "search.map_elites.cells=9"}),
            3u);
  EXPECT_EQ(count(map, {"search.map_elites.select=dominated", "search.map_elites.pool.size=5"}), 0u);
  EXPECT_EQ(count(walk, {"score.heading_deg=90", "ground.height_m=0.1", "noise.push_interval_s=3"}), 3u);
  EXPECT_EQ(count(walk, {"score.terms=[{quantity='heading'}]", "score.heading_deg=90", "ground.kind=rough",
                         "ground.height_m=0.01", "noise.push_m_s=0.1", "noise.push_interval_s=3"}),
            0u);
}

TEST(IdleAssignments, AreThoseOfGenomesThatAMapFillsByChangingWeightsAlone) {
  const auto idle = [](const std::vector<std::string>& assignments) {
    const Overrides overrides{.assignments = assignments, .seed = {}, .generations = {}};
    const auto found = idle_assignments(
        load_config(AMBLE_SOURCE_DIR "/configs/repertoire/quadruped.toml", overrides), assignments);
    std::vector<std::string> keys;
    for (const std::string& text : found) keys.push_back(text.substr(0, text.find(' ')));
    return keys;
  };
  using testing::ElementsAre;
  const std::vector<std::string> of_structure{"mutation.add_node_share=0.1",
                                              "crossover.mutate_child=false",
                                              "innovations.key='link'",
                                              "genome.activation_shares.sine=2",
                                              "genome.initial_link_probability=0.5",
                                              "search.map_elites.initial=4096"};
  const auto with = [&](const std::string& variation) {
    std::vector<std::string> all = of_structure;
    all.insert(all.end(),
               {"search.map_elites.crossover_probability=0", "search.map_elites.reevaluate_share=0.5",
                "search.map_elites.trials=1", "search.map_elites.variation=" + variation});
    return all;
  };
  EXPECT_THAT(idle(with("line")), ElementsAre("mutation.add_node_share", "crossover.mutate_child",
                                              "innovations.key", "genome.activation_shares.sine"));
  EXPECT_THAT(idle(with("cma")), ElementsAre("mutation.add_node_share", "crossover.mutate_child",
                                             "innovations.key", "genome.activation_shares.sine",
                                             "genome.initial_link_probability", "search.map_elites.initial"));
  EXPECT_THAT(idle({"search.map_elites.crossover_probability=0", "search.map_elites.reevaluate_share=0.5",
                    "search.map_elites.trials=1", "crossover.mutate_child=false"}),
              ElementsAre("crossover.mutate_child"));
  EXPECT_THAT(idle({"search.map_elites.crossover_probability=0.5", "crossover.mutate_child=false"}),
              ElementsAre());
}

TEST(IdleParts, AreScalesOfSensorsThatTheControllerTakesAsTheyAre) {
  const auto idle = [](const std::string& kind, const std::string& of, std::vector<std::string> more = {}) {
    more.push_back("controller.sensing.sensors=[{of='" + of + "', scale=0.5}]");
    return !idle_of("authors/" + kind + "-objective.toml", more).empty();
  };
  const std::vector<std::string> by_hand{"command.kind=random", "controller.differential.turn_gain=1"};
  EXPECT_TRUE(idle("supg", "touch"));
  EXPECT_TRUE(idle("supg", "command_turn", by_hand));
  EXPECT_FALSE(idle("supg", "touch",
                    {"controller.supg.modulation.sensors=['touch']", "controller.supg.modulation.rate=1"}));
  EXPECT_FALSE(idle("sine", "touch"));
}

TEST(IdleParts, AreSensorsThatTheControllerDoesNotRead) {
  const auto unread = [](const std::string& kind, const std::string& of, std::vector<std::string> more = {}) {
    more.push_back("controller.sensing.sensors=[{of='" + of + "', delay_s=0.1}]");
    const auto found = idle_of("authors/" + kind + "-objective.toml", more);
    return !found.empty() && found[0].starts_with("controller.sensing.sensors[0] has no effect");
  };
  EXPECT_FALSE(unread("supg", "touch"));
  for (const std::string of : {"pitch", "angle", "load", "torque", "yaw_rate", "command_speed"})
    EXPECT_TRUE(unread("supg", of)) << of;
  EXPECT_TRUE(unread("supg", "touch", {"controller.supg.trigger=none"}));
  const std::string contact = "controller.supg.contact.";
  EXPECT_FALSE(unread("supg", "torque", {contact + "source=torque"}));
  EXPECT_TRUE(unread("supg", "touch", {contact + "source=torque"}));
  EXPECT_FALSE(unread("supg", "angle", {contact + "source=tracking", contact + "threshold=0.1"}));
  EXPECT_FALSE(unread("supg", "pitch", {contact + "source=shock"}));
  const std::vector<std::string> modulated{"controller.supg.modulation.sensors=['pitch']",
                                           "controller.supg.modulation.rate=1"};
  EXPECT_FALSE(unread("supg", "pitch", modulated));
  EXPECT_TRUE(unread("supg", "roll", modulated));
  const std::vector<std::string> turning{"command.kind=random", "controller.differential.turn_gain=1"};
  EXPECT_FALSE(unread("supg", "command_turn", turning));
  EXPECT_TRUE(unread("supg", "command_speed", turning));
  EXPECT_TRUE(unread("supg", "command_stop", turning)) << "turning alone, it goes on when it is told to stop";
  const std::vector<std::string> slowing{"command.kind=random", "controller.differential.full_speed_m_s=0.4"};
  EXPECT_FALSE(unread("supg", "command_speed", slowing));
  EXPECT_FALSE(unread("supg", "command_stop", slowing));
  EXPECT_TRUE(unread("supg", "command_turn", slowing));
  EXPECT_FALSE(unread("ctrnn", "touch"));
  EXPECT_TRUE(unread("ctrnn", "angle"));
  EXPECT_FALSE(unread("sine", "yaw"));
  EXPECT_FALSE(unread("sine", "roll")) << "the authors' formula takes it for yaw";
}

TEST(IdleParts, AreSensorsThatMayChangeNothing) {
  EXPECT_THAT(idle_of("authors/supg-objective.toml", {"controller.supg.modulation.sensors=['pitch']"}),
              testing::ElementsAre(testing::HasSubstr("rate and shape, how much sensors may change, are 0")));
}

TEST(IdleParts, AreCommandsThatNobodyHears) {
  const std::string said = "[command] is not heard: the controller, of kind \"supg\"";
  EXPECT_THAT(idle_of("authors/supg-objective.toml", {"command.kind=random"}),
              testing::ElementsAre(testing::StartsWith(said)));
  EXPECT_THAT(
      idle_of("authors/supg-objective.toml", {"command.kind=random", "controller.differential.turn_gain=1"}),
      testing::ElementsAre());
}

TEST(UntoldCommands, AreThoseThatBeginWhenTheTrialHasEnded) {
  const auto untold = [](double duration_s, trial::CommandKind kind) {
    Problem problem;
    problem.trial.duration_s = duration_s;
    problem.command.kind = kind;
    problem.command.stretches = {{.speed_m_s = 0.3, .seconds = 5}, {.seconds = 5}, {.speed_m_s = 0.1}};
    return untold_commands(problem);
  };
  EXPECT_EQ(untold(10.0, trial::CommandKind::fixed),
            "what begins after 10 s is never told, as the trial is 10 s long");
  EXPECT_EQ(untold(10.01, trial::CommandKind::fixed), std::nullopt);
  EXPECT_EQ(untold(10.0, trial::CommandKind::random), std::nullopt);
}

}  // namespace
}  // namespace amble::experiment
