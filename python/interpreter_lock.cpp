#include "python/interpreter_lock.hpp"

#include <atomic>
#include <chrono>
#include <thread>

#include "amble/core/process.hpp"

namespace amble::python {
namespace {

const MakingProcess imported_in;
/// Unlocked objects of all threads.
std::atomic<int> calls{0};
/// The thread in which the interpreter ends; none as long as it does not.
std::atomic<std::thread::id> ends_in{};

}  // namespace

bool ends_elsewhere() {
  const std::thread::id end = ends_in;
  return end != std::thread::id() && end != std::this_thread::get_id();
}

void end_calls() {
  ends_in = std::this_thread::get_id();
  if (!imported_in.is_this()) return;  // calls of threads that were not forked would never end
  PyThreadState* const state = PyEval_SaveThread();
  for (int attempt = 0; attempt < 200 && calls > 0; ++attempt)
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  PyEval_RestoreThread(state);
}

Unlocked::Unlocked() : state_(PyEval_SaveThread()) {
  ++calls;
  if (!ends_elsewhere()) return;
  --calls;
  wait_for_end();
}

Unlocked::~Unlocked() {
  --calls;
  if (ends_elsewhere()) wait_for_end();
  lock();
}

}  // namespace amble::python
