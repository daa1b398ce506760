#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <limits>
#include <tuple>

#include "amble/figures/figures.hpp"
#include "amble/figures/map_figure.hpp"
#include "tests/figures/cppn_samples.hpp"
#include "tests/figures/golden.hpp"
#include "tests/motion/fixture.hpp"

namespace amble::figures {
namespace golden_figures_test {

/// A wave of period `period` between −1 and 1.
double zigzag(int at, int period) {
  return std::abs(at % period - 0.5 * period) / (0.25 * period) - 1.0;
}

/// A walk that sways, lifts its legs, and has a leg that hardly touches the ground.
motion::RecordedTrial lively_walk(int frames, int legs) {
  motion::RecordedTrial walk = tests::walk(frames, legs);
  motion::Motion& motion = walk.motion;
  for (int k = 0; k < frames; ++k) {
    const auto at = static_cast<std::size_t>(k);
    const Vec3 sway{0.02 * (k % 3), 0.3 * zigzag(k, 50), 0.05 * zigzag(k, 7)};
    motion.root_m[at] = motion.root_m[at] + sway;
    motion.com_m[at] = motion.com_m[at] + sway;
    for (std::size_t joint = 0; joint < motion.angle_rad.size(); ++joint)
      motion.angle_rad[joint][at] = static_cast<float>(0.5 * zigzag(k + 2 * static_cast<int>(joint), 10));
    motion.touch[1][at] = k % 9 == 0;
  }
  for (std::size_t joint = 0; joint < walk.supg->patterns_rad.size(); ++joint)
    for (std::size_t tick = 0; tick < walk.supg->patterns_rad[joint].size(); ++tick)
      walk.supg->patterns_rad[joint][tick] = 0.3 * zigzag(static_cast<int>(3 * joint + tick), 8);
  return walk;
}

record::Generations table(bool map) {
  std::string text = "generation,best,mean,median,evaluations,steps,";
  text += map ? "coverage,qd_score,map_best\n" : "species,threshold,mean_hidden,mean_links\n";
  for (int i = 0; i < 60; ++i) {
    const double best = 5.0 * i / (20.0 + i);
    text += fmt::format("{},{},{},{},300,440000,", i, best, 0.4 * best, 0.3 * best);
    text += map ? fmt::format("{},{},{}\n", 0.01 * i, 2.5 * i, best)
                : fmt::format("{},{},{},{}\n", 3 + i % 7, 100 - i, 0.05 * i, 8 + 0.2 * i);
  }
  return record::parse_generations(text, "table");
}

/// Layers of hidden nodes with all kinds of links: forward, over several layers, back, to itself, disabled.
CppnGraph tangled_cppn() {
  CppnGraph graph = tests::cppn();
  for (std::uint32_t id = 20; id < 26; ++id)
    graph.nodes.push_back({id, CppnRole::hidden, id % 2 == 0 ? "sine" : "|x|", ""});
  const std::size_t count = graph.nodes.size();
  for (std::size_t i = 0; i < 30; ++i) {
    std::size_t to = 3 + (5 * i + i / 7) % (count - 3);
    graph.links.push_back({(7 * i) % count, to, 0.2 * static_cast<double>(i) - 3.0, i % 5 != 4});
  }
  return graph;
}

Substrate places_in(int coordinates) {
  Substrate substrate;
  substrate.link_kinds = {"inner", "outer"};
  int count = 1;
  for (int c = 0; c < coordinates; ++c, count *= 3)
    substrate.coordinates.push_back(fmt::format("axis {}", c));
  for (int i = 0; i < count; ++i) {
    motion::NetworkNode& node = substrate.nodes.emplace_back();
    node.name = fmt::format("n{}", i);
    node.role = i < 3           ? motion::NodeRole::sensor
                : i > count - 4 ? motion::NodeRole::joint
                                : motion::NodeRole::hidden;
    for (int c = 0, rest = i; c < coordinates; ++c, rest /= 3) node.at.push_back(0.5 * (rest % 3) - 0.5);
    substrate.links.push_back({i, (5 * i + 2) % count, i % 2, 0.01 * (i % 100)});
  }
  return substrate;
}

GridMap map_of(const std::vector<int>& bins) {
  GridMap map;
  map.unit = " m";
  int cells = 1;
  for (const int count : bins) {
    map.dimensions.push_back({fmt::format("duty {}", map.dimensions.size()), 0.0, 0.5, count});
    cells *= count;
  }
  for (int cell = 0; cell < cells; ++cell)
    map.objective.push_back(cell % 3 == 0 ? std::numeric_limits<double>::quiet_NaN() : 0.07 * (cell % 41));
  return map;
}

TEST(GoldenFigures, OfMotionMatchTheGoldenHashes) {
  std::map<std::string, std::string> drawn;
  for (const int legs : {2, 4, 6}) {
    const auto walk = lively_walk(120, legs);
    const auto& [robot, motion] = std::tie(walk.robot, walk.motion);
    for (const FigureSize layout : {FigureSize::wide, FigureSize::narrow}) {
      const auto name = [&](const char* kind) {
        return fmt::format("{}-{}-{}.svg", kind, legs, layout == FigureSize::wide ? "wide" : "narrow");
      };
      drawn[name("footfall")] = footfall_figure(robot, motion, layout);
      drawn[name("path")] = path_figure(robot, motion, layout);
      drawn[name("pattern")] = pattern_figure(robot, *walk.supg, motion, layout);
      drawn[name("filmstrip")] = filmstrip_figure(robot, motion, layout);
      motion::Motion told = motion;
      for (int k = 0; k < told.frames(); ++k) told.command.push_back({0.5f, k < 60 ? 0.4f : -0.4f});
      drawn[name("steering")] = steering_figure(robot, told, "note", layout);
    }
    drawn[fmt::format("pattern-{}.svg", legs)] = pattern_svg(robot, *walk.supg);
  }
  tests::expect_golden(
      drawn, {{"filmstrip-2-narrow.svg", "0fad418b8b865263"}, {"filmstrip-2-wide.svg", "f9820533861fe1cf"},
              {"filmstrip-4-narrow.svg", "3db22e8b5257b5c8"}, {"filmstrip-4-wide.svg", "66fff38cf7fd9b7f"},
              {"filmstrip-6-narrow.svg", "0d0549a45a398a94"}, {"filmstrip-6-wide.svg", "1ce8649f8f80aa58"},
              {"footfall-2-narrow.svg", "0d414ebfd1c9fc8a"},  {"footfall-2-wide.svg", "a074ed040b7df677"},
              {"footfall-4-narrow.svg", "462e40f349f1ddca"},  {"footfall-4-wide.svg", "36f25feef0069384"},
              {"footfall-6-narrow.svg", "bf304f17d4eaffab"},  {"footfall-6-wide.svg", "4de717bcc1762eae"},
              {"path-2-narrow.svg", "48294b8ff9a7b3e3"},      {"path-2-wide.svg", "39227d51a49ef849"},
              {"path-4-narrow.svg", "cbde9f1130e33b2a"},      {"path-4-wide.svg", "93bcfdab86b24316"},
              {"path-6-narrow.svg", "71937d27496770e2"},      {"path-6-wide.svg", "da7c728f54484a76"},
              {"pattern-2-narrow.svg", "6d27d43cb36e1e96"},   {"pattern-2-wide.svg", "4cf536fe099a30b7"},
              {"pattern-2.svg", "a230784e5e2c8d47"},          {"pattern-4-narrow.svg", "256c13593fbde4f9"},
              {"pattern-4-wide.svg", "51743acd617459f8"},     {"pattern-4.svg", "a1931f89e6d980c4"},
              {"pattern-6-narrow.svg", "a49509cb3d5d4efc"},   {"pattern-6-wide.svg", "5232405e173bcba2"},
              {"pattern-6.svg", "0a7898caabe475ea"},          {"steering-2-narrow.svg", "d8d308d7b8870168"},
              {"steering-2-wide.svg", "12d7bcb89371ba63"},    {"steering-4-narrow.svg", "4bcfc9420fba8740"},
              {"steering-4-wide.svg", "4909700cec9a5b03"},    {"steering-6-narrow.svg", "4edddfee6104ae73"},
              {"steering-6-wide.svg", "5ce44f3f810630aa"}});
}

TEST(GoldenFigures, OfSearchesMatchTheGoldenHashes) {
  std::map<std::string, std::string> drawn;
  for (const FigureSize layout : {FigureSize::wide, FigureSize::narrow}) {
    const char* width = layout == FigureSize::wide ? "wide" : "narrow";
    drawn[fmt::format("neat-{}.svg", width)] = fitness_figure(table(false), layout);
    drawn[fmt::format("map-elites-{}.svg", width)] =
        fitness_figure(table(true), layout, {.unit = " m/s", .title = "Speed"});
  }
  for (const std::vector<int>& bins : {std::vector{7}, {5, 4}, {3, 4, 2}, {2, 3, 4, 2}, {2, 2, 2, 2, 2, 2}})
    drawn[fmt::format("map-{}.svg", bins.size())] = map_svg(map_of(bins));
  tests::expect_golden(drawn, {{"map-1.svg", "da1469671caa3518"},
                               {"map-2.svg", "97f44e57e9eb16e4"},
                               {"map-3.svg", "5b1d465cde1ec5b7"},
                               {"map-4.svg", "bc91d28b4fb0480e"},
                               {"map-6.svg", "3c4fc938ca3b2c28"},
                               {"map-elites-narrow.svg", "adb35b484c89428f"},
                               {"map-elites-wide.svg", "28d62dfd230b774e"},
                               {"neat-narrow.svg", "12ac1f2c5ba53f49"},
                               {"neat-wide.svg", "fd4ee600acf4f479"}});
}

TEST(GoldenFigures, OfNetworksMatchTheGoldenHashes) {
  std::map<std::string, std::string> drawn;
  drawn["cppn.svg"] = cppn_svg(tests::cppn());
  drawn["tangled-cppn.svg"] = cppn_svg(tangled_cppn());
  drawn["tangled-cppn.dot"] = cppn_dot(tangled_cppn());
  for (const int coordinates : {1, 2, 3, 4}) {
    drawn[fmt::format("substrate-{}.svg", coordinates)] = substrate_svg(places_in(coordinates));
    drawn[fmt::format("substrate-{}-narrow.svg", coordinates)] =
        substrate_figure(places_in(coordinates), FigureSize::narrow);
  }
  tests::expect_golden(drawn, {{"cppn.svg", "d6930642f3b19908"},
                               {"substrate-1-narrow.svg", "31deb92fa81b4118"},
                               {"substrate-1.svg", "4f123200e014177d"},
                               {"substrate-2-narrow.svg", "e9fded149fbd3f26"},
                               {"substrate-2.svg", "909555bfc272b456"},
                               {"substrate-3-narrow.svg", "8d9e718cf6ecd848"},
                               {"substrate-3.svg", "879402ffa049d557"},
                               {"substrate-4-narrow.svg", "d80e8f33f8f67ed4"},
                               {"substrate-4.svg", "160376fc2318a66c"},
                               {"tangled-cppn.dot", "d1377aa703e7889f"},
                               {"tangled-cppn.svg", "61e312681deb04c6"}});
}

}  // namespace golden_figures_test
}  // namespace amble::figures
