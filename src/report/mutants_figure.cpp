#include "amble/report/mutants_figure.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "amble/core/check.hpp"
#include "amble/core/index.hpp"
#include "amble/figures/axis.hpp"
#include "amble/figures/svg.hpp"
#include "amble/report/number_text.hpp"
#include "amble/report/panels.hpp"

namespace amble::report {
namespace {

using figures::Box;
using figures::FigureSize;
using figures::Scale;
using figures::Svg;

constexpr int columns = 24, rows = 16, shades = 9;
constexpr double most_kept = 1.2;

/// The share of viable mutants, at the end of a panel's title.
struct ViableText {
  std::string_view unit;
  double width_px;

  static ViableText of(FigureSize layout) {
    return layout == FigureSize::wide ? ViableText{" viable", 92.0} : ViableText{"", 44.0};
  }
};

/// Share of a panel's mutants in each cell, row by row from below.
using Shares = std::array<double, std::size_t{columns} * rows>;

int bin(double value, double most, int bins) {
  return std::min(static_cast<int>(std::min(value / most, 1.0) * bins), bins - 1);
}

Shares shares_of(const std::vector<record::Mutant>& mutants, double most_change) {
  Shares shares{};
  for (const record::Mutant& mutant : mutants)
    shares[to_index(bin(mutant.change, most_change, rows) * columns +
                    bin(mutant.kept, most_kept, columns))] += 1.0 / static_cast<double>(mutants.size());
  return shares;
}

/// So far up that at most one mutant of a hundred is beyond, to the next 0.05.
double axis_end(std::vector<double> changes) {
  std::ranges::sort(changes);
  const double high = changes[changes.size() - 1 - changes.size() / 100];
  return std::max(0.1, std::ceil(20.0 * high - 1e-9) / 20.0);
}

/// By the root, so that the many cells with few mutants can be told from empty ones.
int shade_of(double share, double largest) {
  return std::clamp(static_cast<int>(shades * std::sqrt(share / largest)), 0, shades - 1);
}

void draw_cells(Svg& svg, const Shares& shares, double largest, const Box& plot) {
  const double width = plot.width / columns, height = plot.height / rows;
  for (int row = 0; row < rows; ++row)
    for (int column = 0; column < columns; ++column) {
      const double share = shares[to_index(row * columns + column)];
      if (share > 0.0)
        svg.rect({plot.x + column * width, plot.bottom() - (row + 1) * height, width, height},
                 fmt::format("shade{}", shade_of(share, largest)));
    }
}

void draw_panel(Svg& svg, const Shares& shares, double largest, const Box& plot, double most_change) {
  const bool is_small = plot.width < 200;
  const Scale x{{0.0, 100.0 * most_kept}, plot.x, plot.right()}, y{{0.0, most_change}, plot.bottom(), plot.y};
  figures::draw_y_axis(svg, y, figures::nice_ticks(y.data, is_small ? 3 : 5), plot.x, plot.right(), "");
  figures::draw_x_axis(svg, x, {{0.0, 50.0, 100.0}, 50.0, 0}, plot.bottom(), " %");
  draw_cells(svg, shares, largest, plot);
  const double border = x(100.0 * record::Mutant::viable_from);
  svg.line({border, plot.y}, {border, plot.bottom()}, "whisker");
}

/// All mutants of a condition's champions in a test, run by run.
std::vector<record::Mutant> mutants_of(const Report& report, std::string_view condition,
                                       std::string_view test) {
  std::vector<record::Mutant> all;
  for (const ledger::Record* run : report.data.runs(condition))
    if (const auto* result = report.data.result(*run, test))
      all.insert(all.end(), result->mutants.begin(), result->mutants.end());
  return all;
}

}  // namespace

bool has_mutants(const Report& report, std::string_view test) {
  return std::ranges::any_of(report.data.records, [&](const ledger::Record& record) {
    const auto* result = report.data.result(record, test);
    return result && !result->mutants.empty();
  });
}

std::string mutants_figure(const Report& report, const std::string& test, FigureSize layout) {
  struct Panel {
    std::string label, viable;
    std::vector<record::Mutant> mutants;
  };
  const ViableText text = ViableText::of(layout);
  std::vector<Panel> panels;
  std::vector<std::string> labels;
  std::vector<double> changes;
  for (const auto& condition : report.data.study.conditions) {
    auto mutants = mutants_of(report, condition.name, test);
    if (mutants.empty()) continue;
    for (const record::Mutant& mutant : mutants) changes.push_back(mutant.change);
    const double viable = static_cast<double>(std::ranges::count_if(mutants, &record::Mutant::viable));
    labels.push_back(condition.label());
    panels.push_back({condition.label(),
                      percent_text(viable / static_cast<double>(mutants.size())) + std::string(text.unit),
                      std::move(mutants)});
  }
  AMBLE_CHECK(!panels.empty(), "a mutant");

  PanelGrid grid = PanelGrid::of(panels.size(), layout);
  grid.make_room(labels, text.width_px);
  const double most_change = axis_end(std::move(changes));
  std::vector<Shares> shares;
  double largest = 0.0;
  for (const Panel& panel : panels) {
    shares.push_back(shares_of(panel.mutants, most_change));
    largest = std::max(largest, std::ranges::max(shares.back()));
  }
  Svg svg(width_px(layout), grid.height_px(),
          fmt::format("Mutants of {} conditions by the share of the score kept and the change of the gait",
                      panels.size()));
  for (std::size_t i = 0; i < panels.size(); ++i) {
    const Box plot = grid.plot(i);
    draw_panel(svg, shares[i], largest, plot, most_change);
    draw_panel_title(svg, grid, plot, panels[i].label, panels[i].viable, text.width_px);
  }
  return svg.finish();
}

}  // namespace amble::report
