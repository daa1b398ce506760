#include "amble/experiment/config.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <optional>
#include <string_view>

#include "amble/core/error.hpp"

namespace amble::experiment {
namespace fs = std::filesystem;

Config load_config(const std::filesystem::path& path, const Overrides& overrides) {
  return config_from(io::TomlDocument::read(path), overrides);
}

Config config_from(const io::TomlDocument& read, const Overrides& overrides) {
  const auto document = std::make_shared<io::TomlDocument>(read);
  for (const auto& assignment : overrides.assignments) document->set(assignment);
  if (overrides.seed) document->set("seed=" + std::to_string(*overrides.seed));
  if (overrides.generations) document->set("generations=" + std::to_string(*overrides.generations));

  Config config;
  config.locate_setting = [document](const std::vector<std::string>& keys) { return document->where(keys); };
  config.describe(*document->reader());
  config.neat.speciation.scale_targets(config.neat.population.size);  // what the document has comes after
  const auto reader = document->reader();
  config.describe(*reader);
  reader->finish();
  try {
    config.validate();
  } catch (const SettingError& error) {
    throw config.with_location(error);
  }
  config.robot = fs::absolute(document->folder_of("robot") / config.robot).lexically_normal().string();
  return config;
}

namespace {

/// A table of settings, and the kinds that use it.
struct OwnTable {
  std::string_view path;
  std::vector<std::string_view> kinds;
};

/// What decides which tables are used. Of kinds that are not amble's own it is not known.
struct Choice {
  std::string_view place;
  std::vector<std::string_view> kinds;
  std::vector<OwnTable> tables;
};

/// Why an assignment to `key` changes nothing; nothing if it does, or is none of these.
std::optional<std::string> idle_reason(std::string_view key, const Choice& choice, const std::string& kind) {
  const auto table = std::ranges::find_if(
      choice.tables, [&](const OwnTable& candidate) { return key.starts_with(candidate.path); });
  const auto knows = [&](const auto& kinds) { return std::ranges::find(kinds, kind) != kinds.end(); };
  if (table == choice.tables.end() || knows(table->kinds) || !knows(choice.kinds)) return {};
  return fmt::format("{} has no effect: {} is \"{}\"", key, choice.place, kind);
}

}  // namespace

std::vector<std::string> idle_assignments(const Config& config, const std::vector<std::string>& assignments) {
  static const Choice controllers{"controller.kind",
                                  {"supg", "network", "ctrnn", "mixed", "oscillators"},
                                  {{"controller.supg.", {"supg", "mixed"}},
                                   {"controller.network.", {"network"}},
                                   {"controller.ctrnn.", {"ctrnn"}},
                                   {"controller.mixed.", {"mixed"}},
                                   {"controller.oscillators.", {"oscillators"}},
                                   {"controller.substrate.", {"supg", "network", "ctrnn", "mixed"}}}};
  static const Choice searches{"search.kind",
                               {"objective", "novelty", "map-elites", "cma-es"},
                               {{"search.novelty.", {"novelty"}},
                                {"search.map_elites.", {"map-elites"}},
                                {"search.cma_es.", {"cma-es"}}}};
  std::vector<std::string> idle;
  for (const std::string& assignment : assignments) {
    const std::string_view key = std::string_view(assignment).substr(0, assignment.find('='));
    for (const auto& reason : {idle_reason(key, controllers, config.controller.kind),
                               idle_reason(key, searches, config.search.kind)})
      if (reason) idle.push_back(*reason);
  }
  return idle;
}

controllers::DifferentialSettings parse_differential(const std::string& text, const std::string& what) {
  const auto document = io::TomlDocument::parse("differential = { " + text + " }", what);
  controllers::DifferentialSettings settings;
  const auto reader = document.reader();
  reader->table("differential", settings, {"steering by hand"});
  reader->finish();
  if (!settings.any())
    fail(ExitCode::bad_input,
         "{}: \"{}\" steers nothing: expected turn_gain, full_speed_m_s or both, e.g. \"turn_gain = 1.5, "
         "full_speed_m_s = 0.4\"",
         what, text);
  return settings;
}

}  // namespace amble::experiment
