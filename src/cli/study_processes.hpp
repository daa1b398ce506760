#pragma once

#include <sys/types.h>

#include <atomic>
#include <functional>
#include <string>
#include <vector>

namespace amble::cli {

/// Child processes that run this program in parallel. Each gets a signal when this process ends in any way.
class ChildProcesses {
 public:
  /// `arguments` of each, without the program's name. Throws UserError(ExitCode::io).
  explicit ChildProcesses(const std::vector<std::vector<std::string>>& arguments);
  /// Terminates those that still run.
  ~ChildProcesses();
  ChildProcesses(const ChildProcesses&) = delete;
  ChildProcesses& operator=(const ChildProcesses&) = delete;

  struct Exit {
    int code = 0;    ///< exit code, if `signal` is 0
    int signal = 0;  ///< that terminated it
  };

  /// Forwards the children's standard output, line by line, until all have ended; forwards `stop` to them.
  /// Returns how they ended, in order.
  std::vector<Exit> wait(const std::function<void(const std::string& line)>& on_line,
                         const std::atomic<bool>& stop);

 private:
  struct Child {
    pid_t pid = -1;
    int out = -1;  ///< its standard output; −1: closed
    std::string unread;
  };

  void read_lines(Child& child, const std::function<void(const std::string& line)>& on_line);

  std::vector<Child> children_;
};

}  // namespace amble::cli
