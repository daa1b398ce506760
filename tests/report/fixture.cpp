#include "tests/report/fixture.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <random>

#include "amble/score/score.hpp"

namespace amble::report {
namespace {

using ledger::ClaimKind;
using ledger::ClaimSpec;

ledger::TestSpec test_spec(const std::string& name, const std::string& engine, double seconds) {
  ledger::TestSpec test;
  test.name = name;
  test.engine = engine;
  test.seconds = seconds;
  return test;
}

ClaimSpec claim(ClaimKind kind, const std::string& text, const std::string& measure) {
  ClaimSpec claim;
  claim.kind = kind;
  claim.text = text;
  claim.source = "the sample";
  claim.figure = "some";
  claim.condition = "a";
  claim.measure = measure;
  return claim;
}

std::vector<ClaimSpec> all_kinds() {
  std::vector<ClaimSpec> claims{
      claim(ClaimKind::difference, "a walks farther than b", "train_m"),
      claim(ClaimKind::ratio, "a walks twice as far in the long test", "long.distance_m"),
      claim(ClaimKind::value, "a has 3 hidden nodes", "hidden"),
      claim(ClaimKind::count, "two runs of a stay up", "long.upright_s"),
      claim(ClaimKind::gaits, "a trots", "long"),
      claim(ClaimKind::plateau, "a converges", "train_m")};
  claims[0].against = "b";
  claims[1].base_measure = "train_m";
  claims[1].at_least = 2.0;
  claims[2].mean = 3.0;
  claims[2].sd = 1.0;
  claims[2].runs = 20;
  claims[3].threshold = 299.0;
  claims[3].at_least = 2.0;
  claims[4].includes = {"trot"};
  claims[5].from_generation = 5;
  claims[5].at_most = 0.5;
  return claims;
}

}  // namespace

ledger::StudySpec sample_study(const std::vector<std::string>& conditions, int seeds) {
  ledger::StudySpec study;
  study.name = "sample";
  study.generations = 10;
  for (int seed = 1; seed <= seeds; ++seed) study.seeds.push_back(seed);
  for (const std::string& name : conditions) {
    ledger::ConditionSpec condition;
    condition.name = name;
    condition.config = name + ".toml";
    study.conditions.push_back(condition);
  }
  return study;
}

ledger::Record sample_run(const std::string& condition, std::int64_t seed, double best_m) {
  ledger::Record run;
  run.study = "sample";
  run.condition = condition;
  run.seed = seed;
  run.config = "00ff";
  run.generations = 10;
  run.engine = "batch";
  run.best_objective = best_m;
  run.best_generation = 6;
  run.hidden = static_cast<int>(seed);
  run.links = 20 + static_cast<int>(seed);
  run.curve = {{0, 0.5 * best_m}, {6, best_m}};
  run.champion = {{"trial", {{"duration_s", 15.0}}}};
  run.provenance.version = "0.1.0";
  run.provenance.commit = "0123456789abcdef";
  run.provenance.finished_utc = "2026-01-01T00:00:00Z";
  return run;
}

void add_test(ledger::Record& run, const std::string& test, double distance_m, double trial_s,
              double upright_s, double walking_s, const std::string& gait, const std::string& engine) {
  ledger::TestResult result;
  result.name = test;
  result.engine = engine;
  result.trial_s = trial_s;
  result.gait = gait;
  result.episodes = {{distance_m, upright_s, walking_s,
                      upright_s < trial_s ? record::Outcome::fell : record::Outcome::completed}};
  run.tests.push_back(result);
}

void add_runs(StudyData& data, const std::string& condition, const std::vector<double>& best_m) {
  std::int64_t seed = 0;
  for (const double best : best_m) data.records.push_back(sample_run(condition, ++seed, best));
}

StudyData small_study() {
  StudyData data{.study = sample_study({"a", "b"}, 3), .records = {}, .unknown_files = {}};
  data.study.tests = {test_spec("long", "", 300.0), test_spec("ode", "ode", 15.0)};
  data.study.claims = all_kinds();
  add_runs(data, "a", {4.0, 5.0, 6.0});
  add_runs(data, "b", {1.0, 2.5, 2.0});
  for (ledger::Record& run : data.records) {
    const double seed = static_cast<double>(run.seed);
    const bool lasts = run.condition == "a" && run.seed > 1;
    add_test(run, "long", 3.0 * run.best_objective, 300.0, lasts ? 300.0 : 40.0 * seed,
             lasts ? 200.0 : 40.0 * seed);
    add_test(run, "ode", 0.5 * run.best_objective, 15.0, 15.0, 15.0, run.seed == 3 ? "irregular" : "pace",
             "ode");
    run.provenance.claims = data.study.claims_hash();
  }
  return data;
}

StudyData scored_study(const std::string& quantity) {
  StudyData data = small_study();
  score::Settings score;
  score.terms = {{.quantity = quantity, .weight = 2.0}};
  for (ledger::Record& run : data.records) run.champion["score"] = io::settings_to_json(score);
  return data;
}

StudyData mutated_study() {
  StudyData data = small_study();
  data.study.tests[0].mutants = 6;
  for (ledger::Record& run : data.records) {
    const double better = run.condition == "a" ? 0.25 : 0.0, of_seed = 0.01 * static_cast<double>(run.seed);
    for (int i = 0; i < 6; ++i)
      run.tests[0].mutants.push_back({.kept = 0.2 * i + better, .change = 0.04 * i + of_seed});
  }
  return data;
}

StudyData large_study(int count, int runs) {
  std::vector<std::string> names;
  for (int i = 0; i < count; ++i) names.push_back(fmt::format("c{}", i));
  StudyData data{.study = sample_study(names, runs), .records = {}, .unknown_files = {}};
  data.study.tests = {test_spec("long", "", 300.0), test_spec("ode", "ode", 15.0)};
  std::mt19937 random(7);
  const auto uniform = [&random](double lower, double upper) {
    return lower + (upper - lower) * static_cast<double>(random()) / static_cast<double>(std::mt19937::max());
  };
  for (int i = 0; i < count; ++i)
    for (int seed = 1; seed <= runs; ++seed) {
      auto run = sample_run(names[static_cast<std::size_t>(i)], seed, uniform(1.0, 3.0) + 0.3 * i);
      const double lasted = std::min(300.0, uniform(1.0, 500.0));
      const double walked = uniform(0.5, 1.0) * lasted, distance_m = uniform(1.0, 60.0);
      add_test(run, "long", distance_m, 300.0, lasted, walked);
      add_test(run, "ode", uniform(0.1, 1.0) * run.best_objective, 15.0, 15.0, 15.0, "pace", "ode");
      run.provenance.claims = data.study.claims_hash();
      data.records.push_back(std::move(run));
    }
  return data;
}

}  // namespace amble::report
