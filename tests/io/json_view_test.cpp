#include <gtest/gtest.h>

#include "amble/io/json_file.hpp"
#include "tests/io/expect_error.hpp"

namespace amble::io {
namespace {

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

}  // namespace
}  // namespace amble::io
