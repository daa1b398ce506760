#include "amble/presentation/walker.hpp"

#include <fmt/format.h>

#include "amble/experiment/build_info.hpp"
#include "amble/experiment/replay.hpp"
#include "amble/figures/cppn_figure.hpp"
#include "amble/gait/recorded_gait.hpp"
#include "amble/gait/report_text.hpp"
#include "amble/io/json_file.hpp"
#include "amble/presentation/cppn_graph.hpp"
#include "amble/study/gait_observer.hpp"

namespace amble::presentation {
namespace {

io::Json gait_of(const gait::Report& report) {
  return io::parse_json(gait::report_json(report), "gait");
}

}  // namespace

std::string engine_note(const experiment::Champion& champion, const WalkOptions& options) {
  const auto& home = champion.problem.engine;
  const auto& judge = options.engine.value_or(home);
  return (judge == home ? "" : fmt::format(", in the engine {}", judge)) +
         (options.noise ? ", median trial" : "");
}

std::optional<page::Walker> walk(const experiment::Champion& champion, const std::filesystem::path& path,
                                 const WalkOptions& options, const std::filesystem::path& recording,
                                 const std::atomic<bool>& stop) {
  auto walker = walk(champion.problem, champion.genome, path.string(), options, recording, stop);
  if (!walker) return std::nullopt;
  walker->title = fmt::format("{}, generation {}{}", champion.experiment, champion.generation,
                              engine_note(champion, options));
  walker->cppn_svg = figures::cppn_figure(cppn_graph(champion));
  // The page simulates amble's reading of the robot: the model itself would only make it larger.
  experiment::Champion shown = champion;
  shown.problem.robot.original = nullptr;
  walker->champion = experiment::champion_text(shown);
  return walker;
}

std::optional<page::Walker> walk(const experiment::Problem& problem, const neat::Genome& genome,
                                 const std::string& origin, const WalkOptions& options,
                                 const std::filesystem::path& recording, const std::atomic<bool>& stop) {
  study::GaitObserver gait(problem.robot, problem.trial.timestep_s, {});
  const auto replay = experiment::replay(problem, genome,
                                         {.seconds = options.seconds,
                                          .engine = options.engine,
                                          .record = recording,
                                          .origin = origin,
                                          .observer = &gait,
                                          .trace = false,
                                          .noise = options.noise},
                                         stop);
  if (!replay) return std::nullopt;
  return page::Walker{.title = {},
                      .recording = recording,
                      .cppn_svg = {},
                      .gait = gait_of(gait.finish(replay->result.outcome))};
}

page::Walker recorded(const std::filesystem::path& recording) {
  return {.title = recording.stem().string(),
          .recording = recording,
          .cppn_svg = {},
          .gait = gait_of(gait::recorded_gait(recording, {}))};
}

std::string made_by() {
  const auto build = experiment::build_info();
  return fmt::format("amble {} ({})", build.version, experiment::short_commit(build));
}

}  // namespace amble::presentation
