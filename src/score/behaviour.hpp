#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "amble/core/circle.hpp"
#include "amble/record/trajectory.hpp"
#include "amble/score/score.hpp"

namespace amble::score {

/// Behaviour characterization of an evaluation: a vector of numbers that searches compare (Lehman & Stanley
/// 2011).
/// Const, shared by all threads.
class Behaviour {
 public:
  virtual ~Behaviour() = default;
  /// Numbers in the vector, the same for every trial.
  virtual std::size_t length() const = 0;
  /// Sampling of the path that it needs.
  virtual record::PathSampling path() const { return {}; }
  /// Measurements of trials that it needs.
  virtual record::Measures measures() const { return {}; }
  /// Of each number, whether it is one of a circle; empty: none is.
  virtual std::vector<Circle> circles() const { return {}; }
  /// The behaviour of one evaluation's episodes (at least one: AMBLE_CHECK), length() numbers also for trials
  /// that ended early. They were sampled as path() says, and measures() were taken.
  virtual std::vector<float> of(std::span<const record::Trajectory> episodes) const = 0;
};

/// A quantity in a behaviour.
struct Descriptor {
  std::string quantity;  ///< name of a row of quantities()
  std::string leg;       ///< name of a leg, for a quantity that legs have; empty: the mean over legs
};

/// Parameters of behaviours.
struct BehaviourSettings {
  int steps = 0;                             ///< length of a trial that completes
  record::PathSampling path = {};            ///< how "path" samples it
  std::vector<Descriptor> descriptors = {};  ///< what "descriptors" has, in order
  Settings score = {};                       ///< what quantities of descriptors depend on
  double duration_s = 0.0,                   ///< Context::duration_s, likewise
      weight_n = 0.0;                        ///< Context::weight_n, likewise
  std::vector<std::string> leg_names = {};   ///< the robot's, in order; empty: legs are not looked up
};

/// The path of the centre of mass over the ground (Morse et al. 2013, sec. 4): x0, y0, x1, y1, …, m, relative
/// to the start, as it was sampled. A trial that ended early is padded with its last centre of mass. Of
/// several episodes that of the first: a mean of paths would not be a path.
class PathBehaviour : public Behaviour {
 public:
  /// Takes `steps` and `path`.
  explicit PathBehaviour(const BehaviourSettings& settings);
  std::size_t length() const override { return length_; }
  record::PathSampling path() const override { return path_; }
  std::vector<float> of(std::span<const record::Trajectory> episodes) const override;

 private:
  record::PathSampling path_;
  std::size_t length_;
};

/// Quantities of a trial, the mean over episodes of each: dimensions of a map.
class DescriptorBehaviour : public Behaviour {
 public:
  /// Throws SettingError for a quantity that does not exist, a leg that the robot does not have, a leg of a
  /// quantity of the whole robot.
  explicit DescriptorBehaviour(const BehaviourSettings& settings);
  std::size_t length() const override { return dimensions_.size(); }
  record::Measures measures() const override;
  std::vector<Circle> circles() const override;
  std::vector<float> of(std::span<const record::Trajectory> episodes) const override;

 private:
  struct Dimension {
    const Quantity* quantity;
    int leg;  ///< -1: of the whole robot, the mean over legs, or not looked up
    Circle circle;
  };
  Settings score_;
  double duration_s_, weight_n_;
  std::vector<Dimension> dimensions_;
};

/// By its name, which search::StrategyKind::behaviour refers to: "path", "descriptors", or "", the behaviour
/// without numbers. AMBLE_CHECK: it is one of them. Throws as DescriptorBehaviour.
std::unique_ptr<const Behaviour> make_behaviour(std::string_view name, const BehaviourSettings& settings);

}  // namespace amble::score
