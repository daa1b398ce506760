#include "amble/search/map_elites.hpp"

#include <algorithm>
#include <cmath>
#include <span>
#include <utility>

#include "amble/core/check.hpp"
#include "amble/core/error.hpp"
#include "amble/core/index.hpp"
#include "amble/neat/crossover.hpp"
#include "amble/neat/genome_io.hpp"
#include "amble/neat/initial_genome.hpp"
#include "amble/neat/mutation.hpp"
#include "amble/search/line.hpp"

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

std::vector<double> turns_of(const MapElitesSettings& settings, std::span<const Circle> circles) {
  std::vector<double> turns;
  for (std::size_t i = 0; i < circles.size(); ++i) {
    const DescriptorSettings& range = settings.descriptors[i];
    turns.push_back(circles[i].turn / (range.most - range.least));
  }
  return turns;
}

MapElites::MapElites(const MapElitesSettings& settings, const SearchSpace& space)
    : settings_(settings),
      neat_(space.neat),
      inputs_(space.inputs),
      outputs_(space.outputs),
      recurrent_(space.recurrent),
      seed_(space.seed),
      circles_(space.circles),
      cells_(make_cells(settings, space.circles)),
      map_(cells_->count(), settings.descriptors.size(), settings.tries_candidates_again()),
      curiosity_(settings.select == Selection::curiosity ? cells_->count() : 0),
      before_(space.inputs, space.outputs, space.neat.innovations),
      innovations_(before_) {
  circles_.resize(settings.descriptors.size());
  if (settings.variation == Variation::cma) emitters_.emplace(settings, space, cells_->count());
  if (settings.select == Selection::dominated)
    pool_.emplace(to_index(settings.pool.size), to_index(settings.pool.neighbours),
                  turns_of(settings, circles_));
  breed();
}

// Candidates of a round depend on the map, the numbers given so far and the round alone.
void MapElites::breed() {
  innovations_ = before_;
  candidates_.clear();
  origins_.clear();
  if (emitters_) return add_samples();
  const int batch = settings_.batch;
  const bool begins = std::int64_t{round_} * batch < settings_.initial;
  // After the first rounds only for a map that is empty, with the numbers that links had in those.
  const bool random = begins || elites().size() + challengers_.size() == 0;
  neat::Innovations first(inputs_, outputs_, neat_.innovations);
  if (!random) {
    innovations_.begin_generation();
    const std::size_t free = to_index(batch) - challengers_.size();
    const std::size_t again = std::min(free, settings_.reevaluations(elites().size()));
    for (const std::uint32_t cell : elites().least_evaluated(again)) add_elite_again(cell);
  }
  for (const Challenger& challenger : challengers_) {
    candidates_.push_back(neat::expand(challenger.elite.genome, "the map"));
    origins_.push_back({Origin::Kind::challenger, challenger.parent});
  }
  while (candidates_.size() < to_index(batch)) {
    const auto index = static_cast<std::uint32_t>(candidates_.size());
    Stream stream(seed_, random ? Purpose::initial_genome : Purpose::map_elites,
                  static_cast<std::uint32_t>(round_), index);
    if (!random) {
      add_child(stream);
      continue;
    }
    candidates_.push_back(
        neat::initial_genome(neat_.genome, inputs_, outputs_, begins ? innovations_ : first, stream));
    origins_.emplace_back();
  }
}

/// Elites again, as many as there are of their share of the batch, and the emitters' samples.
void MapElites::add_samples() {
  for (const std::uint32_t cell : elites().least_evaluated(settings_.reevaluations(elites().size())))
    add_elite_again(cell);
  for (neat::Genome& sample : emitters_->candidates(round_)) candidates_.push_back(std::move(sample));
  origins_.resize(candidates_.size());
}

void MapElites::add_elite_again(std::uint32_t cell) {
  const std::uint32_t number = elites().in(cell);
  const Elite& elite = elites()[number];
  candidates_.push_back(neat::expand(elite.genome, "the map"));
  origins_.push_back({Origin::Kind::again, {cell, elite.round, elite.candidate}});
}

