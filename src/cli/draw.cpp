#include <fmt/format.h>

#include <filesystem>
#include <memory>
#include <optional>
#include <string>

#include "amble/cli/help.hpp"
#include "amble/cli/outputs.hpp"
#include "amble/experiment/run_folder.hpp"
#include "amble/figures/cppn_figure.hpp"
#include "amble/figures/cppn_graph.hpp"
#include "amble/figures/pattern_figure.hpp"
#include "amble/io/file.hpp"
#include "amble/io/json_file.hpp"
#include "amble/presentation/walker.hpp"

namespace amble::cli {
namespace {

namespace fs = std::filesystem;

struct DrawOptions {
  fs::path path;
  std::optional<fs::path> out, patterns;
};

void refuse_unless_ours(const DrawOptions& options) {
  if (options.out) {
    const fs::path kind = options.out->extension();
    if (kind != ".svg" && kind != ".dot")
      fail(ExitCode::bad_input, "--out {}: expected a name that ends in .svg or .dot", options.out->string());
    check_output(*options.out, kind == ".svg" ? "<svg" : "digraph cppn {\n  rankdir=LR;", "a drawing");
  }
  if (options.patterns) check_drawing("--patterns", *options.patterns);
  check_distinct({{"--out", options.out.value_or("")}, {"--patterns", options.patterns.value_or("")}});
}

std::string patterns_svg(const experiment::Champion& champion, const fs::path& path) {
  const controllers::Architecture& architecture = *champion.problem.architecture;
  const robot::RobotSpec& robot = champion.problem.robot;
  const auto controller = architecture.parameters_json(*champion.problem.decode(champion.genome));
  if (!io::parse_json(controller, path.string()).contains("patterns_rad"))
    fail(ExitCode::bad_input, "--patterns: the controller of {} is of kind {}: expected supg, which has them",
         path.string(), architecture.name());
  return figures::pattern_svg(robot, motion::parse_supg(controller, robot, path.string()));
}

ExitCode draw(const DrawOptions& options) {
  refuse_unless_ours(options);
  const fs::path path = experiment::champion_at(options.path);
  const auto champion = experiment::load_champion(path);
  const figures::CppnGraph graph = presentation::cppn_graph(champion);
  if (options.patterns) io::write_output(*options.patterns, patterns_svg(champion, path));
  if (options.out)
    io::write_output(*options.out, options.out->extension() == ".svg" ? figures::cppn_svg(graph)
                                                                      : figures::cppn_dot(graph));
  if (!options.out && !options.patterns) fmt::print("{}", figures::cppn_dot(graph));
  return ExitCode::ok;
}

}  // namespace

void add_draw(CLI::App& app, Action& action) {
  auto* command = app.add_subcommand("draw",
                                     "Draw a champion's compositional pattern producing network (CPPN), and "
                                     "the temporal patterns it paints");
  auto options = std::make_shared<DrawOptions>();
  command->add_option("CHAMPION", options->path, "Champion file, or run folder (its best champion)")
      ->required();
  command->add_option(
      "-o,--out", options->out,
      "Draw the CPPN into this file, by its name's end SVG or DOT (without this and --patterns: "
      "DOT to the standard output)");
  command->add_option("--patterns", options->patterns,
                      "Draw the target angle of each leg and joint over the time of a period (SVG)");
  add_examples(*command, {{"amble draw runs/1 -o cppn.svg --patterns patterns.svg", ""}});
  command->callback([options, &action] { action = [options] { return draw(*options); }; });
}

}  // namespace amble::cli
