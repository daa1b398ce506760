#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "amble/io/binary.hpp"
#include "amble/neat/genome.hpp"
#include "amble/search/evaluation.hpp"

namespace amble::io {
class InputFile;
}

namespace amble::search {

/// A search over genomes, round by round: ask() for candidates, evaluate them by any means, tell() the
/// evaluations. A round is a generation for generational searches, a batch for steady-state ones and for
/// those that keep an archive; rounds may differ in size.
///
/// Not thread safe. Its behaviour depends on its settings, its seed and the evaluations alone, to the bit.
/// save() and load() cover all state but logs: append-only files for data that would make every checkpoint
/// large (archives).
///
/// A strategy that breeds genomes itself (neat/mutation.hpp, neat/crossover.hpp) owns the neat::Innovations
/// they share: begin_generation() before each round, and part of save() and load(). Its random numbers come
/// from streams of a Purpose of its own (core/random.hpp), keyed by round and candidate; nothing of them
/// needs saving then.
class Strategy {
 public:
  virtual ~Strategy() = default;

  /// Number of the current round, from 0: the number of completed rounds.
  virtual int round() const = 0;
  /// The candidates of the current round, at least one; valid until tell().
  virtual std::span<const neat::Genome> ask() const = 0;
  /// Takes the evaluations of all candidates, as many as ask() gave and in its order (what else is a
  /// programming error), and advances to the next round.
  virtual void tell(std::span<const Evaluation> evaluations) = 0;

  /// Statistics of the search after the last completed round: columns of generations.csv. The names and their
  /// order never change.
  virtual std::vector<Metric> metrics() const = 0;

  /// All state but the logs, for checkpoints; after take_log_growth() of each log.
  virtual void save(io::BinaryWriter& writer) const = 0;
  /// Replaces the state by what save() wrote under the same settings. Throws UserError(ExitCode::bad_file) if
  /// it does not fit. restore_log() must follow for each log.
  virtual void load(io::BinaryReader& reader) = 0;

  /// File names of the logs, in the run folder: "archive….bin".
  virtual std::vector<std::string> logs() const { return {}; }
  /// Bytes to append to log `i`, its place in logs(), since the last call. To be called before save().
  virtual std::string take_log_growth(std::size_t i);
  /// After load(): reads log `i` back; returns its length in the file, bytes. Throws
  /// UserError(ExitCode::bad_file) "WHAT: …".
  virtual std::uint64_t restore_log(std::size_t i, io::InputFile& file, const std::string& what);
};

}  // namespace amble::search
