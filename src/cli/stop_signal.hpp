#pragma once

#include <atomic>

namespace amble::cli {

/// Set once SIGINT, SIGTERM or SIGUSR1 has come. The first call installs the handlers.
const std::atomic<bool>& stop_signal();

}  // namespace amble::cli
