#include "amble/neat/speciation.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "amble/core/check.hpp"
#include "amble/core/index.hpp"
#include "amble/neat/genome_io.hpp"

namespace amble::neat {

bool Threshold::steer(int species, const SpeciationSettings& settings) {
  if (species >= settings.target_min && species <= settings.target_max) {
    step_ = 0.0;
    return false;
  }
  const bool down = species < settings.target_min;
  const double direction = down ? -1.0 : 1.0;
  if (step_ == 0.0)
    step_ = direction * std::max(0.1, (down ? settings.first_step_down : settings.first_step_up) * value_);
  else
    step_ *= step_ * direction > 0.0 ? 1.05 : -0.5;

  const double old_value = value_;
  value_ = std::max(lowest, value_ + step_);
  if (value_ == lowest) step_ = 0.0;
  return value_ != old_value;
}

void Threshold::save(io::BinaryWriter& writer) const {
  writer.put(value_);
  writer.put(step_);
}

void Threshold::load(io::BinaryReader& reader) {
  value_ = reader.get<double>();
  step_ = reader.get<double>();
  if (!std::isfinite(value_) || value_ < lowest || !std::isfinite(step_))
    reader.bad("a compatibility threshold that cannot be");
}

double compatibility_distance(const Genome& a, const Genome& b, const DistanceSettings& settings) {
  std::ptrdiff_t disjoint = 0, matching = 0;
  double weight_difference = 0.0;
  auto i = a.links.begin(), j = b.links.begin();
  while (i != a.links.end() && j != b.links.end()) {
    if (i->innovation == j->innovation) {
      ++matching;
      weight_difference += std::abs(i++->weight - j++->weight);
    } else {
      ++disjoint;
      i->innovation < j->innovation ? ++i : ++j;
    }
  }
  // One list is exhausted: the rest of the other is newer than all of it (excess).
  const auto excess = (a.links.end() - i) + (b.links.end() - j);

  double genes = 1.0;
  if (settings.normalised) {
    genes = static_cast<double>(std::max<std::size_t>({a.links.size(), b.links.size(), 1}));
    weight_difference /= static_cast<double>(std::max<std::ptrdiff_t>(matching, 1));
  }
  return (settings.excess * static_cast<double>(excess) + settings.disjoint * static_cast<double>(disjoint)) /
             genes +
         settings.weight * weight_difference;
}

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
