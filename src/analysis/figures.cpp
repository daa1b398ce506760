#include "amble/analysis/figures.hpp"

#include <fmt/format.h>

#include "amble/analysis/filmstrip_figure.hpp"
#include "amble/analysis/fitness_figure.hpp"
#include "amble/analysis/footfall_figure.hpp"
#include "amble/analysis/page_style.hpp"
#include "amble/analysis/path_figure.hpp"
#include "amble/analysis/pattern_figure.hpp"
#include "amble/core/check.hpp"

namespace amble::analysis {
namespace {

/// The inline element with the style sheet inside.
std::string standalone(std::string svg) {
  const std::size_t head_end = svg.find('>');
  AMBLE_CHECK(head_end != std::string::npos, "an SVG element begins with its tag");
  svg.insert(head_end + 1, fmt::format("\n<style>{}</style>", figure_style_sheet()));
  return svg;
}

}  // namespace

std::vector<FigureFile> figure_files(const PageInput& input, const Recorded& recorded) {
  const Motion& motion = recorded.motion;
  const RobotModel& robot = recorded.robot;
  std::vector<FigureFile> files;
  const auto add = [&](std::string name, std::string svg) {
    files.push_back({std::move(name), standalone(std::move(svg))});
  };
  const bool moved = motion.frames() > 0;
  if (moved) add("filmstrip.svg", filmstrip_figure(robot, motion, Layout::wide));
  if (input.generations && input.generations->count() > 0)
    add("fitness.svg", fitness_figure(*input.generations, Layout::wide));
  if (moved) {
    add("footfalls.svg", footfall_figure(robot, motion, Layout::wide));
    if (recorded.supg) add("patterns.svg", pattern_figure(robot, *recorded.supg, motion, Layout::wide));
    add("path.svg", path_figure(robot, motion, Layout::wide));
  }
  return files;
}

}  // namespace amble::analysis
