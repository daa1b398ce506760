#pragma once

#include <memory>
#include <vector>

#include "amble/experiment/problem.hpp"
#include "amble/gait/meter.hpp"
#include "amble/robot/spec.hpp"
#include "amble/trial/trial.hpp"

namespace amble::experiment {

/// Measures the gait of a trial while it runs.
class GaitObserver : public trial::Observer {
 public:
  GaitObserver(const Problem& problem, const gait::Settings& settings);
  void on_start(const physics::Engine& engine, int lane) override;
  void on_step(int step, const physics::Engine& engine, const controllers::Batch& controllers,
               const LaneArray& targets_rad, int lane) override;
  gait::Report finish(record::Outcome outcome);

 private:
  void add_seam(const controllers::Batch& controllers, const LaneArray& targets_rad, int lane);

  gait::Body body_;
  double timestep_s_;
  gait::Settings settings_;
  gait::Meter meter_;
  gait::SeamMeter seam_;
  std::size_t legs_;
  bool timers_ = false;  ///< whether the controller has a timer and triggers per leg
  std::vector<float> touch_, angle_rad_, torque_nm_, target_rad_, state_;
};

}  // namespace amble::experiment
