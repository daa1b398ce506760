#pragma once

#include <cstddef>
#include <memory>
#include <string_view>
#include <vector>

#include "amble/record/trajectory.hpp"

namespace amble::score {

/// Behaviour characterization of a trial: a vector of numbers that searches compare (Lehman & Stanley 2011).
/// Const, shared by all threads.
class Behaviour {
 public:
  virtual ~Behaviour() = default;
  /// Numbers in the vector, the same for every trial.
  virtual std::size_t length() const = 0;
  /// Sampling of the path that it needs.
  virtual record::PathSampling path() const { return {}; }
  /// Of the same length also for trials that ended early.
  virtual std::vector<float> of(const record::Trajectory& trajectory) const = 0;
};

/// Parameters of behaviours.
struct BehaviourSettings {
  int steps = 0;              ///< of a trial that completes
  record::PathSampling path;  ///< how "path" samples it
};

/// The path of the centre of mass over the ground (Morse et al. 2013, sec. 4): x0, y0, x1, y1, …, m, relative
/// to the start, as it was sampled. A trial that ended early is padded with its last centre of mass.
class PathBehaviour : public Behaviour {
 public:
  explicit PathBehaviour(const BehaviourSettings& settings);
  std::size_t length() const override { return length_; }
  record::PathSampling path() const override { return path_; }
  std::vector<float> of(const record::Trajectory& trajectory) const override;

 private:
  record::PathSampling path_;
  std::size_t length_;
};

/// By its name in the table of behaviour.cpp, which search::StrategyKind::behaviour refers to; "" is the
/// behaviour without numbers. AMBLE_CHECK: the name is known.
std::unique_ptr<const Behaviour> make_behaviour(std::string_view name, const BehaviourSettings& settings);

}  // namespace amble::score
