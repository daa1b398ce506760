#include "amble/ledger/measures.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <array>
#include <limits>

#include "amble/core/index.hpp"
#include "amble/io/json_file.hpp"
#include "amble/ledger/study_spec.hpp"
#include "amble/score/score.hpp"
#include "amble/statistics/descriptive.hpp"

namespace amble::ledger {

record::Objective objective_of(const Record& record) {
  const auto score = record.champion.find("score");
  if (score == record.champion.end()) return {};
  const std::string what = fmt::format("the record of {}, seed {}", record.condition, record.seed);
  return score::objective_of(
      io::settings_from_json<score::Settings>(io::JsonView(*score, what, "champion.score")));
}

std::string score_of(const Record& record) {
  const auto score = record.champion.find("score");
  return score == record.champion.end() ? std::string() : score->dump();
}

std::optional<double> evolution_trial_s(const Record& record) {
  const auto trial = record.champion.find("trial");
  if (trial == record.champion.end() || !trial->is_object()) return std::nullopt;
  const auto duration = trial->find("duration_s");
  if (duration == trial->end() || !duration->is_number()) return std::nullopt;
  return duration->get<double>();
}

bool evolved_undisturbed(const Record& record) {
  return !record.champion.contains("noise") && !record.champion.contains("ground");
}

namespace {

struct RunMeasure {
  std::string_view name, label;
  double (*value)(const Record&);
  bool is_compared = false;  ///< in all pairs of conditions
};
constexpr std::array run_measures{
    RunMeasure{"train_m", "distance in evolution, m", [](const Record& r) { return r.best_objective; }, true},
    RunMeasure{"hidden", "hidden nodes of the CPPN", [](const Record& r) { return 1.0 * r.hidden; }},
    RunMeasure{"links", "links of the CPPN", [](const Record& r) { return 1.0 * r.links; }}};

/// A measure of runs that fill a map.
struct MapMeasure {
  std::string_view name, label;
  bool is_share = false;
  bool is_corrected = false;  ///< only of studies with `map_trials`
};
constexpr std::array map_measures{
    MapMeasure{"coverage", "share of the cells filled", true},
    MapMeasure{"qd_score", "QD score"},
    MapMeasure{"map_best", "best objective of the map"},
    MapMeasure{"entering_share", "share of the candidates that enter the map", true},
    MapMeasure{"corrected_coverage", "share of the cells filled, corrected", true, true},
    MapMeasure{"corrected_qd_score", "QD score, corrected", false, true},
    MapMeasure{"staying_share", "share of the elites that stay in their cell", true, true}};

/// What a test must look for to have a measure.
enum class Requires { trials, episodes, reaching, mutants, commands, scores, energy, seam };

struct TestMeasure {
  std::string_view name, label;
  std::optional<double> (*value)(const Record&, const TestResult&);
  Requires needs = Requires::trials;
  bool is_compared = false;  ///< in all pairs of conditions
  bool is_share = false;
};
constexpr double never = std::numeric_limits<double>::infinity();

std::optional<double> kept(const Record& record, const TestResult& test) {
  if (!objective_of(record).is_distance) return std::nullopt;
  return record.best_objective > 0.0 ? test.distance_m() / record.best_objective : 0.0;
}

std::optional<double> reached_s(const Record& record, const TestResult& test) {
  const auto found = record.provenance.reached_s.find(test.name);
  return test.reached && found != record.provenance.reached_s.end() ? found->second : never;
}

std::optional<double> viable_share(const Record&, const TestResult& test) {
  return static_cast<double>(std::ranges::count_if(test.mutants, &record::Mutant::viable)) /
         static_cast<double>(test.mutants.size());
}
std::optional<double> mutants_kept(const Record&, const TestResult& test) {
  std::vector<double> kept;
  for (const record::Mutant& mutant : test.mutants) kept.push_back(mutant.kept);
  return statistics::median(kept);
}
std::optional<double> gait_change(const Record&, const TestResult& test) {
  double sum = 0.0, viable = 0.0;
  for (const record::Mutant& mutant : test.mutants)
    if (mutant.viable()) sum += mutant.change, ++viable;
  return viable > 0.0 ? sum / viable : 0.0;
}

std::optional<double> scored(const Record&, const TestResult& test) {
  return test.score();
}
std::optional<double> cost(const Record&, const TestResult& test) {
  return test.cost_of_transport();
}

std::optional<double> jumps(const Record&, const TestResult& test) {
  return test.seam ? std::optional(static_cast<double>(test.seam->jumps)) : std::nullopt;
}
std::optional<double> jump_rad(const Record&, const TestResult& test) {
  return test.seam ? std::optional(test.seam->mean_rad) : std::nullopt;
}
std::optional<double> jump_power_w(const Record&, const TestResult& test) {
  return test.seam ? std::optional(test.seam->power_w) : std::nullopt;
}

using Found = std::optional<double>;
constexpr std::array test_measures{
    TestMeasure{"distance_m", "distance, m",
                [](const Record&, const TestResult& t) -> Found { return t.distance_m(); }, Requires::trials,
                true},
    TestMeasure{"lower_quartile_m", "lower quartile of the distance, m",
                [](const Record&, const TestResult& t) -> Found { return t.typical().lower_quartile; },
                Requires::episodes},
    TestMeasure{"upper_quartile_m", "upper quartile of the distance, m",
                [](const Record&, const TestResult& t) -> Found { return t.typical().upper_quartile; },
                Requires::episodes},
    TestMeasure{"best_m", "distance of the luckiest episode, m",
                [](const Record&, const TestResult& t) -> Found { return t.typical().best; },
                Requires::episodes},
    TestMeasure{"fell_share", "share of the episodes that fell",
                [](const Record&, const TestResult& t) -> Found { return t.typical().fell_share; },
                Requires::episodes, false, true},
    TestMeasure{"upright_s", "time upright, s",
                [](const Record&, const TestResult& t) -> Found { return t.upright_s(); }},
    TestMeasure{"walking_s", "time walking, s",
                [](const Record&, const TestResult& t) -> Found { return t.walking_s(); }},
    TestMeasure{"moving_s", "time in motion, s",
                [](const Record&, const TestResult& t) { return t.moving_s(); }},
    TestMeasure{"kept", "distance / distance in evolution", kept},
    TestMeasure{"tracking", "commands followed, 0 … 1",
                [](const Record&, const TestResult& t) { return t.obeyed(&Obeyed::tracking); },
                Requires::commands, true, true},
    TestMeasure{"speed_error", "error of speed, m/s",
                [](const Record&, const TestResult& t) { return t.obeyed(&Obeyed::speed_error_m_s); },
                Requires::commands},
    TestMeasure{"turn_error", "error of turning, rad/s",
                [](const Record&, const TestResult& t) { return t.obeyed(&Obeyed::turn_error_rad_s); },
                Requires::commands},
    TestMeasure{"score", "score", scored, Requires::scores, true},
    TestMeasure{"cost_of_transport", "cost of transport", cost, Requires::energy},
    TestMeasure{"switch_s", "time from a change of command until it is followed, s",
                [](const Record&, const TestResult& t) { return t.obeyed(&Obeyed::switch_s); },
                Requires::commands},
    TestMeasure{"jumps", "jumps of legs' targets", jumps, Requires::seam},
    TestMeasure{"jump_rad", "mean jump of a leg's targets, rad", jump_rad, Requires::seam},
    TestMeasure{"jump_power_w", "power of a leg's motors after a jump, W", jump_power_w, Requires::seam},
    TestMeasure{"reached_s", "wall time until it was reached, s", reached_s, Requires::reaching},
    TestMeasure{"reached_generation", "generation that reached it",
                [](const Record&, const TestResult& t) -> Found {
                  return t.reached ? 1.0 * t.reached->generation : never;
                },
                Requires::reaching},
    TestMeasure{"reached_evaluations", "evaluations until it was reached",
                [](const Record&, const TestResult& t) -> Found {
                  return t.reached ? static_cast<double>(t.reached->evaluations) : never;
                },
                Requires::reaching},
    TestMeasure{"viable_share", "share of mutants that are viable", viable_share, Requires::mutants, true,
                true},
    TestMeasure{"mutants_kept", "share of the score that mutants keep", mutants_kept, Requires::mutants},
    TestMeasure{"gait_change", "change of duty factors of viable mutants", gait_change, Requires::mutants,
                true}};

struct Parts {
  std::string_view test, measure;
};
bool has(const TestSpec& test, Requires needs) {
  switch (needs) {
    case Requires::episodes:
      return test.episodes > 1;
    case Requires::reaching:
      return test.reach_m > 0.0;
    case Requires::mutants:
      return test.mutants > 0;
    case Requires::commands:
      return !test.command.empty();
    case Requires::scores:
      return test.score;
    case Requires::energy:
      return test.energy;
    case Requires::seam:
      return test.seam;
    case Requires::trials:
      break;
  }
  return true;
}

Parts split(std::string_view name) {
  const std::size_t dot = name.find('.');
  if (dot == std::string_view::npos) return {{}, name};
  return {name.substr(0, dot), name.substr(dot + 1)};
}

}  // namespace

bool is_measure(const StudySpec& study, std::string_view name) {
  const auto [test, what] = split(name);
  if (test.empty()) {
    if (std::ranges::find(run_measures, what, &RunMeasure::name) != run_measures.end()) return true;
    const auto of_map = std::ranges::find(map_measures, what, &MapMeasure::name);
    return of_map != map_measures.end() && (!of_map->is_corrected || study.map_trials > 0);
  }
  const TestSpec* const spec = study.find_test(test);
  const auto found = std::ranges::find(test_measures, what, &TestMeasure::name);
  return spec != nullptr && found != test_measures.end() && has(*spec, found->needs);
}

bool is_of_map(std::string_view measure) {
  return std::ranges::find(map_measures, measure, &MapMeasure::name) != map_measures.end();
}

bool is_share(std::string_view measure) {
  const auto of_map = std::ranges::find(map_measures, measure, &MapMeasure::name);
  if (of_map != map_measures.end()) return of_map->is_share;
  const auto of_test = std::ranges::find(test_measures, split(measure).measure, &TestMeasure::name);
  return of_test != test_measures.end() && of_test->is_share;
}

bool is_of_seam(std::string_view measure) {
  const auto found = std::ranges::find(test_measures, split(measure).measure, &TestMeasure::name);
  return found != test_measures.end() && found->needs == Requires::seam;
}

const TestSpec* test_of(const StudySpec& study, std::string_view measure) {
  const std::string_view test = split(measure).test;
  return test.empty() ? nullptr : study.find_test(test);
}

std::string measure_names() {
  std::string text;
  for (const RunMeasure& row : run_measures) text += fmt::format("{}, ", row.name);
  std::string corrected;
  for (const MapMeasure& row : map_measures)
    (row.is_corrected ? corrected : text) += fmt::format("{}, ", row.name);
  std::array<std::string, 8> of_tests;
  for (const TestMeasure& row : test_measures) {
    std::string& names = of_tests.at(to_index(row.needs));
    names += fmt::format("{}.{}", names.empty() ? "" : ", ", row.name);
  }
  return fmt::format(
      "{}with map_trials {}TEST{}, with episodes {}, with reach_m {}, with mutants {}, with "
      "command {}, with score {}, with energy {}, with seam {}",
      text, corrected, of_tests[0], of_tests[1], of_tests[2], of_tests[3], of_tests[4], of_tests[5],
      of_tests[6], of_tests[7]);
}

std::vector<std::string> measures_of_runs() {
  std::vector<std::string> names;
  names.reserve(run_measures.size());
  for (const RunMeasure& row : run_measures) names.emplace_back(row.name);
  return names;
}

std::vector<std::string> compared_measures_of_runs() {
  std::vector<std::string> names;
  for (const RunMeasure& row : run_measures)
    if (row.is_compared) names.emplace_back(row.name);
  return names;
}

std::vector<std::string> measures_of(const TestSpec& test) {
  std::vector<std::string> names;
  for (const TestMeasure& row : test_measures)
    if (has(test, row.needs)) names.push_back(fmt::format("{}.{}", test.name, row.name));
  return names;
}

std::vector<std::string> compared_measures_of(const TestSpec& test) {
  std::vector<std::string> names;
  for (const TestMeasure& row : test_measures)
    if (row.is_compared && has(test, row.needs)) names.push_back(fmt::format("{}.{}", test.name, row.name));
  return names;
}

std::optional<double> measure(const Record& record, std::string_view name) {
  const auto [test, what] = split(name);
  if (test.empty()) {
    const auto found = std::ranges::find(run_measures, what, &RunMeasure::name);
    if (found != run_measures.end()) return found->value(record);
    const auto of_map = record.map_figures.find(std::string(what));
    return of_map == record.map_figures.end() ? std::nullopt : std::optional(of_map->second);
  }
  const TestResult* const result = record.find_test(test);
  const auto found = std::ranges::find(test_measures, what, &TestMeasure::name);
  if (result == nullptr || found == test_measures.end()) return std::nullopt;
  if (found->needs == Requires::episodes && result->episodes.size() < 2) return std::nullopt;
  if (found->needs == Requires::reaching && result->reach_m <= 0.0) return std::nullopt;
  if (found->needs == Requires::mutants && result->mutants.empty()) return std::nullopt;
  return found->value(record, *result);
}

std::string measure_label(std::string_view name) {
  const auto [test, what] = split(name);
  if (test.empty()) {
    const auto found = std::ranges::find(run_measures, what, &RunMeasure::name);
    if (found != run_measures.end()) return std::string(found->label);
    const auto of_map = std::ranges::find(map_measures, what, &MapMeasure::name);
    return std::string(of_map == map_measures.end() ? name : of_map->label);
  }
  const auto found = std::ranges::find(test_measures, what, &TestMeasure::name);
  return fmt::format("{}: {}", test, found == test_measures.end() ? what : found->label);
}

std::string measure_unit(std::string_view name, const record::Objective& objective) {
  if (name == "train_m" || split(name).measure == "score") return objective.unit;
  return name.ends_with("_m") ? " m" : name.ends_with("_s") ? " s" : "";
}

}  // namespace amble::ledger
