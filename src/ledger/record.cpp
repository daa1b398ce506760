#include "amble/ledger/record.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "amble/core/check.hpp"
#include "amble/core/error.hpp"
#include "amble/core/hash.hpp"
#include "amble/core/index.hpp"
#include "amble/statistics/descriptive.hpp"

namespace amble::ledger {
namespace {

constexpr std::string_view record_format = "amble-study-record";
constexpr int record_version = 2;

// As records name them.
constexpr std::array<std::pair<const char*, std::optional<double> Obeyed::*>, 4> obeyed_values{
    {{"tracking", &Obeyed::tracking},
     {"speed_error_m_s", &Obeyed::speed_error_m_s},
     {"turn_error_rad_s", &Obeyed::turn_error_rad_s},
     {"switch_s", &Obeyed::switch_s}}};

// A robot moves if it gets that far in that time: the rule of standing still of score/walking.hpp.
constexpr double moving_window_s = 10.0, moving_m = 0.25;

template <typename Value>
double median_of(const std::vector<EpisodeResult>& episodes, Value EpisodeResult::*value) {
  std::vector<double> values;
  values.reserve(episodes.size());
  for (const EpisodeResult& episode : episodes) values.push_back(episode.*value);
  return statistics::median(values);
}

io::Json to_json(const EpisodeResult& episode) {
  io::Json json{{"distance_m", episode.distance_m},
                {"seconds", episode.seconds},
                {"walking_s", episode.walking_s},
                {"outcome", record::outcome_names[to_index(episode.outcome)]}};
  if (episode.obeyed)
    for (const auto& [key, value] : obeyed_values)
      if (const auto& found = *episode.obeyed.*value) json["obeyed"][key] = *found;
  if (episode.spent)
    json["spent"] = {{"energy_j", episode.spent->energy_j},
                     {"way_m", episode.spent->way_m},
                     {"weight_n", episode.spent->weight_n}};
  if (episode.score) json["score"] = *episode.score;
  return json;
}

EpisodeResult episode_from(const io::JsonView& view) {
  EpisodeResult episode{.distance_m = view.at("distance_m").finite_number(),
                        .seconds = view.at("seconds").finite_number(),
                        .walking_s = view.at("walking_s").finite_number()};
  const auto outcome = view.at("outcome").text();
  const auto found = std::ranges::find(record::outcome_names, outcome);
  if (found == record::outcome_names.end()) view.at("outcome").bad("completed, fell or diverged");
  episode.outcome = static_cast<record::Outcome>(found - record::outcome_names.begin());
  if (view.has("obeyed")) {
    const io::JsonView obeyed = view.at("obeyed");
    episode.obeyed.emplace();
    for (const auto& [key, value] : obeyed_values)
      if (value == &Obeyed::tracking || obeyed.has(key))
        *episode.obeyed.*value = obeyed.at(key).finite_number();
  }
  if (view.has("spent")) {
    const io::JsonView spent = view.at("spent");
    episode.spent = {.energy_j = spent.at("energy_j").finite_number(),
                     .way_m = spent.at("way_m").finite_number(),
                     .weight_n = spent.at("weight_n").finite_number()};
    if (!(episode.spent->weight_n > 0.0)) spent.at("weight_n").bad("a number of more than 0");
  }
  if (view.has("score")) episode.score = view.at("score").finite_number();
  return episode;
}

io::Json to_json(const TestResult& test) {
  io::Json episodes = io::Json::array();
  for (const EpisodeResult& episode : test.episodes) episodes.push_back(to_json(episode));
  io::Json json{{"name", test.name},
                {"settings", test.settings},
                {"engine", test.engine},
                {"trial_s", test.trial_s},
                {"episodes", episodes},
                {"gait", test.gait},
                {"path_interval_s", test.path_interval_s},
                {"path_m", test.path_m}};
  if (test.seam)
    json["seam"] = {{"jumps", test.seam->jumps},
                    {"mean_rad", test.seam->mean_rad},
                    {"largest_rad", test.seam->largest_rad},
                    {"power_w", test.seam->power_w}};
  if (test.reach_m > 0.0) json["reach_m"] = test.reach_m;
  if (test.reached)
    json["reached"] = {{"generation", test.reached->generation},
                       {"evaluations", test.reached->evaluations},
                       {"steps", test.reached->steps}};
  if (test.mutants.empty()) return json;
  io::Json kept = io::Json::array(), change = io::Json::array();
  for (const record::Mutant& mutant : test.mutants) {
    kept.push_back(mutant.kept);
    change.push_back(mutant.change);
  }
  json["mutants"] = {
      {"score", test.champion_score}, {"kept", std::move(kept)}, {"change", std::move(change)}};
  return json;
}

int count_from(const io::JsonView& view) {
  const std::int64_t value = view.integer();
  if (value < 0 || value > std::numeric_limits<int>::max()) view.bad("a whole number from 0 to 2147483647");
  return static_cast<int>(value);
}

std::uint64_t total_from(const io::JsonView& view) {
  const std::int64_t value = view.integer();
  if (value < 0) view.bad("a whole number from 0 to 9223372036854775807");
  return static_cast<std::uint64_t>(value);
}

Seam seam_from(const io::JsonView& view) {
  const Seam seam{.jumps = view.at("jumps").integer(),
                  .mean_rad = view.at("mean_rad").finite_number(),
                  .largest_rad = view.at("largest_rad").finite_number(),
                  .power_w = view.at("power_w").finite_number()};
  if (seam.jumps < 0) view.at("jumps").bad("a whole number of at least 0");
  return seam;
}

void read_mutants(const io::JsonView& view, TestResult& test) {
  test.champion_score = view.at("score").finite_number();
  const auto kept = view.at("kept"), change = view.at("change");
  if (kept.size() == 0) kept.bad("a list of at least one number");
  if (kept.size() != change.size()) change.bad("a list as long as 'kept'");
  for (std::size_t i = 0; i < kept.size(); ++i) {
    const record::Mutant mutant{.kept = kept.at(i).finite_number(), .change = change.at(i).finite_number()};
    if (mutant.kept < 0.0) kept.at(i).bad("a number of at least 0");
    if (mutant.change < 0.0 || mutant.change > 1.0) change.at(i).bad("a number from 0 to 1");
    test.mutants.push_back(mutant);
  }
}

TestResult test_from(const io::JsonView& view) {
  TestResult test{.name = view.at("name").text(),
                  .settings = view.at("settings").text(),
                  .engine = view.at("engine").text(),
                  .trial_s = view.at("trial_s").finite_number(),
                  .episodes = {},
                  .gait = view.at("gait").text(),
                  .path_interval_s = view.at("path_interval_s").finite_number(),
                  .path_m = {},
                  .reached = {}};
  const auto episodes = view.at("episodes");
  for (std::size_t i = 0; i < episodes.size(); ++i) test.episodes.push_back(episode_from(episodes.at(i)));
  if (test.episodes.empty()) episodes.bad("a list of at least one trial");
  const auto path = view.at("path_m");
  for (std::size_t i = 0; i < path.size(); ++i) test.path_m.push_back(path.at(i).finite_number());
  if (view.has("seam")) test.seam = seam_from(view.at("seam"));
  if (view.has("reach_m")) test.reach_m = view.at("reach_m").finite_number();
  if (view.has("reached")) {
    const auto reached = view.at("reached");
    test.reached = {.generation = count_from(reached.at("generation")),
                    .evaluations = total_from(reached.at("evaluations")),
                    .steps = total_from(reached.at("steps"))};
  }
  if (view.has("mutants")) read_mutants(view.at("mutants"), test);
  return test;
}

/// All that depends on study, condition, seed and program alone.
io::Json results_json(const Record& record) {
  io::Json curve = io::Json::array(), tests = io::Json::array();
  for (const CurvePoint& point : record.curve) curve.push_back({point.generation, point.best_objective});
  for (const TestResult& test : record.tests) tests.push_back(to_json(test));
  io::Json json{{"study", record.study},
                {"condition", record.condition},
                {"seed", record.seed},
                {"config", record.config},
                {"generations", record.generations},
                {"engine", record.engine},
                {"evaluations", record.evaluations},
                {"steps", record.steps},
                {"best_m", record.best_objective},
                {"best_generation", record.best_generation},
                {"hidden", record.hidden},
                {"links", record.links},
                {"curve", std::move(curve)},
                {"tests", std::move(tests)},
                {"champion_file", record.champion_file},
                {"champion", record.champion}};
  if (!record.map_figures.empty()) json["map"] = record.map_figures;
  if (record.map_trials > 0) json["map_trials"] = record.map_trials;
  return json;
}

io::Json to_json(const Provenance& from) {
  io::Json json{{"version", from.version},   {"commit", from.commit},
                {"compiler", from.compiler}, {"flags", from.flags},
                {"cpu", from.cpu},           {"finished_utc", from.finished_utc},
                {"claims", from.claims},     {"evolution_s", from.evolution_s},
                {"tests_s", from.tests_s},   {"workers", from.workers}};
  if (!from.reached_s.empty()) json["reached_s"] = from.reached_s;
  if (!from.added_by.empty()) json["added_by"] = from.added_by;
  return json;
}

std::map<std::string, double> numbers_from(const io::JsonView& view) {
  if (!view.raw().is_object()) view.bad("an object");
  std::map<std::string, double> numbers;
  for (const auto& [name, value] : view.raw().items()) numbers[name] = view.at(name).finite_number();
  return numbers;
}

Provenance provenance_from(const io::JsonView& view) {
  Provenance from{.version = view.at("version").text(),
                  .commit = view.at("commit").text(),
                  .compiler = view.at("compiler").text(),
                  .flags = view.at("flags").text(),
                  .cpu = view.at("cpu").text(),
                  .finished_utc = view.at("finished_utc").text(),
                  .claims = view.at("claims").text(),
                  .evolution_s = view.at("evolution_s").finite_number(),
                  .tests_s = view.at("tests_s").finite_number(),
                  .workers = count_from(view.at("workers"))};
  if (view.has("reached_s")) from.reached_s = numbers_from(view.at("reached_s"));
  if (view.has("added_by"))
    for (const auto& [name, value] : view.at("added_by").raw().items())
      from.added_by[name] = view.at("added_by").at(name).text();
  return from;
}

}  // namespace

score::Typical TestResult::typical() const {
  std::vector<double> distances_m;
  std::vector<record::Outcome> outcomes;
  for (const EpisodeResult& episode : episodes) {
    distances_m.push_back(episode.distance_m);
    outcomes.push_back(episode.outcome);
  }
  return score::typical(distances_m, outcomes);
}

double TestResult::distance_m() const {
  return median_of(episodes, &EpisodeResult::distance_m);
}
double TestResult::upright_s() const {
  return median_of(episodes, &EpisodeResult::seconds);
}
double TestResult::walking_s() const {
  return median_of(episodes, &EpisodeResult::walking_s);
}

std::optional<double> TestResult::obeyed(std::optional<double> Obeyed::*value) const {
  std::vector<double> values;
  for (const EpisodeResult& episode : episodes)
    if (episode.obeyed && *episode.obeyed.*value) values.push_back(*(*episode.obeyed.*value));
  if (values.empty()) return std::nullopt;
  return statistics::median(values);
}

std::optional<double> TestResult::score() const {
  std::vector<double> values;
  for (const EpisodeResult& episode : episodes)
    if (episode.score) values.push_back(*episode.score);
  if (values.empty()) return std::nullopt;
  return statistics::median(values);
}

std::optional<double> TestResult::cost_of_transport() const {
  double energy_j = 0.0, weighed_way_j = 0.0;
  bool measured = false;
  for (const EpisodeResult& episode : episodes)
    if (const auto& spent = episode.spent) {
      measured = true;
      energy_j += spent->energy_j;
      weighed_way_j += spent->weight_n * spent->way_m;
    }
  if (!measured) return std::nullopt;
  return weighed_way_j > 0.0 ? energy_j / weighed_way_j : std::numeric_limits<double>::infinity();
}

std::optional<double> TestResult::moving_s() const {
  if (trial_s < moving_window_s * (1.0 - 1e-9)) return std::nullopt;
  const auto samples = static_cast<std::int64_t>(path_m.size() / 2);
  if (samples == 0) return 0.0;
  const std::int64_t window = std::max<std::int64_t>(1, std::llround(moving_window_s / path_interval_s));
  const auto place = [this](std::int64_t sample) {  // 0 is the start
    return sample == 0 ? std::pair(0.0, 0.0)
                       : std::pair(path_m[to_index(2 * sample - 2)], path_m[to_index(2 * sample - 1)]);
  };
  std::int64_t moving = 0;
  for (std::int64_t last = window; last <= samples; ++last) {
    const auto [x, y] = place(last);
    const auto [x_before, y_before] = place(last - window);
    if (std::hypot(x - x_before, y - y_before) > moving_m) moving += last == window ? window : 1;
  }
  return static_cast<double>(moving) * path_interval_s;
}

const TestResult* Record::find_test(std::string_view name) const {
  const auto found = std::ranges::find(tests, name, &TestResult::name);
  return found == tests.end() ? nullptr : &*found;
}

double Record::best_after(int generation) const {
  double best = 0.0;
  for (const CurvePoint& point : curve)
    if (point.generation <= generation) best = point.best_objective;
  return best;
}

std::string Record::digest() const {
  return hex(hash_text(results_json(*this).dump()));
}

std::string record_text(const Record& record) {
  io::Json document = results_json(record);
  document["digest"] = record.digest();
  document["provenance"] = to_json(record.provenance);
  return io::sealed_json(record_format, record_version, document);
}

Record parse_record(const std::string& text, const std::string& what) {
  const auto sealed = io::unseal_json(record_format, record_version, text, what);
  const io::JsonView root(sealed.document, what);
  Record record{.study = root.at("study").text(),
                .condition = root.at("condition").text(),
                .seed = root.at("seed").integer(),
                .config = root.at("config").text(),
                .generations = count_from(root.at("generations")),
                .engine = root.at("engine").text(),
                .evaluations = total_from(root.at("evaluations")),
                .steps = total_from(root.at("steps")),
                .best_objective = root.at("best_m").finite_number(),
                .best_generation = count_from(root.at("best_generation")),
                .hidden = count_from(root.at("hidden")),
                .links = count_from(root.at("links")),
                .map_figures = {},
                .curve = {},
                .champion = root.at("champion").raw(),
                .champion_file = root.at("champion_file").text(),
                .tests = {},
                .provenance = provenance_from(root.at("provenance"))};
  if (root.has("map")) record.map_figures = numbers_from(root.at("map"));
  if (root.has("map_trials")) record.map_trials = count_from(root.at("map_trials"));
  const auto curve = root.at("curve"), tests = root.at("tests");
  for (std::size_t i = 0; i < curve.size(); ++i)
    record.curve.push_back(
        {count_from(curve.at(i).at(std::size_t{0})), curve.at(i).at(std::size_t{1}).finite_number()});
  for (std::size_t i = 0; i < tests.size(); ++i) record.tests.push_back(test_from(tests.at(i)));
  if (root.at("digest").text() != record.digest())
    root.at("digest").bad("the digest of the record's results");
  return record;
}

}  // namespace amble::ledger