void MapElites::add_child(Stream& stream) {
  const Parent parent = draw(stream);
  origins_.push_back({Origin::Kind::child, parent.elite});
  if (settings_.variation == Variation::line) {
    candidates_.push_back(moved_along_line(expanded(parent), expanded(draw(stream)), settings_.line, stream));
    return;
  }
  if (stream.chance(settings_.crossover_probability)) {
    const Parent mate = draw(stream);
    const bool mate_is_fitter = mate.objective > parent.objective;
    candidates_.push_back(neat::crossover(expanded(mate_is_fitter ? mate : parent),
                                          expanded(mate_is_fitter ? parent : mate), neat_.crossover,
                                          recurrent_, stream));
    if (!neat_.crossover.mutate_child && mate.genome != parent.genome) return;
  } else {
    candidates_.push_back(expanded(parent));
  }
  neat::mutate(candidates_.back(), neat_, recurrent_, innovations_, stream);
}

/// Any elite or challenger, or of two of them that which is worth more.
MapElites::Parent MapElites::draw(Stream& stream) const {
  if (pool_) {
    const PoolMember& member =
        pool_->members()[stream.below(static_cast<std::uint32_t>(pool_->members().size()))];
    return {&member.genome, member.objective, {}};
  }
  const auto count = elites().size() + static_cast<std::uint32_t>(challengers_.size());
  const Parent one = parent(stream.below(count));
  if (settings_.select == Selection::uniform) return one;
  const Parent other = parent(stream.below(count));
  const auto worth = [this](const Parent& it) {
    if (settings_.select == Selection::objective) return it.objective;
    return it.elite.cell == Elites::none ? 0.0 : double{curiosity_[it.elite.cell]};
  };
  return worth(other) > worth(one) ? other : one;
}

MapElites::Parent MapElites::parent(std::uint32_t number) const {
  if (number < elites().size()) {
    const Elite& elite = elites()[number];
    return {&elite.genome, elite.objective, {elite.cell, elite.round, elite.candidate}};
  }
  const Elite& challenger = challengers_[number - elites().size()].elite;
  return {&challenger.genome, challenger.objective, {}};
}

neat::Genome MapElites::expanded(const Parent& parent) {
  return neat::expand(*parent.genome, "the map");
}

bool MapElites::is_there(const EliteName& elite) const {
  if (elite.cell == Elites::none) return false;
  const std::uint32_t number = elites().in(elite.cell);
  if (number == Elites::none) return false;
  const Elite& there = elites()[number];
  return there.round == elite.round && there.candidate == elite.candidate;
}

/// Whether its cell is empty, or the elite there is not as good by their means.
bool MapElites::would_enter(const Elite& elite) const {
  const std::uint32_t there = elites().in(elite.cell);
  return there == Elites::none || elite.objective > elites()[there].objective;
}

/// Whether the elite of its cell, if there is one, gives way to it.
bool MapElites::prevails(const Elite& elite, std::span<const float> descriptor) const {
  const std::uint32_t there = elites().in(elite.cell);
  if (there == Elites::none || !settings_.tries_candidates_again()) return would_enter(elite);
  return worth(*cells_, elite, descriptor) > worth(*cells_, elites()[there], elites().descriptor(there));
}

void MapElites::tell(std::span<const Evaluation> evaluations) {
  AMBLE_CHECK(evaluations.size() == candidates_.size(), "one evaluation per candidate");
  counts_ = {};
  std::vector<Challenger> challengers = std::exchange(challengers_, {});
  auto challenger = challengers.begin();
  for (std::size_t i = 0; i < evaluations.size(); ++i) {
    if (origins_[i].kind == Origin::Kind::again)
      reevaluate(origins_[i].elite, evaluations[i]);
    else if (origins_[i].kind == Origin::Kind::challenger)
      take_challenger(std::move(*challenger++), evaluations[i]);
    else
      take_child(static_cast<std::uint32_t>(i), evaluations[i]);
  }
  if (emitters_) tell_emitters(evaluations);
  if (pool_) fill_pool(evaluations);
  Selected selected =
      most_promising(std::move(challengers_), settings_.most_challengers(), *cells_, elites());
  challengers_ = std::move(selected.promising);
  for (const EliteName& parent : selected.parents_of_dropped) credit_parent(parent, false);
  ++round_;
  before_ = innovations_;
  breed();
}

