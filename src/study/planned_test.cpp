#include "amble/study/planned_test.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>
#include <string>
#include <string_view>

#include "amble/core/error.hpp"
#include "amble/core/hash.hpp"
#include "amble/experiment/config.hpp"
#include "amble/experiment/given_damage.hpp"
#include "amble/io/json_file.hpp"
#include "amble/physics/engine.hpp"
#include "amble/physics/engine_kinds.hpp"
#include "amble/record/levels.hpp"
#include "amble/trial/commands.hpp"

namespace amble::study {
namespace {

std::string key_of(std::string_view list, std::size_t index, std::string_view key) {
  return fmt::format("{}[{}].{}", list, index, key);
}

std::string names_of(const physics::EngineKind* kind) {
  if (kind == nullptr || kind->numbers.empty())
    return "none: only engines with settings of their own have any";
  std::vector<std::string> names;
  for (const auto& number : kind->numbers) names.push_back(number.name);
  return fmt::format("{}", fmt::join(names, ", "));
}

/// Throws UserError: the engine has no such setting, or not that value.
io::OwnSettings engine_own_of(const ledger::StudySpec& study, std::size_t index) {
  const ledger::TestSpec& test = study.tests[index];
  const std::string key = key_of("tests", index, "engine_own");
  io::OwnSettings own;
  const auto* const kind = physics::find_engine(test.engine);
  if (test.engine.empty() && !test.engine_own.empty())
    throw study.error_at(key,
                         fmt::format("'{}': the test names no engine; expected 'engine' beside it", key));
  for (const std::string& assignment : test.engine_own) {
    const auto equals = assignment.find('=');
    const std::string name = assignment.substr(0, equals);
    const auto known = [&](const io::OwnNumber& number) { return number.name == name; };
    if (kind == nullptr || std::ranges::none_of(kind->numbers, known))
      throw study.error_at(key, fmt::format("'{}': the engine \"{}\" has no setting '{}'; expected {}", key,
                                            test.engine, name, names_of(kind)));
    const io::Range range = std::ranges::find_if(kind->numbers, known)->range;
    double value = 0.0;
    const char* const end = assignment.data() + assignment.size();
    const char* const begin = equals == std::string::npos ? end : assignment.data() + equals + 1;
    const auto [last, error] = std::from_chars(begin, end, value);
    if (error != std::errc() || last != end || !(value >= range.lowest && value <= range.highest))
      throw study.error_at(key, fmt::format("'{}' has \"{}\": expected {}=NUMBER from {} to {}", key,
                                            assignment, name, range.lowest, range.highest));
    if (!own.numbers.emplace(name, value).second)
      throw study.error_at(key, fmt::format("'{}' has {} twice", key, name));
  }
  return own;
}

/// The config of a file that the test names. Throws UserError with both places.
experiment::Config config_of(const ledger::StudySpec& study, std::size_t index, std::string_view key,
                             const std::string& file) {
  try {
    return experiment::load_config(file, {});
  } catch (const UserError& error) {
    throw study.error_at(key_of("tests", index, key),
                         fmt::format("'{}': {}", key_of("tests", index, key), error.what()));
  }
}

}  // namespace

PlannedTest plan_test(const ledger::StudySpec& study, std::size_t index) {
  PlannedTest test{.spec = study.tests[index], .noise = {}, .ground = {}, .damage = {}};
  if (!test.spec.engine.empty() && !physics::is_engine(test.spec.engine))
    throw study.error_at(key_of("tests", index, "engine"),
                         fmt::format("'{}' = \"{}\": expected {}", key_of("tests", index, "engine"),
                                     test.spec.engine, fmt::join(physics::engine_names(), ", ")));
  test.engine_own = engine_own_of(study, index);
  if (!test.spec.noise.empty()) {
    test.noise = config_of(study, index, "noise", test.spec.noise).noise;
    test.noise.first_undisturbed = false;
    if (!test.noise.any())
      throw study.error_at(key_of("tests", index, "noise"),
                           fmt::format("{}: is without noise", test.spec.noise));
  }
  if (const record::Level* const level = record::find_level(test.spec.level); level != nullptr)
    test.noise = trial::noise_of(*level);
  if (!test.spec.ground.empty()) test.ground = config_of(study, index, "ground", test.spec.ground).ground;
  if (test.ground && test.ground->start_place_m <= 0.0 && !test.spec.is_disturbed() &&
      test.spec.episodes != 1)
    throw study.error_at(
        key_of("tests", index, "episodes"),
        fmt::format("'{}' = {}: without noise, and with all starts at one place of the ground "
                    "(ground.start_place_m), all trials are the same",
                    key_of("tests", index, "episodes"), test.spec.episodes));
  if (!test.spec.damage.empty()) {
    test.damage = config_of(study, index, "damage", test.spec.damage).damage;
    try {
      experiment::check_begins(*test.damage, test.spec.seconds);
    } catch (const SettingError& error) {
      throw study.error_at(key_of("tests", index, "damage"), error.what());
    }
  }
  if (test.spec.command.empty()) return test;
  try {
    test.command = {.kind = trial::CommandKind::fixed, .stretches = trial::parse_commands(test.spec.command)};
  } catch (const UserError& error) {
    throw study.error_at(key_of("tests", index, "command"), error.what());
  }
  return test;
}

experiment::Problem PlannedTest::problem(experiment::Problem home) const {
  if (!spec.engine.empty()) home.engine = spec.engine;
  if (!spec.engine.empty()) home.engine_own = engine_own;
  home.noise = noise;
  home.trial.duration_s = spec.seconds;
  home.trial.validate();
  if (ground) home.set_ground(*ground);
  if (damage) home.set_damage(*damage);
  if (command) home.set_commands(*command);
  if (steering) experiment::steer_by_hand(home, *steering);
  return home;
}

std::string PlannedTest::settings_hash(std::string_view home) const {
  io::Json definition{{"engine", spec.engine.empty() ? std::string(home) : spec.engine},
                      {"seconds", spec.seconds},
                      {"episodes", spec.episodes},
                      {"noise", io::settings_to_json(noise)}};
  if (!engine_own.numbers.empty()) definition["engine_own"] = engine_own.numbers;
  if (spec.reach_m > 0.0) definition["reach_m"] = spec.reach_m;
  if (spec.mutants > 0) definition["mutants"] = spec.mutants;
  if (ground) definition["ground"] = io::settings_to_json(*ground);
  if (damage) definition["damage"] = io::settings_to_json(*damage);
  if (command) definition["command"] = io::settings_to_json(*command);
  if (steering) definition["steering"] = io::settings_to_json(steering->gains);
  if (steering && steering->heading.lead_rad > 0.0)
    definition["heading"] = io::settings_to_json(steering->heading);
  if (spec.score) definition["score"] = true;
  if (spec.energy) definition["energy"] = true;
  if (spec.seam) definition["seam"] = true;
  return hex(hash_text(definition.dump()));
}

bool PlannedTest::is_due(const ledger::Record& record) const {
  if (record.find_test(spec.name) == nullptr) return true;
  const auto& made = record.provenance;
  const auto later = made.added_by.find(spec.name);
  return !measured_by.empty() && measured_by != (later == made.added_by.end() ? made.commit : later->second);
}

}  // namespace amble::study
