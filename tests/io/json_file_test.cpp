#include "amble/io/json_file.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "amble/core/hash.hpp"
#include "tests/io/expect_error.hpp"

namespace amble::io {
namespace {

using test::error_of;

Json sample() {
  Json json = Json::object();
  json["seed"] = 18446744073709551615u;
  json["weights"] = {0.1, -1.0, 1e300, static_cast<double>(0.1f)};
  json["nested"] = {{"b", true}, {"a", nullptr}};
  return json;
}

std::string refusal(const std::string& text, Altered altered = Altered::refuse) {
  return error_of(ExitCode::bad_file, [&] { unseal_json("champion", 3, text, "c.json", altered); });
}

std::string replaced(std::string text, const std::string& old_part, const std::string& new_part) {
  const std::size_t at = text.find(old_part);
  EXPECT_NE(at, std::string::npos) << old_part;
  return text.replace(at, old_part.size(), new_part);
}

TEST(SealedJson, OpensAgainWithKeysInOrder) {
  const std::string text = sealed_json("champion", 3, sample());
  const SealedJson read = unseal_json("champion", 3, text, "c.json");
  EXPECT_FALSE(read.altered);
  EXPECT_EQ(read.document.dump(), sample().dump());
}

TEST(SealedJson, LooksAsDocumented) {
  EXPECT_EQ(sealed_json("champion", 3, {{"weights", {0.5, 1.0}}}),
            "{\n"
            "  \"format\": \"champion\",\n"
            "  \"version\": 3,\n"
            "  \"weights\": [0.5, 1.0],\n"
            "  \"checksum\": \"" +
                hex(hash_text(R"({"format":"champion","version":3,"weights":[0.5,1.0]})")) + "\"\n}\n");
}

TEST(SealedJson, SurvivesAnotherLayout) {
  const std::string text = sealed_json("champion", 3, sample());
  const Json parsed = parse_json(text, "x");
  EXPECT_EQ(unseal_json("champion", 3, parsed.dump(), "x").document, sample());
  EXPECT_EQ(unseal_json("champion", 3, parsed.dump(8, '\t'), "x").document, sample());
}

TEST(SealedJson, TellsAnAlteredNumberKeyOrderAndChecksum) {
  const std::string text = sealed_json("champion", 3, sample());
  const std::string expected = "c.json: altered: its checksum does not fit";
  EXPECT_EQ(refusal(replaced(text, "0.1,", "0.2,")), expected);
  EXPECT_EQ(refusal(replaced(text, "\"nested\"", "\"nestle\"")), expected);
  EXPECT_EQ(refusal(replaced(text, "\"checksum\": \"", "\"checksum\": \"0")), expected);
  EXPECT_EQ(refusal(replaced(text, "\"checksum\"", "\"checksun\"")), expected);
  EXPECT_EQ(refusal(replaced(text, R"({"b": true, "a": null})", R"({"a": null, "b": true})")), expected);
}

TEST(SealedJson, OpensAlteredDocumentsOnlyWhereAsked) {
  const std::string text = replaced(sealed_json("champion", 3, sample()), "0.1,", "0.2,");
  const SealedJson read = unseal_json("champion", 3, text, "c.json", Altered::accept);
  EXPECT_TRUE(read.altered);
  EXPECT_EQ(read.document["weights"][0], 0.2);
  EXPECT_FALSE(read.document.contains("checksum"));
}

TEST(SealedJson, TellsForeignFilesAndOtherVersions) {
  EXPECT_EQ(refusal(sealed_json("manifest", 3, sample())),
            "c.json: its format is \"manifest\", \"champion\" was expected");
  EXPECT_EQ(refusal(sealed_json("champion", 4, sample())),
            "c.json: version 4 of the file format; this program reads version 3");
  EXPECT_EQ(refusal("{}"), "c.json: not a file of amble: it has no \"format\"");
  EXPECT_EQ(refusal("[1, 2]"), "c.json: not a file of amble: it has no \"format\"");
  EXPECT_EQ(refusal(R"({"format": "champion"})"), "c.json: key 'version' is missing");
  EXPECT_EQ(refusal(R"({"format": "champion", "version": "3"})"),
            "c.json: key 'version' must be a whole number");
}

TEST(SealedJson, NamesLineAndColumnOfASyntaxError) {
  EXPECT_EQ(refusal("{\n  \"format\": \"champion\",\n  oops\n}"), "c.json:3:3: not valid JSON: 'oops'");
  EXPECT_EQ(refusal("?"), "c.json:1:1: not valid JSON: '?'");
  EXPECT_EQ(refusal("{} {}"), "c.json:1:4: not valid JSON: '{'");
  EXPECT_EQ(refusal("{\"a\": NaN}"), "c.json:1:7: not valid JSON: 'NaN'");
}

TEST(SealedJson, DetectsEveryTruncation) {
  const std::string text = sealed_json("champion", 3, sample());
  for (std::size_t size = 0; size + 2 < text.size(); ++size) {
    EXPECT_EQ(refusal(text.substr(0, size)), "c.json: truncated: the JSON ends too early") << size;
  }
}

TEST(SealedJson, RefusesNumbersBeyondDouble) {
  EXPECT_EQ(refusal("{\"format\": 1e999}"),
            "c.json: a number is not finite: it is beyond the range of double");
}

TEST(SealedJson, RefusesDeepNestingWithoutCrashing) {
  const std::string expected = "c.json: the JSON is nested more than 64 levels deep";
  for (const std::size_t depth : {std::size_t{65}, std::size_t{1000000}}) {
    EXPECT_EQ(refusal(std::string(depth, '[') + std::string(depth, ']')), expected);
    EXPECT_EQ(refusal(std::string(depth, '[')), expected);
    std::string objects;
    for (std::size_t i = 0; i < depth; ++i) objects += "{\"a\":";
    EXPECT_EQ(refusal(objects), expected);
  }
  EXPECT_EQ(parse_json(std::string(64, '[') + std::string(64, ']'), "x").size(), 1u);
  EXPECT_EQ(parse_json("\"" + std::string(100, '[') + "\\\"" + std::string(100, '[') + "\"", "x")
                .get<std::string>()
                .size(),
            201u);
}

TEST(SealedJsonDeathTest, RefusesToWriteNumbersThatAreNotFinite) {
  EXPECT_DEATH(sealed_json("champion", 3, {{"x", NAN}}), "JSON has no NaN and no infinity");
  EXPECT_DEATH(sealed_json("champion", 3, {{"checksum", 1}}), "this key belongs to the seal");
}

}  // namespace
}  // namespace amble::io
