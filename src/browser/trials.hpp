#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "amble/browser/plan.hpp"
#include "amble/trial/trial.hpp"

namespace amble::browser {

/// What a search is told of a genome, and what pages show of it.
struct Told {
  double objective = 0.0;
  bool viable = true;
  std::int32_t fell = 0, diverged = 0;   ///< trials
  float end_x_m = 0.0f, end_y_m = 0.0f;  ///< of its first trial, from its start
  std::vector<float> behaviour;
};

/// Genomes of a generation and what became of them, as bytes between modules of the same build.
struct ToldGenomes {
  std::uint64_t steps = 0;
  std::vector<Told> genomes;

  std::string bytes() const;
  static ToldGenomes read(std::string_view bytes);
};

/// Evaluates genomes in small pieces, sixteen trials at a time in this thread. What comes out depends on
/// plan, generation and genome alone: not on which genomes are together, nor in which module.
class Trials {
 public:
  explicit Trials(std::shared_ptr<const Plan> plan);
  ~Trials();
  Trials(const Trials&) = delete;
  Trials& operator=(const Trials&) = delete;

  /// The bytes of neat::save() of some genomes of a generation. Throws UserError.
  void begin(int generation, std::string_view genomes);
  /// At most so many steps of sixteen robots; true when all trials have ended.
  bool advance(int steps);
  /// Then: of all genomes, in their order.
  ToldGenomes told() const;

 private:
  class Queue;

  std::shared_ptr<const Plan> plan_;
  experiment::GenerationGround ground_;
  std::unique_ptr<physics::Engine> engine_;
  std::unique_ptr<controllers::Batch> controllers_;
  std::unique_ptr<trial::Runner> runner_;
  std::unique_ptr<Queue> queue_;
  std::uint64_t steps_before_ = 0;
};

/// All trials of one genome under these scenarios (none: one trial without noise), at once.
std::vector<record::Trajectory> trials_of(const experiment::Problem& problem, const neat::Genome& genome,
                                          std::span<const trial::Scenario> scenarios,
                                          const std::shared_ptr<const ground::Ground>& ground,
                                          std::vector<std::uint32_t>* trace = nullptr);

}  // namespace amble::browser
