#include <gtest/gtest.h>

#include "amble/controllers/factory.hpp"
#include "amble/substrate/layout.hpp"
#include "tests/figures/golden.hpp"
#include "tests/robot/legged.hpp"

namespace amble::controllers {
namespace golden_substrate_test {

/// A CPPN whose outputs are sums of its inputs, each with another weight.
cppn::Network sums(const Architecture& architecture) {
  neat::Genome genome;
  std::uint32_t innovation = 0;
  const auto inputs = static_cast<std::uint32_t>(architecture.cppn_inputs().size()) + 1;
  const auto outputs = static_cast<std::uint32_t>(architecture.cppn_outputs().size());
  for (std::uint32_t id = 0; id < inputs; ++id)
    genome.nodes.push_back(
        {id, id == 0 ? neat::NodeKind::bias : neat::NodeKind::input, neat::Activation::linear});
  for (std::uint32_t k = 0; k < outputs; ++k) {
    genome.nodes.push_back({inputs + k, neat::NodeKind::output, neat::Activation::linear});
    for (std::uint32_t i = 0; i < inputs; ++i, ++innovation)
      genome.links.push_back({innovation, i, inputs + k, innovation % 2 == 0 ? 0.75 : -0.5});
  }
  return {genome, {cppn::Linear::identity, true}};
}

TEST(GoldenSubstrate, OfTwoToSixLegsMatches) {
  std::map<std::string, std::string> texts;
  for (const char* kind : {"supg", "network", "ctrnn"})
    for (const int rows : {1, 2, 3}) {
      const robot::RobotSpec whole = tests::legged_robot(rows);
      std::string text;
      for (const robot::RobotSpec& robot : {whole, tests::with_held_joint(whole, 1, 0)}) {
        ControllerSettings settings;
        settings.kind = kind;
        settings.substrate.layout = substrate::LayoutSource::automatic;
        const auto architecture = make_architecture(settings, robot, 0.01);
        text += substrate::summary(substrate_of(settings, robot), *architecture->substrate());
        text += architecture->parameters_json(*architecture->decode(sums(*architecture))) + "\n";
      }
      texts[kind + std::to_string(rows) + ".txt"] = text;
    }
  tests::expect_golden(texts, {{"ctrnn1.txt", "d82e84ff488c22ed"},
                               {"ctrnn2.txt", "db22e56b0ae6ecaf"},
                               {"ctrnn3.txt", "7f052babf995db8c"},
                               {"network1.txt", "ddea74ef0e674e2c"},
                               {"network2.txt", "b2b5dd4617b1516c"},
                               {"network3.txt", "d1761f15bbbdffa6"},
                               {"supg1.txt", "4c0c01cf335fd97e"},
                               {"supg2.txt", "ea95a79857aa6141"},
                               {"supg3.txt", "f5076218472207f7"}});
}

}  // namespace golden_substrate_test
}  // namespace amble::controllers
