#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <sstream>
#include <string>

#include "amble/core/random.hpp"
#include "amble/io/json_file.hpp"

namespace amble::io {
namespace {

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

}  // namespace
}  // namespace amble::io
