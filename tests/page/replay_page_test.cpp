#include "amble/page/replay_page.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <regex>

#include "amble/io/base64.hpp"
#include "amble/io/file.hpp"
#include "amble/robot/deflate.hpp"
#include "tests/io/temporary_folder.hpp"
#include "tests/page/synthetic.hpp"

namespace amble::page {
namespace {

using tests::SyntheticWalk;

class ViewPageTest : public testing::Test {
 protected:
  test::TemporaryFolder folder;

  Walker walker(const SyntheticWalk& walk, const std::string& name = "walk") {
    const auto path = folder.path() / (name + ".rec");
    walk.write(path);
    return {.title = name, .recording = path, .cppn_svg = {}, .gait = nullptr};
  }
  static std::string page_of(std::vector<Walker> walkers, const std::string& title = "A title") {
    return make_page({.title = title, .walkers = std::move(walkers), .made_by = "a test"});
  }
};

/// The JSON in a page.
io::Json data_of(const std::string& page) {
  const std::string mark = "<script type=\"application/json\" id=\"amble-data\">";
  const auto start = page.find(mark) + mark.size();
  return io::parse_json(page.substr(start, page.find("</script>", start) - start), "page");
}

TEST_F(ViewPageTest, CarriesRobotsControllersAndFrames) {
  const auto data = data_of(page_of({walker({.frames = 100}, "one"), walker({.frames = 60}, "two")}));
  ASSERT_EQ(data["walkers"].size(), 2u);
  EXPECT_EQ(data["walkers"][0]["title"], "one");
  EXPECT_EQ(data["walkers"][1]["poses"]["count"], 31);
  EXPECT_EQ(data["walkers"][1]["robot"]["name"], "test robot");
  const auto controller = io::parse_json(SyntheticWalk{}.header().controller_json, "controller").dump();
  const auto deflated = io::from_base64(data["walkers"][1]["controller"].get<std::string>());
  EXPECT_EQ(robot::inflated(deflated, controller.size()), controller);
  EXPECT_EQ(data["walkers"][0]["outcome"], "completed");
}

TEST_F(ViewPageTest, CarriesUnevenGround) {
  const auto data =
      data_of(page_of({walker({.frames = 3}, "one"), walker({.frames = 3, .uneven = true}, "two")}));
  EXPECT_TRUE(data["walkers"][0]["ground"].is_null());
  const auto& ground = data["walkers"][1]["ground"];
  EXPECT_EQ(ground["cell_m"], 0.04);
  EXPECT_EQ(ground["heights"]["count"], 256);
  EXPECT_EQ(ground["heights"]["columns"].size(), 256u);
  EXPECT_LT(ground["heights"]["data"].get<std::string>().size(), 150000u);
}

TEST_F(ViewPageTest, IsTheSameEachTime) {
  const auto one = walker({.frames = 100});
  EXPECT_EQ(page_of({one}), page_of({one}));
}

TEST_F(ViewPageTest, LetsNoNameBreakOutOfItsPlace) {
  auto wicked = walker({.frames = 4});
  wicked.title = "</script><script>alert(1)</script><!-- \u2028";
  const auto page = page_of({wicked}, "<b>&amp;</title>");
  EXPECT_EQ(data_of(page)["walkers"][0]["title"], wicked.title);
  EXPECT_THAT(page, testing::HasSubstr("<title>&lt;b&gt;&amp;amp;&lt;/title&gt;</title>"));
  EXPECT_THAT(page, testing::Not(testing::HasSubstr("alert(1)</script>")));
}

TEST_F(ViewPageTest, NamesNothingOutsideItself) {
  const auto page = page_of({walker({.frames = 4})});
  const auto body = page.substr(0, page.find("<script>"));  // elements; the program is tried in a browser
  static const std::regex reference(R"re((src|href|url)\s*[=(]\s*["']?(?!data:)[\w./:]+)re");
  std::smatch match;
  EXPECT_FALSE(std::regex_search(body, match, reference)) << match.str();
  EXPECT_THAT(body, testing::HasSubstr("default-src 'none'"));
}

TEST_F(ViewPageTest, KeepsTheLicenceOfWhatIsInIt) {
  const auto page = page_of({walker({.frames = 4})});
  EXPECT_THAT(page, testing::HasSubstr("Copyright © 2010-"));
  EXPECT_THAT(page, testing::HasSubstr("Permission is hereby granted"));
}

TEST_F(ViewPageTest, StaysUnder3MegabytesForFiveMinutes) {
  const auto page = page_of({walker({.frames = 30000})});
  EXPECT_LT(page.size(), 3'000'000u);
  RecordProperty("bytes", static_cast<int>(page.size()));
}

}  // namespace
}  // namespace amble::page
