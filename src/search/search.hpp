#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "amble/io/binary.hpp"
#include "amble/io/file.hpp"
#include "amble/io/settings.hpp"
#include "amble/neat/population.hpp"
#include "amble/search/novelty_settings.hpp"

namespace amble::search {

enum class Kind { objective, novelty };
inline constexpr std::array<std::string_view, 2> kind_names{"objective", "novelty"};

struct Settings {
  Kind kind = Kind::objective;
  NoveltySettings novelty;
  void describe(io::SettingsVisitor& visitor);
  /// Every how many steps the search wants the path sampled; 0: it wants no behaviour.
  int path_stride() const { return kind == Kind::novelty ? novelty.path_stride : 0; }
};

/// What became of one genome, in the search's terms: how good it was, and what it did. Of what kind is not
/// its business.
struct Evaluation {
  double objective = 0.0;            ///< ≥ 0, finite; more is better
  std::span<const float> behaviour;  ///< same length for all; may be empty for searches that do not need it
};

/// What novelty search made of the generation it judged last.
struct NoveltyStatistics {
  std::size_t archive_members = 0;  ///< after it
  double threshold = 0.0;           ///< that its members had to exceed
  double best_novelty = 0.0;
};

/// Turns evaluations into the fitness that selects parents. Belongs to one thread. All state is in save() and
/// load(), but for an archive, which has a file of its own that only grows.
class Search {
 public:
  virtual ~Search() = default;

  /// Fitness of each genome of a generation, in order.
  virtual std::vector<neat::Fitness> judge(std::span<const Evaluation> generation) = 0;
  virtual void save(io::BinaryWriter& writer) const = 0;
  virtual void load(io::BinaryReader& reader) = 0;

  /// Whether there is an archive to be kept in a file. If not, the next two are never called.
  virtual bool has_archive() const { return false; }
  /// Bytes to append to that file since the last call. To be called before save().
  virtual std::string take_archive_growth() { return {}; }
  /// After load(): reads the archive back; returns how many bytes of the file belong to it. Throws
  /// UserError(bad_file) "WHAT: …".
  virtual std::uint64_t restore_archive(io::InputFile& /*file*/, const std::string& /*what*/) { return 0; }

  /// Nothing for other searches, and before the first generation.
  virtual std::optional<NoveltyStatistics> novelty_statistics() const { return std::nullopt; }
};

/// `behaviour_length`: numbers in each Evaluation::behaviour.
std::unique_ptr<Search> make_search(const Settings& settings, std::size_t behaviour_length);

}  // namespace amble::search
