#include "amble/morphology/complaints.hpp"

#include <mujoco/mujoco.h>

#include <utility>

namespace amble::morphology {
namespace {

std::mutex& one_for_all() {
  static std::mutex mutex;
  return mutex;
}

void throw_complaint(const char* text) {
  throw FatalComplaint(text);
}
void ignore_warning(const char*) {}

}  // namespace

ComplaintsCaught::ComplaintsCaught()
    : lock_(one_for_all()),
      error_(std::exchange(mju_user_error, throw_complaint)),
      warning_(std::exchange(mju_user_warning, ignore_warning)) {}

ComplaintsCaught::~ComplaintsCaught() {
  mju_user_error = error_;
  mju_user_warning = warning_;
}

}  // namespace amble::morphology
