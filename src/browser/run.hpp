#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "amble/browser/plan.hpp"
#include "amble/browser/trials.hpp"
#include "amble/experiment/plan/checkpoint.hpp"
#include "amble/experiment/plan/generation_row.hpp"
#include "amble/experiment/problem/champion.hpp"

namespace amble::browser {

/// Files of a run's folder by their paths in it ("champions/00003.json").
using Files = std::map<std::string, std::string>;

/// A run as `amble evolve` makes it, without its trials: these come from Trials, in any number of modules.
/// The same plan gives the same generations as natively, to the bit, and files() are a run's folder that
/// `amble resume` goes on with.
class Run {
 public:
  /// Before its first generation.
  explicit Run(std::shared_ptr<const Plan> plan);
  /// Goes on with a run, whose plan this must be. Throws UserError: a file is missing, damaged, or of another
  /// run.
  Run(std::shared_ptr<const Plan> plan, const Files& files);

  int generation() const { return state_.strategy->round(); }
  /// Genomes of this generation, and some of them for Trials::begin().
  std::size_t candidates() const { return state_.strategy->ask().size(); }
  std::string candidates(std::size_t first, std::size_t count) const;
  /// What became of those from `first` on. Throws UserError.
  void take(std::size_t first, std::string_view told);
  /// All have been taken: ends the generation. `wall_s`: the time that it took. Throws UserError.
  void tell(double wall_s);

  /// What does not change: names of the CPPN's inputs and outputs, and more, as JSON.
  std::string describe() const;
  /// The generation that ended last, for pages.
  std::string progress_json() const;
  /// The file of the best so far. AMBLE_CHECK: a generation has ended.
  const std::string& champion() const;
  /// The file of the elite in a cell of the map. Throws UserError: none is there.
  std::string elite(std::uint32_t cell) const;
  /// A champion's file of the first genome of this generation, whatever it is worth: to be looked at.
  std::string first() const;
  /// What a run's folder has, now.
  Files files() const;

  /// From the next generation on robots walk elsewhere, or with another body. Search and controller must be
  /// those of before. What was the best so far is forgotten: it was the best of another world. Throws
  /// UserError.
  void change(std::shared_ptr<const Plan> plan);

 private:
  void keep_best(experiment::GenerationRow& row, std::vector<double>& objectives);
  experiment::Champion tried(const neat::Genome& genome, int generation, int index) const;
  void measure_typical(const neat::Genome& genome);
  void write(const experiment::GenerationRow& row, double wall_s);
  void note_species();
  void restore(const Files& files);

  std::shared_ptr<const Plan> plan_;
  experiment::RunState state_;
  std::vector<Told> told_;
  std::size_t taken_ = 0;
  std::uint64_t steps_ = 0;

  std::string header_, table_, log_;
  Files champions_;
  std::string champion_;
  experiment::GenerationRow row_;                       ///< of the generation that ended last
  std::vector<std::pair<std::uint32_t, int>> species_;  ///< of it: ids and sizes
  std::vector<Told> shown_;                             ///< of it
};

}  // namespace amble::browser
