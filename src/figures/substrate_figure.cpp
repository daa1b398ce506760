#include "amble/figures/substrate_figure.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <string_view>
#include <vector>

#include "amble/core/index.hpp"
#include "amble/figures/style_sheet.hpp"
#include "amble/figures/substrate_graph.hpp"
#include "amble/figures/svg.hpp"

namespace amble::figures {
namespace {

constexpr double node_px = 6.0;
/// With more links than this there are no arrowheads: they would hide the nodes.
constexpr std::size_t most_arrows = 200;
constexpr std::array<std::string_view, 3> role_classes{"node-sensor", "node-hidden", "node-joint"};
constexpr std::array<std::string_view, 3> role_names{"sensor", "hidden", "drives a joint"};

std::string_view class_of(motion::NodeRole role) {
  return role_classes[to_index(role)];
}

/// Kinds beyond the colours that there are have those again, dashed.
bool repeats_a_colour(int kind) {
  return kind >= leg_colours;
}

std::string link_class(double strength, bool dashed) {
  const std::string_view look = strength > 0.66 ? "link strong" : strength > 0.33 ? "link" : "link weak";
  return std::string(look) + (dashed ? " dashed" : "");
}

/// A line from the edge of one node to that of the other, and a head at its end.
void draw_link(Svg& svg, Point from, Point to, const std::string& look, bool with_head) {
  const double length = std::hypot(to.x - from.x, to.y - from.y);
  const Point along{(to.x - from.x) / length, (to.y - from.y) / length};
  const auto at = [&](double from_end_px, double aside_px) {
    return Point{to.x - along.x * from_end_px - along.y * aside_px,
                 to.y - along.y * from_end_px + along.x * aside_px};
  };
  const Point start{from.x + along.x * node_px, from.y + along.y * node_px};
  svg.line(start, at(node_px, 0.0), look);
  if (with_head)
    svg.polygon(std::array{at(node_px + 1.0, 0.0), at(node_px + 8.0, 3.0), at(node_px + 8.0, -3.0)}, "arrow");
}

void draw_links(Svg& svg, const Substrate& substrate, const SubstratePlaces& places) {
  const bool many = substrate.links.size() > most_arrows;
  for (std::size_t kind = 0; kind < substrate.link_kinds.size(); ++kind) {
    svg.begin_group(leg_class(static_cast<int>(kind)) + (many ? " many" : ""));
    for (const SubstrateLink& link : substrate.links) {
      if (to_index(link.kind) != kind) continue;
      const Point from = places.nodes[to_index(link.source)], to = places.nodes[to_index(link.target)];
      if (link.source == link.target) {
        svg.circle({from.x + node_px, from.y - node_px}, node_px, "loop");
      } else if (from != to) {
        draw_link(svg, from, to, link_class(link.strength, link.negative || repeats_a_colour(link.kind)),
                  !many);
      }
    }
    svg.end_group();
  }
}

void draw_node(Svg& svg, Point at, motion::NodeRole role) {
  if (role == motion::NodeRole::sensor) {
    svg.rect({at.x - node_px + 1, at.y - node_px + 1, 2 * node_px - 2, 2 * node_px - 2}, class_of(role), 1.5);
  } else {
    svg.circle(at, node_px, class_of(role));
  }
}

/// What a legend says: roles of nodes and kinds of links that there are.
struct LegendEntry {
  std::string_view text;
  int role = -1, kind = -1;  ///< one of them; neither: what dashes mean
  Point at = {};             ///< of its mark
};

constexpr double legend_line_px = 18.0;

/// In rows that the picture is wide enough for.
std::vector<LegendEntry> legend_of(const Substrate& substrate, double width_px) {
  std::vector<LegendEntry> entries;
  for (std::size_t role = 0; role < role_names.size(); ++role)
    if (std::ranges::any_of(substrate.nodes, [&](const motion::NetworkNode& node) {
          return node.role == static_cast<motion::NodeRole>(role);
        }))
      entries.push_back({.text = role_names[role], .role = static_cast<int>(role)});
  for (std::size_t kind = 0; kind < substrate.link_kinds.size(); ++kind)
    if (std::ranges::any_of(substrate.links,
                            [&](const SubstrateLink& link) { return link.kind == static_cast<int>(kind); }))
      entries.push_back({.text = substrate.link_kinds[kind], .kind = static_cast<int>(kind)});
  if (std::ranges::any_of(substrate.links, &SubstrateLink::negative))
    entries.push_back({.text = "dashed: of negative weight"});
  constexpr double left_px = node_px + 1.0, letter_px = 7.4;
  Point at{left_px, 12.0};
  for (LegendEntry& entry : entries) {
    const double wide_px = 12.0 + letter_px * static_cast<double>(entry.text.size());
    if (at.x > left_px && at.x + wide_px > width_px) at = {left_px, at.y + legend_line_px};
    entry.at = at;
    at.x += wide_px + 26.0;
  }
  return entries;
}

void draw_legend(Svg& svg, const std::vector<LegendEntry>& entries) {
  for (const LegendEntry& entry : entries) {
    const Point at = entry.at;
    if (entry.role >= 0) {
      draw_node(svg, at, static_cast<motion::NodeRole>(entry.role));
    } else if (entry.kind >= 0) {
      svg.begin_group(leg_class(entry.kind));
      svg.line({at.x - 8.0, at.y}, {at.x + 6.0, at.y}, link_class(1.0, repeats_a_colour(entry.kind)));
      svg.end_group();
    } else {
      svg.line({at.x - 8.0, at.y}, {at.x + 6.0, at.y}, "axis dashed");
    }
    svg.text({at.x + 12.0, at.y + 4.0}, Anchor::start, "value", entry.text);
  }
}

/// Names to the lower right of their nodes; one that would cover another or stand out goes down line by line,
/// or to the left.
void draw_names(Svg& svg, const Substrate& substrate, const SubstratePlaces& places) {
  constexpr double letter_px = 5.6, line_px = 11.0;
  constexpr int most_lines = 4;
  std::vector<Box> taken;
  for (std::size_t i = 0; i < substrate.nodes.size(); ++i) {
    const std::string& name = substrate.nodes[i].name;
    const double wide_px = letter_px * static_cast<double>(name.size());
    const Point at = places.nodes[i];
    Box box{std::min(at.x + node_px + 2.0, places.width_px - wide_px), at.y + node_px, wide_px, line_px};
    const auto covers = [&](const Box& other) {
      return box.x < other.right() && other.x < box.right() && box.y < other.bottom() - 0.5 &&
             other.y < box.bottom() - 0.5;
    };
    for (int line = 1; line < most_lines && std::ranges::any_of(taken, covers); ++line) box.y += line_px;
    taken.push_back(box);
    svg.text({box.x, box.y + 9.0}, Anchor::start, "tiny halo", name);
  }
}

}  // namespace

std::string substrate_figure(const Substrate& substrate, FigureSize layout) {
  const bool wide = layout == FigureSize::wide;
  const std::vector<LegendEntry> legend =
      wide ? legend_of(substrate, width_px(layout)) : std::vector<LegendEntry>();
  const double top_px = legend.empty() ? 8.0 : 24.0 + legend.back().at.y;
  const SubstratePlaces places = substrate_places(substrate, width_px(layout), top_px);
  Svg svg(places.width_px, places.height_px,
          fmt::format("Substrate of {} nodes and {} links", substrate.nodes.size(), substrate.links.size()));
  for (const auto& frame : places.frames) svg.polygon(frame, "plane");
  draw_links(svg, substrate, places);
  for (std::size_t i = 0; i < substrate.nodes.size(); ++i)
    draw_node(svg, places.nodes[i], substrate.nodes[i].role);
  if (wide) {
    draw_names(svg, substrate, places);
    for (const auto& [at, text] : places.marks) svg.text(at, Anchor::middle, "tick", text);
    for (const auto& [at, text] : places.titles) svg.text(at, Anchor::start, "tick halo", text);
    draw_legend(svg, legend);
  }
  return svg.finish();
}

std::string substrate_svg(const Substrate& substrate) {
  return standalone_svg(substrate_figure(substrate, FigureSize::wide));
}

}  // namespace amble::figures
