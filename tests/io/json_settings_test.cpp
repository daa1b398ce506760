#include <gtest/gtest.h>

#include <functional>

#include "amble/io/json_file.hpp"
#include "tests/io/expect_error.hpp"
#include "tests/io/random_sample.hpp"

namespace amble::io {
namespace json_settings_test {

using test::error_of;
using test::Sample;

/// The error about the sample's JSON after `change`.
std::string refusal(const std::function<void(Json&)>& change) {
  Json json = settings_to_json(Sample{});
  change(json);
  return error_of(ExitCode::bad_file,
                  [&] { settings_from_json<Sample>(JsonView(json, "c.json", "config")); });
}

TEST(JsonSettings, WritesEveryFieldInOrder) {
  EXPECT_EQ(
      settings_to_json(Sample{}).dump(),
      R"({"inner":{"rate":0.25,"seed":1},"name":"walker","population":300,"friction":"inf","elitism":true,)"
      R"("colour":"green","weights":[1.0,-2.5],"legs":["FL","FR"],"knots":[{"name":"first","at":[1.0,2.0],"length":0.5,"tight":false},)"
      R"({"name":"second","at":[],"length":0.25,"tight":true}],"outer":{"deep":{"rate":0.25,"seed":1}}})");
}

TEST(JsonSettings, ReadBackRandomSettingsToTheBit) {
  Stream stream(1, Purpose::test);
  for (int i = 0; i < 1000; ++i) {
    const Sample sample = test::random_sample(stream);
    const Json json = parse_json(json_text(settings_to_json(sample)), "x");
    ASSERT_EQ(test::fingerprint(settings_from_json<Sample>(JsonView(json, "x"))), test::fingerprint(sample))
        << json;
  }
}

TEST(JsonSettings, DemandEveryKeyAndRefuseUnknownOnes) {
  EXPECT_EQ(refusal([](Json& json) { json.erase("population"); }),
            "c.json: key 'config.population' is missing");
  EXPECT_EQ(refusal([](Json& json) { json["outer"]["deep"].erase("seed"); }),
            "c.json: key 'config.outer.deep.seed' is missing");
  EXPECT_EQ(refusal([](Json& json) { json["extra"] = 1; }), "c.json: key 'config.extra' is unknown");
  EXPECT_EQ(refusal([](Json& json) { json["outer"]["deep"]["extra"] = 1; }),
            "c.json: key 'config.outer.deep.extra' is unknown");
}

TEST(JsonSettings, RefuseWrongTypesAndRanges) {
  EXPECT_EQ(refusal([](Json& json) { json["inner"] = 1; }), "c.json: key 'config.inner' must be an object");
  EXPECT_EQ(refusal([](Json& json) { json["population"] = 1; }),
            "c.json: key 'config.population' must be a whole number from 2 to 1000000");
  EXPECT_EQ(refusal([](Json& json) { json["population"] = 3.0; }),
            "c.json: key 'config.population' must be a whole number from 2 to 1000000");
  EXPECT_EQ(refusal([](Json& json) { json["inner"]["rate"] = 1.5; }),
            "c.json: key 'config.inner.rate' must be a number from 0 to 1");
  EXPECT_EQ(refusal([](Json& json) { json["inner"]["rate"] = "inf"; }),
            "c.json: key 'config.inner.rate' must be a number from 0 to 1");
  EXPECT_EQ(refusal([](Json& json) { json["elitism"] = 1; }),
            "c.json: key 'config.elitism' must be true or false");
  EXPECT_EQ(refusal([](Json& json) { json["colour"] = "pink"; }),
            "c.json: key 'config.colour' must be one of \"red\", \"green\", \"blue\"");
  EXPECT_EQ(refusal([](Json& json) { json["weights"][1] = 11; }),
            "c.json: key 'config.weights[1]' must be a number from -10 to 10");
  EXPECT_EQ(refusal([](Json& json) { json["legs"][0] = 11; }), "c.json: key 'config.legs[0]' must be text");
  EXPECT_EQ(refusal([](Json& json) { json = Json::array(); }), "c.json: key 'config' must be an object");
}

TEST(JsonSettings, NamePlaceOfABadItemOfAList) {
  EXPECT_EQ(refusal([](Json& json) { json["knots"][1]["length"] = 2.0; }),
            "c.json: key 'config.knots[1].length' must be a number from 0 to 1");
  EXPECT_EQ(refusal([](Json& json) { json["knots"][0].erase("at"); }),
            "c.json: key 'config.knots[0].at' is missing");
  EXPECT_EQ(refusal([](Json& json) { json["knots"][0]["colour"] = "red"; }),
            "c.json: key 'config.knots[0].colour' is unknown");
  EXPECT_EQ(refusal([](Json& json) { json["knots"][0] = 1; }),
            "c.json: key 'config.knots[0]' must be an object");
}

}  // namespace json_settings_test
}  // namespace amble::io
