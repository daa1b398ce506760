#include <fmt/format.h>

#include <filesystem>
#include <memory>
#include <vector>

#include "amble/cli/data_folder.hpp"
#include "amble/cli/help.hpp"
#include "amble/cli/outputs.hpp"
#include "amble/io/file.hpp"
#include "amble/page/lab_page.hpp"
#include "amble/presentation/lab_robots.hpp"
#include "amble/presentation/walker.hpp"

namespace amble::cli {
namespace {

namespace fs = std::filesystem;

struct LabOptions {
  std::vector<fs::path> configs;
  fs::path out;
};

ExitCode make_lab(const LabOptions& options) {
  check_output(options.out, "<!DOCTYPE html>", "a page");
  const auto data = data_folder();
  if (!data)
    fail(ExitCode::io,
         "the presets of amble (configs/, robots/) were not found: run amble where it was built or "
         "installed, or in the folder of its sources");
  const auto configs = options.configs.empty() ? presentation::gallery_configs(*data) : options.configs;
  io::write_output(options.out,
                   page::make_lab_page(presentation::lab_robots(configs, *data), presentation::made_by()));
  fmt::print("{}\n", fs::absolute(options.out).lexically_normal().string());
  return ExitCode::ok;
}

}  // namespace

void add_lab(CLI::App& app, Action& action) {
  auto* command = app.add_subcommand(
      "lab", "Make a page in which walkers evolve, for lessons: nothing to install, no network");
  auto options = std::make_shared<LabOptions>();
  command->add_option("CONFIG", options->configs,
                      "Configs whose robots are in it (default: the gallery, robots/)");
  command->add_option("-o,--out", options->out, "The page to write (HTML)")->required();
  add_examples(*command, {{"amble lab -o amble-lab.html", "open it in a browser"},
                          {"amble lab robots/servo/evolve.toml -o my-lab.html", "for one's own robot"}});
  command->callback([options, &action] { action = [options] { return make_lab(*options); }; });
}

}  // namespace amble::cli
