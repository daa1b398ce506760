#include "amble/figures/cppn_figure.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <span>
#include <string_view>

#include "amble/figures/axis.hpp"
#include "amble/figures/cppn_detours.hpp"
#include "amble/figures/style_sheet.hpp"
#include "amble/figures/svg.hpp"

namespace amble::figures {
namespace {

constexpr double neuron_px = 15.0, terminal_px = 6.0;
constexpr double layer_px = 84.0, row_px = 46.0, margin_px = 26.0, detour_margin_px = 8.0;
constexpr double letter_px = 7.2;  ///< mean width of a letter of 13 px
constexpr double legend_row_px = 24.0;

/// A cubic Bézier curve by its four points.
using Stroke = std::array<Point, 4>;

struct Glyph {
  std::string_view function, title;
  std::array<Stroke, 2> strokes;
};
/// The curves of the functions, within −8 … 8 px.
constexpr std::array<Glyph, 5> glyphs{
    {{"bipolar_sigmoid",
      "sigmoid",
      {{{{{-8, 6}, {-3, 6}, {-2, 3}, {0, 0}}}, {{{0, 0}, {2, -3}, {3, -6}, {8, -6}}}}}},
     {"gaussian",
      "Gaussian",
      {{{{{-8, 6}, {-3, 6}, {-3, -6}, {0, -6}}}, {{{0, -6}, {3, -6}, {3, 6}, {8, 6}}}}}},
     {"sine", "sine", {{{{{-8, 0}, {-5, -9}, {-3, -9}, {0, 0}}}, {{{0, 0}, {3, 9}, {5, 9}, {8, 0}}}}}},
     {"linear", "linear", {{{{{-7, 6}, {-5, 4}, {-2, 2}, {0, 0}}}, {{{0, 0}, {2, -2}, {5, -4}, {7, -6}}}}}},
     {"|x|", "|x|", {{{{{-7, -6}, {-5, -2}, {-2, 2}, {0, 6}}}, {{{0, 6}, {2, 2}, {5, -2}, {7, -6}}}}}}}};

bool is_terminal(const CppnNode& node) {
  return node.role == CppnRole::bias || node.role == CppnRole::input;
}

std::string node_title(const CppnGraph& graph, std::size_t node) {
  if (is_terminal(graph.nodes[node])) return graph.name_of(node);
  return graph.name_of(node) + ": " + graph.nodes[node].function;
}

std::string link_title(const CppnGraph& graph, const CppnLink& link) {
  return fmt::format("{} → {}: {}{}", graph.name_of(link.from), graph.name_of(link.to), label(link.weight, 3),
                     link.enabled ? "" : ", disabled");
}

std::string link_class(const CppnLink& link, bool back) {
  return fmt::format("wire {}{}{}", link.weight < 0.0 ? "minus" : "plus", link.enabled ? "" : " off",
                     back ? " back" : "");
}

/// Width of a link's line, 0.8 to 6 px.
double width_of(const CppnLink& link, double most) {
  return 0.8 + 5.2 * std::fabs(link.weight) / most;
}

class Drawing {
 public:
  explicit Drawing(const CppnGraph& graph) : graph_(graph), places_(place_nodes(graph)) {
    std::size_t rows = 1, first = 0, last = 0;
    for (const auto& nodes : places_.layers) rows = std::max(rows, nodes.size());
    for (const CppnNode& node : graph.nodes) {
      if (is_terminal(node)) first = std::max(first, node.name.size());
      if (node.role == CppnRole::output) last = std::max(last, node.name.size());
    }
    const double left = 20.0 + letter_px * static_cast<double>(first),
                 right = 28.0 + letter_px * static_cast<double>(last),
                 inner = layer_px * static_cast<double>(places_.layers.size() - 1);
    width_px_ = std::max(340.0, left + inner + right);
    bottom_px_ = 2 * margin_px + row_px * static_cast<double>(rows);
    for (std::size_t node = 0; node < graph.nodes.size(); ++node) {
      const double share = static_cast<double>(places_.layer[node]) /
                           std::max(1.0, static_cast<double>(places_.layers.size() - 1));
      centres_.push_back({left + share * (width_px_ - left - right),
                          margin_px + places_.place[node] * (bottom_px_ - 2 * margin_px)});
      radii_px_.push_back(is_terminal(graph.nodes[node]) ? terminal_px : neuron_px);
    }
    names_px_ = width_px_ - right + neuron_px + 6;
    detours_ = detours(graph, places_, centres_, radii_px_);
    make_room();
  }

  std::string draw() {
    const auto legend = legend_places();
    const double top = bottom_px_;
    const double height = top + (legend.empty() ? 0.0 : legend.back().y + legend_row_px);
    Svg svg(width_px_, height,
            fmt::format("CPPN of {} nodes and {} links", graph_.nodes.size(), graph_.links.size()));
    svg.begin_group("cppn");
    draw_links(svg);
    for (std::size_t i = 0; i < graph_.nodes.size(); ++i) draw_node(svg, i);
    for (std::size_t i = 0; i < legend.size(); ++i) draw_key(svg, keys_[i], {legend[i].x, top + legend[i].y});
    svg.end_group();
    return svg.finish();
  }

 private:
  struct Key {
    std::string_view text;
    const Glyph* glyph;  ///< null: a line of class `wire`
    std::string_view wire;
  };

