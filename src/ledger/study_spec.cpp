#include "amble/ledger/study_spec.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <set>

#include "amble/core/hash.hpp"
#include "amble/io/file_kind.hpp"
#include "amble/io/text.hpp"
#include "amble/io/toml_settings.hpp"
#include "amble/record/levels.hpp"

namespace amble::ledger {
namespace {

constexpr double largest_seed = 0x1p53;
constexpr double most_generations = 1e9;
constexpr double most_mutants = 1e5;  ///< a record has two numbers of each

bool is_name(std::string_view text) {
  return !text.empty() && text.size() <= 64 && std::ranges::all_of(text, [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '-' || c == '_';
  });
}

/// Keys of an item, e.g. "conditions[2].name".
std::string item(std::string_view list, std::size_t index, std::string_view key) {
  return fmt::format("{}[{}].{}", list, index, key);
}

void check_name(const StudySpec& study, const std::string& key, const std::string& name,
                std::set<std::string>& names) {
  if (!is_name(name))
    throw study.error_at(key,
                         fmt::format("'{}' = \"{}\": expected 1 to 64 of a-z, 0-9, '-' and '_'", key, name));
  if (!names.insert(name).second)
    throw study.error_at(key, fmt::format("'{}' = \"{}\": that name is taken", key, name));
}

void check_seeds(const StudySpec& study, const std::string& key, const std::vector<double>& seeds) {
  std::set<double> seen;
  for (const double seed : seeds) {
    if (seed != std::floor(seed))
      throw study.error_at(key, fmt::format("'{}' has {}: expected whole numbers", key, seed));
    if (!seen.insert(seed).second)
      throw study.error_at(key, fmt::format("'{}' has the seed {:.0f} twice", key, seed));
  }
}

/// Refuses a robot among settings, whose path nobody would take from the study file.
void check_settings(const StudySpec& study) {
  const auto check = [&study](const std::string& key, const std::vector<std::string>& settings) {
    for (const std::string& setting : settings)
      if (io::trimmed(setting.substr(0, setting.find('=')), " \t") == "robot")
        throw study.error_at(key, fmt::format("'{}' has \"{}\": expected 'robot' as a key of the condition, "
                                              "which is relative to the study file",
                                              key, io::printable(setting)));
  };
  check("settings", study.settings);
  for (std::size_t i = 0; i < study.conditions.size(); ++i)
    check(item("conditions", i, "settings"), study.conditions[i].settings);
}

void check_conditions(const StudySpec& study) {
  if (study.conditions.empty())
    throw study.error_at("conditions", "no conditions: expected at least one [[conditions]]");
  std::set<std::string> names;
  for (std::size_t i = 0; i < study.conditions.size(); ++i) {
    const ConditionSpec& condition = study.conditions[i];
    check_name(study, item("conditions", i, "name"), condition.name, names);
    check_seeds(study, item("conditions", i, "seeds"), condition.seeds);
    if (condition.config.empty())
      throw study.error_at(item("conditions", i, "config"),
                           fmt::format("'{}' is missing: expected the path of a config file",
                                       item("conditions", i, "config")));
    const auto commands = [&](const TestSpec& test) {
      return !test.command.empty() && test.applies_to(condition.name);
    };
    if (!condition.steering.empty() && std::ranges::none_of(study.tests, commands))
      throw study.error_at(
          item("conditions", i, "steering"),
          fmt::format("'{}': no test of the condition has a command", item("conditions", i, "steering")));
    if (!condition.steering.empty() && condition.gaits > 0)
      throw study.error_at(item("conditions", i, "steering"),
                           fmt::format("'{}': champions that switch between gaits are steered by that; "
                                       "expected 'gaits' or 'steering'",
                                       item("conditions", i, "steering")));
    if (condition.seeds.empty() && study.seeds.empty())
      throw study.error_at("seeds",
                           "'seeds' is missing or empty: expected a list of whole numbers, at least one");
  }
}

void check_condition_names(const StudySpec& study, const std::string& key,
                           const std::vector<std::string>& names) {
  for (const std::string& name : names)
    if (study.find(name) == nullptr)
      throw study.error_at(key, fmt::format("'{}' names \"{}\", which is none of the conditions", key, name));
}

void check_tests(const StudySpec& study) {
  std::set<std::string> names;
  for (std::size_t i = 0; i < study.tests.size(); ++i) {
    const TestSpec& test = study.tests[i];
    check_name(study, item("tests", i, "name"), test.name, names);
    check_condition_names(study, item("tests", i, "conditions"), test.conditions);
    if (!test.level.empty() && test.level != record::own_noise && record::find_level(test.level) == nullptr)
      throw study.error_at(item("tests", i, "level"),
                           fmt::format("'{}' = \"{}\": expected {}, {}", item("tests", i, "level"),
                                       test.level, record::own_noise, record::level_names()));
    if (!test.level.empty() && !test.noise.empty())
      throw study.error_at(
          item("tests", i, "level"),
          fmt::format("'{}': the test has 'noise' as well; expected one of them", item("tests", i, "level")));
    if (!test.is_disturbed() && test.ground.empty() && test.episodes != 1)
      throw study.error_at(item("tests", i, "episodes"),
                           fmt::format("'{}' = {}: without noise all trials are the same",
                                       item("tests", i, "episodes"), test.episodes));
  }
}

}  // namespace

void ConditionSpec::describe(io::SettingsVisitor& visitor) {
  visitor.text("name", name, {"how files and claims call it: a-z, 0-9, '-', '_'"});
  visitor.text("title", title, {"how figures call it; empty: as its name"});
  visitor.text("config", config, {"config file, relative to the study file"});
  visitor.text("robot", robot, {"robot file, relative to the study file; empty: the config's"});
  visitor.texts("settings", settings,
                {"\"key.path=value\", laid over the config after the study's settings"});
  visitor.text("steering", steering,
               {"[controller.differential] in one line, \"turn_gain = 1.5, full_speed_m_s = 0.4\", by which "
                "champions are steered in tests with a command; empty: as in their own config"});
  visitor.integer("gaits", gaits, {0, 1000},
                  {"champions that switch between so many elites of the run's map as they are told "
                   "(`amble repertoire RUN --switching N`), in place of its best elite; 0: the best elite"});
  visitor.numbers("seeds", seeds, {0, largest_seed}, {"seeds of its runs; empty: the study's"});
  visitor.integer("generations", generations, {0, most_generations},
                  {"generations of its runs; 0: the study's"});
}

void TestSpec::describe(io::SettingsVisitor& visitor) {
  visitor.text("name", name, {"how claims call it: a-z, 0-9, '-', '_'"});
  visitor.text("engine", engine, {"physics engine; empty: the run's own"});
  visitor.texts("engine_own", engine_own,
                {"\"NAME=NUMBER\", settings of that engine if it has its own; empty: its defaults"});
  visitor.number("seconds", seconds, {1e-5, 1e6}, {"length of the trials, s"});
  visitor.text("noise", noise, {"config file whose [noise] disturbs the trials; empty: none"});
  visitor.text("level", level,
               {"level of disturbance of the trials, in place of noise, or \"own\": the noise of each "
                "condition's own config; empty: none"});
  visitor.text("ground", ground, {"config file whose [ground] the champion walks on; empty: its own"});
  visitor.text("damage", damage, {"config file whose [damage] the champion's robot has; empty: its own"});
  visitor.text(
      "command", command,
      {"what the champion is told, \"SPEED,TURN[,SECONDS]; …\" in m/s, rad/s to the left and s; empty: "
       "as in its own config"});
  visitor.integer("episodes", episodes, {1, 1000}, {"trials under noise that evolution has not met"});
  visitor.number("reach_m", reach_m, {0, 1e6},
                 {"the first best of the run whose median trial gets that far is found, m; 0: not"});
  visitor.flag("score", score, {"whether trials are also scored as in evolution, by [score] of the config"});
  visitor.flag("energy", energy, {"whether the cost of transport is measured"});
  visitor.flag("seam", seam,
               {"whether jumps of targets from cycle to cycle are measured, and the power after them"});
  visitor.integer("mutants", mutants, {0, most_mutants},
                  {"mutants of the champion that are tried beside it, in the same trials; 0: none"});
  visitor.texts("conditions", conditions, {"conditions whose champions are tested; empty: all"});
}

bool TestSpec::applies_to(std::string_view condition) const {
  return conditions.empty() || std::ranges::find(conditions, condition) != conditions.end();
}

void StudySpec::describe(io::SettingsVisitor& visitor) {
  visitor.text("name", name, {"what this study is called in its records"});
  visitor.text("title", title, {"what its report is called"});
  visitor.numbers("seeds", seeds, {0, largest_seed}, {"one run of each condition per seed"});
  visitor.integer("generations", generations, {0, most_generations},
                  {"generations of every run; 0: as in its config"});
  visitor.integer("map_trials", map_trials, {0, 1000},
                  {"new trials in which each elite of a run's map is tried when the run ends; 0: none"});
  visitor.texts("settings", settings, {"\"key.path=value\", laid over every config"});
  visitor.tables("conditions", conditions, {"what is compared"});
  visitor.tables("tests", tests, {"trials of each run's champion"});
  visitor.tables("claims", claims, {"sentences to be judged, each with its rule"});
}

std::vector<std::int64_t> StudySpec::seeds_of(const ConditionSpec& condition) const {
  std::vector<std::int64_t> whole;
  for (const double seed : condition.seeds.empty() ? seeds : condition.seeds)
    whole.push_back(static_cast<std::int64_t>(seed));
  return whole;
}

const ConditionSpec* StudySpec::find(std::string_view condition) const {
  const auto found = std::ranges::find(conditions, condition, &ConditionSpec::name);
  return found == conditions.end() ? nullptr : &*found;
}

const TestSpec* StudySpec::find_test(std::string_view test) const {
  const auto found = std::ranges::find(tests, test, &TestSpec::name);
  return found == tests.end() ? nullptr : &*found;
}

std::string StudySpec::to_toml() const {
  StudySpec copy = *this;
  return io::settings_to_toml([&copy](io::SettingsVisitor& visitor) { copy.describe(visitor); });
}

std::string StudySpec::claims_hash(JudgingRules rules) const {
  std::vector<ClaimSpec> copy = claims;
  std::string text =
      io::settings_to_toml([&copy](io::SettingsVisitor& visitor) { visitor.tables("claims", copy, {""}); });
  if (rules != first_rules) text += fmt::format("verdicts {}, stop {}\n", rules.verdicts, rules.stop);
  return hex(hash_text(text));
}

std::optional<JudgingRules> StudySpec::rules_of(const std::string& claims_hash) const {
  for (int verdicts = current_rules.verdicts; verdicts >= 1; --verdicts)
    for (int stop = current_rules.stop; stop >= 1; --stop)
      if (this->claims_hash({verdicts, stop}) == claims_hash) return JudgingRules{verdicts, stop};
  return std::nullopt;
}

UserError StudySpec::error_at(const std::string& key, const std::string& text) const {
  return UserError(where ? fmt::format("{}: {}", where(key), text) : text);
}

StudySpec load_study(const std::filesystem::path& path, bool is_recorded) {
  io::refuse_other_kinds(path, io::FileKind::study, "and not a study");
  const auto document = std::make_shared<io::TomlDocument>(io::TomlDocument::read(path));
  StudySpec study;
  study.where = [document](const std::string& key) { return document->where(key); };
  const auto reader = document->reader();
  study.describe(*reader);
  reader->finish();
  check_seeds(study, "seeds", study.seeds);
  check_conditions(study);
  if (!is_recorded) check_settings(study);
  check_tests(study);
  for (std::size_t i = 0; i < study.claims.size(); ++i) check_claim(study, i, is_recorded);

  const auto resolve = [&document](std::string& file, const std::string& key) {
    if (file.empty() || std::filesystem::path(file).is_absolute()) return;
    // Where a folder is a link, its parent is not the one that the name says.
    const auto full = document->folder_of(key) / file, plain = full.lexically_normal();
    const bool same = std::filesystem::weakly_canonical(full) == std::filesystem::weakly_canonical(plain);
    file = (same ? plain : full).string();
  };
  for (std::size_t i = 0; i < study.conditions.size(); ++i) {
    resolve(study.conditions[i].config, item("conditions", i, "config"));
    resolve(study.conditions[i].robot, item("conditions", i, "robot"));
  }
  for (std::size_t i = 0; i < study.tests.size(); ++i) {
    resolve(study.tests[i].noise, item("tests", i, "noise"));
    resolve(study.tests[i].ground, item("tests", i, "ground"));
    resolve(study.tests[i].damage, item("tests", i, "damage"));
  }
  return study;
}

}  // namespace amble::ledger
