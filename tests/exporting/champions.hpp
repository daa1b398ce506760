#pragma once

#include <ostream>
#include <string>
#include <vector>

#include "amble/experiment/champion.hpp"

namespace amble::tests {

/// A small run whose champion is exported.
struct Sample {
  std::string name;
  std::string preset;               ///< below configs/, e.g. "authors/supg"
  std::string robot = "quadruped";  ///< or hexapod, biped, lacking, holding: with automatic substrates
  std::vector<std::string> assignments = {};  ///< settings
  std::string file = {};                      ///< champion file or run folder in place of all that
};

/// For GoogleTest, which otherwise names a sample by its bytes.
inline void PrintTo(const Sample& sample, std::ostream* out) {
  *out << sample.name;
}

/// Twenty: all architectures with most of their settings, on robots of two, four and six legs.
std::vector<Sample> twenty_samples();

/// SUPGs whose targets are smoothed, and whose patterns end where they began.
std::vector<Sample> seam_samples();

/// SUPGs that sensors modulate.
std::vector<Sample> modulated_samples();

/// CTRNNs that sense more than touch, sensors that are late, and guessed contacts beside what else is sensed.
std::vector<Sample> sensing_samples();

/// Its champion after a few generations, or that of its file. One that fell before: in the trials of tests
/// the robot may fall and go on, so that they are as long as they are meant to be.
experiment::Champion evolve(const Sample& sample);

}  // namespace amble::tests
