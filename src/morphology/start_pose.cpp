#include "amble/morphology/start_pose.hpp"

#include <fmt/ranges.h>
#include <mujoco/mujoco.h>
#include <algorithm>
#include <string>
#include <utility>

#include "amble/core/error.hpp"
#include "amble/core/index.hpp"
#include "amble/morphology/mujoco_handlers.hpp"

namespace amble::morphology {
namespace {

Quat unit(const double* numbers) {
  const Quat q{numbers[0], numbers[1], numbers[2], numbers[3]};
  const double length = std::sqrt(q.w * q.w + q.x * q.x + q.y * q.y + q.z * q.z);
  return length > 0.0 ? Quat{q.w / length, q.x / length, q.y / length, q.z / length} : Quat{};
}

int width(int type) {
  return type == mjJNT_FREE ? 7 : type == mjJNT_BALL ? 4 : 1;
}

int joint_of_name(const mjModel_& model, const std::string& name) {
  for (int j = 0; j < model.njnt; ++j)
    if (name == model.names + model.name_jntadr[j]) return j;
  return -1;
}

}  // namespace

std::vector<std::string> keyframes(const mjModel_& model) {
  std::vector<std::string> names;
  names.reserve(static_cast<std::size_t>(model.nkey));
  for (int k = 0; k < model.nkey; ++k) names.emplace_back(model.names + model.name_keyadr[k]);
  return names;
}

StartPose::StartPose(const ModelFile& file, const ReadingOptions& options)
    : model_(*file.model), positions_(model_.qpos0, model_.qpos0 + model_.nq) {
  if (!options.start_keyframe.empty()) {
    const std::vector<std::string> names = keyframes(model_);
    const auto found = std::ranges::find(names, options.start_keyframe);
    if (found == names.end())
      fail(ExitCode::bad_input, "{}: no keyframe '{}' to start from; the model has: {}", file.path.string(),
           options.start_keyframe, names.empty() ? "none" : fmt::format("{}", fmt::join(names, ", ")));
    const mjtNum* key = model_.key_qpos + (found - names.begin()) * model_.nq;
    positions_.assign(key, key + model_.nq);
  }
  for (const auto& [name, angle] : options.start_angles_rad) {
    const int j = joint_of_name(model_, name);
    if (j < 0 || width(model_.jnt_type[j]) != 1)
      fail(ExitCode::bad_input, "{}: no hinge '{}', of which a start angle is given", file.path.string(),
           name);
    positions_[to_index(model_.jnt_qposadr[j])] = angle;
  }
}

double StartPose::angle_rad(int joint) const {
  return positions_[to_index(model_.jnt_qposadr[joint])];
}

bool StartPose::moved(int joint) const {
  const int at = model_.jnt_qposadr[joint];
  return !std::equal(model_.qpos0 + at, model_.qpos0 + at + width(model_.jnt_type[joint]),
                     positions_.begin() + at);
}

robot::Pose StartPose::motion(int joint) const {
  const double* now = positions_.data() + model_.jnt_qposadr[joint];
  const double by = *now - model_.qpos0[model_.jnt_qposadr[joint]];
  const Vec3 axis = vec3(model_.jnt_axis + 3 * joint), anchor = vec3(model_.jnt_pos + 3 * joint);
  if (model_.jnt_type[joint] == mjJNT_SLIDE) return {by * axis, {}};
  const Quat turn = model_.jnt_type[joint] == mjJNT_BALL ? unit(now) : axis_angle(axis, by);
  return {anchor - rotate(turn, anchor), turn};
}

robot::Pose StartPose::pose_in_parent(int body) const {
  robot::Pose pose{vec3(model_.body_pos + 3 * body),
                   {model_.body_quat[4 * body], model_.body_quat[4 * body + 1],
                    model_.body_quat[4 * body + 2], model_.body_quat[4 * body + 3]}};
  for (int j = model_.body_jntadr[body], end = j + model_.body_jntnum[body]; j < end; ++j) {
    if (!moved(j)) continue;
    if (model_.jnt_type[j] == mjJNT_FREE) {
      const double* now = positions_.data() + model_.jnt_qposadr[j];
      pose = {vec3(now), unit(now + 3)};
    } else {
      pose = pose * motion(j);
    }
  }
  return pose;
}

robot::Pose StartPose::after(int joint) const {
  const int body = model_.jnt_bodyid[joint], end = model_.body_jntadr[body] + model_.body_jntnum[body];
  robot::Pose pose;
  for (int j = joint + 1; j < end; ++j)
    if (moved(j)) pose = pose * motion(j);
  return pose;
}

std::vector<double> lower_cost(const std::function<double(const std::vector<double>&)>& cost,
                               std::vector<double> at, const std::vector<double>& lower,
                               const std::vector<double>& upper, double& best) {
  const auto clamped = [&](std::size_t i, double value) { return std::clamp(value, lower[i], upper[i]); };
  const auto explore = [&](std::vector<double> from, double& value, double step) {
    for (std::size_t i = 0; i < from.size(); ++i)
      for (const double by : {step, -step}) {
        std::vector<double> next = from;
        next[i] = clamped(i, from[i] + by);
        if (const double there = cost(next); there < value) {
          value = there;
          from = std::move(next);
          break;
        }
      }
    return from;
  };
  best = cost(at);
  constexpr double first_rad = 0.2, last_rad = 1e-5;
  for (double step = first_rad; step > last_rad;) {
    double value = best;
    std::vector<double> next = explore(at, value, step);
    if (value >= best) {
      step *= 0.5;
      continue;
    }
    // On in the same direction for as long as it pays.
    while (value < best) {
      std::vector<double> beyond = next;
      for (std::size_t i = 0; i < beyond.size(); ++i) beyond[i] = clamped(i, 2.0 * next[i] - at[i]);
      best = value;
      at = std::move(next);
      value = cost(beyond);
      next = explore(std::move(beyond), value, step);
    }
  }
  return at;
}

double evenly(int n, int base) {
  double value = 0.0, share = 1.0;
  for (; n > 0; n /= base) {
    share /= base;
    value += share * (n % base);
  }
  return value;
}

}  // namespace amble::morphology
