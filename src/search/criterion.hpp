#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "amble/io/binary.hpp"
#include "amble/neat/fitness.hpp"
#include "amble/search/evaluation.hpp"
#include "amble/search/metric.hpp"

namespace amble::io {
class InputFile;
}

namespace amble::search {

/// Selection criterion of generational NEAT: turns the evaluations of a generation into fitness. Not thread
/// safe. save() and load() cover all state but an archive, which has an append-only file of its own.
class Criterion {
 public:
  virtual ~Criterion() = default;

  /// Fitness of each genome of a generation, in order.
  virtual std::vector<neat::Fitness> fitness_of(std::span<const Evaluation> generation) = 0;
  virtual void save(io::BinaryWriter& writer) const = 0;
  virtual void load(io::BinaryReader& reader) = 0;

  /// Whether there is an archive to be kept in a file; if not, the next two are never called.
  virtual bool has_archive() const { return false; }
  /// Bytes to append to that file since the last call. To be called before save().
  virtual std::string take_archive_growth() { return {}; }
  /// After load(): reads the archive back; returns its length in the file, bytes. Throws UserError(bad_file)
  /// "WHAT: …".
  virtual std::uint64_t restore_archive(io::InputFile& /*file*/, const std::string& /*what*/) { return 0; }

  /// Statistics of the generation judged last; the same names in every generation, also before the first.
  virtual std::vector<Metric> metrics() const { return {}; }
};

}  // namespace amble::search
