#include "amble/figures/cppn_detours.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

namespace amble::figures {
namespace {

constexpr double arrow_px = 9.0, corner_px = 8.0, lane_px = 7.0;
constexpr double clear_px = 20.0;  ///< between the nodes and the first lane above or below them
constexpr double endless = std::numeric_limits<double>::infinity();

/// Parallel lanes; routes that overlap take different ones.
class Lanes {
 public:
  /// Distance from the innermost lane to the first one that is free from one end to the other, px.
  double take(double one_end, double other_end) {
    const double begin = std::min(one_end, other_end), end = std::max(one_end, other_end);
    std::size_t lane = 0;
    while (lane < taken_.size() && std::ranges::any_of(taken_[lane], [&](const auto& other) {
             return begin <= other.second && other.first <= end;
           }))
      ++lane;
    if (lane == taken_.size()) taken_.emplace_back();
    taken_[lane].emplace_back(begin, end);
    return lane_px * static_cast<double>(lane);
  }

 private:
  std::vector<std::vector<std::pair<double, double>>> taken_;
};

Point between(Point a, Point b, double share) {
  return {a.x + share * (b.x - a.x), a.y + share * (b.y - a.y)};
}

void add_line(std::vector<Point>& curve, Point to) {
  const Point from = curve.back();
  curve.insert(curve.end(), {between(from, to, 1.0 / 3.0), between(from, to, 2.0 / 3.0), to});
}

/// Straight from corner to corner, with the inner corners rounded.
std::vector<Point> rounded(std::span<const Point> corners) {
  // Distance of the control points from the corner, in radii, if a Bézier curve is to be a quarter circle.
  constexpr double close = 0.4477;
  const auto length = [](Point a, Point b) { return std::hypot(a.x - b.x, a.y - b.y); };
  std::vector<Point> curve{corners.front()};
  for (std::size_t i = 1; i + 1 < corners.size(); ++i) {
    const Point before = corners[i - 1], at = corners[i], after = corners[i + 1];
    const double to_before = length(before, at), to_after = length(at, after);
    const double radius = std::min({corner_px, to_before / 2, to_after / 2});
    add_line(curve, between(at, before, radius / to_before));
    curve.insert(curve.end(),
                 {between(at, before, close * radius / to_before),
                  between(at, after, close * radius / to_after), between(at, after, radius / to_after)});
  }
  add_line(curve, corners.back());
  return curve;
}

class Planner {
 public:
  Planner(const CppnPlaces& places, std::span<const Point> centres, std::span<const double> radii_px)
      : places_(places), centres_(centres), radii_px_(radii_px), beside_(places.layers.size()) {
    for (std::size_t node = 0; node < centres.size(); ++node) {
      top_ = std::min(top_, centres[node].y - radii_px[node]);
      bottom_ = std::max(bottom_, centres[node].y + radii_px[node]);
    }
  }

  Detour plan(const CppnLink& link) {
    if (link.from == link.to) return loop(link.from);
    return places_.layer[link.from] == places_.layer[link.to] ? beside(link) : around(link);
  }

 private:
  /// A point on the right edge of a node, `below` × its radius below the centre.
  Point port(std::size_t node, double below) const {
    const double radius = radii_px_[node];
    return {centres_[node].x + radius * std::sqrt(1.0 - below * below), centres_[node].y + radius * below};
  }
  /// The x of a free lane on the right of a node.
  double lane_beside(std::size_t node, double one_end, double other_end) {
    return centres_[node].x + radii_px_[node] + arrow_px + corner_px +
           beside_[places_.layer[node]].take(one_end, other_end);
  }

  static Detour to_the_left(std::vector<Point> corners, Point tip) {
    corners.push_back({tip.x + arrow_px, tip.y});
    return {rounded(corners), tip};
  }

  Detour loop(std::size_t node) const {
    const auto out = [&](double right, double px) {
      const double distance = radii_px_[node] + px;
      return Point{centres_[node].x + right * distance / 2,
                   centres_[node].y - distance * std::numbers::sqrt3 / 2};
    };
    return {{out(-1, 0), out(-1, 20), out(1, arrow_px + 14), out(1, arrow_px)}, out(1, 0)};
  }

  Detour beside(const CppnLink& link) {
    // Links leave a node farther from its middle than they arrive.
    const double down = centres_[link.to].y > centres_[link.from].y ? 1.0 : -1.0;
    const Point start = port(link.from, 0.65 * down), tip = port(link.to, -0.3 * down);
    const double x = lane_beside(link.from, start.y, tip.y);
    return to_the_left({start, {x, start.y}, {x, tip.y}}, tip);
  }

  Detour around(const CppnLink& link) {
    const bool above = centres_[link.from].y + centres_[link.to].y <= top_ + bottom_;
    const double out = above ? -1.0 : 1.0, far = out * endless;
    const Point start = port(link.from, 0.65 * out), tip = port(link.to, 0.3 * out);
    const double start_x = lane_beside(link.from, start.y, far), end_x = lane_beside(link.to, tip.y, far);
    Lanes& lanes = above ? above_ : below_;
    const double y = (above ? top_ : bottom_) + out * (clear_px + lanes.take(start_x, end_x));
    return to_the_left({start, {start_x, start.y}, {start_x, y}, {end_x, y}, {end_x, tip.y}}, tip);
  }

  const CppnPlaces& places_;
  std::span<const Point> centres_;
  std::span<const double> radii_px_;
  std::vector<Lanes> beside_;
  Lanes above_, below_;
  double top_ = endless, bottom_ = -endless;
};

}  // namespace

std::vector<Detour> detours(const CppnGraph& graph, const CppnPlaces& places, std::span<const Point> centres,
                            std::span<const double> radii_px) {
  std::vector<std::size_t> order;
  for (std::size_t i = 0; i < graph.links.size(); ++i)
    if (places.leads_back(graph.links[i])) order.push_back(i);
  // Short ones first, so that they take the inner lanes.
  std::ranges::stable_sort(order, {}, [&](std::size_t i) {
    const CppnLink& link = graph.links[i];
    return std::pair(places.layer[link.from] - places.layer[link.to],
                     std::abs(centres[link.from].y - centres[link.to].y));
  });
  std::vector<Detour> found(graph.links.size());
  Planner planner(places, centres, radii_px);
  for (const std::size_t i : order) found[i] = planner.plan(graph.links[i]);
  return found;
}

}  // namespace amble::figures
