#include <fmt/format.h>

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "amble/cli/help.hpp"
#include "amble/experiment/problem.hpp"
#include "amble/figures/substrate_figure.hpp"
#include "amble/io/file.hpp"
#include "amble/io/toml_settings.hpp"
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
  for (const substrate::Link& link : layout.links())
    picture.links.push_back({link.source, link.target, link.output, 0.5});
  if (!layout.links().empty()) picture.link_kinds = layout.output_names();
  return picture;
}

/// As a part of a config.
std::string toml_text(substrate::Settings settings) {
  return io::settings_to_toml([&settings](io::SettingsVisitor& visitor) {
    visitor.begin("controller", {});
    visitor.table("substrate", settings, {"the nodes of the controller, and what the CPPN says of them"});
    visitor.end();
  });
}

ExitCode show_substrate(const SubstrateOptions& options) {
  if (!options.out.empty()) io::refuse_to_replace(options.out, "<svg", "a drawing");
  const auto config = experiment::load_config(options.config, options.overrides);
  const auto problem = experiment::Problem::make(config, experiment::load_robot(config));
  const substrate::Layout* const layout = problem.architecture->substrate();
  if (!layout)
    fail(ExitCode::bad_input, "{}: a controller of kind {} has no substrate", options.config.string(),
         problem.architecture->name());
  if (options.toml)
    fmt::print("{}", toml_text(problem.controller.substrate));
  else
    fmt::print("controller    {}\n{}", problem.architecture->name(),
               substrate::summary(problem.controller.substrate, *layout));
  if (!options.out.empty()) io::write_file(options.out, figures::substrate_svg(drawn(*layout)));
  return ExitCode::ok;
}

}  // namespace

void add_substrate(CLI::App& app, Action& action) {
  auto* command =
      app.add_subcommand("substrate", "Show the nodes and links of a config's controller, and draw them");
  auto options = std::make_shared<SubstrateOptions>();
  command->add_option("CONFIG", options->config, "Config file (TOML)")->required();
  command
      ->add_option("--set", options->overrides.assignments, "Lay key.path=value over the config (repeatable)")
      ->type_name("KEY=VALUE")
      ->allow_extra_args(false);
  command->add_flag("--toml", options->toml,
                    "Print them as the table [controller.substrate] of a config, to be edited");
  command->add_option("-o,--out", options->out, "Draw them into this file (SVG)");
  add_examples(*command,
               {{"amble substrate configs/authors/ctrnn-objective.toml -o substrate.svg", ""},
                {"amble substrate configs/authors/ctrnn-objective.toml --toml", "as text to be edited"}});
  command->callback([options, &action] { action = [options] { return show_substrate(*options); }; });
}

}  // namespace amble::cli
