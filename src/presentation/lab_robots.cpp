#include "amble/presentation/lab_robots.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string>

#include "amble/controllers/automatic.hpp"
#include "amble/core/error.hpp"
#include "amble/experiment/config.hpp"
#include "amble/experiment/problem.hpp"
#include "amble/io/quoting.hpp"

namespace amble::presentation {
namespace {

namespace fs = std::filesystem;
using experiment::Config;

/// What the lab cannot have, or decides itself.
Config for_lab(Config config) {
  config.robot = "robot.json";
  config.referees.clear();
  config.champion = {};
  config.evaluation = {};
  config.search.kind = "objective";
  return config;
}

/// The preset's controller in the world of `base`.
Config with_controller(const Config& base, const fs::path& preset) {
  Config config = experiment::load_config(
      preset, {{"robot=" + io::toml_quoted(base.robot), "controller.substrate=\"auto\""}, {}, {}});
  config.drop_m = base.drop_m;
  config.noise = base.noise;
  config.score = base.score;
  config.controller.substrate.sine_period_s = base.controller.supg.period_s;
  return config;
}

/// SUPGs whose offsets are all the same.
Config all_together(Config config, const robot::RobotSpec& robot) {
  auto& substrate = config.controller.substrate;
  const double sine_period_s = substrate.sine_period_s;
  substrate = controllers::automatic_supg(robot);
  substrate.sine_period_s = sine_period_s;
  for (auto& property : substrate.properties)
    if (property.property == "offset") {
      property.output.clear();
      property.zero.clear();
    }
  std::erase(substrate.outputs, "offset");
  return config;
}

page::LabRobot lab_robot(const fs::path& path, const fs::path& data) {
  const Config base = experiment::load_config(path, {{"engine=\"batch\""}, {}, {}});
  robot::RobotSpec robot = experiment::load_robot(base);
  robot.original = nullptr;  // no page needs it
  std::vector<std::pair<std::string, Config>> configs;
  if (base.controller.kind == "supg")
    configs.emplace_back("supg", base);
  else
    configs.emplace_back("supg", with_controller(base, data / "configs/quick/supg.toml"));
  configs.emplace_back("together", all_together(configs.front().second, robot));
  for (const char* kind : {"sine", "ctrnn"})
    configs.emplace_back(kind, with_controller(base, data / fmt::format("configs/quick/{}.toml", kind)));
  page::LabRobot made{
      .id = robot.name, .name = robot.name, .text = experiment::robot_file_text(robot), .configs = {}};
  for (auto& [name, config] : configs) {
    experiment::Problem::make(config, robot);  // throws if it does not fit
    made.configs.emplace_back(name, io::settings_to_json(for_lab(std::move(config))));
  }
  return made;
}

}  // namespace

std::vector<page::LabRobot> lab_robots(const std::vector<fs::path>& configs, const fs::path& data) {
  std::vector<page::LabRobot> robots;
  for (const fs::path& path : configs) {
    auto robot = lab_robot(path, data);
    const auto same = [&robot](const page::LabRobot& other) { return other.id == robot.id; };
    if (std::ranges::any_of(robots, same))
      fail(ExitCode::bad_input, "{}: a robot called {} is in the lab already", path.string(), robot.name);
    robots.push_back(std::move(robot));
  }
  return robots;
}

std::vector<fs::path> gallery_configs(const fs::path& data) {
  std::vector<fs::path> found;
  for (const auto& entry : fs::directory_iterator(data / "robots"))
    if (fs::exists(entry.path() / "evolve.toml")) found.push_back(entry.path() / "evolve.toml");
  std::ranges::sort(found);
  found.insert(found.begin(), data / "configs/quick/quadruped.toml");
  return found;
}

}  // namespace amble::presentation
