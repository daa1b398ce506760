#pragma once

#include <array>
#include <cstdint>

namespace amble {

/// The purpose of a random stream. Part of its key, so that a new use of randomness never shifts an old one.
/// Values are part of the reproducibility promise: add at the end, never renumber. Those from 1000 on are for
/// extensions outside amble: static_cast<Purpose>(1000).
enum class Purpose : std::uint32_t {
  test = 0,
  initial_genome = 1,
  reproduction = 2,
  speciation = 3,
  trial_noise = 4,
  bootstrap = 5,
  ground = 6,
  centroids = 7,
  map_elites = 8,
  mutants = 9,
  random_triggers = 10,
  cma_es = 11,
};

/// A stream of random numbers that depends on its key alone, (seed, purpose, generation, individual), and so
/// on neither thread nor order of work. Philox4x32-10 (Salmon et al., SC 2011) in counter mode: 2^34 32-bit
/// numbers per stream. The transforms to distributions are not those of the standard library, which
/// differ between implementations.
class Stream {
 public:
  Stream(std::uint64_t seed, Purpose purpose, std::uint32_t generation = 0, std::uint32_t individual = 0);

  std::uint32_t next_u32();
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
