#include "amble/neat/genome_io.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "amble/core/error.hpp"
#include "tests/neat/samples.hpp"

namespace amble::neat {
namespace {

std::string bytes_of(const Genome& genome) {
  io::BinaryWriter writer;
  save(genome, writer);
  return writer.bytes();
}

TEST(GenomeBinary, ReadsBackToTheBit) {
  Stream stream(42, Purpose::test);
  Innovations innovations(3, 2);
  std::vector<Genome> genomes;
  for (int i = 0; i < 100; ++i) genomes.push_back(grown_genome(3, 2, i, true, innovations, stream));
  genomes.push_back({});
  io::BinaryWriter writer;
  save(genomes, writer);
  io::BinaryReader reader(writer.bytes(), "file");
  EXPECT_EQ(load_genomes(reader), genomes);
  reader.finish();
}

TEST(GenomeBinary, RefusesEveryTruncation) {
  const std::string bytes = bytes_of(sample_genome(1, 1, {}, {{0, 0, 2, 0.5, true}, {1, 1, 2, 0.5, false}}));
  for (std::size_t size = 0; size < bytes.size(); ++size) {
    io::BinaryReader reader(std::string_view(bytes).substr(0, size), "file");
    EXPECT_NE(error_of([&] { load_genome(reader); }).find("file: truncated"), std::string::npos) << size;
  }
}

TEST(GenomeBinary, RefusesUnknownEnumsAndHalfEnabledLinks) {
  const std::string good = bytes_of(sample_genome(0, 1, {}, {{0, 0, 1, 0.5, true}}));
  const auto error_about = [](const std::string& bytes) {
    io::BinaryReader reader(bytes, "file");
    return error_of([&] { load_genome(reader); });
  };
  std::string bytes = good;
  bytes[8 + 4] = 4;  // the first node's kind
  EXPECT_NE(error_about(bytes).find("unknown enum value"), std::string::npos);
  bytes = good;
  bytes[8 + 5] = 4;  // its activation
  EXPECT_NE(error_about(bytes).find("unknown enum value"), std::string::npos);
  bytes = good;
  bytes.back() = 2;
  EXPECT_NE(error_about(bytes).find("a link is neither enabled nor disabled"), std::string::npos);
}

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
