#include "amble/morphology/mujoco_handlers.hpp"

#include <mujoco/mujoco.h>

#include <utility>

#include "amble/core/error.hpp"

namespace amble::morphology {
namespace {

std::mutex& handler_mutex() {
  static std::mutex mutex;
  return mutex;
}

void throw_error(const char* text) {
  throw MujocoError(text);
}
void ignore_warning(const char*) {}

}  // namespace

ScopedMujocoHandlers::ScopedMujocoHandlers()
    : lock_(handler_mutex()),
      error_(std::exchange(mju_user_error, throw_error)),
      warning_(std::exchange(mju_user_warning, ignore_warning)) {}

ScopedMujocoHandlers::~ScopedMujocoHandlers() {
  mju_user_error = error_;
  mju_user_warning = warning_;
}

void keep_mujoco_quiet() {
  const std::lock_guard lock(handler_mutex());
  if (mju_user_error == nullptr) mju_user_error = throw_error;
  if (mju_user_warning == nullptr) mju_user_warning = ignore_warning;
}

MujocoData new_mujoco_data(const mjModel* model, std::string_view engine) {
  const ScopedMujocoHandlers handlers;
  try {
    return MujocoData(mj_makeData(model));
  } catch (const MujocoError& fatal) {
    fail(ExitCode::bad_input, "{}: {}", engine, fatal.what());
  }
}

}  // namespace amble::morphology
