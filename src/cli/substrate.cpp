#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "amble/cli/help.hpp"
#include "amble/cli/outputs.hpp"
#include "amble/experiment/champion.hpp"
#include "amble/experiment/problem.hpp"
#include "amble/experiment/run_folder.hpp"
#include "amble/figures/substrate_figure.hpp"
#include "amble/io/file.hpp"
#include "amble/io/file_kind.hpp"
#include "amble/io/json_file.hpp"
#include "amble/io/toml_settings.hpp"
#include "amble/motion/recorded_trial.hpp"
#include "amble/substrate/layout.hpp"

namespace amble::cli {
namespace {

struct SubstrateOptions {
  std::filesystem::path config, out;
  experiment::Overrides overrides;
  bool toml = false;
};

figures::Substrate drawn(const substrate::Layout& layout) {
  figures::Substrate picture{.coordinates = layout.coordinates(), .nodes = {}, .links = {}, .link_kinds = {}};
  for (const substrate::Node& node : layout.nodes())
    picture.nodes.push_back({node.name, node.at,
                             node.sensor       ? motion::NodeRole::sensor
                             : node.joint >= 0 ? motion::NodeRole::joint
                                               : motion::NodeRole::hidden});
  const bool ports = std::ranges::any_of(
      layout.links(), [](const substrate::Link& link) { return link.port != substrate::Port::hidden; });
  for (const substrate::Link& link : layout.links())
    picture.links.push_back({link.source, link.target, ports ? static_cast<int>(link.port) : link.output});
  if (ports)
    picture.link_kinds.assign(substrate::port_names.begin(), substrate::port_names.end());
  else if (!layout.links().empty())
    picture.link_kinds = layout.output_names();
  return picture;
}

/// The nodes of a champion with the links that it has of all possible ones; nothing where its kind keeps
/// none.
std::optional<figures::Substrate> drawn(const experiment::Champion& champion, const std::string& what) {
  const auto& architecture = *champion.problem.architecture;
  const std::string controller = architecture.parameters_json(*champion.problem.decode(champion.genome));
  if (!io::parse_json(controller, what).contains("nodes")) return {};
  return figures::substrate_of(motion::parse_network(controller, what));
}

/// As a part of a config.
std::string toml_text(substrate::Settings settings) {
  return io::settings_to_toml([&settings](io::SettingsVisitor& visitor) {
    visitor.begin("controller", {});
    visitor.table("substrate", settings, {"the nodes of the controller, and what the CPPN says of them"});
    visitor.end();
  });
}

void show(const SubstrateOptions& options, const experiment::Problem& problem,
          const std::optional<figures::Substrate>& links) {
  const substrate::Layout* const layout = problem.architecture->substrate();
  if (!layout)
    fail(ExitCode::bad_input, "{}: a controller of kind {} has no substrate", options.config.string(),
         problem.architecture->name());
  if (options.toml)
    fmt::print("{}", toml_text(problem.controller.substrate));
  else
    fmt::print("controller    {}\n{}", problem.architecture->name(),
               substrate::summary(problem.controller.substrate, *layout));
  if (!options.out.empty())
    io::write_output(options.out, figures::substrate_svg(links ? *links : drawn(*layout)));
}

ExitCode show_substrate(const SubstrateOptions& options) {
  if (!options.out.empty()) check_drawing("--out", options.out);
  const auto path = experiment::champion_at(options.config);
  if (path.extension() == ".json" || io::file_kind(path) == io::FileKind::champion) {
    if (!options.overrides.assignments.empty())
      fail(ExitCode::bad_input, "--set is for a config: {} is a champion", path.string());
    const auto champion = experiment::load_champion(path);
    show(options, champion.problem, drawn(champion, path.string()));
    return ExitCode::ok;
  }
  const auto config = experiment::load_config(options.config, options.overrides);
  show(options, experiment::Problem::make(config, experiment::load_robot(config)), {});
  return ExitCode::ok;
}

}  // namespace

void add_substrate(CLI::App& app, Action& action) {
  auto* command = app.add_subcommand(
      "substrate", "Show the nodes and links of a config's or champion's controller, and draw them");
  auto options = std::make_shared<SubstrateOptions>();
  command
      ->add_option(
          "CONFIG", options->config,
          "Config file (TOML), or champion file or run folder (its best champion), of whose links those are "
          "drawn that it has")
      ->required();
  command
      ->add_option("--set", options->overrides.assignments, "Lay key.path=value over the config (repeatable)")
      ->type_name("KEY=VALUE")
      ->allow_extra_args(false);
  command->add_flag("--toml", options->toml,
                    "Print them as the table [controller.substrate] of a config, to be edited");
  command->add_option("-o,--out", options->out, "Draw them into this file (SVG)");
  add_examples(*command,
               {{"amble substrate configs/authors/ctrnn-objective.toml -o substrate.svg", ""},
                {"amble substrate robots/hexapod/steered.json -o steered.svg", "a champion's, by ports"},
                {"amble substrate configs/authors/ctrnn-objective.toml --toml", "as text to be edited"}});
  command->callback([options, &action] { action = [options] { return show_substrate(*options); }; });
}

}  // namespace amble::cli
