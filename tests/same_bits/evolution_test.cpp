#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cstdint>
#include <memory>
#include <optional>
#include <ostream>
#include <string>
#include <utility>
#include <vector>

#include "amble/controllers/factory.hpp"
#include "amble/core/hash.hpp"
#include "amble/core/index.hpp"
#include "amble/cppn/network.hpp"
#include "amble/io/binary.hpp"
#include "amble/neat/genome_io.hpp"
#include "amble/physics/engine.hpp"
#include "amble/score/behaviour.hpp"
#include "amble/score/score.hpp"
#include "amble/search/strategies.hpp"
#include "amble/trial/trial.hpp"
#include "tests/robot/legged.hpp"

// Small runs of evolution, from the seed to the last genome, by the parts of amble that need neither ODE nor
// MuJoCo: NEAT, CPPNs, substrates, controllers, the batch engine, trials, scores, searches.
namespace amble::tests {
namespace {

struct SmallRun {
  const char* controller;
  const char* search;
  int leg_rows;
  const char* hash;
  double friction_loss_nm = 0.0;  ///< of every other joint
};

void PrintTo(const SmallRun& small, std::ostream* out) {
  *out << small.controller << " by " << small.search;
}

/// Evaluates one candidate after the other.
class Candidates : public trial::TaskQueue {
 public:
  Candidates(std::span<const neat::Genome> genomes, const controllers::Architecture& architecture)
      : genomes_(genomes), architecture_(architecture), trajectories(genomes.size()) {}

  std::optional<trial::Task> next() override {
    if (next_ == genomes_.size()) return std::nullopt;
    trial::Task task{.index = next_, .parameters = architecture_.decode(cppn::Network(genomes_[next_], {}))};
    ++next_;
    return task;
  }
  void done(std::size_t index, record::Trajectory trajectory) override {
    trajectories[index] = std::move(trajectory);
  }

 private:
  std::span<const neat::Genome> genomes_;
  const controllers::Architecture& architecture_;
  std::size_t next_ = 0;

