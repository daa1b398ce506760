#include "amble/search/usable_memory.hpp"

#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <fstream>
#include <limits>
#include <string>

namespace amble::search {
namespace {

namespace fs = std::filesystem;

/// Share of the whole; the rest is for other processes.
constexpr double usable_share = 0.8;

/// What `ulimit -v` or `-d` allow.
double limit_of_process_bytes() {
  double least = std::numeric_limits<double>::infinity();
  for (const auto resource : {RLIMIT_AS, RLIMIT_DATA}) {
    rlimit limit{};
    if (getrlimit(resource, &limit) == 0 && limit.rlim_cur != RLIM_INFINITY)
      least = std::min(least, static_cast<double>(limit.rlim_cur));
  }
  return least;
}

double machine_memory_bytes() {
  return static_cast<double>(sysconf(_SC_PHYS_PAGES)) * static_cast<double>(sysconf(_SC_PAGE_SIZE));
}

/// The process's group, relative to the folder of all groups; empty for the topmost one, and where there are
/// none of version 2.
fs::path group_of_process(const fs::path& process_groups) {
  std::ifstream file(process_groups);
  for (std::string line; std::getline(file, line);)
    if (line.starts_with("0::/")) return line.substr(4);
  return {};
}

}  // namespace

double usable_memory_bytes(const fs::path& process_groups, const fs::path& groups) {
  double bytes = std::min(machine_memory_bytes(), limit_of_process_bytes());
  // The limits of all groups above apply, too. "max", which is no number, means none.
  for (fs::path group = group_of_process(process_groups);; group = group.parent_path()) {
    double limit_bytes = 0.0;
    if (std::ifstream(groups / group / "memory.max") >> limit_bytes) bytes = std::min(bytes, limit_bytes);
    if (group.empty()) break;
  }
  return usable_share * bytes;
}

}  // namespace amble::search
