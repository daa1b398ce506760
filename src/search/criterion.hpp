#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "amble/io/binary.hpp"
#include "amble/neat/fitness.hpp"
#include "amble/search/evaluation.hpp"

namespace amble::io {
class InputFile;
}

namespace amble::search {

/// Selection criterion of generational NEAT: turns the evaluations of a generation into fitness. Not thread
/// safe. save() and load() cover all state but an archive, which has an append-only file of its own.
///
/// GenerationalSearch makes a search of it. What it gives depends on its settings and the evaluations so far
/// alone, to the bit.
class Criterion {
 public:
  virtual ~Criterion() = default;

  /// Fitness of each genome of a generation, in order, within the limits of neat::Fitness. Called once for
  /// each generation, in order; advances the state.
  virtual std::vector<neat::Fitness> fitness_of(std::span<const Evaluation> generation) = 0;
  /// The state between two generations, for checkpoints.
  virtual void save(io::BinaryWriter& writer) const = 0;
  /// Replaces the state by what save() wrote under the same settings; throws UserError(ExitCode::bad_file) if
  /// it does not fit.
  virtual void load(io::BinaryReader& reader) = 0;

  /// Whether there is an archive to be kept in a file, always or never; if not, the next two are never
  /// called.
  virtual bool has_archive() const { return false; }
  /// Bytes to append to that file since the last call. To be called before save().
  virtual std::string take_archive_growth() { return {}; }
  /// After load(): reads the archive back; returns its length in the file, bytes, after which the file may
  /// have what a later generation wrote. Throws UserError(ExitCode::bad_file) "WHAT: …".
  virtual std::uint64_t restore_archive(io::InputFile& /*file*/, const std::string& /*what*/) { return 0; }

  /// Statistics of the generation judged last: columns of generations.csv. The same names in the same order
  /// in every generation, also before the first.
  virtual std::vector<Metric> metrics() const { return {}; }
};

}  // namespace amble::search
