#pragma once

#include <unistd.h>

#include <atomic>
#include <chrono>
#include <mutex>
#include <stdexcept>
#include <thread>

namespace amble::python {

/// Lets one thread at a time use an object. After a fork (multiprocessing's default on Linux) the child's
/// copy of an object is sound, unless another thread of the parent was in the middle of a call: that thread
/// is not there to end it, so the child gets an error instead of waiting for ever.
class CallLock {
 public:
  /// Nobody who has it waits for the interpreter. Throws std::runtime_error, Python's RuntimeError.
  std::unique_lock<std::timed_mutex> hold() {
    if (process_ == ::getpid()) return std::unique_lock(mutex_);
    constexpr int attempts = 200;  // a second: other threads of this process may be first
    for (int attempt = 0; attempt < attempts; ++attempt) {
      if (std::unique_lock lock(mutex_, std::try_to_lock); lock) {
        process_ = ::getpid();
        return lock;
      }
      if (process_ == ::getpid()) return std::unique_lock(mutex_);
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
    }
    throw std::runtime_error(
        "this process was forked while another thread used the object: make a new one here, or start "
        "processes by multiprocessing.get_context(\"spawn\")");
  }
  /// The same for what may be held long: holds nothing if `stop` was set meanwhile.
  std::unique_lock<std::timed_mutex> hold(const std::atomic<bool>& stop) {
    if (process_ != ::getpid()) return hold();
    std::unique_lock lock(mutex_, std::defer_lock);
    while (!stop && !lock.try_lock_for(std::chrono::milliseconds(20))) {
    }
    return lock;
  }

 private:
  std::timed_mutex mutex_;
  std::atomic<pid_t> process_{::getpid()};
};

}  // namespace amble::python
