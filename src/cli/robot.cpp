#include <fmt/format.h>

#include <filesystem>
#include <memory>

#include "amble/cli/commands.hpp"
#include "amble/experiment/problem.hpp"
#include "amble/morphology/summary.hpp"

namespace amble::cli {

void add_robot(CLI::App& app, Action& action) {
  auto* command = app.add_subcommand("robot", "Show what was read from a robot file");
  auto path = std::make_shared<std::filesystem::path>();
  command->add_option("FILE", *path, "Robot file (TOML beside an MJCF model, or a run's robot.json)")
      ->required();
  command->callback([path, &action] {
    action = [path] {
      fmt::print("{}", morphology::summary(experiment::load_robot_file(*path)));
      return ExitCode::ok;
    };
  });
}

}  // namespace amble::cli
