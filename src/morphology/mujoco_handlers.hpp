#pragma once

#include <mujoco/mujoco.h>
#include <memory>
#include <mutex>
#include <stdexcept>
#include <string_view>

#include "amble/core/math.hpp"

namespace amble::morphology {

/// A fatal error of MuJoCo, after which its default handler ends the process.
class MujocoError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Replaces MuJoCo's error and warning handlers within a scope: errors throw MujocoError, warnings (by
/// default written to a log file in the current folder) are dropped. The handlers are global to the process,
/// so a mutex admits one scope at a time; the previous handlers are restored at its end.
class ScopedMujocoHandlers {
 public:
  ScopedMujocoHandlers();
  ~ScopedMujocoHandlers();
  ScopedMujocoHandlers(const ScopedMujocoHandlers&) = delete;
  ScopedMujocoHandlers& operator=(const ScopedMujocoHandlers&) = delete;

 private:
  std::lock_guard<std::mutex> lock_;
  void (*error_)(const char*);
  void (*warning_)(const char*);
};

/// From now on in this process, unless somebody has handlers of his own: errors throw MujocoError, warnings
/// are dropped. For code that steps models of strangers in many threads.
void keep_mujoco_quiet();

struct DeleteMujocoData {
  void operator()(mjData* data) const { mj_deleteData(data); }
};
using MujocoData = std::unique_ptr<mjData, DeleteMujocoData>;

/// The state of a simulation. Throws UserError "ENGINE: …" if MuJoCo refuses.
MujocoData new_mujoco_data(const mjModel* model, std::string_view engine);

/// Three or four numbers of one of MuJoCo's arrays.
inline Vec3 vec3(const mjtNum* numbers) {
  return {numbers[0], numbers[1], numbers[2]};
}
inline Quat quat(const mjtNum* numbers) {
  return {numbers[0], numbers[1], numbers[2], numbers[3]};
}

}  // namespace amble::morphology
