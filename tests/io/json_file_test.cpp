#include "amble/io/json_file.hpp"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <sstream>
#include <string>

#include "amble/core/hash.hpp"
#include "amble/core/random.hpp"
#include "tests/io/expect_error.hpp"

namespace amble::io {
namespace json_file_test {

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

TEST(JsonText, IndentsByTwoAndKeepsListsOfPlainValuesOnOneLine) {
  Json json = Json::object();
  json["name"] = "a \"b\"";
  json["list"] = {1, 2.5, nullptr, true};
  json["point"] = {{"x", 1}, {"y", -0.0}};
  json["empty"] = Json::array();
  json["long"] = Json(std::vector<int>(60, 1000));
  json["links"] = Json::array();
  for (int i = 0; i < 3; ++i)
    json["links"].push_back({{"innovation", i}, {"from", 12345678}, {"to", 12345678}});
  std::string expected =
      "{\n"
      "  \"name\": \"a \\\"b\\\"\",\n"
      "  \"list\": [1, 2.5, null, true],\n"
      "  \"point\": {\"x\": 1, \"y\": -0.0},\n"
      "  \"empty\": [],\n"
      "  \"long\": [1000";
  for (int i = 1; i < 60; ++i) expected += ", 1000";
  expected +=
      "],\n"
      "  \"links\": [\n"
      "    {\"innovation\": 0, \"from\": 12345678, \"to\": 12345678},\n"
      "    {\"innovation\": 1, \"from\": 12345678, \"to\": 12345678},\n"
      "    {\"innovation\": 2, \"from\": 12345678, \"to\": 12345678}\n"
      "  ]\n"
      "}\n";
  EXPECT_EQ(json_text(json), expected);
  EXPECT_EQ(parse_json(expected, "x"), json);
}

TEST(JsonText, KeepsEveryBitOfRandomDoublesAndFloats) {
  Stream stream(1, Purpose::test);
  std::vector<double> values{0.0, -0.0, 5e-324,     2.2250738585072014e-308, 1.7976931348623157e308,
                             0.1, 1e22, 123456789.0};
  while (values.size() < 20000) {
    const auto number = std::bit_cast<double>(stream.next_u64());
    if (std::isfinite(number)) values.push_back(number);
    const auto single = std::bit_cast<float>(stream.next_u32());
    if (std::isfinite(single)) values.push_back(static_cast<double>(single));
  }
  const Json read = parse_json(json_text(Json(values)), "x");
  for (std::size_t i = 0; i < values.size(); ++i) {
    ASSERT_EQ(std::bit_cast<std::uint64_t>(JsonView(read, "x").at(i).number()),
              std::bit_cast<std::uint64_t>(values[i]));
  }
}

TEST(JsonText, ReplacesInvalidUtf8) {
  EXPECT_EQ(json_text(Json("a\xff")), "\"a\xef\xbf\xbd\"\n");
}

TEST(JsonNumber, WritesInfinityAsText) {
  EXPECT_EQ(json_number(-INFINITY).dump(), "\"-inf\"");
  EXPECT_EQ(json_number(INFINITY).dump(), "\"inf\"");
  EXPECT_EQ(json_number(0.5).dump(), "0.5");
}

TEST(JsonTextDeathTest, RefusesNumbersThatAreNotFinite) {
  EXPECT_DEATH(json_text(Json{{"x", INFINITY}}), "JSON has no NaN and no infinity");
  EXPECT_DEATH(json_text(Json{{"x", {1.0, NAN}}}), "JSON has no NaN and no infinity");
  EXPECT_DEATH(json_number(NAN), "NaN is not stored in files");
}

TEST(JsonText, HasNoLineLongerThan110ColumnsWhereItMayBreakOne) {
  // Objects in objects, at every depth and column at which the innermost may stand.
  for (int depth = 1; depth < 6; ++depth)
    for (std::size_t key = 1; key < 90; ++key) {
      Json json{{"a", 1}, {"b", 2}, {"c", {{"d", 3}}}};
      for (int i = 0; i < depth; ++i)
        json = Json{{std::string(i == 0 ? key : 2, 'k'), json}, {"z", Json::object()}};
      std::istringstream text(json_text(json));
      for (std::string line; std::getline(text, line);) EXPECT_LE(line.size(), 110u) << line;
      EXPECT_EQ(parse_json(text.str(), "x"), json);
    }
}

using test::error_of;

class JsonViewTest : public testing::Test {
 protected:
  template <typename Action>
  std::string refusal(Action&& action) {
    return error_of(ExitCode::bad_file, [&] { action(view_); });
  }

