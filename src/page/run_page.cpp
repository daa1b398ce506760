#include "amble/page/run_page.hpp"

#include <fmt/format.h>
#include <functional>
#include <string_view>

#include "amble/core/index.hpp"
#include "amble/figures/figures.hpp"
#include "amble/figures/style_sheet.hpp"
#include "amble/figures/svg.hpp"
#include "amble/io/quoting.hpp"
#include "amble/motion/footfalls.hpp"
#include "amble/page/html_page.hpp"

namespace amble::page {
namespace {

using figures::FigureSize, figures::leg_class, io::escape_xml;

/// Both layouts of a figure; the style sheet shows the one that fits.
std::string both(const std::function<std::string(FigureSize)>& figure) {
  return fmt::format("<figure><div class=\"wide\">{}</div><div class=\"narrow\">{}</div></figure>\n",
                     figure(FigureSize::wide), figure(FigureSize::narrow));
}

std::string section(std::string_view title, std::string_view text, std::string_view content) {
  const std::string lead = text.empty() ? "" : fmt::format("<p>{}</p>\n", escape_xml(text));
  return fmt::format("<section>\n<h2>{}</h2>\n{}{}</section>\n", escape_xml(title), lead, content);
}

std::string note(std::string_view text) {
  return fmt::format("<p class=\"note\">{}</p>\n", escape_xml(text));
}

std::string leg_keys(const robot::RobotSpec& robot) {
  std::string keys = "<p class=\"keys\">";
  for (std::size_t leg = 0; leg < robot.legs.size(); ++leg)
    keys += fmt::format("<span class=\"key {}\">{}</span> ", leg_class(static_cast<int>(leg)),
                        escape_xml(robot.legs[leg].name));
  return keys + "</p>\n";
}

std::string headline_number(std::string_view name, std::string_view value, std::string_view unit) {
  return fmt::format("<div><dt>{}</dt><dd>{} <small>{}</small></dd></div>\n", name, value, unit);
}

std::string_view upright_name(record::Outcome outcome) {
  switch (outcome) {
    case record::Outcome::completed:
      return "Upright, full time";
    case record::Outcome::fell:
      return "Upright, then fell";
    case record::Outcome::diverged:
      return "Until it diverged";
  }
  return {};
}

std::string headline(const motion::Summary& summary, const robot::RobotSpec& robot,
                     const std::optional<CppnSize>& cppn) {
  std::string out = "<dl class=\"numbers\">\n";
  out += headline_number("Distance", fmt::format("{:.2f}", summary.distance_m), "m");
  out += headline_number(upright_name(summary.outcome), fmt::format("{:.1f}", summary.seconds), "s");
  out += headline_number("Mean speed", fmt::format("{:.2f}", summary.mean_speed_m_s), "m/s");
  if (cppn)
    out += fmt::format(
        "<div><dt>Compositional pattern producing network (CPPN)</dt><dd>{} <small>hidden</small> {} "
        "<small>links</small></dd></div>\n",
        cppn->hidden, cppn->links);
  if (!summary.triggers.empty()) {
    out += "<div class=\"span\"><dt>Triggers</dt><dd class=\"per-leg\">";
    for (std::size_t leg = 0; leg < summary.triggers.size(); ++leg)
      out +=
          fmt::format("<span class=\"key {}\"><small>{}</small> {}</span>", leg_class(static_cast<int>(leg)),
                      escape_xml(robot.legs[leg].name), summary.triggers[leg]);
    out += "</dd></div>\n";
  }
  return out + "</dl>\n";
}

std::string filmstrip_section(const motion::RecordedTrial& recorded) {
  const motion::Motion& motion = recorded.motion;
  const auto frames = figures::filmstrip_frames(motion);
  const double from_s = motion.time_s(frames.front()), to_s = motion.time_s(frames.back());
  return section("A look at the gait",
                 fmt::format("Side views from {:.1f} s to {:.1f} s, drawn from the recording. A filled foot "
                             "is on the ground; legs on the far side are "
                             "lighter. The ground is marked with the distance from the start.",
                             from_s, to_s),
                 leg_keys(recorded.robot) + both([&](FigureSize layout) {
                   return figures::filmstrip_figure(recorded.robot, motion, layout);
                 }));
}

double sum(const std::vector<double>& values) {
  double total = 0.0;
  for (const double value : values) total += value;
  return total;
}

/// A count with narrow spaces between thousands.
std::string grouped(double count) {
  std::string digits = fmt::format("{:.0f}", count);
  for (std::ptrdiff_t at = static_cast<std::ptrdiff_t>(digits.size()) - 3; at > 0; at -= 3)
    digits.insert(to_index(at), "\u202f");
  return digits;
}

std::string fitness_section(const record::Generations& generations, const record::Objective& objective) {
  const std::size_t count = generations.count();
  if (count == 0) return section("How it learned", "", note("No generation has been finished yet."));
  return section(
      "How it learned",
      fmt::format("{} over {} generation{}: {} evaluations, {} simulated steps.", objective.title, count,
                  count == 1 ? "" : "s", grouped(sum(generations.evaluations)),
                  grouped(sum(generations.steps))),
      both([&](FigureSize layout) { return figures::fitness_figure(generations, layout, objective); }));
}

std::string footfall_section(const motion::RecordedTrial& recorded) {
  const motion::Motion& motion = recorded.motion;
  std::string text = "A bar means that the foot is on the ground.";
  if (!motion.trigger.empty())
    text += " A triangle marks a trigger: the foot came down and reset the timer of its leg.";
  std::string silent;
  for (std::size_t leg = 0; leg < recorded.robot.legs.size(); ++leg)
    if (motion::contact_share(motion.touch[leg]) == 0.0)
      silent += (silent.empty() ? "" : ", ") + recorded.robot.legs[leg].name;
  if (!silent.empty()) text += " Never on the ground: " + silent + ".";
  return section("Footfalls", text, both([&](FigureSize layout) {
                   return figures::footfall_figure(recorded.robot, motion, layout);
                 }));
}

std::string network_section(const motion::NeuralNetwork& network) {
  const figures::Substrate substrate = figures::substrate_of(network);
  const std::string text =
      fmt::format("The neurons at their places in the substrate. {} of {} possible links are expressed.",
                  substrate.links.size(), network.possible_links);
  if (!figures::can_be_drawn(substrate))
    return section("The network", text, note("A substrate with more than four coordinates is not drawn."));
  return section("The network", text,
                 both([&](FigureSize layout) { return figures::substrate_figure(substrate, layout); }));
}

std::string patterns_section(const motion::RecordedTrial& recorded) {
  const motion::SupgPatterns& supg = *recorded.supg;
  const std::string_view offset = supg.starts_at_offset ? "where the leg’s timer starts"
                                                        : "how long the leg waits before its timer starts";
  return section(
      "Temporal patterns",
      fmt::format("Target angle of each joint over the {} s of its leg’s timer. Shaded: the joint’s range. "
                  "Grey: the other "
                  "legs. Dotted: {}. The last row counts how far the timer had come when the foot came down "
                  "and reset it; "
                  "beyond the end of the axis it had stopped.",
                  figures::number(supg.period_s()), offset),
      both([&](FigureSize layout) {
        return figures::pattern_figure(recorded.robot, supg, recorded.motion, layout);
      }));
}

std::string controller_section(const motion::RecordedTrial& recorded) {
  if (!recorded.network && !recorded.supg)
    return section("The controller", "",
                   note(fmt::format("The controller of this champion is of kind “{}”, which is not drawn.",
                                    recorded.controller_kind)));
  return (recorded.network ? network_section(*recorded.network) : std::string()) +
         (recorded.supg ? patterns_section(recorded) : std::string());
}

std::string steering_section(const motion::RecordedTrial& recorded) {
  if (recorded.motion.command.empty()) return {};
  return section(
      "Told and done",
      "Dashed: the speed and the turn that it was told, and the way that they lead to. Solid: what "
      "it did, means over a second.",
      both([&](FigureSize layout) {
        return figures::steering_figure(recorded.robot, recorded.motion, {}, layout);
      }));
}

std::string path_section(const motion::RecordedTrial& recorded, const motion::Summary& summary) {
  return section(fmt::format("Seen from above: {:.2f} m", summary.distance_m),
                 "The way of the centre of mass, with the places where feet came down in the colours of "
                 "their legs and the trunk at start and "
                 "end.",
                 leg_keys(recorded.robot) + both([&](FigureSize layout) {
                   return figures::path_figure(recorded.robot, recorded.motion, layout);
                 }));
}

std::string provenance_section(const RunPage& page) {
  if (page.facts.empty() && page.commands.empty()) return {};
  std::string content;
  if (!page.facts.empty()) {
    content += "<table>\n";
    for (const Fact& fact : page.facts)
      content += fmt::format("<tr><th scope=\"row\">{}</th><td>{}</td></tr>\n", escape_xml(fact.label),
                             escape_xml(fact.value));
    content += "</table>\n";
  }
  if (!page.commands.empty()) {
    content += "<pre>";
    for (const std::string& command : page.commands) content += escape_xml(command) + "\n";
    content += "</pre>\n";
  }
  return section("How this was made", page.commands.empty() ? "" : "The commands below make this page again.",
                 content);
}

/// The sections after the evolution's that are drawn from the recording.
std::string walk_sections(const motion::RecordedTrial& recorded, const motion::Summary& summary) {
  std::string out = footfall_section(recorded);
  out += controller_section(recorded);
  out += steering_section(recorded);
  return out + path_section(recorded, summary);
}

}  // namespace

std::string make_page(const RunPage& page, const motion::RecordedTrial& recorded) {
  const motion::Summary summary = motion::summarise(recorded.motion);
  const bool moved = recorded.motion.frames() > 0;
  std::string body = fmt::format(
      "<header>\n<p class=\"kicker\">amble</p>\n<h1>{}</h1>\n<p class=\"subtitle\">{}</p>\n</header>\n",
      escape_xml(page.title), escape_xml(page.subtitle));
  body += headline(summary, recorded.robot, page.cppn);
  if (moved) body += filmstrip_section(recorded);
  if (!moved)
    body += section("No step was recorded", "",
                    note("The trial ended before its first step; there is nothing to draw."));
  if (page.generations) body += fitness_section(*page.generations, page.objective);
  if (moved) body += walk_sections(recorded, summary);
  body += provenance_section(page);
  return html_page(page.title, figures::style_sheet(), body);
}

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
    if (!motion.command.empty())
      add("steering.svg", figures::steering_figure(robot, motion, {}, FigureSize::wide));
    add("path.svg", figures::path_figure(robot, motion, FigureSize::wide));
  }
  return files;
}

}  // namespace amble::page
