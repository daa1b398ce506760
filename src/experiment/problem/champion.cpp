#include "amble/experiment/problem/champion.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

#include "amble/core/error.hpp"
#include "amble/core/index.hpp"
#include "amble/experiment/problem/episode_set.hpp"
#include "amble/experiment/problem/evaluation_settings.hpp"
#include "amble/experiment/problem/problem_json.hpp"
#include "amble/io/json_file.hpp"
#include "amble/neat/genome_json.hpp"
#include "amble/robot/original_model.hpp"
#include "amble/score/score.hpp"
#include "amble/score/tracking.hpp"

namespace amble::experiment {
namespace {

constexpr std::string_view champion_format = "amble-champion";
constexpr int champion_version = 4;

/// The score is written where it is not the distance.
io::Json result_json(const TrialResult& result) {
  io::Json json{{"distance_m", result.distance_m},
                {"seconds", result.seconds},
                {"steps", result.steps},
                {"outcome", record::outcome_names[to_index(result.outcome)]}};
  if (result.score) json["score"] = *result.score;
  return json;
}

int count_of(const io::JsonView& view) {
  const std::int64_t value = view.integer();
  if (value < 0 || value > std::numeric_limits<int>::max()) view.bad("a whole number from 0 to 2147483647");
  return static_cast<int>(value);
}

TrialResult parse_result(const io::JsonView& view) {
  TrialResult result;
  result.distance_m = view.at("distance_m").finite_number();
  if (view.has("score")) result.score = view.at("score").finite_number();
  result.seconds = view.at("seconds").finite_number();
  result.steps = count_of(view.at("steps"));
  const auto outcome = view.at("outcome").text();
  const auto found = std::ranges::find(record::outcome_names, outcome);
  if (found == record::outcome_names.end()) view.at("outcome").bad("completed, fell or diverged");
  result.outcome = static_cast<record::Outcome>(found - record::outcome_names.begin());
  return result;
}

io::Json noise_json(const Champion& champion) {
  io::Json episodes = io::Json::array();
  for (const auto& episode : champion.episodes)
    episodes.push_back({{"result", result_json(episode.result)}, {"trace", trace_text(episode.trace)}});
  return {{"settings", io::settings_to_json(champion.problem.noise)}, {"episodes", std::move(episodes)}};
}

std::vector<NoisyTrial> parse_episodes(const io::JsonView& root) {
  std::vector<NoisyTrial> episodes;
  if (!root.has("noise")) return episodes;
  const auto list = root.at("noise").at("episodes");
  if (static_cast<std::int64_t>(list.size()) != root.at("noise").at("settings").at("episodes").integer())
    list.bad("as many as settings.episodes");
  for (std::size_t i = 0; i < list.size(); ++i)
    episodes.push_back(
        {.result = parse_result(list.at(i).at("result")), .trace = parse_trace(list.at(i).at("trace"))});
  return episodes;
}

io::Json referees_json(const Champion& champion) {
  io::Json list = io::Json::array();
  for (const auto& [engine, result] : champion.referees) {
    io::Json referee{{"engine", engine}};
    referee.update(result_json(result));
    if (const auto kept = share_kept(result.distance_m, champion.result.distance_m)) referee["kept"] = *kept;
    list.push_back(std::move(referee));
  }
  return list;
}

std::vector<RefereeResult> parse_referees(const io::JsonView& root) {
  std::vector<RefereeResult> referees;
  if (!root.has("referees")) return referees;
  const auto list = root.at("referees");
  for (std::size_t i = 0; i < list.size(); ++i)
    referees.push_back({.engine = list.at(i).at("engine").text(), .result = parse_result(list.at(i))});
  return referees;
}

Draw parse_draw(const io::JsonView& root) {
  if (!root.has("draw")) return Draw::each_generation;
  if (root.at("draw").text() != draw_names[to_index(Draw::once)]) root.at("draw").bad("\"once\"");
  return Draw::once;
}

Champion champion_from(const io::Json& document, const std::string& what) {
  const io::JsonView root(document, what);
  try {
    Champion champion{.experiment = root.at("experiment").text(),
                      .seed = root.at("seed").integer(),
                      .generation = count_of(root.at("generation")),
                      .index = count_of(root.at("index")),
                      .problem = problem_from_json(root),
                      .genome = neat::genome_from_json(root.at("genome")),
                      .result = parse_result(root.at("result")),
                      .trace = parse_trace(root.at("trace")),
                      .episodes = parse_episodes(root),
                      .referees = parse_referees(root),
                      .draw = parse_draw(root)};
    champion.problem.ground_key = champion.ground_key();
    neat::validate(champion.genome, champion.problem.cppn_inputs(), champion.problem.cppn_outputs(),
                   champion.problem.cppn.recurrent);
    return champion;
  } catch (const UserError& error) {
    const std::string_view reason = error.what();
    if (reason.starts_with(what)) throw;
    fail(ExitCode::bad_file, "{}: {}", what, reason);
  }
}

}  // namespace

namespace {

std::optional<Tracking> tracking_of(const Problem& problem, const record::Trajectory& trajectory) {
  const bool told = problem.command.kind != trial::CommandKind::none;
  const score::Context context{.settings = problem.score,
                               .duration_s = problem.trial.steps() * problem.trial.timestep_s};
  if (told && record::second_count(trajectory.seconds()) == 0)
    return Tracking{.switch_s = score::switch_s(trajectory, context)};
  if (trajectory.command_by_second.empty()) return std::nullopt;
  return Tracking{.tracking = score::tracking(trajectory, context),
                  .speed_error_m_s = score::speed_error(trajectory, context),
                  .turn_error_rad_s = score::turn_error(trajectory, context),
                  .switch_s = score::switch_s(trajectory, context)};
}

/// The way from whole second to whole second over the ground, m.
double way_m(const record::Trajectory& trajectory) {
  const std::vector<double>& places_m = trajectory.com_by_second_m;
  double sum_m = 0.0, x_m = 0.0, y_m = 0.0;
  for (std::size_t i = 0; i + 1 < places_m.size(); i += 2) {
    const double dx_m = places_m[i] - x_m, dy_m = places_m[i + 1] - y_m;
    sum_m += std::sqrt(dx_m * dx_m + dy_m * dy_m);
    x_m = places_m[i];
    y_m = places_m[i + 1];
  }
  return sum_m;
}

}  // namespace

TrialResult summarise(const Problem& problem, const record::Trajectory& trajectory) {
  TrialResult result{.distance_m = score::distance_m(trajectory),
                     .steps = trajectory.steps,
                     .seconds = trajectory.seconds(),
                     .outcome = trajectory.outcome,
                     .tracking = tracking_of(problem, trajectory),
                     .energy_j = trajectory.energy_j,
                     .way_m = way_m(trajectory)};
  if (!problem.score.is_distance()) result.score = problem.make_score().of(trajectory);
  return result;
}

ground::Key Champion::ground_key() const {
  return {.seed = static_cast<std::uint64_t>(seed),
          .generation = static_cast<std::uint32_t>(noise_generation(draw, generation))};
}

trial::ScenarioKey Champion::scenario_key(std::size_t episode) const {
  return {.seed = static_cast<std::uint64_t>(seed),
          .generation = static_cast<std::uint32_t>(noise_generation(draw, generation)),
          .episode = static_cast<std::uint32_t>(episode)};
}

trial::ScenarioKey Champion::unseen_scenario_key(std::size_t episode) const {
  return scenario_key(episode_number(EpisodeSet::unseen, static_cast<std::uint32_t>(episode)));
}

double Champion::objective() const {
  const auto credited = [this](const TrialResult& trial) {
    return problem.credited(trial.value(), trial.outcome);
  };
  if (episodes.empty()) return credited(result);
  std::vector<double> scores;
  for (const auto& episode : episodes) scores.push_back(credited(episode.result));
  return experiment::objective(problem.noise.score, scores);
}

std::optional<double> share_kept(double distance_m, double of_m) {
  if (of_m <= 0.0) return std::nullopt;
  return distance_m / of_m;
}

std::string champion_text(const Champion& champion) {
  io::Json document{{"experiment", champion.experiment},      {"seed", champion.seed},
                    {"generation", champion.generation},      {"index", champion.index},
                    {"result", result_json(champion.result)}, {"genome", neat::to_json(champion.genome)}};
  document.update(problem_json(champion.problem));
  if (champion.problem.robot.original)
    document["original_model"] = robot::to_json(*champion.problem.robot.original);
  document["trace"] = trace_text(champion.trace);
  if (!champion.episodes.empty()) document["noise"] = noise_json(champion);
  if (champion.draw == Draw::once) document["draw"] = draw_names[to_index(champion.draw)];
  if (!champion.referees.empty()) document["referees"] = referees_json(champion);
  return io::sealed_json(champion_format, champion_version, document);
}

LoadedChampion parse_champion(const std::string& text, const std::string& what, io::Altered altered) {
  const auto sealed = io::unseal_json(champion_format, champion_version, text, what, altered);
  return {champion_from(sealed.document, what), sealed.altered};
}

Champion parse_champion_for(std::string_view engine, const std::string& text, const std::string& what) {
  auto sealed = io::unseal_json(champion_format, champion_version, text, what);
  sealed.document.erase("original_model");
  if (sealed.document.contains("engine") && sealed.document["engine"].is_string())
    sealed.document["engine"] = engine;
  return champion_from(sealed.document, what);
}

}  // namespace amble::experiment
