#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "amble/experiment/problem/champion.hpp"
#include "amble/io/settings.hpp"
#include "amble/search/generational.hpp"
#include "amble/trial/trial.hpp"

namespace amble::browser {

/// What can be chosen; the rest is as in configs/quick.
struct EvolutionSettings {
  std::int64_t seed = 1;
  int population = 100;
  double seconds = 10.0;         ///< of a trial
  double add_node_share = 0.05;  ///< of offspring by mutation
  double add_link_share = 0.15;
  bool feels_its_feet = true;  ///< false: a SUPG's timer goes round by itself

  void describe(io::SettingsVisitor& visitor);
};

/// A generation that is over.
struct Progress {
  int generation = -1;  ///< −1: none yet
  double best = 0.0;    ///< of it
  double median = 0.0;  ///< of it
  double best_so_far = 0.0;
  int best_generation = -1;  ///< that of best_so_far
  int fell = 0;              ///< trials of it
  std::uint64_t steps = 0;   ///< of all robots so far
};

struct SpeciesSize {
  std::uint32_t id = 0;
  int size = 0;
};

/// NEAT by objective on the robot, controller, ground, damage and score of a champion, from nothing, in small
/// pieces: sixteen trials at a time in this thread. The same champion and settings give the same generations,
/// to the bit. Trials are without noise, or all walkers would begin alike: their start is as in the problem.
class Evolution {
 public:
  /// Text of a champion file, and settings as JSON. Throws UserError.
  Evolution(const std::string& champion, const std::string& settings);
  ~Evolution();
  Evolution(const Evolution&) = delete;
  Evolution& operator=(const Evolution&) = delete;

  /// At most so many steps of sixteen robots; true if a generation has ended with them.
  bool advance(int steps);
  const Progress& progress() const { return progress_; }
  /// The species of the generation.
  const std::vector<SpeciesSize>& species() const { return species_; }
  /// Both as a JSON object; "species" as a list of [id, size].
  std::string progress_json() const;
  /// The file of the best so far, which the commands of amble take. Before the first generation has ended, a
  /// programming error.
  std::string champion() const;

 private:
  class Candidates;

  void begin_generation();
  void end_generation();

  EvolutionSettings settings_;
  experiment::Champion of_;
  neat::Settings neat_;
  std::shared_ptr<const ground::Ground> ground_;
  std::unique_ptr<physics::Engine> engine_;
  std::unique_ptr<controllers::Batch> controllers_;
  std::unique_ptr<trial::Runner> runner_;
  std::unique_ptr<search::GenerationalSearch> search_;
  std::unique_ptr<Candidates> candidates_;
  std::optional<neat::Genome> best_;
  int best_index_ = 0;
  Progress progress_;
  std::vector<SpeciesSize> species_;
};

}  // namespace amble::browser
