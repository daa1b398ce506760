#include "amble/figures/substrate_graph.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

#include "amble/core/error.hpp"
#include "amble/core/index.hpp"
#include "amble/figures/axis.hpp"

namespace amble::figures {

namespace {

/// Kinds by the names of the ports, in the order in which they are met.
Substrate by_port(const motion::NeuralNetwork& network, Substrate substrate) {
  substrate.link_kinds.clear();
  std::vector<double> largest;
  for (const motion::NetworkLink& link : network.links) {
    const auto found = std::ranges::find(substrate.link_kinds, link.port);
    const int kind = static_cast<int>(found - substrate.link_kinds.begin());
    if (found == substrate.link_kinds.end()) {
      substrate.link_kinds.push_back(link.port);
      largest.push_back(0.0);
    }
    largest[to_index(kind)] = std::max(largest[to_index(kind)], std::fabs(link.weight));
    substrate.links.push_back({link.source, link.target, kind, std::fabs(link.weight), link.weight < 0.0});
  }
  for (SubstrateLink& link : substrate.links)
    if (const double most = largest[to_index(link.kind)]; most > 0.0) link.strength /= most;
  return substrate;
}

}  // namespace

Substrate substrate_of(const motion::NeuralNetwork& network) {
  Substrate substrate{.coordinates = network.coordinates,
                      .nodes = network.nodes,
                      .links = {},
                      .link_kinds = {"excites", "inhibits"}};
  if (std::ranges::any_of(network.links, [](const auto& link) { return !link.port.empty(); }))
    return by_port(network, std::move(substrate));
  double largest = 0.0;
  for (const motion::NetworkLink& link : network.links) largest = std::max(largest, std::fabs(link.weight));
  for (const motion::NetworkLink& link : network.links)
    substrate.links.push_back({link.source, link.target, link.weight < 0.0 ? 1 : 0,
                               largest > 0.0 ? std::fabs(link.weight) / largest : 0.0});
  return substrate;
}

bool can_be_drawn(const Substrate& substrate) {
  return substrate.coordinates.size() <= 4;
}

namespace {

constexpr double places_margin_px = 56.0;

double coordinate(const motion::NetworkNode& node, std::size_t axis) {
  return axis < node.at.size() ? node.at[axis] : 0.0;
}

std::vector<double> distinct(const Substrate& substrate, std::size_t axis) {
  std::set<double> values;
  for (const motion::NetworkNode& node : substrate.nodes) values.insert(coordinate(node, axis));
  return {values.begin(), values.end()};
}

/// Maps the values of a coordinate to an interval of px; a single value to its middle.
Scale stretch(const std::vector<double>& values, double lower_px, double upper_px) {
  if (values.size() < 2) {
    const double middle = 0.5 * (lower_px + upper_px);
    return {{values.empty() ? 0.0 : values[0], (values.empty() ? 0.0 : values[0]) + 1.0}, middle, middle};
  }
  return {{values.front(), values.back()}, lower_px, upper_px};
}

std::vector<Point> corners(const Box& box) {
  return {{box.x, box.y}, {box.right(), box.y}, {box.right(), box.bottom()}, {box.x, box.bottom()}};
}

/// As many decimals as necessary, up to four.
std::string plain(double value) {
  int decimals = 0;
  for (double rest = value; decimals < 4 && std::fabs(rest - std::round(rest)) > 1e-6; rest *= 10.0)
    ++decimals;
  return label(value, decimals);
}

std::string title(const Substrate& substrate, std::size_t axis, double value) {
  return fmt::format("{} = {}", substrate.coordinates[axis], plain(value));
}

/// One or two coordinates: right and up.
SubstratePlaces in_a_plane(const Substrate& substrate, double width_px, double top_px) {
  constexpr double height_px = 320.0;
  SubstratePlaces places;
  places.width_px = width_px;
  places.height_px = top_px + height_px + 40.0;
  const Box box{1.0, top_px, width_px - 2.0, height_px};
  const auto xs = distinct(substrate, 0), ys = distinct(substrate, 1);
  const Scale x = stretch(xs, box.x + 1.6 * places_margin_px, box.right() - 1.6 * places_margin_px);
  const Scale y = stretch(ys, box.bottom() - places_margin_px, box.y + places_margin_px);
  for (const motion::NetworkNode& node : substrate.nodes)
    places.nodes.push_back({x(coordinate(node, 0)), y(coordinate(node, 1))});
  places.frames.push_back(corners(box));
  constexpr std::size_t most_marks = 9;
  if (xs.size() <= most_marks)
    for (const double value : xs) places.marks.push_back({{x(value), box.bottom() + 18.0}, plain(value)});
  if (substrate.coordinates.size() > 1 && ys.size() <= most_marks)
    for (const double value : ys) places.marks.push_back({{box.x + 22.0, y(value) + 4.0}, plain(value)});
  places.marks.push_back({{0.5 * width_px, box.bottom() + 36.0}, substrate.coordinates[0] + " →"});
  if (substrate.coordinates.size() > 1)
    places.titles.push_back({{box.x + 8.0, box.y + 18.0}, substrate.coordinates[1] + " ↑"});
  return places;
}

/// Three coordinates: the first upwards from plane to plane, the second into the depth of a plane, the third
/// to the right.
SubstratePlaces in_planes(const Substrate& substrate, double width_px, double top_px) {
  const double depth_px = 150.0, gap_px = 72.0, skew_px = 0.16 * width_px, edge_px = 0.07 * width_px;
  const auto levels = distinct(substrate, 0), rows = distinct(substrate, 1), columns = distinct(substrate, 2);
  SubstratePlaces places;
  places.width_px = width_px;
  places.height_px = top_px + static_cast<double>(levels.size()) * (depth_px + gap_px);
  const auto bottom = [&](double level) {
    const auto above = std::ranges::find(levels, level) - levels.begin();
    return places.height_px - gap_px + 30.0 - static_cast<double>(above) * (depth_px + gap_px);
  };
  const Scale into = stretch(rows, 0.08, 0.92),
              right = stretch(columns, edge_px, width_px - skew_px - edge_px);
  for (const motion::NetworkNode& node : substrate.nodes) {
    const double depth = into(coordinate(node, 1));
    places.nodes.push_back(
        {right(coordinate(node, 2)) + depth * skew_px, bottom(coordinate(node, 0)) - depth * depth_px});
  }
  for (const double level : levels) {
    const double front = bottom(level), back = front - depth_px;
    places.frames.push_back(
        {{1.0, front}, {width_px - skew_px, front}, {width_px - 1.0, back}, {skew_px, back}});
    places.titles.push_back({{1.0, back + 12.0}, title(substrate, 0, level)});
  }
  return places;
}

/// Four coordinates: the last two arrange modules, the first two are right and up within them.
SubstratePlaces in_modules(const Substrate& substrate, double width_px, double top_px) {
  const double height_px = 250.0, gap_px = 0.07 * width_px;
  const auto columns = distinct(substrate, 2), rows = distinct(substrate, 3);
  const auto count = static_cast<double>(columns.size());
  const double module_px = (width_px - 2.0 - (count - 1.0) * gap_px) / count;
  SubstratePlaces places;
  places.width_px = width_px;
  places.height_px = top_px + static_cast<double>(rows.size()) * (height_px + gap_px) - gap_px + 8.0;
  const auto box = [&](double column, double row) {
    const auto x = static_cast<double>(std::ranges::find(columns, column) - columns.begin());
    const auto y = static_cast<double>(rows.end() - std::ranges::find(rows, row) - 1);
    return Box{1.0 + x * (module_px + gap_px), top_px + y * (height_px + gap_px), module_px, height_px};
  };
  const auto xs = distinct(substrate, 0), ys = distinct(substrate, 1);
  std::set<std::pair<double, double>> framed;
  for (const motion::NetworkNode& node : substrate.nodes) {
    const Box own = box(coordinate(node, 2), coordinate(node, 3));
    const Scale x = stretch(xs, own.x + 0.1 * module_px, own.right() - 0.2 * module_px);
    const Scale y = stretch(ys, own.bottom() - 0.7 * places_margin_px, own.y + 0.9 * places_margin_px);
    places.nodes.push_back({x(coordinate(node, 0)), y(coordinate(node, 1))});
    if (!framed.emplace(coordinate(node, 2), coordinate(node, 3)).second) continue;
    places.frames.push_back(corners(own));
    places.titles.push_back(
        {{own.x + 8.0, own.y + 18.0},
         title(substrate, 2, coordinate(node, 2)) + ", " + title(substrate, 3, coordinate(node, 3))});
  }
  return places;
}

}  // namespace

SubstratePlaces substrate_places(const Substrate& substrate, double width_px, double top_px) {
  const std::size_t count = substrate.coordinates.size();
  if (!can_be_drawn(substrate))
    fail(ExitCode::bad_input, "a substrate with {} coordinates cannot be drawn: expected at most 4", count);
  if (count <= 2) return in_a_plane(substrate, width_px, top_px);
  return count == 3 ? in_planes(substrate, width_px, top_px) : in_modules(substrate, width_px, top_px);
}

}  // namespace amble::figures
