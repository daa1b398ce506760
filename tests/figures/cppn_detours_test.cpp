#include "amble/figures/cppn_detours.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace amble::figures {
namespace {

constexpr double radius_px = 15.0;

double distance(Point a, Point b) {
  return std::hypot(a.x - b.x, a.y - b.y);
}

/// Points on a chain of Bézier curves, close to each other.
std::vector<Point> sampled(const std::vector<Point>& curve) {
  std::vector<Point> points;
  for (std::size_t i = 0; i + 3 < curve.size(); i += 3) {
    for (int k = 0; k <= 20; ++k) {
      const double t = k / 20.0, s = 1.0 - t;
      const double w[] = {s * s * s, 3 * s * s * t, 3 * s * t * t, t * t * t};
      Point point;
      for (std::size_t j = 0; j < 4; ++j)
        point = {point.x + w[j] * curve[i + j].x, point.y + w[j] * curve[i + j].y};
      points.push_back(point);
    }
  }
  return points;
}

/// Three inputs, hidden nodes 3 … 6 one after the other, outputs 7 … 10; and these links, too.
class CppnDetours : public testing::Test {
 protected:
  void plan(const std::vector<std::pair<std::size_t, std::size_t>>& back) {
    using enum CppnRole;
    const CppnRole roles[] = {bias,   input,  input,  hidden, hidden, hidden,
                              hidden, output, output, output, output};
    for (std::uint32_t i = 0; i < 11; ++i) graph_.nodes.push_back({i, roles[i], "sine", ""});
    for (std::size_t i = 2; i < 7; ++i) graph_.links.push_back({i, i + 1, 1.0, true});
    for (const auto& [from, to] : back) graph_.links.push_back({from, to, 1.0, true});
    places_ = place_nodes(graph_);
    for (std::size_t i = 0; i < graph_.nodes.size(); ++i)
      centres_.push_back(
          {100.0 + 84.0 * static_cast<double>(places_.layer[i]), 50.0 + 200.0 * places_.place[i]});
    found_ = detours(graph_, places_, centres_, std::vector<double>(graph_.nodes.size(), radius_px));
  }
  const Detour& last() const { return found_.back(); }
  void expect_from_edge_to_edge() const {
    for (std::size_t i = 0; i < graph_.links.size(); ++i) {
      ASSERT_EQ(found_[i].curve.empty(), !places_.leads_back(graph_.links[i])) << i;
      if (found_[i].curve.empty()) continue;
      EXPECT_NEAR(distance(found_[i].curve.front(), centres_[graph_.links[i].from]), radius_px, 1e-9);
      EXPECT_NEAR(distance(found_[i].tip, centres_[graph_.links[i].to]), radius_px, 1e-9);
      EXPECT_NEAR(distance(found_[i].tip, found_[i].curve.back()), 9.0, 1e-9);
    }
  }
  void expect_clear_of_nodes() const {
    for (const Detour& detour : found_)
      for (const Point& point : sampled(detour.curve))
        for (const Point& centre : centres_) EXPECT_GE(distance(point, centre), radius_px - 1e-9);
  }

  CppnGraph graph_;
  CppnPlaces places_;
  std::vector<Point> centres_;
  std::vector<Detour> found_;
};

TEST_F(CppnDetours, WithinALayerRunOnItsRight) {
  plan({{10, 8}});
  expect_from_edge_to_edge();
  expect_clear_of_nodes();
  EXPECT_GT(last().tip.x, centres_[8].x);
  EXPECT_EQ(last().curve.back(), (Point{last().tip.x + 9.0, last().tip.y})) << "it arrives from the right";
  for (const Point& point : sampled(last().curve)) EXPECT_GT(point.x, centres_[8].x);
}

TEST_F(CppnDetours, ToEarlierLayersRunOutsideOnTheNearerSide) {
  plan({{7, 3}});
  expect_from_edge_to_edge();
  expect_clear_of_nodes();
  const auto outside = [&](Point point) { return point.y < centres_[7].y - radius_px; };
  EXPECT_TRUE(std::ranges::any_of(last().curve, outside)) << "output 7 is the topmost";
}

TEST_F(CppnDetours, OfTheLowerNodesRunBelow) {
  plan({{10, 6}});
  expect_from_edge_to_edge();
  expect_clear_of_nodes();
  const double lowest = centres_[10].y + radius_px;
  EXPECT_TRUE(std::ranges::any_of(last().curve, [&](Point point) { return point.y > lowest; }));
}

TEST_F(CppnDetours, FromANodeToItselfAreLoopsAboveIt) {
  plan({{9, 9}});
  expect_from_edge_to_edge();
  expect_clear_of_nodes();
  for (const Point& point : sampled(last().curve)) {
    EXPECT_LT(point.y, centres_[9].y);
    EXPECT_GT(point.y, centres_[9].y - 31.0) << "the node above begins there at the latest";
  }
}

TEST_F(CppnDetours, HaveLanesOfTheirOwn) {
  // All four run on the right of the outputs, over each other's span.
  plan({{7, 10}, {10, 7}, {8, 10}, {9, 7}});
  expect_from_edge_to_edge();
  expect_clear_of_nodes();
  std::vector<double> lanes;
  for (std::size_t i = graph_.links.size() - 4; i < graph_.links.size(); ++i)
    lanes.push_back(std::ranges::max(found_[i].curve, {}, &Point::x).x);
  std::ranges::sort(lanes);
  for (std::size_t i = 1; i < lanes.size(); ++i) EXPECT_NEAR(lanes[i] - lanes[i - 1], 7.0, 1e-9);
  // Those that do not overlap may share one.
  graph_ = {};
  centres_.clear();
  plan({{7, 8}, {9, 10}});
  EXPECT_EQ(std::ranges::max(found_[5].curve, {}, &Point::x).x,
            std::ranges::max(found_[6].curve, {}, &Point::x).x);
}

TEST_F(CppnDetours, KeepClearOfAllNodesInAnyFewCycles) {
  std::minstd_rand random(11);
  const auto from_hidden_on = [&] { return 3 + static_cast<std::size_t>(random()) % 8; };
  for (int round = 0; round < 300; ++round) {
    graph_ = {};
    centres_.clear();
    plan({{from_hidden_on(), from_hidden_on()},
          {from_hidden_on(), from_hidden_on()},
          {from_hidden_on(), from_hidden_on()}});
    expect_from_edge_to_edge();
    expect_clear_of_nodes();
    if (HasFailure()) break;
  }
}

}  // namespace
}  // namespace amble::figures
