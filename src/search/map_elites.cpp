#include "amble/search/map_elites.hpp"

#include <algorithm>
#include <cmath>
#include <span>
#include <utility>

#include "amble/core/check.hpp"
#include "amble/core/error.hpp"
#include "amble/core/index.hpp"
#include "amble/neat/crossover.hpp"
#include "amble/neat/genome_compact.hpp"
#include "amble/neat/initial_genome.hpp"
#include "amble/neat/mutation.hpp"

namespace amble::search {
namespace {

// Curiosity of an elite (Cully & Demiris 2018): rises with each child that enters the map, falls with each
// that does not, not below 0.
constexpr float curiosity_gain = 1.0f, curiosity_loss = 0.5f;

/// Mean of `count` values, from the mean of all but the last and the last.
double mean_with(double before, double last, std::uint32_t count) {
  return before + (last - before) / count;
}

}  // namespace

MapElites::MapElites(const MapElitesSettings& settings, const SearchSpace& space)
    : settings_(settings),
      neat_(space.neat),
      inputs_(space.inputs),
      outputs_(space.outputs),
      recurrent_(space.recurrent),
      seed_(space.seed),
      cells_(make_cells(settings)),
      map_(cells_->count(), settings.descriptors.size()),
      curiosity_(settings.select == Selection::curiosity ? cells_->count() : 0),
      before_(space.inputs, space.outputs, space.neat.innovations),
      innovations_(before_) {
  breed();
}

// Candidates of a round depend on the map, the numbers given so far and the round alone.
void MapElites::breed() {
  innovations_ = before_;
  candidates_.clear();
  origins_.clear();
  const int batch = settings_.batch;
  // After the first rounds only for a map that is still empty.
  const bool random = std::int64_t{round_} * batch < settings_.initial || elites().size() == 0;
  if (random) {
    for (int i = 0; i < batch; ++i) {
      Stream stream(seed_, Purpose::initial_genome, static_cast<std::uint32_t>(round_),
                    static_cast<std::uint32_t>(i));
      candidates_.push_back(neat::initial_genome(neat_.genome, inputs_, outputs_, innovations_, stream));
    }
    origins_.resize(candidates_.size());
    return;
  }
  innovations_.begin_generation();
  for (const std::uint32_t cell : elites().least_evaluated(settings_.reevaluations(elites().size())))
    add_elite_again(cell);
  while (candidates_.size() < to_index(batch)) {
    Stream stream(seed_, Purpose::map_elites, static_cast<std::uint32_t>(round_),
                  static_cast<std::uint32_t>(candidates_.size()));
    add_child(stream);
  }
}

void MapElites::add_elite_again(std::uint32_t cell) {
  const std::uint32_t number = elites().in(cell);
  const Elite& elite = elites()[number];
  candidates_.push_back(genome_of(number));
  origins_.push_back({{cell, elite.round, elite.candidate}, true});
}

void MapElites::add_child(Stream& stream) {
  const std::uint32_t parent = draw(stream);
  const Elite& elite = elites()[parent];
  origins_.push_back({{elite.cell, elite.round, elite.candidate}, false});
  if (stream.chance(settings_.crossover_probability)) {
    const std::uint32_t mate = draw(stream);
    const bool mate_is_fitter = elites()[mate].objective > elite.objective;
    candidates_.push_back(neat::crossover(genome_of(mate_is_fitter ? mate : parent),
                                          genome_of(mate_is_fitter ? parent : mate), neat_.crossover,
                                          recurrent_, stream));
    if (!neat_.crossover.mutate_child && mate != parent) return;
  } else {
    candidates_.push_back(genome_of(parent));
  }
  neat::mutate(candidates_.back(), neat_, recurrent_, innovations_, stream);
}

std::uint32_t MapElites::draw(Stream& stream) const {
  const std::uint32_t one = stream.below(elites().size());
  if (settings_.select == Selection::uniform) return one;
  const std::uint32_t other = stream.below(elites().size());
  const auto worth = [this](std::uint32_t number) {
    const Elite& elite = elites()[number];
    return settings_.select == Selection::objective ? elite.objective : double{curiosity_[elite.cell]};
  };
  return worth(other) > worth(one) ? other : one;
}

neat::Genome MapElites::genome_of(std::uint32_t number) const {
  return neat::expand(elites()[number].genome, "the map");
}

bool MapElites::is_there(const Identity& elite) const {
  if (elite.cell == Elites::none) return false;
  const std::uint32_t number = elites().in(elite.cell);
  if (number == Elites::none) return false;
  const Elite& there = elites()[number];
  return there.round == elite.round && there.candidate == elite.candidate;
}

void MapElites::tell(std::span<const Evaluation> evaluations) {
  AMBLE_CHECK(evaluations.size() == candidates_.size(), "one evaluation per candidate");
  counts_ = {};
  for (std::size_t i = 0; i < evaluations.size(); ++i) {
    const Origin& origin = origins_[i];
    if (origin.again)
      take_again(origin.elite, evaluations[i]);
    else
      credit_parent(origin.elite, take(static_cast<std::uint32_t>(i), evaluations[i]));
  }
  ++round_;
  before_ = innovations_;
  breed();
}

/// A new candidate; returns whether it entered the map.
bool MapElites::take(std::uint32_t candidate, const Evaluation& evaluation) {
  if (!evaluation.viable) return false;
  Elite elite{.cell = cells_->of(evaluation.behaviour),
              .round = static_cast<std::uint32_t>(round_),
              .candidate = candidate,
              .evaluations = 1,
              .objective = evaluation.objective,
              .genome = {}};
  const std::uint32_t there = elites().in(elite.cell);
  if (there != Elites::none && !(elite.objective > elites()[there].objective)) return false;
  ++(there == Elites::none ? counts_.entered : counts_.improved);
  if (!curiosity_.empty()) curiosity_[elite.cell] = 0.0f;
  elite.genome = neat::compact(candidates_[candidate]);
  map_.put(std::move(elite), evaluation.behaviour);
  return true;
}

/// One more evaluation of an elite, unless another took its cell in this round.
void MapElites::take_again(const Identity& identity, const Evaluation& evaluation) {
  if (!is_there(identity)) return;
  ++counts_.reevaluated;
  const std::uint32_t number = elites().in(identity.cell);
  Elite elite = elites()[number];
  ++elite.evaluations;
  elite.objective = mean_with(elite.objective, evaluation.objective, elite.evaluations);
  const auto before = elites().descriptor(number);
  std::vector<float> descriptor(before.begin(), before.end());
  // What a simulation that diverged did says nothing of the gait.
  for (std::size_t i = 0; i < descriptor.size() && evaluation.viable; ++i)
    descriptor[i] = static_cast<float>(
        mean_with(double{descriptor[i]}, double{evaluation.behaviour[i]}, elite.evaluations));
  const std::uint32_t cell = cells_->of(descriptor);
  if (cell == elite.cell) return map_.update(cell, elite.evaluations, elite.objective, descriptor);

  map_.remove(elite.cell);
  const std::uint32_t there = elites().in(cell);
  if (there != Elites::none && !(elite.objective > elites()[there].objective)) {
    ++counts_.lost;
    return;
  }
  ++counts_.moved;
  if (!curiosity_.empty()) curiosity_[cell] = curiosity_[elite.cell];
  elite.cell = cell;
  map_.put(std::move(elite), descriptor);
}

void MapElites::credit_parent(const Identity& parent, bool entered) {
  if (curiosity_.empty() || !is_there(parent)) return;
  float& curiosity = curiosity_[parent.cell];
  curiosity = std::max(0.0f, entered ? curiosity + curiosity_gain : curiosity - curiosity_loss);
}

std::vector<Metric> MapElites::metrics() const {
  const double cells = elites().cells(), filled = elites().size();
  return {{"elites", filled},
          {"coverage", filled / cells},
          {"qd_score", elites().objective_sum()},
          {"map_best", elites().best_objective()},
          {"entered", static_cast<double>(counts_.entered)},
          {"improved", static_cast<double>(counts_.improved)},
          {"reevaluated", static_cast<double>(counts_.reevaluated)},
          {"moved", static_cast<double>(counts_.moved)},
          {"lost", static_cast<double>(counts_.lost)}};
}

void MapElites::save(io::BinaryWriter& writer) const {
  writer.put(static_cast<std::int32_t>(round_));
  map_.save(writer);
  before_.save(writer);
  std::vector<float> curiosity;
  for (std::uint32_t number = 0; number < elites().size() && !curiosity_.empty(); ++number)
    curiosity.push_back(curiosity_[elites()[number].cell]);
  writer.put_span(std::span<const float>(curiosity));
}

void MapElites::load(io::BinaryReader& reader) {
  round_ = reader.get<std::int32_t>();
  if (round_ < 0) reader.bad("a negative round");
  map_ = LoggedElites(cells_->count(), settings_.descriptors.size());
  map_.load(reader);
  before_.load(reader);
  loaded_curiosity_ = reader.get_vector<float>();
  for (const float curiosity : loaded_curiosity_)
    if (!(curiosity >= 0.0f && std::isfinite(curiosity))) reader.bad("a curiosity below 0");
}

std::string MapElites::take_log_growth(std::size_t i) {
  AMBLE_CHECK(i == 0, "the archive is the only log");
  return map_.take_growth();
}

std::uint64_t MapElites::restore_log(std::size_t i, io::InputFile& file, const std::string& what) {
  AMBLE_CHECK(i == 0, "the archive is the only log");
  const std::uint64_t bytes = map_.restore(file, what);
  for (std::uint32_t number = 0; number < elites().size(); ++number)
    neat::validate(neat::expand(elites()[number].genome, what), inputs_, outputs_, recurrent_);
  if (loaded_curiosity_.size() != (curiosity_.empty() ? 0 : elites().size()))
    fail(ExitCode::bad_file, "{}: not the map that the checkpoint was written with", what);
  std::ranges::fill(curiosity_, 0.0f);
  for (std::uint32_t number = 0; number < loaded_curiosity_.size(); ++number)
    curiosity_[elites()[number].cell] = loaded_curiosity_[number];
  breed();
  return bytes;
}

void validate_map_elites(const Settings& settings, std::size_t) {
  settings.map_elites.validate();
}

void check_map_elites_memory(const Settings& settings, const SearchSpace& space, double memory_bytes) {
  if (space.neat.innovations.scope == neat::InnovationScope::run)
    fail_setting(
        {"innovations.scope", "search.kind"},
        "innovations.scope = \"run\": expected \"generation\": the list of a run's innovations grows "
        "without bound under search.kind = \"map-elites\"");
  // Genomes are taken for grown to four times the links they start with.
  const double links = 4.0 * (space.inputs + 1.0) * space.outputs;
  const double elite_bytes = 160.0 + 13.0 * links + 4.0 * static_cast<double>(space.behaviour_length);
  const double cells = settings.map_elites.cell_count();
  if (const double needed = cells * (elite_bytes + 8.0); needed > memory_bytes)
    fail_setting({"search.map_elites.descriptors", "search.map_elites.cells"},
                 "search.map_elites: {} cells could need {:.1f} GB, this process may use {:.1f} GB: expected "
                 "fewer cells",
                 settings.map_elites.cell_count(), needed / 1e9, memory_bytes / 1e9);
}

}  // namespace amble::search