/// Their samples are the last candidates of the round.
void MapElites::tell_emitters(std::span<const Evaluation> evaluations) {
  const std::size_t samples = to_index(settings_.cma.emitters) * to_index(settings_.candidates_per_emitter());
  const auto of_samples = evaluations.last(samples);
  std::vector<std::uint32_t> cells;
  for (const Evaluation& evaluation : of_samples)
    cells.push_back(evaluation.viable ? cells_->of(evaluation.behaviour) : 0);
  emitters_->tell(std::span(candidates_).last(samples), of_samples, cells, elites(), round_);
}

/// New genomes alone: those that are tried again are in it, if they are worth it, by their first evaluation.
void MapElites::fill_pool(std::span<const Evaluation> evaluations) {
  std::vector<PoolMember> members;
  for (std::size_t i = 0; i < evaluations.size(); ++i) {
    if (origins_[i].kind != Origin::Kind::child || !evaluations[i].viable) continue;
    PoolMember& member = members.emplace_back();
    member.genome = neat::compact(candidates_[i]);
    member.objective = evaluations[i].objective;
    for (std::size_t d = 0; d < settings_.descriptors.size(); ++d) {
      const DescriptorSettings& range = settings_.descriptors[d];
      member.descriptor.push_back((double{evaluations[i].behaviour[d]} - range.least) /
                                  (range.most - range.least));
    }
  }
  pool_->add(std::move(members));
}

void MapElites::take_child(std::uint32_t candidate, const Evaluation& evaluation) {
  const EliteName& parent = origins_[candidate].elite;
  if (!evaluation.viable) return credit_parent(parent, false);
  Elite elite{.cell = cells_->of(evaluation.behaviour),
              .round = static_cast<std::uint32_t>(round_),
              .candidate = candidate,
              .evaluations = 1,
              .objective = evaluation.objective,
              .genome = {}};
  if (!would_enter(elite)) return credit_parent(parent, false);
  elite.genome = neat::compact(candidates_[candidate]);
  decide({std::move(elite), {evaluation.behaviour.begin(), evaluation.behaviour.end()}, parent});
}

void MapElites::take_challenger(Challenger challenger, const Evaluation& evaluation) {
  ++counts_.reevaluated;
  if (!evaluation.viable) return credit_parent(challenger.parent, false);
  add_evaluation(challenger.elite, challenger.descriptor, evaluation);
  challenger.elite.cell = cells_->of(challenger.descriptor);
  decide(std::move(challenger));
}

/// Whether a candidate enters the map, is tried once more, or is dropped.
void MapElites::decide(Challenger challenger) {
  Elite& elite = challenger.elite;
  if (!would_enter(elite)) return credit_parent(challenger.parent, false);
  const bool is_tried = elite.evaluations >= static_cast<std::uint32_t>(settings_.trials);
  if (!is_tried || !prevails(elite, challenger.descriptor)) {
    if (elite.evaluations < most_evaluations(elite.cell))
      challengers_.push_back(std::move(challenger));
    else
      credit_parent(challenger.parent, false);
    return;
  }
  ++(elites().in(elite.cell) == Elites::none ? counts_.entered : counts_.improved);
  if (!curiosity_.empty()) curiosity_[elite.cell] = 0.0f;
  map_.put(std::move(elite), challenger.descriptor);
  credit_parent(challenger.parent, true);
}

/// A candidate that has been tried so often and does not prevail over the elite of the cell is dropped: as
/// often as that elite, but no more than four times the least.
std::uint32_t MapElites::most_evaluations(std::uint32_t cell) const {
  constexpr std::uint32_t most_times = 4;
  const auto trials = static_cast<std::uint32_t>(settings_.trials);
  const std::uint32_t there = elites().in(cell);
  if (there == Elites::none) return trials;
  return std::clamp(elites()[there].evaluations, trials, most_times * trials);
}

