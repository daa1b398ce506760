#include "amble/page/figure_files.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/figures/xml.hpp"
#include "tests/motion/fixture.hpp"

namespace amble::page {
namespace {

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
