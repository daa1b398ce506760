#include "amble/cli/stop_signal.hpp"

#include <csignal>

namespace amble::cli {
namespace {

std::atomic<bool> stop{false};
static_assert(std::atomic<bool>::is_always_lock_free, "a signal handler may touch only lock-free atomics");

void on_signal(int) {
  stop.store(true);
}

}  // namespace

const std::atomic<bool>& stop_signal() {
  static const bool installed = [] {
    struct sigaction action = {};
    action.sa_handler = on_signal;
    for (const int signal : {SIGINT, SIGTERM, SIGUSR1}) sigaction(signal, &action, nullptr);
    // The signal of a terminal that is closed, unless nohup asked to go on then.
    struct sigaction before = {};
    if (sigaction(SIGHUP, nullptr, &before) == 0 && before.sa_handler != SIG_IGN)
      sigaction(SIGHUP, &action, nullptr);
    return true;
  }();
  static_cast<void>(installed);
  return stop;
}

}  // namespace amble::cli
