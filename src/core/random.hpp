#pragma once

#include <array>
#include <cstdint>

namespace amble {

/// The purpose of a random stream. Part of its key, so that a new use of randomness never shifts an old one.
/// Values are part of the reproducibility promise: add at the end, never renumber. Those from 1000 on are for
/// extensions outside amble: static_cast<Purpose>(1000).
enum class Purpose : std::uint32_t {
  test = 0,              ///< for tests alone
  initial_genome = 1,    ///< genomes without parents
  reproduction = 2,      ///< parents, crossover and mutation of NEAT
  speciation = 3,        ///< reserved: speciation draws nothing
  trial_noise = 4,       ///< all that a trial::Scenario has
  bootstrap = 5,         ///< resampling for confidence intervals
  ground = 6,            ///< heights of uneven ground
  centroids = 7,         ///< cells of a map that are spread evenly
  map_elites = 8,        ///< parents and children of MAP-Elites
  mutants = 9,           ///< mutants that only measure evolvability
  random_triggers = 10,  ///< triggers of SUPGs by chance
  cma_es = 11,           ///< samples of CMA-ES
  cma_emitters = 12,     ///< samples of the emitters of a map, and where they begin
};

/// A stream of random numbers that depends on its key alone, (seed, purpose, generation, individual), and so
/// on neither thread nor order of work. Philox4x32-10 (Salmon et al., SC 2011) in counter mode: 2^34 32-bit
/// numbers per stream. The transforms to distributions are amble's own (core/elementary.hpp): those of the
/// standard library differ between implementations.
class Stream {
 public:
  /// Streams of different keys are independent. `generation` and `individual` are any numbers that tell
  /// streams of one purpose apart.
  Stream(std::uint64_t seed, Purpose purpose, std::uint32_t generation = 0, std::uint32_t individual = 0);

  /// Uniform over all 2^32 values. After 2^34 of them an AMBLE_CHECK fails.
  std::uint32_t next_u32();
  /// Uniform over all 2^64 values: two of next_u32(), the first one above.
  std::uint64_t next_u64();

  /// Uniform in [0, 1), 53 random bits.
  double uniform();
  /// Uniform in [low, high), but for rounding, which may give `high`.
  double uniform(double low, double high);
  /// Uniform in {0, …, count − 1}, without modulo bias. `count` > 0.
  std::uint32_t below(std::uint32_t count);
  /// True with the given probability in [0, 1].
  bool chance(double probability);
  /// Standard normal, by the Box–Muller transform (both of a pair are used).
  double normal();

 private:
  void refill();

  std::array<std::uint32_t, 2> key_;
  std::array<std::uint32_t, 4> counter_;
  std::array<std::uint32_t, 4> block_{};
  int used_ = 4;
  double spare_normal_ = 0.0;
  bool has_spare_normal_ = false;
};

}  // namespace amble
