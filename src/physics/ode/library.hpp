#pragma once

#include <ode/ode.h>

#include <stdexcept>

namespace amble::physics::ode {

/// An internal error of ODE, such as a NaN, on which ODE itself would end the process.
class Fault : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Makes ODE ready for the calling thread: initialises the library once per process, with handlers that are
/// silent and throw Fault instead of aborting, and the thread's data once per thread.
void prepare_thread();

/// Runs the steps of one world in the calling thread. ODE's default shares one implementation among all
/// worlds of the process, which fails an assertion as soon as two threads step.
class Threading {
 public:
  Threading();
  ~Threading();
  Threading(const Threading&) = delete;
  Threading& operator=(const Threading&) = delete;

  void attach_to(dWorldID world) const;
  /// After a Fault out of a step. The unfinished jobs cannot be freed (ODE would abort), so this
  /// implementation is kept until the process ends, and a new one takes its place. ODE also loses the step's
  /// working memory, some 90 KB per Fault.
  void replace();

 private:
  dThreadingImplementationID implementation_;
};

}  // namespace amble::physics::ode
