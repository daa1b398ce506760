#include "amble/experiment/idle_settings.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <deque>
#include <initializer_list>
#include <optional>
#include <string_view>

#include "amble/controllers/sensing.hpp"
#include "amble/search/strategies.hpp"

namespace amble::experiment {
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

bool is_told_by_list(const Config& config) {
  return config.command.kind == trial::CommandKind::fixed;
}

bool has_no_trigger(const Config& config) {
  return has_supgs(config) && config.controller.supg.trigger == controllers::Trigger::none;
}

bool grows_nothing(const Config& config) {
  return config.search.kind == "cma-es";
}

bool is_map_search(const Config& config) {
  return config.search.kind == "map-elites";
}

/// Whether terms, limits or a map's descriptors name one of these quantities.
bool names_any(const Config& config, std::initializer_list<std::string_view> quantities) {
  const auto is_one = [&](const std::string& name) {
    return std::ranges::find(quantities, name) != quantities.end();
  };
  return std::ranges::any_of(config.score.terms, is_one, &score::Term::quantity) ||
         std::ranges::any_of(config.score.limits, is_one, &score::Limit::quantity) ||
         (is_map_search(config) && std::ranges::any_of(config.search.map_elites.descriptors, is_one,
                                                       &search::DescriptorSettings::quantity));
}

/// Whether children have the nodes and links of their parents, as by lines and CMA-MAE.
bool changes_weights_alone(const Config& config) {
  return is_map_search(config) && config.search.map_elites.variation != search::Variation::mutation;
}

bool is_cma_of_maps(const Config& config) {
  return is_map_search(config) && config.search.map_elites.variation == search::Variation::cma;
}

bool has_one_parent(const Config& config) {
  return is_map_search(config) && !changes_weights_alone(config) &&
         config.search.map_elites.crossover_probability == 0.0;
}

bool is_grid(const Config& config) {
  return is_map_search(config) && config.search.map_elites.archive == search::Archive::grid;
}

bool is_plane(const Config& config) {
  return !config.ground.has_field();
}

bool is_mixed(const Config& config) {
  return config.controller.kind == "mixed";
}

/// Uneven ground that is the same in all trials.
bool has_one_ground(const Config& config) {
  return config.ground.has_field() && config.ground.concentric() && config.ground.start_place_m == 0.0;
}

constexpr std::array<IdleRule, 57> idle_rules = {
    {{"population.size", "", is_map_search,
      "search.kind is \"map-elites\", whose rounds have search.map_elites.batch"},
     {"search.map_elites.challenger_share", "",
      [](const Config& config) { return is_map_search(config) && config.search.map_elites.trials == 1; },
      "search.map_elites.trials is 1"},
     {"search.map_elites.pool.", "",
      [](const Config& config) {
        return is_map_search(config) && config.search.map_elites.select != search::Selection::dominated;
      },
      "search.map_elites.select is not \"dominated\""},
     {"search.map_elites.initial", "", is_cma_of_maps,
      "search.map_elites.variation is \"cma\", whose emitters begin at once"},
     {"genome.initial_link_probability", "", is_cma_of_maps,
      "search.map_elites.variation is \"cma\", which begins with all links"},
     {"mutation.", "", changes_weights_alone, "search.map_elites.variation is not \"mutation\""},
     {"crossover.", "", changes_weights_alone, "search.map_elites.variation is not \"mutation\""},
     {"crossover.", "", has_one_parent, "search.map_elites.crossover_probability is 0"},
     {"innovations.", "", changes_weights_alone, "search.map_elites.variation is not \"mutation\""},
     {"genome.activation_shares", "", changes_weights_alone,
      "search.map_elites.variation is not \"mutation\", so no node is new"},
     {"search.map_elites.line.", "",
      [](const Config& config) {
        return is_map_search(config) && config.search.map_elites.variation != search::Variation::line;
      },
      "search.map_elites.variation is not \"line\""},
     {"search.map_elites.cma.", "",
      [](const Config& config) {
        return is_map_search(config) && config.search.map_elites.variation != search::Variation::cma;
      },
      "search.map_elites.variation is not \"cma\""},
     {"search.map_elites.cells", "", is_grid, "search.map_elites.archive is \"grid\""},
     {"search.map_elites.centroid_", "", is_grid, "search.map_elites.archive is \"grid\""},
     {"score.heading_deg", "",
      [](const Config& config) {
        return !names_any(config, {"heading", "speed_kept"});
      },
      "nothing asks for the quantities heading or speed_kept"},
     {"score.speed_m_s", "", [](const Config& config) { return !names_any(config, {"speed_kept"}); },
      "nothing asks for the quantity speed_kept"},
     {"score.breach_factor", "", [](const Config& config) { return config.score.limits.empty(); },
      "score.limits is empty"},
     {"noise.score", "",
      [](const Config& config) {
        return config.noise.episodes == 1 && config.champion.episodes == 0 &&
               config.evaluation.finalists == 0.0;
      },
      "noise.episodes is 1"},
     {"noise.push_interval_s", "", [](const Config& config) { return config.noise.push_m_s == 0.0; },
      "noise.push_m_s is 0"},
     {"champion.score", "", [](const Config& config) { return config.champion.episodes == 0; },
      "champion.episodes is 0"},
     {"evaluation.draw", "", [](const Config& config) { return !config.disturbed() && is_plane(config); },
      "there is no noise, and no uneven ground"},
     {"evaluation.finalist_episodes", "",
      [](const Config& config) { return config.evaluation.finalists == 0.0; }, "evaluation.finalists is 0"},
     {"ground.height_m", "", is_plane, "ground.kind is \"plane\""},
     {"ground.length_m", "", is_plane, "ground.kind is \"plane\""},
     {"ground.cell_m", "", is_plane, "ground.kind is \"plane\""},
     {"ground.start_radius_m", "", is_plane, "ground.kind is \"plane\""},
     {"ground.seed", "", is_plane, "ground.kind is \"plane\""},
     {"ground.vary", "", is_plane, "ground.kind is \"plane\""},
     {"ground.seed", "", has_one_ground, "stairs and hurdles are always at the same places"},
     {"ground.vary", "", has_one_ground, "stairs and hurdles are always at the same places"},
     {"ground.grow_generations", "", is_plane, "ground.kind is \"plane\""},
     {"cppn.passes", "", [](const Config& config) { return !config.cppn.recurrent; },
      "cppn.recurrent is false"},
     {"controller.supg.modulation.rate", "", senses_nothing, "controller.supg.modulation.sensors is empty"},
     {"controller.supg.modulation.shape", "", senses_nothing, "controller.supg.modulation.sensors is empty"},
     {"controller.supg.modulation.shape_by", "",
      [](const Config& config) {
        return !senses_nothing(config) && !is_mixed(config) && config.controller.supg.modulation.shape == 0.0;
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
     {"controller.supg.modulation.rate", "", is_mixed,
      "controller.kind is \"mixed\", whose links have the rate"},
     {"controller.supg.modulation.shape", "", is_mixed,
      "controller.kind is \"mixed\", whose patterns are not changed"},
     {"controller.supg.modulation.reset", "", has_no_trigger, "controller.supg.trigger is \"none\""},
     {"controller.supg.modulation.refractory_ticks", "", has_no_trigger,
      "controller.supg.trigger is \"none\""},
     {"controller.differential.change_s", "",
      [](const Config& config) { return !config.controller.differential.any(); },
      "controller.differential steers nothing"},
     {"controller.switching.", "controller.switching.gaits",
      [](const Config& config) { return !config.controller.switching.any(); },
      "controller.switching.gaits is empty"},
     {"command.stretch_s", "", is_told_by_list, "command.kind is \"fixed\""},
     {"command.least_speed_m_s", "", is_told_by_list, "command.kind is \"fixed\""},
     {"command.most_speed_m_s", "", is_told_by_list, "command.kind is \"fixed\""},
     {"command.most_turn_rad_s", "", is_told_by_list, "command.kind is \"fixed\""},
     {"command.straight_share", "", is_told_by_list, "command.kind is \"fixed\""},
     {"command.stop_share", "", is_told_by_list, "command.kind is \"fixed\""},
     {"command.mirrored", "", is_told_by_list, "command.kind is \"fixed\""},
     {"genome.initial_link_probability", "", grows_nothing,
      "search.kind is \"cma-es\", which begins with all links"},
     {"genome.activation_shares", "", grows_nothing, "search.kind is \"cma-es\", which adds no nodes"},
     {"innovations.", "", grows_nothing, "search.kind is \"cma-es\", which adds no nodes and links"}}};

/// Sensors that settings name and no controller reads.
void find_unread_sensors(const Problem& problem, std::vector<std::string>& idle) {
  const std::vector<controllers::SensorSettings>& named = problem.controller.sensing.sensors;
  for (std::size_t i = 0; i < named.size(); ++i) {
    const auto models = controllers::sensor_models({{named[i]}}, problem.robot, problem.trial.timestep_s);
    const controllers::Architecture& controller = *problem.architecture;
    const auto any = [&](bool (controllers::Architecture::*does)(const substrate::Sensor&) const) {
      return std::ranges::any_of(models, [&](const auto& model) { return (controller.*does)(model.sensor); });
    };
    if (!any(&controllers::Architecture::reads))
      idle.push_back(fmt::format("controller.sensing.sensors[{}] has no effect: the controller reads no {}",
                                 i, named[i].of));
    else if (named[i].scale != 1.0 && !any(&controllers::Architecture::scales))
      idle.push_back(
          fmt::format("controller.sensing.sensors[{}].scale has no effect: the controller takes {} as it is",
                      i, named[i].of));
  }
  if (problem.controller.sensing.heading.lead_rad > 0.0 &&
      !problem.architecture->reads({.kind = substrate::Sensor::Kind::heading_error}))
    idle.push_back(
        "controller.sensing.heading.lead_rad has no effect: the controller reads no heading_error");
}

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

std::vector<std::string> idle_parts(const Problem& problem) {
  std::vector<std::string> idle;
  find_unread_sensors(problem, idle);
  for (std::size_t i = 0; i < problem.damage.parts.size(); ++i)
    if (const double from_s = problem.damage.parts[i].from_s; from_s >= problem.trial.duration_s)
      idle.push_back(
          fmt::format("damage.parts[{}] has no effect: it begins at {:g} s, and trials are {:g} s long", i,
                      from_s, problem.trial.duration_s));
  const controllers::ModulationSettings& modulation = problem.controller.supg.modulation;
  if (problem.controller.kind == "supg" && !modulation.sensors.empty() && modulation.rate == 0.0 &&
      modulation.shape == 0.0)
    idle.push_back(
        "controller.supg.modulation.sensors has no effect: rate and shape, how much sensors may change, are "
        "0");
  if (problem.command.kind != trial::CommandKind::none && !problem.architecture->extra_senses().commands())
    idle.push_back(fmt::format(
        "[command] is not heard: the controller, of kind \"{}\", senses no commands; configs/steer has those "
        "that do",
        problem.controller.kind));
  return idle;
}

std::optional<std::string> unheard_commands(const Problem& problem) {
  if (problem.architecture->extra_senses().commands()) return std::nullopt;
  return "this champion senses no commands, and walks as it would without";
}

std::optional<std::string> untold_commands(const Problem& problem) {
  double begins_s = 0.0;
  for (const trial::CommandStretch& stretch : problem.command.stretches) {
    if (problem.command.kind == trial::CommandKind::fixed && begins_s >= problem.trial.duration_s)
      return fmt::format("what begins after {:g} s is never told, as the trial is {:g} s long", begins_s,
                         problem.trial.duration_s);
    begins_s += stretch.seconds;
  }
  return std::nullopt;
}

}  // namespace amble::experiment
