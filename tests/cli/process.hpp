#pragma once

#include <sys/types.h>

#include <filesystem>
#include <string>
#include <vector>

#include "tests/io/temporary_folder.hpp"

namespace amble::tests {

using test::TemporaryFolder;

struct Finished {
  int exit_code = -1;  ///< −1: ended by a signal
  int signal = 0;
  std::string out, err;
  double peak_memory_bytes = 0.0;  ///< its largest resident set
};

/// A real process of the program under test.
class Process {
 public:
  /// `leads_group`: of itself and the processes that it starts, for signal_group().
  explicit Process(const std::vector<std::string>& arguments, bool leads_group = false);
  ~Process();
  Process(const Process&) = delete;
  Process& operator=(const Process&) = delete;

  void signal(int number) const;
  void signal_group(int number) const;
  bool running() const;
  pid_t pid() const { return pid_; }
  Finished wait();

 private:
  pid_t pid_ = -1;
  std::filesystem::path out_, err_;
  bool waited_ = false;
};

/// Runs `amble` with these arguments to its end.
Finished amble(const std::vector<std::string>& arguments);

std::string slurp(const std::filesystem::path& path);
void spill(const std::filesystem::path& path, const std::string& text);

/// generations.csv without its last four columns, which are times.
std::string without_times(const std::string& csv);

/// Every champion file's name and text.
std::string all_champions(const std::filesystem::path& run);

}  // namespace amble::tests