  /// Makes room for the detours: above and below everything else, and between the outputs and their names.
  void make_room() {
    double top = detour_margin_px, bottom = bottom_px_ - margin_px, right = names_px_ - detour_margin_px;
    for (const Detour& detour : detours_) {
      for (const Point& point : detour.curve) {
        top = std::min(top, point.y);
        bottom = std::max(bottom, point.y);
        right = std::max(right, point.x);
      }
    }
    const double down = detour_margin_px - top;
    for (Point& centre : centres_) centre.y += down;
    for (Detour& detour : detours_) {
      for (Point& point : detour.curve) point.y += down;
      detour.tip.y += down;
    }
    bottom_px_ = bottom + down + margin_px;
    width_px_ += right + detour_margin_px - names_px_;
    names_px_ = right + detour_margin_px;
  }

  /// Large weights first, so that they do not hide small ones.
  void draw_links(Svg& svg) const {
    std::vector<std::size_t> order(graph_.links.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::ranges::stable_sort(order, std::ranges::greater(),
                             [&](std::size_t i) { return std::fabs(graph_.links[i].weight); });
    const double most = graph_.heaviest_weight();
    for (const std::size_t i : order) {
      const CppnLink& link = graph_.links[i];
      const bool back = places_.leads_back(link);
      svg.begin_group(link_class(link, back), link_title(graph_, link));
      if (back)
        draw_detour(svg, detours_[i], width_of(link, most));
      else
        svg.bezier(way_forth(link), {}, width_of(link, most));
      svg.end_group();
    }
  }
  Stroke way_forth(const CppnLink& link) const {
    const Point from = centres_[link.from], to = centres_[link.to];
    const double start = from.x + radii_px_[link.from], end = to.x - radii_px_[link.to];
    const double bend = std::max(20.0, (end - start) / 2);
    return {{{start, from.y}, {start + bend, from.y}, {end - bend, to.y}, {end, to.y}}};
  }
  static void draw_detour(Svg& svg, const Detour& detour, double width) {
    svg.bezier(detour.curve, {}, width);
    const Point base = detour.curve.back(), tip = detour.tip;
    const double length = std::hypot(tip.x - base.x, tip.y - base.y);
    const double half = (2.5 + width / 2) / length;
    const double x = half * (base.y - tip.y), y = half * (tip.x - base.x);
    svg.polygon(std::array{tip, Point{base.x + x, base.y + y}, Point{base.x - x, base.y - y}});
  }

  void draw_node(Svg& svg, std::size_t i) const {
    const CppnNode& node = graph_.nodes[i];
    const Point centre = centres_[i];
    svg.begin_group(is_terminal(node) ? "terminal" : "neuron", node_title(graph_, i));
    svg.circle(centre, radii_px_[i]);
    if (!is_terminal(node)) {
      const auto glyph = std::ranges::find(glyphs, node.function, &Glyph::function);
      if (glyph != glyphs.end()) draw_glyph(svg, *glyph, centre);
    }
    if (is_terminal(node)) svg.text({centre.x - 12, centre.y + 4.5}, Anchor::end, {}, node.name);
    if (node.role == CppnRole::output) svg.text({names_px_, centre.y + 4.5}, Anchor::start, {}, node.name);
    svg.end_group();
  }

  static void draw_glyph(Svg& svg, const Glyph& glyph, Point centre) {
    for (Stroke stroke : glyph.strokes) {
      for (Point& point : stroke) point = {point.x + centre.x, point.y + centre.y};
      svg.bezier(stroke, "glyph");
    }
  }

  /// Chooses the legend's entries and returns their positions, row by row from 0.
  std::vector<Point> legend_places() {
    for (const Glyph& glyph : glyphs)
      if (std::ranges::any_of(graph_.nodes, [&](const CppnNode& node) {
            return !is_terminal(node) && node.function == glyph.function;
          }))
        keys_.push_back({glyph.title, &glyph, {}});
    const std::size_t functions = keys_.size();
    if (!graph_.links.empty()) keys_.push_back({"weight above 0", nullptr, "wire plus"});
    if (!graph_.links.empty()) keys_.push_back({"below 0", nullptr, "wire minus"});
    if (std::ranges::any_of(graph_.links, [](const CppnLink& link) { return !link.enabled; }))
      keys_.push_back({"disabled", nullptr, "wire off"});
    std::vector<Point> places;
    Point next{4.0, 0.0};
    for (std::size_t i = 0; i < keys_.size(); ++i) {
      const double needs = 42.0 + letter_px * static_cast<double>(keys_[i].text.size());
      if (next.x > 4.0 && (i == functions || next.x + needs > width_px_))
        next = {4.0, next.y + legend_row_px};
      places.push_back(next);
      next.x += needs;
    }
    return places;
  }
  static void draw_key(Svg& svg, const Key& key, Point at) {
    if (key.glyph) {
      draw_glyph(svg, *key.glyph, {at.x + 10, at.y});
    } else {
      svg.begin_group(key.wire);
      svg.bezier(Stroke{{at, {at.x + 6, at.y}, {at.x + 14, at.y}, {at.x + 20, at.y}}}, {}, 4.0);
      svg.end_group();
    }
    svg.text({at.x + 27, at.y + 4.5}, Anchor::start, "key-text", key.text);
  }

  const CppnGraph& graph_;
  CppnPlaces places_;
  std::vector<Key> keys_;
  std::vector<Point> centres_;
  std::vector<double> radii_px_;
  std::vector<Detour> detours_;
  double width_px_ = 0.0;
  double bottom_px_ = 0.0;  ///< of the part above the legend
  double names_px_ = 0.0;   ///< where the outputs' names begin
};

}  // namespace

std::string cppn_figure(const CppnGraph& graph) {
  return Drawing(graph).draw();
}

std::string cppn_svg(const CppnGraph& graph) {
  return standalone_svg(cppn_figure(graph));
}

}  // namespace amble::figures
