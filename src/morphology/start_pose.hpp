#pragma once

#include <functional>
#include <vector>

#include "amble/morphology/model_parts.hpp"
#include "amble/robot/pose.hpp"

struct mjModel_;

namespace amble::morphology {

/// The pose in which a robot starts, in terms of a compiled model. A model's bodies and joints are given for
/// its reference pose (mjModel::qpos0); here each is as it is at the start. Where a joint starts at its
/// reference nothing is computed, so the model's own bits are kept.
class StartPose {
 public:
  /// Throws UserError: no such keyframe or joint.
  StartPose(const ModelFile& file, const ReadingOptions& options);

  /// MuJoCo's qpos.
  const std::vector<double>& positions() const { return positions_; }
  /// The start angle of a joint with one degree of freedom, as the model counts.
  double angle_rad(int joint) const;
  /// The start pose of a body's frame in its parent's; of a free body in the world.
  robot::Pose pose_in_parent(int body) const;
  /// What the joints of its body after this one do at the start, in the body's frame: the inverse takes
  /// the joint's anchor and axis from the reference pose to the start pose.
  robot::Pose after(int joint) const;

 private:
  robot::Pose motion(int joint) const;
  bool moved(int joint) const;

  const mjModel_& model_;
  std::vector<double> positions_;  ///< MuJoCo's qpos
};

/// Names of the keyframes of a model, in its order.
std::vector<std::string> keyframes(const mjModel_& model);

}  // namespace amble::morphology

namespace amble::morphology {

/// A local minimum of `cost` within bounds, from a point on, by pattern search (Hooke and Jeeves): steps of
/// each angle, which are halved where none pays, down to 1e-5 rad. `best` becomes its cost.
std::vector<double> lower_cost(const std::function<double(const std::vector<double>&)>& cost,
                               std::vector<double> at, const std::vector<double>& lower,
                               const std::vector<double>& upper, double& best);

/// The n-th number of a sequence that fills [0, 1) evenly (Halton), for a prime base.
double evenly(int n, int base);

}  // namespace amble::morphology
