#pragma once

#include <cstdint>
#include <string>

#include "amble/experiment/champion.hpp"

namespace amble::exporting {

/// Where an exported controller comes from.
struct Provenance {
  std::string amble;  ///< version and commit of the program that exports
  std::string experiment;
  std::int64_t seed = 0;
  int generation = 0, index = 0;
  std::string engine;
  std::string result;         ///< of its trial without noise: distance, time, outcome
  std::string settings_hash;  ///< XXH3 of its settings and robot as in the champion file
  std::string genome_hash;    ///< neat::Genome::hash
};

Provenance provenance_of(const experiment::Champion& champion);

}  // namespace amble::exporting
