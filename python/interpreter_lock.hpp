#pragma once

#include <Python.h>
#include <cxxabi.h>
#include <unistd.h>

namespace amble::python {

/// Waits for the end of the process.
[[noreturn]] inline void wait_for_end() {
  while (true) ::pause();
}

/// Runs a function that may take the interpreter's lock. Once the interpreter ends, Python ends a thread that
/// takes it by unwinding its stack, which destructors of C++ do not survive (std::terminate): such a thread
/// waits here instead. For calls of Python's own functions alone.
template <typename Function>
auto unless_it_ends(const Function& function) {
  try {
    return function();
  } catch (const abi::__forced_unwind&) {
    wait_for_end();
  }
}

/// Whether the interpreter is ending, and in another thread.
bool ends_elsewhere();
/// For Python's atexit: tells the calls of other threads (daemons) that run without the lock to end, and
/// waits for them for at most two seconds, as what is static is destroyed next. They do not return to Python.
void end_calls();

/// As long as it lives, the interpreter's lock is released: other threads of Python run.
class Unlocked {
 public:
  Unlocked();
  ~Unlocked();
  Unlocked(const Unlocked&) = delete;
  Unlocked& operator=(const Unlocked&) = delete;

  /// Runs a function with the lock, but for one that ends elsewhere. It must not throw.
  template <typename Function>
  void with_lock(const Function& function) {
    if (ends_elsewhere()) return;
    lock();
    function();
    state_ = PyEval_SaveThread();
  }

 private:
  void lock() {
    unless_it_ends([this] { PyEval_RestoreThread(state_); });
  }

  PyThreadState* state_;
};

}  // namespace amble::python
