#include "amble/neat/genome_json.hpp"

#include <gtest/gtest.h>

#include "amble/core/error.hpp"
#include "amble/neat/genome_io.hpp"
#include "tests/neat/samples.hpp"

namespace amble::neat {
namespace {

Genome small() {
  return sample_genome(1, 1, {{7, NodeKind::hidden, Activation::sine}},
                       {{0, 0, 2, 0.1, true}, {4294967295u, 1, 7, -1.5, false}});
}

std::string error_about(const io::Json& json) {
  return error_of([&] { genome_from_json(io::JsonView(json, "file.json")); });
}

TEST(GenomeJson, IsTheDocumentedText) {
  EXPECT_EQ(
      to_json(small()).dump(),
      R"({"nodes":[{"id":0,"kind":"bias","activation":"linear"},{"id":1,"kind":"input","activation":"linear"},)"
      R"({"id":2,"kind":"output","activation":"bipolar_sigmoid"},{"id":7,"kind":"hidden","activation":"sine"}],)"
      R"("links":[{"innovation":0,"from":0,"to":2,"weight":0.1,"enabled":true},)"
      R"({"innovation":4294967295,"from":1,"to":7,"weight":-1.5,"enabled":false}]})");
}

TEST(GenomeJson, ReadsBackToTheBitThroughText) {
  Stream stream(41, Purpose::test);
  Innovations innovations(3, 2);
  for (int i = 0; i < 200; ++i) {
    const Genome genome = grown_genome(3, 2, i, true, innovations, stream);
    const io::Json json = io::Json::parse(to_json(genome).dump());
    const Genome read = genome_from_json(io::JsonView(json, "file.json"));
    ASSERT_EQ(read, genome);
    ASSERT_EQ(read.hash(), genome.hash());
  }
}

TEST(GenomeJson, ReadsAGenomeWithoutLinks) {
  const Genome genome = sample_genome(1, 1, {}, {});
  EXPECT_EQ(genome_from_json(io::JsonView(to_json(genome), "file.json")), genome);
}

TEST(GenomeJson, NamesTheKeyThatIsWrong) {
  const io::Json good = to_json(small());
  io::Json json = good;
  json.erase("links");
  EXPECT_EQ(error_about(json), "file.json: key 'links' is missing");
  json = good;
  json["nodes"][3]["kind"] = "middle";
  EXPECT_EQ(error_about(json), "file.json: key 'nodes[3].kind' must be one of bias, input, output, hidden");
  json = good;
  json["nodes"][3]["activation"] = "tanh";
  EXPECT_EQ(error_about(json),
            "file.json: key 'nodes[3].activation' must be one of bipolar_sigmoid, gaussian, sine, linear");
  json = good;
  json["links"][1]["from"] = -1;
  EXPECT_EQ(error_about(json), "file.json: key 'links[1].from' must be a whole number from 0 to 4294967295");
  json["links"][1]["from"] = 4294967296;
  EXPECT_EQ(error_about(json), "file.json: key 'links[1].from' must be a whole number from 0 to 4294967295");
  json = good;
  json["links"][0]["enabled"] = 1;
  EXPECT_EQ(error_about(json), "file.json: key 'links[0].enabled' must be true or false");
}

TEST(GenomeJson, RefusesWeightsThatAreNotFinite) {
  io::Json json = to_json(small());
  json["links"][0]["weight"] = "inf";
  EXPECT_EQ(error_about(json), "file.json: key 'links[0].weight' must be a finite number");
  json["links"][0]["weight"] = nullptr;
  EXPECT_EQ(error_about(json), "file.json: key 'links[0].weight' must be a number");
}

TEST(GenomeJson, ReadsNumbersUpToTheLargest) {
  for (const std::uint32_t number : {0u, 0xffffffffu}) {
    io::Json json = to_json(small());
    for (const char* key : {"innovation", "from", "to"}) json["links"][1][key] = number;
    json["nodes"][3]["id"] = number;
    const Genome genome = genome_from_json(io::JsonView(json, "file.json"));
    EXPECT_EQ(genome.links[1].innovation, number);
    EXPECT_EQ(genome.links[1].from, number);
    EXPECT_EQ(genome.links[1].to, number);
    EXPECT_EQ(genome.nodes[3].id, number);
  }
  for (const auto& [list, index, key] :
       {std::tuple{"links", 1, "innovation"}, {"links", 1, "from"}, {"links", 1, "to"}, {"nodes", 3, "id"}})
    for (const std::int64_t number : {std::int64_t{-1}, std::int64_t{1} << 32}) {
      io::Json json = to_json(small());
      json[list][static_cast<std::size_t>(index)][key] = number;
      EXPECT_NE(error_about(json).find("must be a whole number from 0 to 4294967295"), std::string::npos)
          << key;
    }
}

TEST(GenomeText, ReadsBackToTheSameBits) {
  const Genome genome = parse_genome(genome_text(small()), "it");
  EXPECT_EQ(to_json(genome), to_json(small()));
  for (std::size_t i = 0; i < genome.links.size(); ++i)
    EXPECT_EQ(genome.links[i].weight, small().links[i].weight);
}

TEST(GenomeText, NamesWhatIsWrong) {
  EXPECT_THROW(parse_genome("{", "mine"), UserError);
  try {
    parse_genome(R"({"nodes": []})", "mine");
    FAIL();
  } catch (const UserError& error) {
    EXPECT_STREQ(error.what(), "mine: key 'links' is missing");
  }
}

}  // namespace
}  // namespace amble::neat
