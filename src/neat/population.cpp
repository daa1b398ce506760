#include "amble/neat/population.hpp"

#include <cmath>
#include <map>
#include <utility>

#include "amble/core/check.hpp"
#include "amble/core/error.hpp"
#include "amble/core/index.hpp"
#include "amble/core/random.hpp"
#include "amble/neat/genome_io.hpp"
#include "amble/neat/initial_genome.hpp"
#include "amble/neat/innovations.hpp"
#include "amble/neat/reproduction.hpp"
#include "amble/neat/speciation.hpp"

namespace amble::neat {

struct Population::State {
  State(const Settings& s, int input_count, int output_count, bool may_recur, std::uint64_t run_seed)
      : settings(s),
        inputs(input_count),
        outputs(output_count),
        recurrent(may_recur),
        seed(run_seed),
        innovations(input_count, output_count, s.innovations),
        speciation(s.speciation) {}

  /// Inputs of the constructor. save() writes them so that load() can refuse the state of another run.
  Settings settings;
  int inputs, outputs;
  bool recurrent;
  std::uint64_t seed;

  int generation = 0;
  std::vector<Genome> genomes;
  Innovations innovations;
  Speciation speciation;

  void read(io::BinaryReader& reader);
  void check_loaded() const;
};

Population::Population(const Settings& settings, int inputs, int outputs, bool recurrent,
                       std::uint64_t seed) {
  AMBLE_CHECK(inputs >= 0 && outputs > 0, "a genome has outputs");
  settings.validate();
  state_ = std::make_unique<State>(settings, inputs, outputs, recurrent, seed);
  for (int i = 0; i < settings.population.size; ++i) {
    Stream stream(seed, Purpose::initial_genome, 0, static_cast<std::uint32_t>(i));
    state_->genomes.push_back(initial_genome(settings.genome, inputs, outputs, state_->innovations, stream));
  }
  state_->speciation.assign(state_->genomes);
}

Population::~Population() = default;
Population::Population(Population&&) noexcept = default;
Population& Population::operator=(Population&&) noexcept = default;

int Population::generation() const {
  return state_->generation;
}

std::span<const Genome> Population::genomes() const {
  return state_->genomes;
}

PopulationStatistics Population::statistics() const {
  int hidden = 0, links = 0;
  for (const Genome& genome : state_->genomes) {
    hidden += genome.count(NodeKind::hidden);
    links += genome.enabled_links();
  }
  const auto size = static_cast<double>(state_->genomes.size());
  return {.species = static_cast<int>(state_->speciation.species().size()),
          .compatibility_threshold = state_->speciation.threshold(),
          .mean_hidden = hidden / size,
          .mean_links = links / size};
}

std::vector<SpeciesStatistics> Population::species() const {
  std::vector<SpeciesStatistics> statistics;
  for (const Species& species : state_->speciation.species())
    statistics.push_back({.id = species.id,
                          .size = static_cast<int>(species.members.size()),
                          .age = species.age,
                          .generations_without_improvement = species.generations_without_improvement});
  return statistics;
}

void Population::advance(std::span<const Fitness> fitness) {
  AMBLE_CHECK(fitness.size() == state_->genomes.size(), "one fitness per genome");
  for (const Fitness& f : fitness)
    AMBLE_CHECK(std::isfinite(f.selection) && f.selection >= 0.0 && std::isfinite(f.objective),
                "fitness is finite and selection not negative");
  State& state = *state_;
  state.speciation.record(state.genomes, fitness);
  std::vector<Genome> children = reproduce(
      {.genomes = state.genomes, .fitness = fitness, .species = state.speciation.species()}, state.settings,
      state.recurrent, state.innovations, state.seed, static_cast<std::uint32_t>(state.generation + 1));
  state.genomes = std::move(children);
  ++state.generation;
  state.speciation.assign(state.genomes);
}

void Population::save(io::BinaryWriter& writer) const {
  const State& state = *state_;
  writer.put(state.inputs);
  writer.put(state.outputs);
  writer.put(static_cast<std::uint8_t>(state.recurrent));
  writer.put(state.seed);
  writer.put(state.generation);
  neat::save(state.genomes, writer);
  state.innovations.save(writer);
  state.speciation.save(writer);
}

void Population::load(io::BinaryReader& reader) {
  auto loaded = std::make_unique<State>(state_->settings, state_->inputs, state_->outputs, state_->recurrent,
                                        state_->seed);
  loaded->read(reader);
  try {
    loaded->check_loaded();
  } catch (const UserError& error) {
    reader.bad(error.what());
  }
  state_ = std::move(loaded);
}

void Population::State::read(io::BinaryReader& reader) {
  if (reader.get<int>() != inputs || reader.get<int>() != outputs)
    reader.bad("other numbers of inputs and outputs");
  if (reader.get<std::uint8_t>() != static_cast<std::uint8_t>(recurrent))
    reader.bad("another answer to whether networks are recurrent");
  if (reader.get<std::uint64_t>() != seed) reader.bad("another seed");
  generation = reader.get<int>();
  if (generation < 0) reader.bad("a negative generation");
  genomes = load_genomes(reader);
  if (genomes.size() != to_index(settings.population.size)) reader.bad("another population size");
  innovations.load(reader);
  speciation.load(reader, genomes.size());
}

/// Throws UserError unless all genomes are valid and have the numbers of this run.
void Population::State::check_loaded() const {
  const auto check = [&](const Genome& genome) {
    validate(genome, inputs, outputs, recurrent);
    if (!innovations.knows(genome)) fail(ExitCode::bad_file, "genome: a number that the run did not give");
  };
  // The list of innovations may be younger than the genomes: their numbers must agree with each other, too.
  std::map<std::uint32_t, std::pair<std::uint32_t, std::uint32_t>> ends_of;
  const auto check_all = [&](const Genome& genome) {
    check(genome);
    for (const LinkGene& link : genome.links) {
      const std::pair ends{link.from, link.to};
      if (ends_of.try_emplace(link.innovation, ends).first->second != ends)
        fail(ExitCode::bad_file, "genome: innovation {} joins other nodes in another genome",
             link.innovation);
    }
  };
  for (const Genome& genome : genomes) check_all(genome);
  for (const Species& species : speciation.species()) check_all(species.representative);
}

}  // namespace amble::neat
