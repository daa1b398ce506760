#include "amble/analysis/figures.hpp"

#include "amble/analysis/filmstrip_figure.hpp"
#include "amble/analysis/fitness_figure.hpp"
#include "amble/analysis/footfall_figure.hpp"
#include "amble/analysis/page_style.hpp"
#include "amble/analysis/path_figure.hpp"
#include "amble/analysis/pattern_figure.hpp"
#include "amble/analysis/substrate_figure.hpp"

namespace amble::analysis {

std::vector<FigureFile> figure_files(const PageInput& input, const Recorded& recorded) {
  const Motion& motion = recorded.motion;
  const robot::RobotSpec& robot = recorded.robot;
  std::vector<FigureFile> files;
  const auto add = [&](std::string name, std::string svg) {
    files.push_back({std::move(name), standalone_svg(std::move(svg))});
  };
  const bool moved = motion.frames() > 0;
  if (moved) add("filmstrip.svg", filmstrip_figure(robot, motion, Layout::wide));
  if (input.generations && input.generations->count() > 0)
    add("fitness.svg", fitness_figure(*input.generations, Layout::wide));
  if (moved) {
    add("footfalls.svg", footfall_figure(robot, motion, Layout::wide));
    if (recorded.supg) add("patterns.svg", pattern_figure(robot, *recorded.supg, motion, Layout::wide));
    if (recorded.network && can_be_drawn(recorded.network->substrate))
      add("network.svg", substrate_figure(recorded.network->substrate, Layout::wide));
    add("path.svg", path_figure(robot, motion, Layout::wide));
  }
  return files;
}

}  // namespace amble::analysis
