#pragma once

#include "amble/search/criterion.hpp"

namespace amble::search {

/// Selects by the objective itself (the fitness-driven runs of Morse et al. 2013, sec. 4). Has no state.
class ObjectiveSearch : public Criterion {
 public:
  std::vector<neat::Fitness> fitness_of(std::span<const Evaluation> generation) override;
  void save(io::BinaryWriter&) const override {}
  void load(io::BinaryReader&) override {}
};

}  // namespace amble::search
