#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "amble/io/binary.hpp"
#include "amble/io/file.hpp"
#include "amble/neat/genome.hpp"
#include "amble/search/evaluation.hpp"
#include "amble/search/reading.hpp"

namespace amble::search {

/// A search over genomes, round by round: ask() for candidates, evaluate them by whatever means, tell() what
/// came of them. A round is a generation for generational searches, a batch for steady-state ones and for
/// those that keep an archive; rounds may differ in size.
///
/// Belongs to one thread. What it does depends on its settings, its seed and the evaluations alone, to the
/// bit. All state is in save() and load(), but for logs: files that only grow, for what would make every
/// checkpoint large (archives).
class Strategy {
 public:
  virtual ~Strategy() = default;

  /// Rounds told so far, and so the number of the present round, from 0.
  virtual int round() const = 0;
  /// The candidates of the present round, at least one; the same until tell(), which ends their life.
  virtual std::span<const neat::Genome> ask() const = 0;
  /// The evaluations of all candidates, in the order of ask(); goes on to the next round.
  virtual void tell(std::span<const Evaluation> evaluations) = 0;

  /// What there is to say of the round told last: columns of generations.csv. The same names in the same
  /// order at any time.
  virtual std::vector<Reading> readings() const = 0;

  virtual void save(io::BinaryWriter& writer) const = 0;
  /// Replaces the state by what save() wrote under the same settings. Throws UserError(bad_file) if it does
  /// not fit. To be followed by restore_log() for each log.
  virtual void load(io::BinaryReader& reader) = 0;

  /// File names of the logs, in the run folder: "archive….bin".
  virtual std::vector<std::string> logs() const { return {}; }
  /// Bytes to append to log `i` since the last call. To be called before save().
  virtual std::string take_log_growth(std::size_t i);
  /// After load(): reads log `i` back; returns how many bytes of the file belong to it. Throws
  /// UserError(bad_file) "WHAT: …".
  virtual std::uint64_t restore_log(std::size_t i, io::InputFile& file, const std::string& what);
};

}  // namespace amble::search
