#include "amble/study/plan.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <charconv>
#include <filesystem>
#include <map>
#include <system_error>
#include <utility>

#include "amble/core/error.hpp"
#include "amble/core/hash.hpp"
#include "amble/core/index.hpp"
#include "amble/experiment/build_info.hpp"
#include "amble/experiment/problem.hpp"
#include "amble/experiment/repertoire.hpp"
#include "amble/experiment/run_folder.hpp"
#include "amble/experiment/steering.hpp"
#include "amble/experiment/switching_champion.hpp"
#include "amble/io/json_file.hpp"
#include "amble/io/quoting.hpp"
#include "amble/ledger/measures.hpp"
#include "amble/record/levels.hpp"
#include "amble/score/walking.hpp"

namespace amble::study {
namespace {

namespace fs = std::filesystem;

/// A mistake of a condition whose place in the study file is known.
[[noreturn]] void blame(const ledger::StudySpec& study, const std::string& key, std::string_view condition,
                        const std::string& mistake) {
  throw study.error_at(key, fmt::format("condition '{}': {}", condition, mistake));
}

/// The key that a mistake in a test of the condition is about, as far as its words tell.
std::string key_of_test(const ledger::ConditionSpec& condition, const std::string& condition_key,
                        const ledger::TestSpec& test, const std::string& test_key, std::string_view mistake) {
  const auto is_about = [&](std::string_view part) { return mistake.find(part) != std::string_view::npos; };
  if (!condition.steering.empty() && is_about("controller.differential")) return condition_key + ".steering";
  if (is_about("trial.duration_s")) return test_key + ".seconds";
  if (!test.ground.empty() && is_about("ground")) return test_key + ".ground";
  if (!test.damage.empty() && is_about("damage")) return test_key + ".damage";
  if (!test.command.empty() && is_about("command")) return test_key + ".command";
  return test_key + (test.engine.empty() ? ".name" : ".engine");
}

/// Throws UserError where a champion of the condition could not be tested.
void check_tests(const ledger::StudySpec& study, std::size_t index, const PlannedCondition& condition) {
  const auto home = experiment::Problem::make(condition.config, condition.robot);
  for (const PlannedTest& test : condition.tests) {
    try {
      test.problem(home).make_engine();
    } catch (const UserError& error) {
      const auto number = study.find_test(test.spec.name) - study.tests.data();
      blame(study,
            key_of_test(condition.spec, fmt::format("conditions[{}]", index), test.spec,
                        fmt::format("tests[{}]", number), error.what()),
            condition.spec.name, fmt::format("test '{}': {}", test.spec.name, error.what()));
    }
  }
}

/// Throws UserError: the condition's champions switch between the elites of a map, and its runs make none
/// that can, or a test asks when a run's champions first got somewhere, which are elites that do not switch.
void check_gaits(const ledger::StudySpec& study, std::size_t index, const PlannedCondition& condition) {
  if (condition.spec.gaits == 0) return;
  const std::string key = fmt::format("conditions[{}].gaits", index);
  try {
    experiment::check_can_switch(condition.config);
  } catch (const UserError& error) {
    blame(study, key, condition.spec.name, fmt::format("gaits = {}: {}", condition.spec.gaits, error.what()));
  }
  for (const PlannedTest& test : condition.tests)
    if (test.spec.reach_m > 0.0)
      blame(study, key, condition.spec.name,
            fmt::format("gaits = {}: test '{}' has reach_m, which looks through a run's champions, and they "
                        "do not switch; leave the condition out of the test's conditions",
                        condition.spec.gaits, test.spec.name));
}

/// The test as the champions of a condition meet it: under its own noise where the test asks for that, and
/// steered by hand where they are. Throws UserError: it has no noise.
PlannedTest of_condition(const ledger::StudySpec& study, std::size_t test_index, PlannedTest test,
                         const PlannedCondition& condition,
                         const std::optional<experiment::HandSteering>& steering) {
  if (test.spec.level == record::own_noise) {
    test.noise = condition.config.noise;
    test.noise.first_undisturbed = false;
    if (!test.noise.any())
      blame(study, fmt::format("tests[{}].level", test_index), condition.spec.name,
            fmt::format("test '{}' has level = \"{}\", and the config is without noise; expected {}",
                        test.spec.name, record::own_noise, record::level_names()));
  }
  if (test.damage && test.damage->is_default() && condition.config.damage.is_default())
    blame(study, fmt::format("tests[{}].damage", test_index), condition.spec.name,
          fmt::format(
              "test '{}' has damage = \"{}\", a config without [damage], and the robot has none anyway; "
              "expected a config that has it",
              test.spec.name, test.spec.damage));
  if (test.command) test.steering = steering;
  return test;
}

/// "FILE:LINE: " of what a condition's mistake is about: its own settings, or those of all; empty if the
/// study was not read from a file.
std::string place_of(const ledger::StudySpec& study, std::size_t index, std::string_view mistake) {
  if (!study.where) return {};
  const auto names = [&](const std::string& setting) {
    return mistake.find(setting) != std::string_view::npos;
  };
  const ledger::ConditionSpec& condition = study.conditions[index];
  std::string key = fmt::format("conditions[{}].config", index);
  if (!condition.robot.empty() && names(condition.robot))
    key = fmt::format("conditions[{}].robot", index);
  else if (mistake.starts_with("steering:"))
    key = fmt::format("conditions[{}].steering", index);
  else if (std::ranges::any_of(condition.settings, names))
    key = fmt::format("conditions[{}].settings", index);
  else if (std::ranges::any_of(study.settings, names))
    key = "settings";
  return study.where(key) + ": ";
}

/// Throws UserError: a file that the study names is not there.
void check_files(const ledger::StudySpec& study) {
  const auto check = [&](const std::string& key, const std::string& path) {
    std::error_code error;
    if (path.empty() || fs::status(path, error).type() != fs::file_type::not_found) return;
    // Files of others, as public robots, are fetched first: a study says how in the comments it begins with.
    throw study.error_at(
        key, fmt::format("'{}' = \"{}\": no such file{}", key, fs::path(path).lexically_normal().string(),
                         study.where ? "; the head of the study may say how it is made" : ""));
  };
  for (std::size_t i = 0; i < study.conditions.size(); ++i) {
    check(fmt::format("conditions[{}].config", i), study.conditions[i].config);
    check(fmt::format("conditions[{}].robot", i), study.conditions[i].robot);
  }
  for (std::size_t i = 0; i < study.tests.size(); ++i) {
    check(fmt::format("tests[{}].noise", i), study.tests[i].noise);
    check(fmt::format("tests[{}].ground", i), study.tests[i].ground);
    check(fmt::format("tests[{}].damage", i), study.tests[i].damage);
  }
}

/// Throws UserError: settings of what the study itself says, which would be dropped.
void check_overruled(const std::vector<std::string>& assignments, bool has_generations) {
  for (const std::string& assignment : assignments) {
    const std::string_view key = std::string_view(assignment).substr(0, assignment.find_first_of(" ="));
    if (key == "seed")
      fail(ExitCode::bad_input,
           "the setting {}: a study says itself which seeds its runs have; expected 'seeds'", assignment);
    if (key == "generations" && has_generations)
      fail(ExitCode::bad_input,
           "the setting {}: the study or the condition has 'generations' as well; expected one of "
           "them",
           assignment);
  }
}

/// Robots by file: conditions share them, and a model with large meshes takes a while to read.
using RobotsByFile = std::map<std::string, robot::RobotSpec>;

const robot::RobotSpec& robot_of(const experiment::Config& config, RobotsByFile& robots) {
  const auto known = robots.find(config.robot);
  return known != robots.end() ? known->second
                               : robots.emplace(config.robot, experiment::load_robot(config)).first->second;
}

PlannedCondition plan_condition(const ledger::StudySpec& study, std::size_t index,
                                const std::vector<PlannedTest>& tests, RobotsByFile& robots) {
  const ledger::ConditionSpec& spec = study.conditions[index];
  experiment::Overrides overrides{.assignments = study.settings, .seed = {}, .generations = {}};
  overrides.assignments.insert(overrides.assignments.end(), spec.settings.begin(), spec.settings.end());
  if (!spec.robot.empty()) overrides.assignments.push_back("robot=" + io::toml_quoted(spec.robot));
  const int generations = spec.generations > 0 ? spec.generations : study.generations;
  if (generations > 0) overrides.generations = generations;
  PlannedCondition condition{.spec = spec, .config = {}, .robot = {}, .tests = {}, .hash = {}};
  std::optional<experiment::HandSteering> steering;
  try {
    condition.config = experiment::load_config(spec.config, overrides);
    if (!spec.steering.empty()) steering = experiment::parse_steering(spec.steering, "steering");
    check_overruled(overrides.assignments, generations > 0);
    condition.robot = robot_of(condition.config, robots);
  } catch (const UserError& error) {
    std::string mistake = error.what();
    constexpr std::string_view typed = "--set ";  // what nobody has typed here
    if (mistake.starts_with(typed)) mistake.replace(0, typed.size(), "the setting ");
    fail(error.code(), "{}condition '{}': {}", place_of(study, index, mistake), spec.name, mistake);
  }
  for (std::size_t t = 0; t < tests.size(); ++t)
    if (tests[t].spec.applies_to(spec.name))
      condition.tests.push_back(of_condition(study, t, tests[t], condition, steering));
  check_tests(study, index, condition);
  check_gaits(study, index, condition);
  condition.hash = config_hash(condition.config, condition.robot);
  return condition;
}

bool has_timers(const PlannedCondition& condition) {
  const auto problem = experiment::Problem::make(condition.config, condition.robot);
  return std::ranges::any_of(problem.architecture->make_batch(1)->state_names(),
                             [](const std::string& name) { return name.starts_with("timer."); });
}

/// Why runs of a condition never have a measure; empty if they may.
std::string why_never(const ledger::StudySpec& study, const PlannedCondition& condition,
                      std::string_view measure) {
  if (ledger::is_of_seam(measure) && !has_timers(condition))
    return fmt::format(
        "the controller of condition '{}' is of kind {}, which has no cycles that targets could jump between",
        condition.spec.name, condition.config.controller.kind);
  if (ledger::is_of_map(measure) && condition.config.search.kind != "map-elites")
    return fmt::format("the search of condition '{}' is of kind {}, which fills no map", condition.spec.name,
                       condition.config.search.kind);
  const ledger::TestSpec* const test = ledger::test_of(study, measure);
  if (test == nullptr) return {};
  if (measure.ends_with(".kept") && !condition.config.score.is_distance())
    return fmt::format("the score of condition '{}' is not the distance", condition.spec.name);
  if (const double stop_s = score::StandingRule().window_s;
      measure.ends_with(".moving_s") && test->seconds < stop_s)
    return fmt::format("who moves is known after {:g} s, and the test is {:g} s long", stop_s, test->seconds);
  return {};
}

/// Throws UserError: a claim is about what a condition's runs never have.
void check_measures(const Plan& plan) {
  for (std::size_t i = 0; i < plan.study.claims.size(); ++i) {
    const ledger::ClaimSpec& claim = plan.study.claims[i];
    for (const PlannedCondition& condition : plan.conditions) {
      const std::string& name = condition.spec.name;
      if (name != claim.condition && name != claim.against && name != claim.threshold_condition) continue;
      for (const auto& [which, measure] :
           {std::pair("measure", claim.measure), std::pair("base_measure", claim.base_measure)}) {
        const std::string never = why_never(plan.study, condition, measure);
        const std::string key = fmt::format("claims[{}].{}", i, which);
        if (!never.empty())
          throw plan.study.error_at(
              key,
              fmt::format("'{}' = \"{}\": {}; expected another measure or condition", key, measure, never));
      }
    }
  }
}

/// The same of its map's corrected figures. A record without their number is older than that.
std::string map_misfit(int map_trials, const ledger::Record& record) {
  if (map_trials == 0 || record.map_figures.empty()) return {};
  if (!record.map_figures.contains("corrected_coverage"))
    return fmt::format("its map was not tried again, and map_trials is {}", map_trials);
  if (record.map_trials == 0 || record.map_trials == map_trials) return {};
  return fmt::format("its map was tried again with map_trials = {} instead of {}", record.map_trials,
                     map_trials);
}

/// Why a record does not fit; empty if it does, or only lacks tests. `folder`: that of its run.
std::string record_misfit(const PlannedCondition& condition, const ledger::Record& record, int map_trials,
                          const fs::path& folder) {
  if (record.config != condition.recorded_hash()) return "made with other settings or another robot";
  if (record.generations != condition.config.generations)
    return fmt::format("{} generations instead of {}", record.generations, condition.config.generations);
  if (std::string misfit = map_misfit(map_trials, record); !misfit.empty()) return misfit;
  for (const PlannedTest& test : condition.tests) {
    const auto* const result = record.find_test(test.spec.name);
    if (result != nullptr && result->settings != test.settings_hash(condition.config.engine))
      return fmt::format("the test '{}' was another one", test.spec.name);
    if (test.spec.reach_m > 0.0 && test.is_due(record) && !experiment::is_run_folder(folder))
      return fmt::format(
          "the test '{}' has reach_m and looks through all champions of a run, and these were discarded",
          test.spec.name);
  }
  return {};
}

std::string folder_misfit(const PlannedCondition& condition, const experiment::RunPaths& paths,
                          std::int64_t seed) {
  const auto config = experiment::load_config(paths.config, {});
  const auto robot = experiment::load_robot_file(paths.robot);
  if (config.seed != seed) return fmt::format("has the seed {}", config.seed);
  if (config_hash(config, robot) != condition.hash) return "made with other settings or another robot";
  if (config.generations != condition.config.generations)
    return fmt::format("{} generations instead of {}", config.generations, condition.config.generations);
  return {};
}

/// What the folders say of a run.
struct Finding {
  RunStatus status = RunStatus::missing;
  std::filesystem::path place;  ///< the record or the run folder; empty if missing
  std::string misfit;           ///< why it does not fit; empty if it does
};

Finding look_at(const Plan& plan, const ledger::Ledger& ledger, const PlannedRun& run) {
  const PlannedCondition& condition = plan.condition(run);
  if (ledger.has(condition.spec.name, run.seed)) {
    const auto record = ledger.load(condition.spec.name, run.seed);
    return {.status = condition.has_all_tests(record) ? RunStatus::done : RunStatus::untested,
            .place = plan.paths.record(condition.spec.name, run.seed),
            .misfit = record_misfit(condition, record, plan.study.map_trials, plan.folder(run))};
  }
  const auto folder = plan.folder(run);
  if (!experiment::is_run_folder(folder)) return {};
  try {
    auto misfit = folder_misfit(condition, experiment::RunPaths(folder), run.seed);
    return {.status = RunStatus::begun, .place = folder, .misfit = std::move(misfit)};
  } catch (const UserError&) {
    // Another process may have finished the run and removed its folder meanwhile.
    if (!ledger.has(condition.spec.name, run.seed)) throw;
    return look_at(plan, ledger, run);
  }
}

/// Names of runs, by condition and seed: "supg-001 to supg-020, sine-003".
std::string names_of(const Plan& plan, std::vector<PlannedRun> runs) {
  std::ranges::sort(runs, {}, [](const PlannedRun& run) { return std::pair(run.condition, run.seed); });
  const auto name = [&plan](const PlannedRun& run) { return plan.folder(run).filename().string(); };
  const auto follows = [](const PlannedRun& run, const PlannedRun& other) {
    return other.condition == run.condition && other.seed - 1 == run.seed;
  };
  std::string text;
  for (std::size_t first = 0, last = 0; first < runs.size(); first = last + 1) {
    last = first;
    while (last + 1 < runs.size() && follows(runs[last], runs[last + 1])) ++last;
    text += (text.empty() ? "" : ", ") + name(runs[first]);
    if (last > first) text += (last == first + 1 ? ", " : " to ") + name(runs[last]);
  }
  return text;
}

/// Runs that do not fit the study, by the folder that what is there of them is in, and the reason.
using Misfits = std::map<std::pair<std::string, std::string>, std::vector<PlannedRun>>;

[[noreturn]] void refuse(const Plan& plan, const Misfits& misfits) {
  std::size_t count = 0;
  std::string named;
  for (const auto& [where, runs] : misfits) {
    count += runs.size();
    named += fmt::format("{} in {} ({}); ", names_of(plan, runs), where.first, where.second);
  }
  fail(ExitCode::bad_input,
       "{} of {} runs no longer fit the study: {}nothing was changed; name another --out, or move them away",
       count, plan.runs.size(), named);
}

}  // namespace

std::string PlannedCondition::recorded_hash() const {
  return spec.gaits == 0 ? hash : hex(hash_text(fmt::format("{}, {} gaits", hash, spec.gaits)));
}

bool PlannedCondition::has_all_tests(const ledger::Record& record) const {
  return std::ranges::none_of(tests, [&](const PlannedTest& test) { return test.is_due(record); });
}

Shard Shard::parse(std::string_view text) {
  Shard shard{.index = 0, .count = 0};
  const std::size_t slash = text.find('/');
  const auto number = [](std::string_view digits, int& value) {
    const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
    return error == std::errc() && end == digits.data() + digits.size();
  };
  if (slash == std::string_view::npos || !number(text.substr(0, slash), shard.index) ||
      !number(text.substr(slash + 1), shard.count) || shard.index < 1 || shard.index > shard.count)
    fail(ExitCode::bad_input, "--shard {}: expected I/N with 1 <= I <= N, e.g. 2/8", text);
  return shard;
}

void Plan::retest(const std::vector<std::string>& tests) {
  const auto commit = experiment::build_info().commit;
  for (const std::string& name : tests) {
    bool found = false;
    for (PlannedCondition& condition : conditions)
      for (PlannedTest& test : condition.tests)
        if (test.spec.name == name) {
          test.measured_by = commit;
          found = true;
        }
    if (!found) fail(ExitCode::bad_input, "--retest {}: expected the name of a test of the study", name);
  }
}

std::filesystem::path Plan::folder(const PlannedRun& run) const {
  return paths.run(condition(run).spec.name, run.seed);
}

std::string Plan::name(const PlannedRun& run) const {
  return fmt::format("{}, seed {}", condition(run).spec.name, run.seed);
}

experiment::Config Plan::config(const PlannedRun& run) const {
  experiment::Config config = condition(run).config;
  config.seed = run.seed;
  return config;
}

std::vector<std::size_t> Plan::shard(const Shard& shard) const {
  std::vector<std::size_t> part;
  for (std::size_t i = 0; i < runs.size(); ++i)
    if (i % to_index(shard.count) == to_index(shard.index - 1)) part.push_back(i);
  return part;
}

Plan make_plan(const ledger::StudySpec& study, const std::filesystem::path& folder) {
  Plan plan{.study = study, .paths = ledger::StudyPaths(folder), .conditions = {}, .runs = {}};
  check_files(study);
  std::vector<PlannedTest> tests;
  for (std::size_t i = 0; i < study.tests.size(); ++i) tests.push_back(plan_test(study, i));
  std::vector<std::vector<std::int64_t>> seeds;
  std::size_t most_seeds = 0;
  RobotsByFile robots;
  for (std::size_t i = 0; i < study.conditions.size(); ++i) {
    plan.conditions.push_back(plan_condition(study, i, tests, robots));
    seeds.push_back(study.seeds_of(study.conditions[i]));
    most_seeds = std::max(most_seeds, seeds.back().size());
  }
  check_measures(plan);
  for (std::size_t s = 0; s < most_seeds; ++s)
    for (std::size_t i = 0; i < seeds.size(); ++i) {
      const std::size_t condition = (i + s) % seeds.size();
      if (s < seeds[condition].size()) plan.runs.push_back({condition, seeds[condition][s]});
    }
  return plan;
}

std::string config_hash(const experiment::Config& config, const robot::RobotSpec& robot) {
  return hex(hash_text(config.identity() + experiment::robot_file_text(robot)));
}

std::vector<RunStatus> survey(const Plan& plan) {
  const ledger::Ledger ledger(plan.paths);
  std::vector<RunStatus> states;
  Misfits misfits;
  for (const PlannedRun& run : plan.runs) {
    const Finding found = look_at(plan, ledger, run);
    if (!found.misfit.empty()) misfits[{found.place.parent_path().string(), found.misfit}].push_back(run);
    states.push_back(found.status);
  }
  if (!misfits.empty()) refuse(plan, misfits);
  return states;
}

}  // namespace amble::study
