#include "amble/physics/ode/library.hpp"

#include <cstdarg>
#include <mutex>
#include <vector>

#include "amble/core/check.hpp"

namespace amble::physics::ode {
namespace {

void ignore_message(int, const char*, va_list) {}

[[noreturn]] void throw_fault(int, const char* message, va_list) {
  throw Fault(message);
}

void initialise_process() {
  AMBLE_CHECK(dInitODE2(0) != 0, "dInitODE2");
  dSetMessageHandler(ignore_message);
  dSetErrorHandler(throw_fault);
  dSetDebugHandler(throw_fault);
}

/// Keeps an implementation that cannot be freed any more until the process ends.
void abandon(dThreadingImplementationID implementation) {
  static std::mutex mutex;
  static auto* const abandoned = new std::vector<dThreadingImplementationID>;  // outlives every engine
  const std::lock_guard lock(mutex);
  abandoned->push_back(implementation);
}

}  // namespace

void prepare_thread() {
  static std::once_flag once;
  std::call_once(once, initialise_process);
  thread_local const bool ready = dAllocateODEDataForThread(static_cast<unsigned>(dAllocateMaskAll)) != 0;
  AMBLE_CHECK(ready, "dAllocateODEDataForThread");
}

Threading::Threading() : implementation_(dThreadingAllocateSelfThreadedImplementation()) {}

Threading::~Threading() {
  dThreadingFreeImplementation(implementation_);
}

void Threading::attach_to(dWorldID world) const {
  dWorldSetStepThreadingImplementation(world, dThreadingImplementationGetFunctions(implementation_),
                                       implementation_);
}

void Threading::replace() {
  abandon(implementation_);
  implementation_ = dThreadingAllocateSelfThreadedImplementation();
}

}  // namespace amble::physics::ode
