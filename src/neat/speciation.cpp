#include "amble/neat/speciation.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "amble/core/check.hpp"
#include "amble/core/index.hpp"
#include "amble/neat/distance.hpp"
#include "amble/neat/genome_binary.hpp"

namespace amble::neat {

Speciation::Speciation(const SpeciationSettings& settings)
    : settings_(settings), threshold_(settings.initial_threshold) {}

int Speciation::Grouping::occupied() const {
  return static_cast<int>(std::ranges::count_if(members, [](const auto& group) { return !group.empty(); }));
}

Speciation::Grouping Speciation::group(std::span<const Genome> genomes) const {
  std::vector<const Genome*> representatives;
  for (const Species& species : species_) representatives.push_back(&species.representative);
  Grouping grouping{std::vector<std::vector<int>>(species_.size())};
  for (std::size_t i = 0; i < genomes.size(); ++i) {
    const auto close = [&](const Genome* representative) {
      return compatibility_distance(*representative, genomes[i], settings_.distance) < threshold_.value();
    };
    const auto found = std::ranges::find_if(representatives, close);
    const auto index = to_index(found - representatives.begin());
    if (found == representatives.end()) {
      representatives.push_back(&genomes[i]);
      grouping.members.emplace_back();
    }
    grouping.members[index].push_back(static_cast<int>(i));
  }
  return grouping;
}

void Speciation::assign(std::span<const Genome> genomes) {
  Grouping grouping = group(genomes);
  for (int corrections = 0; corrections < settings_.corrections_per_generation; ++corrections) {
    if (!threshold_.steer(grouping.occupied(), settings_)) break;
    grouping = group(genomes);
  }

  std::vector<Species> next;
  for (std::size_t i = 0; i < grouping.members.size(); ++i) {
    std::vector<int>& members = grouping.members[i];
    if (members.empty()) continue;
    if (i < species_.size()) {
      next.push_back(std::move(species_[i]));
      ++next.back().age;
    } else {
      next.push_back({.id = next_id_++, .representative = genomes[to_index(members.front())], .members = {}});
    }
    next.back().members = std::move(members);
  }
  species_ = std::move(next);
}

void Speciation::record(std::span<const Genome> genomes, std::span<const Fitness> fitness) {
  AMBLE_CHECK(genomes.size() == fitness.size(), "one fitness per genome");
  const auto objective = [&](int i) { return fitness[to_index(i)].objective; };
  for (Species& species : species_) {
    std::ranges::sort(species.members, [&](int a, int b) {
      return objective(a) != objective(b) ? objective(a) > objective(b) : a < b;
    });
    const int best = species.members.front();
    species.representative = genomes[to_index(best)];
    if (objective(best) > species.best_objective) {
      species.best_objective = objective(best);
      species.generations_without_improvement = 0;
    } else {
      ++species.generations_without_improvement;
    }
  }
}

void Speciation::save(io::BinaryWriter& writer) const {
  threshold_.save(writer);
  writer.put(next_id_);
  writer.put(static_cast<std::uint64_t>(species_.size()));
  for (const Species& species : species_) {
    writer.put(species.id);
    neat::save(species.representative, writer);
    writer.put_span(std::span<const int>(species.members));
    writer.put(species.age);
    writer.put(species.generations_without_improvement);
    writer.put(species.best_objective);
  }
}

void Speciation::load(io::BinaryReader& reader, std::size_t genomes) {
  constexpr std::size_t least_species_bytes = 4 + 16 + 8 + 4 + 4 + 8;
  threshold_.load(reader);
  next_id_ = reader.get<std::uint32_t>();
  species_.assign(reader.get_count(least_species_bytes), {});
  std::vector<bool> placed(genomes);
  std::size_t members = 0;
  for (Species& species : species_) {
    species.id = reader.get<std::uint32_t>();
    species.representative = load_genome(reader);
    species.members = reader.get_vector<int>();
    species.age = reader.get<int>();
    species.generations_without_improvement = reader.get<int>();
    species.best_objective = reader.get<double>();
    if (species.id >= next_id_ || species.members.empty() || species.age < 0 ||
        species.generations_without_improvement < 0 || std::isnan(species.best_objective))
      reader.bad("a species that cannot be");
    for (const int member : species.members) {
      const auto i = to_index(member);
      if (member < 0 || i >= genomes || placed[i]) reader.bad("a genome of no species or of two");
      placed[i] = true;
      ++members;
    }
  }
  if (members != genomes) reader.bad("a genome of no species or of two");
}

}  // namespace amble::neat
