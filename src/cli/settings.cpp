#include <fmt/format.h>

#include <filesystem>
#include <memory>
#include <vector>

#include "amble/cli/commands.hpp"
#include "amble/experiment/config.hpp"
#include "amble/io/toml_settings.hpp"

namespace amble::cli {
namespace {

ExitCode print_settings(const std::vector<std::filesystem::path>& files) {
  std::vector<experiment::Config> configs(1);
  for (const auto& file : files) configs.push_back(experiment::load_config(file, {}));
  std::vector<io::SettingsColumn> columns;
  for (std::size_t i = 0; i < configs.size(); ++i) {
    // A preset is a folder of configs, and gives the column its name.
    const std::string title = i == 0 ? "default" : files[i - 1].parent_path().filename().string();
    columns.push_back(
        {title, [&config = configs[i]](io::SettingsVisitor& visitor) { config.describe(visitor); }});
  }
  fmt::print("{}", io::settings_to_markdown(columns));
  return ExitCode::ok;
}

}  // namespace

void add_settings(CLI::App& app, Action& action) {
  auto* command =
      app.add_subcommand("settings", "Print the table of all settings with their meaning and source");
  auto files = std::make_shared<std::vector<std::filesystem::path>>();
  command->add_option("CONFIG", *files, "Config files whose values are shown beside the defaults");
  command->callback([files, &action] { action = [files] { return print_settings(*files); }; });
}

}  // namespace amble::cli
