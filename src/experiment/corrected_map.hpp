#pragma once

#include <atomic>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "amble/experiment/repertoire.hpp"

namespace amble::experiment {

/// What an elite does typically: the means over trials that its search has not met.
struct TypicalElite {
  std::uint32_t cell = 0;                             ///< of the map
  double promised = 0.0;                              ///< its objective in the map
  double objective = 0.0;                             ///< credited as in the search
  std::vector<float> descriptor;                      ///< empty: a trial diverged
  std::uint32_t typical_cell = search::Elites::none;  ///< that of this descriptor; none: a trial diverged

  bool stays() const { return typical_cell == cell; }
};

/// A map whose elites were all tried again, in the same new trials, and the map that MAP-Elites fills with
/// what they did: the "corrected" one of Flageat & Cully (2020, 2023).
struct CorrectedMap {
  std::uint32_t cells = 0;           ///< of the map, filled or not
  int trials = 1;                    ///< of each elite
  std::vector<TypicalElite> elites;  ///< in the order of the map's numbers

  double promised() const;        ///< sum of the elites' objectives in the map: its QD score
  double kept() const;            ///< of their typical ones
  std::uint32_t staying() const;  ///< elites whose typical descriptor belongs to their cell
  std::uint32_t filled() const;   ///< cells of the corrected map that have an elite
  double qd_score() const;        ///< sum over these of the best typical objective there
  double coverage() const { return filled() / static_cast<double>(cells); }
  double staying_share() const;  ///< 0 for an empty map
};

/// Tries each elite in `trials` ≥ 1 of those unseen during evolution (unseen_scenarios()). The same for any
/// number of `jobs`. Nothing if `stop` was set.
std::optional<CorrectedMap> correct_map(const Repertoire& repertoire, int trials, int jobs,
                                        const std::atomic<bool>& stop);

/// A table of the elites, cells in ascending order: cell, objective, evaluations, descriptor, and after new
/// trials the typical objective and descriptor (empty if a trial diverged), and whether the elite stays (0,
/// 1).
std::string repertoire_csv(const Repertoire& repertoire, const std::optional<CorrectedMap>& corrected);

}  // namespace amble::experiment
