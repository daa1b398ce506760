#pragma once

#include <array>
#include <memory>
#include <span>
#include <string_view>
#include <vector>

#include "amble/io/binary.hpp"
#include "amble/io/settings.hpp"
#include "amble/neat/population.hpp"

namespace amble::search {

enum class Kind { objective };
inline constexpr std::array<std::string_view, 1> kind_names{"objective"};

struct Settings {
  Kind kind = Kind::objective;
  void describe(io::SettingsVisitor& visitor);
};

/// What became of one genome, in the search's terms: how good it was, and what it did. Of what kind is not
/// its business.
struct Evaluation {
  double objective = 0.0;            ///< ≥ 0, finite; more is better
  std::span<const float> behaviour;  ///< same length for all; may be empty for searches that do not need it
};

/// Turns evaluations into the fitness that selects parents. Belongs to one thread; all state is in save() and
/// load().
class Search {
 public:
  virtual ~Search() = default;

  /// Fitness of each genome of a generation, in order.
  virtual std::vector<neat::Fitness> judge(std::span<const Evaluation> generation) = 0;
  virtual void save(io::BinaryWriter& writer) const = 0;
  virtual void load(io::BinaryReader& reader) = 0;
};

std::unique_ptr<Search> make_search(const Settings& settings);

}  // namespace amble::search
