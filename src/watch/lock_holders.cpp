#include "amble/watch/lock_holders.hpp"

#include <charconv>
#include <fstream>
#include <sstream>
#include <string>

#include "amble/watch/table_tail.hpp"

namespace amble::watch {

LockHolders LockHolders::now() {
  LockHolders found;
  std::ifstream list("/proc/locks");
  // "1: FLOCK  ADVISORY  WRITE 1234 08:01:5678 0 EOF": process, then device and inode.
  for (std::string line; std::getline(list, line);) {
    std::istringstream words(line);
    std::string number, kind, advisory, mode, place;
    long process = 0;
    if (!(words >> number >> kind >> advisory >> mode >> process >> place) || kind != "FLOCK") continue;
    const std::string inode = place.substr(place.rfind(':') + 1);
    unsigned long value = 0;
    std::from_chars(inode.data(), inode.data() + inode.size(), value);
    found.held_.emplace(process, value);
  }
  return found;
}

bool LockHolders::hold(const std::filesystem::path& folder) const {
  const std::filesystem::path lock = folder / ".lock";
  const std::string text = read_part(lock, 0, 32);
  long process = 0;
  std::from_chars(text.data(), text.data() + text.size(), process);
  return held_.contains({process, FileMark::of(lock).inode});
}

}  // namespace amble::watch
