#pragma once

#include <filesystem>

namespace amble::search {

/// How much memory a process may use without being killed: four fifths of the machine's or, where that is
/// less, of the smallest limit of the process (ulimit), its control group and the groups above (cgroup v2,
/// memory.max).
/// `process_groups` and `groups` are /proc/self/cgroup and the folder where the groups are mounted; without
/// them, or without a limit, the machine's memory counts.
double usable_memory_bytes(const std::filesystem::path& process_groups = "/proc/self/cgroup",
                           const std::filesystem::path& groups = "/sys/fs/cgroup");

}  // namespace amble::search
