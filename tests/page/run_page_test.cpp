#include "amble/page/run_page.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <string>

#include "tests/figures/golden.hpp"
#include "tests/figures/xml.hpp"
#include "tests/motion/fixture.hpp"

namespace amble::page {
namespace {

using testing::Contains;
using testing::HasSubstr;
using testing::Not;

RunPage input() {
  RunPage page;
  page.title = "A <walker> & more";
  page.subtitle = "by \"evolution\"";
  page.cppn = CppnSize{7, 41};
  page.facts = {{"Seed", "1"}, {"Config", "a<b>.toml"}};
  page.commands = {"amble evolve a.toml --out runs/1 && amble page runs/1"};
  page.generations = record::parse_generations(
      "generation,best,mean,median,species,threshold,mean_hidden,mean_links,evaluations,steps\n"
      "0,0.5,0.25,0.2,3,100,0,8,300,440000\n1,1.5,0.5,0.4,5,90,0.5,9,300,450000\n",
      "x");
  return page;
}

/// Texts of the headline numbers, by their names.
std::map<std::string, std::string> headline(const std::string& page) {
  std::map<std::string, std::string> numbers;
  std::string name;
  for (const auto& element : tests::parse_xml(page)) {
    if (element.name == "dt") name = element.text;
    if (element.name == "dd") numbers[name] = element.text;
  }
  return numbers;
}

TEST(Page, IsWellFormedWhateverTheTexts) {
  const auto elements = tests::parse_xml(make_page(input(), tests::walk(150)));
  const auto text_of = [&](const std::string& name) {
    for (const auto& element : elements)
      if (element.name == name) return element.text;
    return std::string("none");
  };
  EXPECT_EQ(text_of("title"), "A <walker> & more");
  EXPECT_EQ(text_of("h1"), "A <walker> & more");
  EXPECT_EQ(text_of("pre"), "amble evolve a.toml --out runs/1 && amble page runs/1\n");
}

TEST(Page, NeedsNeitherNetworkNorScripts) {
  const std::string page = make_page(input(), tests::walk(150));
  for (const char* word :
       {"<script", "<link", "<img", "<iframe", "url(", "@import", "src=", "href=", "javascript"})
    EXPECT_THAT(page, Not(HasSubstr(word)));
  // The only addresses are names of XML namespaces.
  std::size_t addresses = 0, namespaces = 0;
  for (std::size_t at = 0; (at = page.find("://", at)) != std::string::npos; ++at) ++addresses;
  for (std::size_t at = 0; (at = page.find("xmlns=\"http://www.w3.org/", at)) != std::string::npos; ++at)
    ++namespaces;
  EXPECT_EQ(addresses, namespaces);
}

TEST(Page, GivesTheNumbersOfTheRecording) {
  // 15 s at 0.5 m/s.
  const std::string page = make_page(input(), tests::walk(150));
  const auto numbers = headline(page);
  EXPECT_EQ(numbers.at("Distance"), "7.50 ");
  EXPECT_EQ(numbers.at("Upright, full time"), "15.0 ");
  EXPECT_EQ(numbers.at("Mean speed"), "0.50 ");
  EXPECT_EQ(numbers.at("Compositional pattern producing network (CPPN)"), "7 ");
  EXPECT_THAT(page, HasSubstr("<h2>Seen from above: 7.50 m</h2>"));
  EXPECT_THAT(
      page, HasSubstr("Distance walked over 2 generations: 600 evaluations, 890\u202f000 simulated steps."));
  // Leg 0 comes down every 0.4 s from 0.5 s on: 37 times until 14.9 s.
  EXPECT_THAT(page, HasSubstr("<span class=\"key leg0\"><small>FL</small> 37</span>"));
}

TEST(Page, SaysHowTheTrialEnded) {
  motion::RecordedTrial recorded = tests::walk(23);
  recorded.motion.outcome = record::Outcome::fell;
  EXPECT_EQ(headline(make_page(input(), recorded)).at("Upright, then fell"), "2.3 ");
  recorded.motion.outcome = record::Outcome::diverged;
  EXPECT_EQ(headline(make_page(input(), recorded)).at("Until it diverged"), "2.3 ");
}

TEST(Page, HoldsEveryFigureInBothLayouts) {
  const auto elements = tests::parse_xml(make_page(input(), tests::walk(150)));
  int pictures = 0;
  for (const auto& element : elements) pictures += element.name == "svg";
  EXPECT_EQ(pictures, 10);
  EXPECT_EQ(tests::with_class(elements, "wide").size(), 5u);
  EXPECT_EQ(tests::with_class(elements, "narrow").size(), 5u);
}

TEST(Page, DoesWithoutGenerationsFactsAndCommands) {
  RunPage bare;
  bare.title = "t";
  const std::string page = make_page(bare, tests::walk(20));
  tests::parse_xml(page);
  EXPECT_THAT(page, Not(HasSubstr("How it learned")));
  EXPECT_THAT(page, Not(HasSubstr("How this was made")));
}

TEST(Page, SaysSoIfNoGenerationIsFinished) {
  RunPage page = input();
  page.generations = record::Generations{};
  EXPECT_THAT(make_page(page, tests::walk(20)), HasSubstr("No generation has been finished yet."));
}

TEST(Page, DrawsTheNetworkOfAControllerWithoutTimers) {
  motion::RecordedTrial recorded = tests::walk(20);
  recorded.controller_kind = "ctrnn";
  recorded.network = motion::parse_network(tests::network_json(), "test");
  recorded.supg.reset();
  recorded.motion.timer_ticks.clear();
  recorded.motion.trigger.clear();
  const std::string page = make_page(input(), recorded);
  tests::parse_xml(page);
  EXPECT_THAT(page, HasSubstr("2 of 4 possible links are expressed."));
  EXPECT_THAT(page, Not(HasSubstr("Temporal patterns")));
  EXPECT_THAT(page, Not(HasSubstr("<dt>Triggers</dt>")));
}

TEST(Page, DrawsNetworkAndPatternsOfAControllerThatHasBoth) {
  motion::RecordedTrial recorded = tests::walk(20);
  recorded.controller_kind = "mixed";
  recorded.network = motion::parse_network(tests::network_json(), "test");
  for (motion::NetworkLink& link : recorded.network->links) link.port = "rate";
  const std::string page = make_page(input(), recorded);
  tests::parse_xml(page);
  EXPECT_THAT(page, HasSubstr("2 of 4 possible links are expressed."));
  EXPECT_THAT(page, HasSubstr(">rate</text>"));
  EXPECT_THAT(page, HasSubstr("Temporal patterns"));
}

TEST(Page, DrawsWhatItWasToldBesideWhatItDid) {
  motion::RecordedTrial recorded = tests::walk(20);
  EXPECT_THAT(make_page(input(), recorded), Not(HasSubstr("Told and done")));
  recorded.motion.command.assign(20, {0.5f, 0.1f});
  const std::string page = make_page(input(), recorded);
  tests::parse_xml(page);
  EXPECT_THAT(page, HasSubstr("Told and done"));
  const auto files = figure_files(input(), recorded);
  EXPECT_TRUE(std::ranges::any_of(files, [](const auto& file) { return file.name == "steering.svg"; }));
}

TEST(Page, SaysSoIfItCannotDrawTheController) {
  motion::RecordedTrial recorded = tests::walk(20);
  recorded.controller_kind = "spring";
  recorded.supg.reset();
  EXPECT_THAT(make_page(input(), recorded), HasSubstr("of kind “spring”, which is not drawn"));
}

TEST(Page, SaysSoIfAFootNeverTouches) {
  motion::RecordedTrial recorded = tests::walk(20);
  recorded.motion.touch[1].assign(20, false);
  recorded.motion.touch[3].assign(20, false);
  EXPECT_THAT(make_page(input(), recorded), HasSubstr("Never on the ground: FR, BR."));
  EXPECT_THAT(make_page(input(), tests::walk(20)), Not(HasSubstr("Never on the ground")));
}

TEST(Page, SaysSoIfNothingWasRecorded) {
  const std::string page = make_page(input(), tests::walk(0));
  tests::parse_xml(page);
  EXPECT_THAT(page, HasSubstr("No step was recorded"));
}

TEST(Page, TakesOneFrameAndOtherLegCounts) {
  for (const int legs : {1, 2, 6, 9})
    for (const int frames : {1, 2, 30}) tests::parse_xml(make_page(input(), tests::walk(frames, legs)));
}

TEST(Page, IsTheSameForTheSameInput) {
  EXPECT_EQ(make_page(input(), tests::walk(40)), make_page(input(), tests::walk(40)));
}

TEST(GoldenPage, OfWalksOnTwoFourAndSixLegsMatchesTheGoldenHash) {
  RunPage bare = input();
  bare.generations = {};
  bare.cppn = {};
  tests::expect_golden({{"page-2.html", make_page(input(), tests::walk(30, 2))},
                        {"page-4.html", make_page(input(), tests::walk(150))},
                        {"page-6.html", make_page(bare, tests::walk(80, 6))}},
                       {{"page-2.html", "5d94980ba02d4044"},
                        {"page-4.html", "7a8132767450ec1f"},
                        {"page-6.html", "3efe214ef80621eb"}});
}

std::vector<std::string> names(const std::vector<FigureFile>& files) {
  std::vector<std::string> result;
  for (const auto& file : files) result.push_back(file.name);
  return result;
}

TEST(Figures, AreOnePerSectionOfThePage) {
  using Names = std::vector<std::string>;
  RunPage input;
  EXPECT_EQ(names(figure_files(input, tests::walk(150))),
            (Names{"filmstrip.svg", "walk.svg", "footfalls.svg", "patterns.svg", "path.svg"}));
  input.generations = record::Generations();
  EXPECT_EQ(names(figure_files(input, tests::walk(0))), Names{}) << "no generation is complete yet";
  input.generations = record::parse_generations(
      "generation,best,mean,median,species,threshold,mean_hidden,mean_links,evaluations,steps\n"
      "0,0.5,0.25,0.2,3,100,0,8,300,440000\n",
      "x");
  EXPECT_EQ(names(figure_files(input, tests::walk(0))), Names{"fitness.svg"});
  for (const auto& name : names(figure_files(input, tests::walk(150))))
    EXPECT_NE(std::ranges::find(figure_names, name), figure_names.end()) << name;
  auto other_kind = tests::walk(150);
  other_kind.supg.reset();
  EXPECT_EQ(names(figure_files(input, other_kind)),
            (Names{"filmstrip.svg", "walk.svg", "fitness.svg", "footfalls.svg", "path.svg"}));
}

TEST(Figures, AreSelfContainedWithTheirOwnStyle) {
  for (const auto& file : figure_files({}, tests::walk(150))) {
    const auto elements = tests::parse_xml(file.svg);
    ASSERT_GE(elements.size(), 2u) << file.name;
    EXPECT_EQ(elements[0].name, "svg");
    EXPECT_EQ(elements[0].attributes.at("xmlns"), "http://www.w3.org/2000/svg");
    ASSERT_EQ(elements[1].name, "style");
    EXPECT_NE(elements[1].text.find("#16191d"), std::string::npos) << file.name;
    EXPECT_EQ(elements[1].text.find("var("), std::string::npos) << file.name;
    EXPECT_EQ(elements[1].text.find("url("), std::string::npos) << file.name;
  }
}

}  // namespace

}  // namespace amble::page
