#pragma once

#include <span>
#include <string_view>

namespace amble::search {

/// The result of evaluating one candidate: the objective and the behaviour over all of its episodes
/// (trials under different scenarios).
struct Evaluation {
  /// Finite, ≥ 0; higher is better. Of what is not viable "objective" and "novelty" use it, too; "map-elites"
  /// drops such a candidate, "cma-es" ranks it last.
  double objective = 0.0;
  std::span<const float>
      behaviour;       ///< same length for all, valid during tell(); empty if the search needs none
  bool viable = true;  ///< false: a simulation diverged, so that its behaviour means nothing
};

/// A statistic that a search reports for a generation: one cell of generations.csv, in column `name`.
struct Metric {
  std::string_view name;  ///< a string literal, without commas; no other column has it
  double value = 0.0;     ///< written so that it reads back to the same bits
};

}  // namespace amble::search
