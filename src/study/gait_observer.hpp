#pragma once

#include <memory>
#include <vector>

#include "amble/gait/meter.hpp"
#include "amble/robot/spec.hpp"
#include "amble/trial/trial.hpp"

namespace amble::study {

/// Measures the gait of a trial while it runs.
class GaitObserver : public trial::Observer {
 public:
  GaitObserver(const robot::RobotSpec& robot, double timestep_s, const gait::Settings& settings);
  void on_step(int step, const physics::Engine& engine, const controllers::Batch& controllers,
               const LaneArray& targets_rad, int lane) override;
  gait::Report finish(record::Outcome outcome) { return meter_.finish(outcome); }

 private:
  gait::Meter meter_;
  std::vector<float> touch_, angle_rad_, torque_nm_;
};

}  // namespace amble::study
