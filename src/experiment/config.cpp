#include "amble/experiment/config.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <deque>
#include <memory>
#include <optional>
#include <string_view>

#include "amble/controllers/factory.hpp"
#include "amble/core/error.hpp"
#include "amble/io/toml_settings.hpp"
#include "amble/search/strategies.hpp"

namespace amble::experiment {
namespace fs = std::filesystem;

Config load_config(const std::filesystem::path& path, const Overrides& overrides) {
  const io::TomlDocument document = io::TomlDocument::read(path);
  // The first unknown key of another kind of file would say little.
  if (document.is_list("conditions"))
    fail(ExitCode::bad_input, "{}: a study, and not the config of a run; expected `amble study` for it",
         path.string());
  if (document.is_list("legs"))
    fail(ExitCode::bad_input,
         "{}: a robot, and not the config of a run; expected a config that has robot = \"…\", e.g. the "
         "evolve.toml beside it",
         path.string());
  return config_from(document, overrides);
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

/// Why an assignment to `key` changes nothing: it is in a table that other kinds read and this one does not.
/// Nothing if it does, or if it is not known what this kind reads. `place`: the key that chooses the kind.
template <typename Kind>
std::optional<std::string> idle_reason(std::string_view key, std::string_view place,
                                       const std::string& chosen, const std::deque<Kind>& kinds) {
  const auto reads = [key](const Kind& kind) {
    return std::ranges::any_of(kind.tables,
                               [key](const std::string& table) { return key.starts_with(table + "."); });
  };
  const auto kind = std::ranges::find(kinds, chosen, &Kind::name);
  if (kind == kinds.end() || kind->tables.empty() || reads(*kind) || std::ranges::none_of(kinds, reads))
    return {};
  return fmt::format("{} has no effect: {} is \"{}\"", key, place, chosen);
}

/// What decides, beside the kinds, whether settings are used.
struct IdleRule {
  std::string_view path;  ///< settings that begin so
  std::string_view but;   ///< of which this one is not meant
  bool (*idle)(const Config&);
  std::string_view because;
};

bool has_supgs(const Config& config) {
  return config.controller.kind == "supg" || config.controller.kind == "mixed";
}

bool is_triggered(const Config& config) {
  return config.controller.supg.trigger == controllers::Trigger::edge ||
         config.controller.supg.trigger == controllers::Trigger::level;
}

bool senses_nothing(const Config& config) {
  return config.controller.kind == "supg" && config.controller.supg.modulation.sensors.empty();
}

constexpr std::array<IdleRule, 10> idle_rules{
    {{"controller.supg.modulation.rate", "", senses_nothing, "controller.supg.modulation.sensors is empty"},
     {"controller.supg.modulation.shape", "", senses_nothing, "controller.supg.modulation.sensors is empty"},
     {"controller.supg.modulation.shape_by", "",
      [](const Config& config) {
        return !senses_nothing(config) && config.controller.supg.modulation.shape == 0.0;
      },
      "controller.supg.modulation.shape is 0"},
     {"controller.supg.contact.", "",
      [](const Config& config) { return has_supgs(config) && !is_triggered(config); },
      "controller.supg.trigger waits for no contact"},
     {"controller.supg.contact.", "controller.supg.contact.source",
      [](const Config& config) {
        return has_supgs(config) && is_triggered(config) &&
               config.controller.supg.contact.source == controllers::ContactSource::touch;
      },
      "controller.supg.contact.source is \"touch\""},
     {"controller.supg.contact.joint_type", "",
      [](const Config& config) {
        return has_supgs(config) && is_triggered(config) &&
               config.controller.supg.contact.source == controllers::ContactSource::shock;
      },
      "controller.supg.contact.source is \"shock\""},
     {"controller.supg.trigger_debounce_ticks", "",
      [](const Config& config) {
        return has_supgs(config) && config.controller.supg.trigger != controllers::Trigger::edge;
      },
      "controller.supg.trigger is not \"edge\""},
     {"controller.supg.seam.filter_order", "",
      [](const Config& config) { return has_supgs(config) && config.controller.supg.seam.filter_s == 0.0; },
      "controller.supg.seam.filter_s is 0"},
     {"command.", "command.kind",
      [](const Config& config) { return config.command.kind == trial::CommandKind::none; },
      "command.kind is \"none\""},
     {"command.stretches", "",
      [](const Config& config) { return config.command.kind == trial::CommandKind::random; },
      "command.kind is \"random\""}}};

}  // namespace

std::vector<std::string> idle_assignments(const Config& config, const std::vector<std::string>& assignments) {
  std::vector<std::string> idle;
  for (const std::string& assignment : assignments) {
    const std::string_view key = std::string_view(assignment).substr(0, assignment.find('='));
    for (const auto& reason :
         {idle_reason(key, "controller.kind", config.controller.kind, controllers::controller_kinds()),
          idle_reason(key, "search.kind", config.search.kind, search::strategy_kinds())})
      if (reason) idle.push_back(*reason);
    for (const IdleRule& rule : idle_rules)
      if (key.starts_with(rule.path) && key != rule.but && rule.idle(config))
        idle.push_back(fmt::format("{} has no effect: {}", key, rule.because));
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
