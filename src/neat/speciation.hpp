#pragma once

#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "amble/io/binary.hpp"
#include "amble/neat/fitness.hpp"
#include "amble/neat/genome.hpp"
#include "amble/neat/settings.hpp"

namespace amble::neat {

/// The compatibility threshold, steered so that the number of species comes to the target range
/// (HyperSharpNEAT's rule, in which the authors' code raised the first step up): the first step out of the
/// range is the larger of 0.1 and SpeciationSettings::first_step_down or first_step_up × the threshold; each
/// further step on the same side is 1.05 times the last; after stepping over the range it turns round and is
/// half as long. The threshold stays at or above 0.01.
class Threshold {
 public:
  static constexpr double lowest = 0.01;

  explicit Threshold(double initial) : value_(initial) {}

  double value() const { return value_; }
  /// Takes one step if `species` is out of the range target_min … target_max. Returns whether the value
  /// changed.
  bool steer(int species, const SpeciationSettings& settings);

  void save(io::BinaryWriter& writer) const;
  /// Throws UserError(ExitCode::bad_file).
  void load(io::BinaryReader& reader);

 private:
  double value_;
  double step_ = 0.0;  ///< the last one; 0 while in the range, or at the lowest value
};

/// The compatibility distance of Stanley & Miikkulainen 2002, eq. 1: excess · E + disjoint · D + weight · W.
/// E counts the links of one genome that are newer than all of the other's, D the other links that only one
/// has; W is the sum of |weight difference| over the links of both. If settings.normalised, E and D are
/// divided by the larger genome's number of links and W by the number of links of both. Disabled links count
/// like others. Symmetric, ≥ 0.
double compatibility_distance(const Genome& a, const Genome& b, const DistanceSettings& settings);

struct Species {
  std::uint32_t id = 0;      ///< never used again once the species is extinct
  Genome representative;     ///< the best by objective of the last generation; of a new species, its founder
  std::vector<int> members;  ///< indices of genomes; best objective first once record() was called
  int age = 0;               ///< generations since it was founded
  int generations_without_improvement = 0;
  double best_objective = -std::numeric_limits<double>::infinity();  ///< over its whole life
};

/// Assigns genomes to species, generation by generation (Stanley & Miikkulainen 2002, sec. 3.3).
///
/// Each genome joins the first species, oldest first, whose representative is closer than the threshold, or
/// founds a new one. Then the threshold is adjusted towards the target number of species and all genomes are
/// assigned anew, at most corrections_per_generation times. A species without members is extinct.
///
/// Improvement is measured by the objective, because it can be compared between generations, which novelty
/// cannot.
class Speciation {
 public:
  explicit Speciation(const SpeciationSettings& settings);

  /// Assigns the genomes of a new generation to species.
  void assign(std::span<const Genome> genomes);
  /// Records the fitness of the generation: sorts members by objective (equal ones by index), makes the best
  /// the representative, and updates best_objective and generations_without_improvement.
  void record(std::span<const Genome> genomes, std::span<const Fitness> fitness);

  const std::vector<Species>& species() const { return species_; }
  double threshold() const { return threshold_.value(); }

  void save(io::BinaryWriter& writer) const;
  /// Replaces the state by what save() wrote. Throws UserError(ExitCode::bad_file), also unless each of
  /// `genomes` genomes is a member of exactly one species. The caller checks whether the representatives are
  /// valid genomes.
  void load(io::BinaryReader& reader, std::size_t genomes);

 private:
  /// A partition of the genomes: the groups of `species_` first, some perhaps empty, then new ones.
  struct Grouping {
    std::vector<std::vector<int>> members;
    int occupied() const;
  };
  Grouping group(std::span<const Genome> genomes) const;

  SpeciationSettings settings_;
  Threshold threshold_;
  std::vector<Species> species_;
  std::uint32_t next_id_ = 0;
};

}  // namespace amble::neat