 public:
  std::vector<record::Trajectory> trajectories;
};

search::Settings search_settings(const std::string& kind) {
  search::Settings settings;
  // "map-elites-line", "map-elites-cma" and "map-elites-dominated" name a variation or selection too.
  settings.kind = kind.starts_with("map-elites") ? "map-elites" : kind;
  if (kind.ends_with("-line")) settings.map_elites.variation = search::Variation::line;
  if (kind.ends_with("-cma")) settings.map_elites.variation = search::Variation::cma;
  if (kind.ends_with("-dominated")) settings.map_elites.select = search::Selection::dominated;
  settings.map_elites.cma.emitters = 4;
  settings.map_elites.pool.size = 20;
  settings.novelty.path_stride = 50;
  settings.map_elites.descriptors = {{.quantity = "duty_factor", .leg = "L1", .bins = 5},
                                     {.quantity = "uprightness", .leg = {}, .bins = 5}};
  settings.map_elites.batch = 32;
  settings.map_elites.initial = 32;
  return settings;
}

/// "modulated": SUPGs that sense touch and pitch, by gains; "reading": by a pattern for each reading.
controllers::ControllerSettings controller_settings(const std::string& name) {
  controllers::ControllerSettings settings;
  if (name != "oscillators") settings.substrate.layout = substrate::LayoutSource::automatic;
  if (name != "modulated" && name != "reading") {
    settings.kind = name;
    return settings;
  }
  settings.kind = "supg";
  settings.supg.idle = controllers::Idle::wrap;
  settings.supg.modulation = {
      .sensors = {"touch", "pitch"},
      .rate = 0.5,
      .shape = 0.5,
      .shape_by = name == "reading" ? controllers::ShapeBy::reading : controllers::ShapeBy::gain};
  return settings;
}

/// Hash of all objectives and behaviours of a run, and of its last candidates.
std::string run_hash(const SmallRun& small) {
  constexpr int steps = 150, rounds = 6;
  constexpr double timestep_s = 0.01;
  robot::RobotSpec robot = legged_robot(small.leg_rows);
  for (std::size_t j = 0; j < robot.joints.size(); j += 2)
    robot.joints[j].friction_loss_nm = small.friction_loss_nm;
  const auto architecture =
      controllers::make_architecture(controller_settings(small.controller), robot, timestep_s);

  neat::Settings neat;
  neat.population.size = 32;
  neat.speciation.scale_targets(32);
  neat.mutation.add_node_share = 0.3;
  if (std::string_view(small.search) == "cma-es") neat.genome.initial_link_probability = 1.0;
  const search::Settings settings = search_settings(small.search);
  const search::StrategyKind& kind = search::strategy_kind(settings);
  score::BehaviourSettings described{.steps = steps,
                                     .path = {.stride = settings.novelty.path_stride, .first_step = 1},
                                     .duration_s = steps * timestep_s,
                                     .weight_n = 9.81 * robot.total_mass_kg()};
  for (const auto& descriptor : settings.map_elites.descriptors)
    described.descriptors.push_back({descriptor.quantity, descriptor.leg});
  for (const auto& leg : robot.legs) described.leg_names.push_back(leg.name);
  const auto behaviour = score::make_behaviour(kind.behaviour, described);
  const auto strategy = kind.make(settings, {.neat = neat,
                                             .inputs = static_cast<int>(architecture->cppn_inputs().size()),
                                             .outputs = static_cast<int>(architecture->cppn_outputs().size()),
                                             .recurrent = true,
                                             .seed = 5,
                                             .behaviour_length = behaviour->length()});

  const auto engine = physics::make_engine("batch", robot, {.timestep_s = timestep_s});
  const auto batch = architecture->make_batch(engine->lanes());
  trial::Runner runner(*engine, *batch,
                       {.steps = steps,
                        .timestep_s = timestep_s,
                        .path = behaviour->path(),
                        .measures = behaviour->measures(),
                        .sensing = {.extra = architecture->extra_senses(), .models = {}},
                        .commands = trial::CommandSchedule({{0, {0.3f, 0.0f}}, {75, {0.2f, 0.5f}}}, 10),
                        .fall = robot.fall_rule(),
                        .start_rotation = robot.bodies[0].rotation});
  const std::atomic<bool> never{false};
  std::uint64_t hash = 0;
  for (int round = 0; round < rounds; ++round) {
    Candidates candidates(strategy->ask(), *architecture);
    runner.run(candidates, never);
    std::vector<std::vector<float>> behaviours;
    std::vector<search::Evaluation> evaluations;
    for (const auto& trajectory : candidates.trajectories) {
      behaviours.push_back(behaviour->of(std::span(&trajectory, 1)));
      evaluations.push_back({.objective = score::distance_m(trajectory),
                             .behaviour = {},
                             .viable = trajectory.outcome != record::Outcome::diverged});
    }
    for (std::size_t i = 0; i < evaluations.size(); ++i) {
      evaluations[i].behaviour = behaviours[i];
      hash = hash_span<double>(std::array{evaluations[i].objective}, hash);
      hash = hash_span<float>(behaviours[i], hash);
    }
    strategy->tell(evaluations);
  }
  io::BinaryWriter last;
  neat::save(strategy->ask(), last);
  return hex(hash_bytes(last.bytes().data(), last.bytes().size(), hash));
}

class GoldenEvolution : public testing::TestWithParam<SmallRun> {};

TEST_P(GoldenEvolution, IsTheSameEverywhere) {
  EXPECT_EQ(run_hash(GetParam()), GetParam().hash);
}

INSTANTIATE_TEST_SUITE_P(SameBits, GoldenEvolution,
                         testing::Values(SmallRun{"supg", "objective", 2, "4c5ad5e45746e92f"},
                                         SmallRun{"supg", "novelty", 3, "bcd6ad155b3ac9f3"},
                                         SmallRun{"network", "objective", 2, "e2d5eca137498544"},
                                         SmallRun{"network", "map-elites", 3, "ebe2d87ba554b763"},
                                         SmallRun{"ctrnn", "novelty", 2, "0af50aecfc591f5f"},
                                         SmallRun{"ctrnn", "map-elites", 1, "3ecb48f53a092895"},
                                         SmallRun{"modulated", "objective", 2, "fcc3786bf621f36e"},
                                         SmallRun{"reading", "novelty", 2, "8b3b45c6d42215f6"},
                                         SmallRun{"mixed", "objective", 2, "7e647738fe27b7c0"},
                                         SmallRun{"oscillators", "cma-es", 2, "386755dc2e856f79"},
                                         SmallRun{"supg", "map-elites-dominated", 2, "789b15833b541787"},
                                         SmallRun{"oscillators", "map-elites-line", 2, "9b8ad1e8cae227ce"},
                                         SmallRun{"oscillators", "map-elites-cma", 2, "3cce0043fedb163f"},
                                         SmallRun{"supg", "objective", 2, "ed560bfd06151878", 0.1}),
                         [](const auto& small) {
                           std::string name = std::string(small.param.controller) + "_" + small.param.search;
                           if (small.param.friction_loss_nm > 0.0) name += "_with_friction";
                           std::ranges::replace(name, '-', '_');
                           return name;
                         });

}  // namespace
}  // namespace amble::tests
