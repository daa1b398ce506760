#pragma once

#include <atomic>

namespace amble::cli {

/// Set once SIGINT, SIGTERM, SIGUSR1 or SIGHUP has come (SIGHUP not under nohup). The first call installs the
/// handlers.
const std::atomic<bool>& stop_signal();

}  // namespace amble::cli
