#include "amble/browser/run.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "amble/core/check.hpp"
#include "amble/core/error.hpp"
#include "amble/core/index.hpp"
#include "amble/experiment/plan/generation_row.hpp"
#include "amble/experiment/plan/manifest.hpp"
#include "amble/experiment/plan/told_generation.hpp"
#include "amble/experiment/plan/typical_level.hpp"
#include "amble/io/binary.hpp"
#include "amble/io/file.hpp"
#include "amble/io/json_file.hpp"
#include "amble/neat/genome_io.hpp"
#include "amble/search/generational.hpp"
#include "amble/search/map_elites.hpp"

namespace amble::browser {
namespace {

std::string champion_path(int generation) {
  return fmt::format("champions/{:05}.json", generation);
}

const std::string& file_of(const Files& files, const std::string& path) {
  const auto found = files.find(path);
  if (found == files.end()) fail(ExitCode::bad_file, "{}: missing; the run cannot go on without it", path);
  return found->second;
}

/// What a change of the world must leave as it is.
std::string searched(const experiment::Config& config) {
  io::Json all = io::parse_json(config_json(config), "config");
  for (const char* key :
       {"name", "robot", "drop_m", "seed", "generations", "trial", "noise", "ground", "damage", "score"})
    all.erase(key);
  return all.dump();
}

io::Json process_json(int from_generation) {
  return io::Json::array({{{"amble", "in a page"}, {"jobs", 1}, {"from_generation", from_generation}}});
}

}  // namespace

Run::Run(std::shared_ptr<const Plan> plan)
    : plan_(std::move(plan)),
      state_(plan_->config, plan_->problem),
      told_(state_.strategy->ask().size()),
      header_(experiment::csv_header(state_.strategy->metrics())),
      table_(header_) {
  state_.progress.csv_bytes = table_.size();
  state_.progress.csv_digest = experiment::table_digest(0, header_, header_);
  if (!state_.strategy->logs().empty()) log_ = state_.strategy->take_log_growth(0);
}

Run::Run(std::shared_ptr<const Plan> plan, const Files& files) : Run(std::move(plan)) {
  restore(files);
}

void Run::restore(const Files& files) {
  search::Strategy& strategy = *state_.strategy;
  state_.progress = experiment::parse_checkpoint(file_of(files, "checkpoint.bin"), "checkpoint.bin",
                                                 plan_->config, strategy);
  const experiment::Progress& progress = state_.progress;
  const auto logs = strategy.logs();
  if (!logs.empty()) {
    log_ = file_of(files, logs[0]);
    io::InputFile file(log_, logs[0]);
    log_.resize(static_cast<std::size_t>(strategy.restore_log(0, file, logs[0])));
  }
  table_ = file_of(files, "generations.csv");
  if (table_.size() < progress.csv_bytes)
    fail(ExitCode::bad_file, "generations.csv: it ends after {} bytes of {}", table_.size(),
         progress.csv_bytes);
  table_.resize(static_cast<std::size_t>(progress.csv_bytes));
  header_ = table_.substr(0, table_.find('\n') + 1);
  if (const auto unknown = experiment::unknown_column(header_, strategy.metrics()); !unknown.empty())
    fail(ExitCode::bad_file, "generations.csv: column '{}': expected the columns of the run", unknown);
  for (const auto& [path, text] : files)
    if (path.starts_with("champions/")) champions_.emplace(path, text);
  if (progress.best_generation >= 0) {
    champion_ = file_of(files, champion_path(progress.best_generation));
    const auto best = experiment::parse_champion_for(plan_->problem.engine, champion_, "the champion's file");
    if (best.generation != progress.best_generation || best.objective() != progress.best)
      fail(ExitCode::bad_file, "{}: not the champion that the run had there",
           champion_path(progress.best_generation));
    measure_typical(best.genome);
  }
  told_.assign(candidates(), {});
}

std::string Run::candidates(std::size_t first, std::size_t count) const {
  const auto all = state_.strategy->ask();
  AMBLE_CHECK(first <= all.size() && count <= all.size() - first, "candidates of this generation");
  io::BinaryWriter writer;
  neat::save(all.subspan(first, count), writer);
  return writer.bytes();
}

void Run::take(std::size_t first, std::string_view told) {
  auto read = ToldGenomes::read(told);
  AMBLE_CHECK(first + read.genomes.size() <= told_.size(), "candidates of this generation");
  std::ranges::move(read.genomes, told_.begin() + static_cast<std::ptrdiff_t>(first));
  taken_ += read.genomes.size();
  steps_ += read.steps;
}

void Run::tell(double wall_s) {
  AMBLE_CHECK(taken_ == candidates(), "all have been evaluated");
  experiment::GenerationRow row;
  row.generation = generation();
  row.evaluations = told_.size();
  row.steps = steps_;
  std::vector<double> objectives;
  std::vector<search::Evaluation> evaluations;
  for (const Told& told : told_) {
    objectives.push_back(told.objective);
    evaluations.push_back({.objective = told.objective, .behaviour = told.behaviour, .viable = told.viable});
    row.fell += told.fell;
    row.diverged += told.diverged;
  }
  const int fell = row.fell, diverged = row.diverged;
  experiment::summarise_trials(objectives, {}, row);
  row.fell = fell;
  row.diverged = diverged;
  keep_best(row, objectives);
  note_species();
  state_.strategy->tell(evaluations);
  row.search = state_.strategy->metrics();
  write(row, wall_s);
  shown_ = std::move(told_);
  told_.assign(candidates(), {});
  taken_ = 0;
  steps_ = 0;
}

void Run::keep_best(experiment::GenerationRow& row, std::vector<double>& objectives) {
  const auto best = to_index(std::ranges::max_element(objectives) - objectives.begin());
  const neat::Genome genome = state_.strategy->ask()[best];
  row.best_hidden = genome.count(neat::NodeKind::hidden);
  row.best_links = genome.enabled_links();
  experiment::Progress& progress = state_.progress;
  if (row.best > progress.best) {
    const experiment::Champion champion = tried(genome, row.generation, static_cast<int>(best));
    if (champion.objective() != row.best)
      fail(ExitCode::differs, "generation {}: the champion reached {}, and {} when run again", row.generation,
           row.best, champion.objective());
    measure_typical(genome);
    champion_ = experiment::champion_text(champion);
    champions_[champion_path(row.generation)] = champion_;
    progress.best = row.best;
    progress.best_generation = row.generation;
  }
  row.best_so_far = progress.best;
  row.typical = progress.typical.value_or(score::Typical());
}

experiment::Champion Run::tried(const neat::Genome& genome, int generation, int index) const {
  const experiment::Config& config = plan_->config;
  experiment::Champion champion{.experiment = config.name,
                                .seed = config.seed,
                                .generation = generation,
                                .index = index,
                                .problem = plan_->problem,
                                .genome = genome,
                                .result = {},
                                .trace = {},
                                .episodes = {},
                                .draw = config.evaluation.draw};
  experiment::Problem& problem = champion.problem;
  problem.ground_key = champion.ground_key();
  const auto ground = problem.make_ground(problem.ground_key);
  champion.result =
      experiment::summarise(problem, trials_of(problem, genome, {}, ground, &champion.trace).front());
  if (!problem.trials_vary()) return champion;
  for (std::size_t i = 0; i < to_index(problem.noise.episodes); ++i) {
    const trial::ScenarioKey key = champion.scenario_key(i);
    const auto on = problem.make_ground(experiment::ground_of(key));
    const trial::Scenario scenario = problem.scenario(key, on.get());
    experiment::NoisyTrial again;
    again.result =
        experiment::summarise(problem, trials_of(problem, genome, {&scenario, 1}, on, &again.trace).front());
    champion.episodes.push_back(std::move(again));
  }
  return champion;
}

void Run::measure_typical(const neat::Genome& genome) {
  experiment::Problem disturbed = plan_->problem;
  disturbed.noise = experiment::typical_level(disturbed).noise;
  trial::ScenarioKey key = experiment::episode_key(experiment::EpisodeSet::typical, plan_->config.seed);
  const auto ground = disturbed.make_ground(experiment::ground_of(key));
  std::vector<trial::Scenario> scenarios;
  for (int i = 0; i < experiment::running_trials; ++i, ++key.episode)
    scenarios.push_back(disturbed.scenario(key, ground.get()));
  std::vector<experiment::TrialResult> results;
  for (const auto& trial : trials_of(disturbed, genome, scenarios, ground))
    results.push_back(experiment::summarise(disturbed, trial));
  state_.progress.typical = experiment::typical_objective(disturbed, results);
}

void Run::write(const experiment::GenerationRow& row, double wall_s) {
  row_ = row;
  row_.wall_s = wall_s;
  experiment::Progress& progress = state_.progress;
  progress.evaluations += row.evaluations;
  progress.steps += row.steps;
  progress.wall_s += wall_s;
  const std::string line = experiment::csv_line(row_, header_);
  table_ += line;
  progress.csv_bytes = table_.size();
  progress.csv_digest = experiment::table_digest(progress.csv_digest, header_, line);
  if (!state_.strategy->logs().empty()) log_ += state_.strategy->take_log_growth(0);
}

void Run::note_species() {
  species_.clear();
  if (const auto* neat = dynamic_cast<const search::GenerationalSearch*>(state_.strategy.get()))
    for (const auto& species : neat->population().species()) species_.emplace_back(species.id, species.size);
}

const std::string& Run::champion() const {
  AMBLE_CHECK(!champion_.empty(), "a generation has ended");
  return champion_;
}

std::string Run::elite(std::uint32_t cell) const {
  const auto* map = dynamic_cast<const search::MapElites*>(state_.strategy.get());
  if (map == nullptr || cell >= map->elites().cells() || map->elites().in(cell) == search::Elites::none)
    fail(ExitCode::bad_input, "no walker is in cell {} of the map", cell);
  const search::Elite& elite = map->elites()[map->elites().in(cell)];
  return experiment::champion_text(tried(neat::expand(elite.genome, "the map"), static_cast<int>(elite.round),
                                         static_cast<int>(elite.candidate)));
}

std::string Run::first() const {
  return experiment::champion_text(tried(state_.strategy->ask()[0], generation(), 0));
}

Files Run::files() const {
  experiment::Config config = plan_->config;
  config.robot = "robot.json";
  Files files = champions_;
  files["config.toml"] = config.to_toml();
  files["config.json"] = config_json(config);
  files["robot.json"] = experiment::robot_file_text(plan_->robot);
  files["manifest.json"] = experiment::manifest_text(config, process_json(0));
  files["generations.csv"] = table_;
  files["checkpoint.bin"] = experiment::checkpoint_bytes(plan_->config, state_.progress, *state_.strategy);
  if (const auto logs = state_.strategy->logs(); !logs.empty()) files[logs[0]] = log_;
  return files;
}

void Run::change(std::shared_ptr<const Plan> plan) {
  if (searched(plan->config) != searched(plan_->config))
    fail(ExitCode::bad_input,
         "while a run goes on, only ground, body, noise, trial and score can be changed");
  if (plan->problem.cppn_inputs() != plan_->problem.cppn_inputs() ||
      plan->problem.cppn_outputs() != plan_->problem.cppn_outputs())
    fail(ExitCode::bad_input, "while a run goes on, the robot must keep its legs and joints as they are");
  if (plan->behaviour->length() != plan_->behaviour->length())
    fail(ExitCode::bad_input, "while a run goes on, trials must stay as long as they are");
  plan_ = std::move(plan);
  state_.progress.best = -1.0;
  state_.progress.best_generation = -1;
  state_.progress.typical.reset();
  champion_.clear();
}

}  // namespace amble::browser
