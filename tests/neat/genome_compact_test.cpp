#include "amble/neat/genome_compact.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "amble/core/error.hpp"
#include "tests/neat/samples.hpp"

namespace amble::neat {
namespace {

TEST(CompactGenome, IsTheSameGenomeAfterwardsForThousandsOfThem) {
  Stream stream(1, Purpose::test);
  Innovations innovations(3, 2);
  for (int i = 0; i < 3000; ++i) {
    Genome genome = grown_genome(3, 2, i % 40, i % 2 == 0, innovations, stream);
    for (LinkGene& link : genome.links) link.enabled = stream.chance(0.7);
    ASSERT_EQ(expand(compact(genome), "it"), genome) << i;
  }
}

TEST(CompactGenome, KeepsExtremeNumbersAndWeights) {
  Genome genome = sample_genome(1, 1, {{0x7fffffffu, NodeKind::hidden, Activation::sine}}, {});
  genome.links = {{0, 0xffffffffu, 3, -0.0, false}, {0xffffffffu, 1, 0xfffffffeu, 5e-324, true}};
  EXPECT_EQ(expand(compact(genome), "it"), genome);
  EXPECT_EQ(compact(expand(compact(genome), "it")), compact(genome));
}

TEST(CompactGenome, TakesElevenBytesForALinkAndThreeForANode) {
  Stream stream(2, Purpose::test);
  Innovations innovations(3, 2);
  const Genome genome = grown_genome(3, 2, 60, true, innovations, stream);
  EXPECT_LE(compact(genome).size(), 2 + 3 * genome.nodes.size() + 13 * genome.links.size());
}

TEST(CompactGenome, IsRefusedInOneLineWhereverItIsCutOffAndWithMoreAtItsEnd) {
  Stream stream(3, Purpose::test);
  Innovations innovations(2, 1);
  const std::string bytes = compact(grown_genome(2, 1, 25, true, innovations, stream));
  for (std::size_t length = 0; length < bytes.size(); ++length)
    EXPECT_EQ(error_of([&] { expand(bytes.substr(0, length), "archive.bin"); }), "archive.bin: not a genome");
  EXPECT_EQ(error_of([&] { expand(bytes + '\0', "archive.bin"); }), "archive.bin: not a genome");
}

TEST(CompactGenome, OfAnyBytesIsAGenomeOrRefused) {
  Stream stream(4, Purpose::test);
  int refused = 0;
  for (int i = 0; i < 20000; ++i) {
    std::string bytes(stream.below(60), '\0');
    for (char& byte : bytes) byte = static_cast<char>(stream.below(stream.chance(0.5) ? 8 : 256));
    try {
      expand(bytes, "it");
    } catch (const UserError&) {
      ++refused;
    }
  }
  EXPECT_GT(refused, 10000);
}

}  // namespace
}  // namespace amble::neat
