#include "amble/page/figure_files.hpp"

#include "amble/figures/figures.hpp"
#include "amble/figures/style_sheet.hpp"

namespace amble::page {

using figures::FigureSize;

std::vector<FigureFile> figure_files(const RunPage& page, const motion::RecordedTrial& recorded) {
  const motion::Motion& motion = recorded.motion;
  const robot::RobotSpec& robot = recorded.robot;
  std::vector<FigureFile> files;
  const auto add = [&](std::string name, std::string svg) {
    files.push_back({std::move(name), figures::standalone_svg(std::move(svg))});
  };
  const bool moved = motion.frames() > 0;
  if (moved) {
    add("filmstrip.svg", figures::filmstrip_figure(robot, motion, FigureSize::wide));
    files.push_back(
        {"walk.svg", figures::with_rules(figures::standalone_svg(figures::walk_animation(robot, motion)),
                                         figures::animation_style(motion))});
  }
  if (page.generations && page.generations->count() > 0)
    add("fitness.svg", figures::fitness_figure(*page.generations, FigureSize::wide, page.objective));
  if (moved) {
    add("footfalls.svg", figures::footfall_figure(robot, motion, FigureSize::wide));
    if (recorded.supg)
      add("patterns.svg", figures::pattern_figure(robot, *recorded.supg, motion, FigureSize::wide));
    if (recorded.network)
      if (const auto substrate = figures::substrate_of(*recorded.network); figures::can_be_drawn(substrate))
        add("network.svg", figures::substrate_figure(substrate, FigureSize::wide));
    add("path.svg", figures::path_figure(robot, motion, FigureSize::wide));
  }
  return files;
}

}  // namespace amble::page
