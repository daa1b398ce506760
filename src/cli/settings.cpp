#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "amble/cli/help.hpp"
#include "amble/experiment/config.hpp"
#include "amble/io/toml_settings.hpp"
#include "amble/morphology/side_file.hpp"

namespace amble::cli {
namespace {

struct SettingsOptions {
  std::vector<std::filesystem::path> files;
  bool differing = false, robot = false;
};

/// A preset is a folder of configs, and gives the column its name; or the file does, if the folder is one.
std::string column_title(const std::filesystem::path& file, const std::vector<std::filesystem::path>& files) {
  const auto folder = file.parent_path();
  const auto in_folder =
      std::ranges::count(files, folder, [](const auto& path) { return path.parent_path(); });
  return in_folder > 1 || folder.empty() ? file.stem().string() : folder.filename().string();
}

ExitCode print_settings(const SettingsOptions& options) {
  const auto& files = options.files;
  if (options.robot) {
    if (!files.empty() || options.differing)
      fail(ExitCode::bad_input,
           "--robot: the keys of robot files, which no config has; expected nothing beside it");
    fmt::print("{}", io::keys_to_markdown(morphology::describe_side_file));
    return ExitCode::ok;
  }
  if (options.differing && files.size() < 2)
    fail(ExitCode::bad_input, "--differing: settings that differ between configs; expected two or more");
  std::vector<experiment::Config> configs(1);
  for (const auto& file : files) configs.push_back(experiment::load_config(file, {}));
  std::vector<io::SettingsColumn> columns;
  for (std::size_t i = 0; i < configs.size(); ++i) {
    const std::string title = i == 0 ? "default" : column_title(files[i - 1], files);
    columns.push_back(
        {title, [&config = configs[i]](io::SettingsVisitor& visitor) { config.describe(visitor); }});
  }
  fmt::print("{}", io::settings_to_markdown(
                       columns, options.differing ? io::SettingsRows::differing : io::SettingsRows::all));
  return ExitCode::ok;
}

}  // namespace

void add_settings(CLI::App& app, Action& action) {
  auto* command =
      app.add_subcommand("settings", "Print the table of all settings with their meaning and source");
  auto options = std::make_shared<SettingsOptions>();
  command->add_option("CONFIG", options->files, "Config files whose values are shown beside the defaults");
  command->add_flag("--differing", options->differing, "Only settings in which the config files differ");
  command->add_flag("--robot", options->robot, "The keys of robot files in place of those of configs");
  add_examples(
      *command,
      {{"amble settings", "all with their defaults"},
       {"amble settings --differing configs/authors/supg-novelty.toml configs/paper/supg-novelty.toml", ""}});
  command->callback([options, &action] { action = [options] { return print_settings(*options); }; });
}

}  // namespace amble::cli
