#include "amble/presentation/walker.hpp"

#include <fmt/format.h>
#include <array>
#include <string>
#include <string_view>

#include "amble/core/index.hpp"
#include "amble/experiment/build_info.hpp"
#include "amble/experiment/gait_observer.hpp"
#include "amble/experiment/replay.hpp"
#include "amble/figures/cppn_figure.hpp"
#include "amble/gait/recorded_gait.hpp"
#include "amble/gait/report_text.hpp"
#include "amble/io/json_file.hpp"

namespace amble::presentation {
namespace {

/// By neat::NodeKind.
constexpr std::array<figures::CppnRole, 4> roles{figures::CppnRole::bias, figures::CppnRole::input,
                                                 figures::CppnRole::output, figures::CppnRole::hidden};

/// What a node computes: "linear" may mean |x|.
std::string_view function_name(neat::Activation activation, const cppn::Settings& settings) {
  if (activation == neat::Activation::linear && settings.linear == cppn::Linear::absolute) return "|x|";
  return neat::activation_names[to_index(activation)];
}

io::Json gait_of(const gait::Report& report) {
  return io::parse_json(gait::report_json(report), "gait");
}

}  // namespace

figures::CppnGraph cppn_graph(const experiment::Champion& champion) {
  const neat::Genome& genome = champion.genome;
  const controllers::Architecture& architecture = *champion.problem.architecture;
  figures::CppnGraph graph;
  std::size_t inputs = 0, outputs = 0;
  for (const neat::NodeGene& node : genome.nodes) {
    const figures::CppnRole role = roles[to_index(node.kind)];
    std::string name;
    if (role == figures::CppnRole::bias) name = "bias";
    if (role == figures::CppnRole::input) name = architecture.cppn_inputs()[inputs++];
    if (role == figures::CppnRole::output) name = architecture.cppn_outputs()[outputs++];
    graph.nodes.push_back(
        {node.id, role, std::string(function_name(node.activation, champion.problem.cppn)), std::move(name)});
  }
  for (const neat::LinkGene& link : genome.links)
    graph.links.push_back({to_index(genome.index_of(link.from)), to_index(genome.index_of(link.to)),
                           link.weight, link.enabled});
  return graph;
}

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
  experiment::GaitObserver gait(problem, {});
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
