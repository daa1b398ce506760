#include "amble/neat/innovations.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <tuple>

#include "amble/neat/mutation.hpp"
#include "tests/neat/samples.hpp"

namespace amble::neat {
namespace {

constexpr InnovationSettings whole_run{InnovationScope::run, InnovationKey::link_and_function};

TEST(Innovations, GiveTheSameLinkTheSameNumberForEver) {
  Innovations innovations(2, 1, whole_run);
  EXPECT_EQ(innovations.link(0, 3), 0u);
  EXPECT_EQ(innovations.link(1, 3), 1u);
  EXPECT_EQ(innovations.link(0, 3), 0u);
  EXPECT_EQ(innovations.link(3, 3), 2u);
  innovations.begin_generation();
  EXPECT_EQ(innovations.link(1, 3), 1u);
  EXPECT_EQ(innovations.link(2, 3), 3u);
}

TEST(Innovations, GiveNumbersAnewInEachGenerationIfSet) {
  Innovations innovations(2, 1, {InnovationScope::generation, InnovationKey::link_and_function});
  const Genome none = sample_genome(2, 1, {}, {});
  EXPECT_EQ(innovations.link(0, 3), 0u);
  EXPECT_EQ(innovations.link(1, 3), 1u);
  EXPECT_EQ(innovations.node(0, Activation::sine, none), 4u);
  innovations.begin_generation();
  EXPECT_EQ(innovations.link(1, 3), 2u);
  EXPECT_EQ(innovations.link(1, 3), 2u) << "the same in one generation";
  EXPECT_EQ(innovations.link(4, 3), 3u) << "nodes of earlier generations stay";
  EXPECT_EQ(innovations.node(0, Activation::sine, none), 5u) << "links of earlier generations can be split";
  EXPECT_EQ(innovations.node(0, Activation::sine, none), 5u);
}

TEST(Innovations, BeyondAGenomeKnowItAndNumberItsMutationsAboveAllItHas) {
  int new_nodes = 0, new_links = 0;
  for (const auto key : {InnovationKey::link, InnovationKey::link_and_function}) {
    Innovations run(3, 2, {InnovationScope::generation, key});
    Stream stream(9, Purpose::test);
    for (int round = 0; round < 300; ++round) {
      run.begin_generation();
      const Genome genome = grown_genome(3, 2, round % 9, true, run, stream);
      std::uint32_t last_node = 0, last_link = 0;
      for (const auto& node : genome.nodes) last_node = std::max(last_node, node.id);
      for (const auto& link : genome.links) last_link = std::max(last_link, link.innovation);
      Innovations alone = Innovations::beyond(genome, key);
      EXPECT_TRUE(alone.knows(genome));
      Genome mutant = genome;
      mutate(mutant, lively_settings(), true, alone, stream);
      EXPECT_NO_THROW(validate(mutant, 3, 2, true));
      EXPECT_TRUE(alone.knows(mutant));
      for (const auto& node : mutant.nodes) {
        if (genome.index_of(node.id) < 0) {
          EXPECT_GT(node.id, last_node);
          ++new_nodes;
        }
      }
      for (const auto& link : mutant.links) {
        const bool is_new =
            std::ranges::find(genome.links, link.innovation, &LinkGene::innovation) == genome.links.end();
        if (is_new) {
          EXPECT_GT(link.innovation, last_link);
          ++new_links;
        }
      }
    }
  }
  EXPECT_GT(new_nodes, 20);
  EXPECT_GT(new_links, 20);
}

TEST(Innovations, GiveTheSameSplitTheSameNodeWhateverItsFunctionIfTheLinkAloneCounts) {
  Innovations innovations(2, 1, {InnovationScope::run, InnovationKey::link});
  const Genome none = sample_genome(2, 1, {}, {});
  const auto link = innovations.link(0, 3);
  const auto node = innovations.node(link, Activation::sine, none);
  EXPECT_EQ(innovations.node(link, Activation::gaussian, none), node);
  const Genome with_it = sample_genome(2, 1, {{node, NodeKind::hidden, Activation::sine}}, {});
  EXPECT_NE(innovations.node(link, Activation::gaussian, with_it), node) << "a genome has an id only once";
  EXPECT_TRUE(innovations.knows(sample_genome(2, 1, {{node, NodeKind::hidden, Activation::gaussian}}, {})));
}

TEST(Innovations, TellTheDirectionsOfALinkApart) {
  Innovations innovations(1, 2);
  EXPECT_NE(innovations.link(2, 3), innovations.link(3, 2));
}

TEST(Innovations, GiveTheSameSplitTheSameNodeInEveryGenome) {
  Innovations innovations(2, 1, whole_run);
  const Genome one = sample_genome(2, 1, {}, {}), other = sample_genome(2, 1, {}, {{0, 0, 3, 1.0, true}});
  const auto link = innovations.link(0, 3), second_link = innovations.link(1, 3);
  const auto node = innovations.node(link, Activation::sine, one);
  EXPECT_EQ(node, 4u) << "the first id after bias, inputs and outputs";
  EXPECT_EQ(innovations.node(link, Activation::sine, other), node);
  EXPECT_EQ(innovations.node(second_link, Activation::sine, one), 5u);
  EXPECT_EQ(innovations.node(link, Activation::gaussian, one), 6u) << "another function is another node";
  EXPECT_EQ(innovations.node(link, Activation::sine, one), node);
}

TEST(Innovations, GiveAGenomeThatHasTheNodeTheNextOneInLine) {
  Innovations innovations(2, 1, whole_run);
  const auto link = innovations.link(0, 3);
  const Genome none = sample_genome(2, 1, {}, {});
  const auto first = innovations.node(link, Activation::sine, none);
  const Genome with_first = sample_genome(2, 1, {{first, NodeKind::hidden, Activation::sine}}, {});
  const auto second = innovations.node(link, Activation::sine, with_first);
  EXPECT_NE(second, first);
  EXPECT_EQ(innovations.node(link, Activation::sine, with_first), second) << "the same for every such genome";
  EXPECT_EQ(innovations.node(link, Activation::sine, none), first);
  const Genome with_second = sample_genome(2, 1, {{second, NodeKind::hidden, Activation::sine}}, {});
  EXPECT_EQ(innovations.node(link, Activation::sine, with_second), first) << "the first in line that is free";
}

TEST(Innovations, KnowTheirOwnNumbersOnly) {
  Stream stream(51, Purpose::test);
  Innovations innovations(2, 1, whole_run);
  const Genome genome = grown_genome(2, 1, 60, true, innovations, stream);
  ASSERT_GT(genome.count(NodeKind::hidden), 2);
  EXPECT_TRUE(innovations.knows(genome));
  Genome other = genome;
  other.links.back().innovation = 100000;
  EXPECT_FALSE(innovations.knows(other));
  other = genome;
  std::swap(other.links[0].from, other.links[1].from);
  std::swap(other.links[0].to, other.links[1].to);
  EXPECT_FALSE(innovations.knows(other)) << "links with each other's numbers";
  other = genome;
  other.nodes.back().id = 100000;
  EXPECT_FALSE(innovations.knows(other));
  other = genome;
  other.nodes.back().activation =
      static_cast<Activation>((static_cast<int>(other.nodes.back().activation) + 1) % 4);
  EXPECT_FALSE(innovations.knows(other)) << "equal ids mean equal functions";
}

/// What the four combinations of settings have in common.
class AllInnovations : public testing::TestWithParam<std::tuple<InnovationScope, InnovationKey>> {
 protected:
  InnovationSettings settings_{std::get<0>(GetParam()), std::get<1>(GetParam())};
};

TEST_P(AllInnovations, ContinueAfterSaveAndLoad) {
  Stream stream(52, Purpose::test);
  Innovations innovations(2, 1, settings_);
  for (int i = 0; i < 20; ++i) {
    if (i % 8 == 7) innovations.begin_generation();
    grown_genome(2, 1, 30, true, innovations, stream);
  }
  io::BinaryWriter writer;
  innovations.save(writer);
  Innovations loaded(2, 1, settings_);
  io::BinaryReader reader(writer.bytes(), "file");
  loaded.load(reader);
  reader.finish();
  Stream one(53, Purpose::test), two(53, Purpose::test);
  for (int i = 0; i < 20; ++i) {
    ASSERT_EQ(grown_genome(2, 1, 60, true, innovations, one), grown_genome(2, 1, 60, true, loaded, two));
    if (i % 7 == 6) {
      innovations.begin_generation();
      loaded.begin_generation();
    }
  }
  io::BinaryWriter after, loaded_after;
  innovations.save(after);
  loaded.save(loaded_after);
  EXPECT_EQ(after.bytes(), loaded_after.bytes());
}

INSTANTIATE_TEST_SUITE_P(ScopesAndKeys, AllInnovations,
                         testing::Combine(testing::Values(InnovationScope::generation, InnovationScope::run),
                                          testing::Values(InnovationKey::link,
                                                          InnovationKey::link_and_function)));

TEST(Innovations, RefuseWhatCannotBe) {
  const auto error_about = [](std::initializer_list<std::uint32_t> ends, std::uint32_t split_link,
                              InnovationSettings settings = whole_run, std::uint32_t first_link = 0) {
    io::BinaryWriter writer;
    writer.put(std::uint32_t{4});
    writer.put(first_link);
    writer.put(static_cast<std::uint64_t>(ends.size() / 2));
    for (const auto end : ends) writer.put(end);
    writer.put(std::uint32_t{4});
    writer.put(std::uint64_t{1});
    writer.put(split_link);
    writer.put(Activation::sine);
    Innovations innovations(2, 1, settings);
    io::BinaryReader reader(writer.bytes(), "file");
    return error_of([&] { innovations.load(reader); });
  };
  EXPECT_EQ(error_about({0, 3, 4, 3}, 0), "");
  EXPECT_NE(error_about({0, 3, 0, 3}, 0).find("a link with two innovation numbers"), std::string::npos);
  EXPECT_NE(error_about({0, 3, 5, 3}, 0).find("a link that joins unknown nodes"), std::string::npos);
  EXPECT_NE(error_about({0, 3, 4, 3}, 2).find("a node that splits an unknown link"), std::string::npos);
  EXPECT_NE(error_about({0, 3, 4, 3}, 0, whole_run, 9).find("begins where it cannot"), std::string::npos);
  const InnovationSettings generation{InnovationScope::generation, InnovationKey::link_and_function};
  EXPECT_EQ(error_about({0, 3, 4, 3}, 0, generation, 9), "");
  EXPECT_NE(error_about({0, 3, 4, 3}, 0, generation, 0xffffffffu).find("too many innovations"),
            std::string::npos);
  EXPECT_NE(error_about({0, 3, 4, 3}, 0, {InnovationScope::run, InnovationKey::link})
                .find("where the link alone counts"),
            std::string::npos);
}

TEST(Innovations, LoadNumbersUpToTheLargest) {
  // Two links, of new nodes too, and one node, in a generation's list that begins at these numbers.
  const auto refusal = [](std::uint32_t first_link, std::uint32_t first_node, std::uint32_t from,
                          std::uint32_t to, InnovationScope scope = InnovationScope::generation) {
    io::BinaryWriter writer;
    writer.put(std::uint32_t{4});
    writer.put(first_link);
    writer.put(std::uint64_t{2});
    for (const std::uint32_t end : {0u, 3u, from, to}) writer.put(end);
    writer.put(first_node);
    writer.put(std::uint64_t{1});
    writer.put(std::uint32_t{0});
    writer.put(Activation{});
    Innovations innovations(2, 1, {scope, InnovationKey::link});
    io::BinaryReader reader(writer.bytes(), "file");
    return error_of([&] { innovations.load(reader); });
  };
  const auto says = [](const std::string& text, const char* part) {
    return text.find(part) != std::string::npos;
  };
  EXPECT_EQ(refusal(0xfffffffdu, 9, 1, 3), "");
  EXPECT_TRUE(says(refusal(0xfffffffeu, 9, 1, 3), "too many innovations"));
  EXPECT_EQ(refusal(0, 0xfffffffeu, 1, 3), "");
  EXPECT_TRUE(says(refusal(0, 0xffffffffu, 1, 3), "too many innovations"));
  EXPECT_EQ(refusal(0, 9, 9, 3), "");
  EXPECT_EQ(refusal(0, 9, 1, 9), "");
  EXPECT_TRUE(says(refusal(0, 9, 10, 3), "a link that joins unknown nodes"));
  EXPECT_TRUE(says(refusal(0, 9, 1, 10), "a link that joins unknown nodes"));
  EXPECT_EQ(refusal(0, 4, 1, 3), "");
  EXPECT_TRUE(says(refusal(0, 3, 1, 3), "begins where it cannot"));
  const auto whole = InnovationScope::run;
  EXPECT_EQ(refusal(0, 4, 1, 3, whole), "");
  EXPECT_TRUE(says(refusal(1, 4, 1, 3, whole), "begins where it cannot"));
  EXPECT_TRUE(says(refusal(0, 5, 1, 3, whole), "begins where it cannot"));
}

}  // namespace
}  // namespace amble::neat
