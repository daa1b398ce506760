#include "amble/presentation/walker.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/experiment/fixture.hpp"

namespace amble::presentation {
namespace {

using figures::CppnLink;
using figures::CppnNode;
using figures::CppnRole;
using testing::ElementsAre;
using testing::FieldsAre;

/// The SUPG quadruped's CPPN with one hidden node, 6, and a link that is disabled.
experiment::Champion champion(const std::vector<std::string>& settings = {}) {
  experiment::Champion champion{.experiment = "test",
                                .seed = 7,
                                .generation = 12,
                                .index = 3,
                                .problem = experiment::small_problem(experiment::small_config(settings)),
                                .genome = {},
                                .result = {},
                                .trace = {},
                                .episodes = {}};
  using neat::Activation;
  using neat::NodeKind;
  champion.genome.nodes = {{0, NodeKind::bias, Activation::linear},
                           {1, NodeKind::input, Activation::linear},
                           {2, NodeKind::input, Activation::linear},
                           {3, NodeKind::input, Activation::linear},
                           {4, NodeKind::output, Activation::bipolar_sigmoid},
                           {5, NodeKind::output, Activation::linear},
                           {6, NodeKind::hidden, Activation::sine}};
  champion.genome.links = {{7, 0, 6, 0.5, true}, {8, 2, 4, -1.5, false}, {9, 6, 5, 2.5, true}};
  return champion;
}

TEST(CppnGraphOfChampion, GivesEachNodeItsRoleAndTheNameItsControllerKnowsItBy) {
  const auto graph = cppn_graph(champion());
  const auto names = champion().problem.architecture->cppn_inputs();
  ASSERT_EQ(names.size(), 3u);
  std::vector<CppnRole> roles;
  std::vector<std::string> all;
  std::vector<std::uint32_t> ids;
  for (const CppnNode& node : graph.nodes) {
    roles.push_back(node.role);
    all.push_back(node.name);
    ids.push_back(node.id);
  }
  EXPECT_THAT(roles, ElementsAre(CppnRole::bias, CppnRole::input, CppnRole::input, CppnRole::input,
                                 CppnRole::output, CppnRole::output, CppnRole::hidden));
  const auto outputs = champion().problem.architecture->cppn_outputs();
  EXPECT_THAT(all, ElementsAre("bias", names[0], names[1], names[2], outputs[0], outputs[1], ""));
  EXPECT_THAT(ids, ElementsAre(0, 1, 2, 3, 4, 5, 6));
}

TEST(CppnGraphOfChampion, NamesFunctionsAndWhatLinearMeansInItsSettings) {
  const auto functions = [](const std::string& linear) {
    std::vector<std::string> all;
    for (const CppnNode& node : cppn_graph(champion({"cppn.linear=" + linear})).nodes)
      all.push_back(node.function);
    return std::vector<std::string>(all.begin() + 4, all.end());
  };
  EXPECT_THAT(functions("absolute"), ElementsAre("bipolar_sigmoid", "|x|", "sine"));
  EXPECT_THAT(functions("identity"), ElementsAre("bipolar_sigmoid", "linear", "sine"));
}

TEST(CppnGraphOfChampion, JoinsNodesByTheirPlaceInTheGraph) {
  auto with_gap = champion();
  with_gap.genome.nodes.back().id = 40;
  with_gap.genome.links[0].to = with_gap.genome.links[2].from = 40;
  EXPECT_THAT(
      cppn_graph(with_gap).links,
      ElementsAre(FieldsAre(0, 6, 0.5, true), FieldsAre(2, 4, -1.5, false), FieldsAre(6, 5, 2.5, true)));
}

}  // namespace
}  // namespace amble::presentation