/// One more evaluation in the means of an elite. The spread by Welford's formula.
void MapElites::add_evaluation(Elite& elite, std::vector<float>& descriptor,
                               const Evaluation& evaluation) const {
  const double before = elite.evaluations, after = ++elite.evaluations;
  elite.objective = mean_with(elite.objective, evaluation.objective, elite.evaluations);
  double squares = 0.0;
  for (std::size_t i = 0; i < descriptor.size(); ++i) {
    const DescriptorSettings& dimension = settings_.descriptors[i];
    const double mean = double{descriptor[i]},
                 value = circles_[i].nearest(double{evaluation.behaviour[i]}, mean);
    const double difference = (value - mean) / (dimension.most - dimension.least);
    squares += difference * difference;
    descriptor[i] = static_cast<float>(circles_[i].inside(mean_with(mean, value, elite.evaluations)));
  }
  elite.spread += squares * before / after / static_cast<double>(descriptor.size());
}

/// One more evaluation of an elite, unless another took its cell in this round.
void MapElites::reevaluate(const EliteName& name, const Evaluation& evaluation) {
  if (!is_there(name)) return;
  ++counts_.reevaluated;
  const std::uint32_t number = elites().in(name.cell);
  Elite elite = elites()[number];
  if (!evaluation.viable) {
    ++counts_.lost;
    return map_.remove(elite.cell);
  }
  const auto before = elites().descriptor(number);
  std::vector<float> descriptor(before.begin(), before.end());
  add_evaluation(elite, descriptor, evaluation);
  const std::uint32_t cell = cells_->of(descriptor);
  if (cell == elite.cell) return map_.update(elite, descriptor);

  map_.remove(std::exchange(elite.cell, cell));
  if (!prevails(elite, descriptor)) {
    ++counts_.lost;
    return;
  }
  ++counts_.moved;
  if (!curiosity_.empty()) curiosity_[cell] = curiosity_[name.cell];
  map_.put(std::move(elite), descriptor);
}

void MapElites::credit_parent(const EliteName& parent, bool entered) {
  if (curiosity_.empty() || !is_there(parent)) return;
  float& curiosity = curiosity_[parent.cell];
  curiosity = std::max(0.0f, entered ? curiosity + curiosity_gain : curiosity - curiosity_loss);
}

std::vector<Metric> MapElites::metrics() const {
  const double cells = elites().cells(), filled = elites().size();
  std::vector<Metric> all{{"elites", filled},
                          {"coverage", filled / cells},
                          {"qd_score", elites().objective_sum()},
                          {"map_best", elites().best_objective()},
                          {"entered", static_cast<double>(counts_.entered)},
                          {"improved", static_cast<double>(counts_.improved)},
                          {"reevaluated", static_cast<double>(counts_.reevaluated)},
                          {"moved", static_cast<double>(counts_.moved)},
                          {"lost", static_cast<double>(counts_.lost)}};
  if (emitters_) all.push_back({"cma_restarts", static_cast<double>(emitters_->restarts())});
  return all;
}

void MapElites::save(io::BinaryWriter& writer) const {
  writer.put(static_cast<std::int32_t>(round_));
  map_.save(writer);
  before_.save(writer);
  std::vector<float> curiosity;
  for (std::uint32_t number = 0; number < elites().size() && !curiosity_.empty(); ++number)
    curiosity.push_back(curiosity_[elites()[number].cell]);
  writer.put_span(std::span<const float>(curiosity));
  if (settings_.tries_candidates_again()) save_challengers(challengers_, writer);
  if (emitters_) emitters_->save(writer);
  if (pool_) pool_->save(writer);
}

void MapElites::load(io::BinaryReader& reader) {
  round_ = reader.get<std::int32_t>();
  if (round_ < 0) reader.bad("a negative round");
  map_ = LoggedElites(cells_->count(), settings_.descriptors.size(), settings_.tries_candidates_again());
  map_.load(reader);
  before_.load(reader);
  loaded_curiosity_ = reader.get_vector<float>();
  for (const float curiosity : loaded_curiosity_)
    if (!(curiosity >= 0.0f && std::isfinite(curiosity))) reader.bad("a curiosity below 0");
  challengers_.clear();
  if (settings_.tries_candidates_again())
    challengers_ =
        load_challengers(reader, settings_.most_challengers(), cells_->count(), settings_.descriptors.size());
  if (emitters_) emitters_->load(reader);
  if (!pool_) return;
  pool_->load(reader, settings_.descriptors.size());
  for (const PoolMember& member : pool_->members())
    neat::validate(neat::expand(member.genome, "the pool"), inputs_, outputs_, recurrent_);
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

}  // namespace amble::search
