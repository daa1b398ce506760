#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <string>
#include <vector>

#include "amble/core/index.hpp"
#include "amble/experiment/replay.hpp"
#include "tests/experiment/fixture.hpp"

// Genomes that say something of senses which have no effect.
namespace amble::experiment {
namespace {

using neat::Genome;
using neat::NodeKind;
using Names = std::vector<std::string>;

const std::string modulation = "controller.supg.modulation.";

/// With a hidden node between the last input and all outputs.
Genome with_hidden_node(Genome genome) {
  const auto inputs = static_cast<std::uint32_t>(genome.count(NodeKind::input)),
             outputs = static_cast<std::uint32_t>(genome.count(NodeKind::output)), id = inputs + outputs + 1;
  std::uint32_t innovation = genome.links.back().innovation;
  genome.nodes.push_back({id, NodeKind::hidden, neat::Activation::sine});
  neat::insert_link(genome, {++innovation, inputs, id, 1.3});
  for (std::uint32_t output = 0; output < outputs; ++output)
    neat::insert_link(genome, {++innovation, id, inputs + 1 + output, 0.4 + 0.3 * output});
  return genome;
}

/// The same without some inputs and outputs and their links. `kept`: places, from 0.
Genome narrowed(const Genome& wide, const std::vector<int>& kept_inputs,
                const std::vector<int>& kept_outputs) {
  const int inputs = wide.count(NodeKind::input);
  std::vector<int> id_of(wide.nodes.size() + 1, -1);
  int next = 0;
  Genome genome;
  for (const neat::NodeGene& node : wide.nodes) {
    const int id = static_cast<int>(node.id);
    const bool kept = node.kind == NodeKind::bias || node.kind == NodeKind::hidden ||
                      (node.kind == NodeKind::input ? std::ranges::count(kept_inputs, id - 1)
                                                    : std::ranges::count(kept_outputs, id - 1 - inputs)) > 0;
    if (!kept) continue;
    id_of[to_index(id)] = next;
    genome.nodes.push_back({static_cast<std::uint32_t>(next++), node.kind, node.activation});
  }
  for (neat::LinkGene link : wide.links) {
    const int from = id_of[link.from], to = id_of[link.to];
    if (from < 0 || to < 0) continue;
    link.from = static_cast<std::uint32_t>(from);
    link.to = static_cast<std::uint32_t>(to);
    genome.links.push_back(link);
  }
  return genome;
}

/// Places of `some` among `all`. Names of the source's coordinates are those of a node's own.
std::vector<int> places_of(const Names& some, const Names& all) {
  std::vector<int> places;
  for (const std::string& name : some) {
    auto found = std::ranges::find(all, name);
    if (found == all.end())
      found = std::ranges::find_if(all, [&](const std::string& one) { return one.ends_with(name); });
    EXPECT_NE(found, all.end()) << name;
    places.push_back(static_cast<int>(found - all.begin()));
  }
  return places;
}

Names together(Names some, const Names& more) {
  some.insert(some.end(), more.begin(), more.end());
  return some;
}

/// Walks by genomes of `wide` settings, with gains of 0 and more, and by the same genomes without what only
/// `wide` controllers ask their CPPN.
void expect_no_effect(const Names& plain_settings, const Names& wide_settings, const Names& gains,
                      const std::function<void(Genome&, const Problem&)>& silence = {}) {
  for (const char* const engine : {"batch", "ode", "mujoco"}) {
    const Names base{std::string("engine=") + engine, "command.kind=random", "trial.duration_s=2"};
    const Problem plain = small_problem(small_config(together(base, plain_settings)));
    const Problem wide = small_problem(small_config(together(base, wide_settings)));
    const Problem with_gains = small_problem(small_config(together(together(base, wide_settings), gains)));
    const auto inputs = places_of(plain.architecture->cppn_inputs(), wide.architecture->cppn_inputs()),
               outputs = places_of(plain.architecture->cppn_outputs(), wide.architecture->cppn_outputs());
    const auto population = small_population(wide);
    int differ = 0;
    for (std::size_t i = 0; i < 6; ++i) {
      Genome genome = with_hidden_node(population.genomes()[i]);
      const auto affected = replay(with_gains, genome, {}, unstopped)->trace;
      if (silence) silence(genome, wide);
      const auto expected = replay(plain, narrowed(genome, inputs, outputs), {}, unstopped)->trace;
      EXPECT_EQ(replay(wide, genome, {}, unstopped)->trace, expected) << engine << " " << i;
      differ += affected != expected ? 1 : 0;
    }
    EXPECT_GE(differ, 4) << engine << ": with gains genomes say something of senses";
  }
}

TEST(WithoutEffect, SupgsWhoseGainsAreZeroWalkAsThePapersToTheBit) {
  const Names sensors{modulation + R"(sensors=["pitch","angle.knee","load","command_turn"])"};
  const Names gains{modulation + "rate=1", modulation + "shape=1"};
  expect_no_effect({}, sensors, gains);
  expect_no_effect({}, together(sensors, {modulation + "shape_by=reading"}), gains);
  expect_no_effect({"controller.supg.seam.residual_s=0.05"},
                   together(sensors, {"controller.supg.seam.residual_s=0.05"}), gains);
}

TEST(WithoutEffect, MixedSubstratesWhoseGainsAreZeroWalkAsTheirSupgsToTheBit) {
  const Names plain{"controller.substrate=auto"};
  Names wide{"controller.substrate=auto", "controller.kind=mixed"}, gains;
  for (const char* const gain : {"rate", "amplitude", "shift", "coupling"}) {
    wide.push_back(std::string("controller.mixed.") + gain + "=0");
    gains.push_back(std::string("controller.mixed.") + gain + "=1");
  }
  expect_no_effect(plain, wide, gains);
}

TEST(WithoutEffect, CtrnnsWhoseCppnSaysNothingOfSensesWalkAsThoseWithoutToTheBit) {
  const Names plain{"controller.substrate=auto", "controller.kind=ctrnn", "controller.ctrnn.state=kept"};
  const Names senses{R"(controller.ctrnn.sensors=["command_turn","heading_error","pitch","load"])"};
  expect_no_effect(plain, together(plain, senses), {}, [](Genome& genome, const Problem& problem) {
    const auto& names = problem.architecture->cppn_outputs();
    for (const char* const output : {"sense", "turn"}) {
      const auto place = std::ranges::find(names, output) - names.begin();
      const auto id = static_cast<std::uint32_t>(1 + genome.count(NodeKind::input) + place);
      std::erase_if(genome.links,
                    [&](const neat::LinkGene& link) { return link.to == id || link.from == id; });
      genome.nodes[id].activation = neat::Activation::linear;
    }
  });
}

}  // namespace
}  // namespace amble::experiment
