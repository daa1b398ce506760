#include "amble/neat/genome_binary.hpp"

#include <gtest/gtest.h>

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

}  // namespace
}  // namespace amble::neat