  const Json json_ = parse_json(R"({"a": {"list": [1, -2.5, "x", "inf", "-inf"], "big": 9223372036854775808},
                                    "flag": true, "name": "n", "least": -9223372036854775808})",
                                "x");
  const JsonView view_{json_, "c.json"};
};

TEST_F(JsonViewTest, ReadsValuesOfAllKinds) {
  const JsonView list = view_.at("a").at("list");
  EXPECT_EQ(list.size(), 5u);
  EXPECT_EQ(list.at(std::size_t{0}).integer(), 1);
  EXPECT_EQ(list.at(std::size_t{0}).number(), 1.0);
  EXPECT_EQ(list.at(std::size_t{1}).number(), -2.5);
  EXPECT_EQ(list.at(std::size_t{3}).number(), std::numeric_limits<double>::infinity());
  EXPECT_EQ(list.at(std::size_t{4}).number(), -std::numeric_limits<double>::infinity());
  EXPECT_TRUE(view_.at("flag").flag());
  EXPECT_EQ(view_.at("name").text(), "n");
  EXPECT_EQ(view_.at("least").integer(), std::numeric_limits<std::int64_t>::min());
  EXPECT_TRUE(view_.has("a"));
  EXPECT_FALSE(view_.has("b"));
  EXPECT_FALSE(view_.at("name").has("b"));
}

TEST_F(JsonViewTest, NamesFileKeyAndWhatWasExpected) {
  EXPECT_EQ(refusal([](const auto& v) { v.at("b"); }), "c.json: key 'b' is missing");
  EXPECT_EQ(refusal([](const auto& v) { v.at("a").at("b"); }), "c.json: key 'a.b' is missing");
  EXPECT_EQ(refusal([](const auto& v) { v.at("a").at("list").at(std::size_t{9}); }),
            "c.json: key 'a.list[9]' is missing");
  EXPECT_EQ(refusal([](const auto& v) { v.at("name").at("b"); }), "c.json: key 'name' must be an object");
  EXPECT_EQ(refusal([](const auto& v) { v.at("name").number(); }), "c.json: key 'name' must be a number");
  EXPECT_EQ(refusal([](const auto& v) { v.at("a").at("list").at(std::size_t{1}).integer(); }),
            "c.json: key 'a.list[1]' must be a whole number");
  EXPECT_EQ(refusal([](const auto& v) { v.at("a").at("big").integer(); }),
            "c.json: key 'a.big' must be a whole number below 2^63");
  EXPECT_EQ(refusal([](const auto& v) { v.at("name").flag(); }), "c.json: key 'name' must be true or false");
  EXPECT_EQ(refusal([](const auto& v) { v.at("flag").text(); }), "c.json: key 'flag' must be text");
  EXPECT_EQ(refusal([](const auto& v) { v.at("flag").size(); }), "c.json: key 'flag' must be a list");
  EXPECT_EQ(refusal([](const auto& v) { v.size(); }), "c.json: the document must be a list");
  EXPECT_EQ(refusal([](const auto& v) { v.at("flag").refuse("is unknown"); }),
            "c.json: key 'flag' is unknown");
}

TEST_F(JsonViewTest, ReadsWholeNumbersUpToTheLargestAndTextsOfInfinityAlone) {
  const Json json =
      parse_json(R"({"most": 9223372036854775807, "inf": "inf", "+inf": "+inf", "nan": "nan"})", "x");
  const JsonView view(json, "c.json");
  EXPECT_EQ(view.at("most").integer(), std::numeric_limits<std::int64_t>::max());
  for (const char* key : {"+inf", "nan"})
    EXPECT_EQ(error_of(ExitCode::bad_file, [&] { view.at(key).number(); }),
              std::string("c.json: key '") + key + "' must be a number");
  EXPECT_EQ(error_of(ExitCode::bad_file, [&] { view.at("inf").finite_number(); }),
            "c.json: key 'inf' must be a finite number");
  EXPECT_EQ(view.at("most").finite_number(), 0x1p63);
}

TEST_F(JsonViewTest, ListsEndAtTheirSize) {
  const JsonView list = view_.at("a").at("list");
  EXPECT_NO_THROW(list.at(std::size_t{4}));
  EXPECT_EQ(error_of(ExitCode::bad_file, [&] { list.at(std::size_t{5}); }),
            "c.json: key 'a.list[5]' is missing");
}

}  // namespace json_file_test

}  // namespace amble::io
