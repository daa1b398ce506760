#include "amble/cli/study_processes.hpp"

#include <fcntl.h>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <utility>

#include "amble/core/error.hpp"
#include "amble/core/index.hpp"

namespace amble::cli {
namespace {

/// Between fork() and exec: only what is safe there.
[[noreturn]] void become_child(pid_t parent, int out, char* const* arguments) {
  ::prctl(PR_SET_PDEATHSIG, SIGTERM);
  if (::getppid() != parent) ::_exit(1);  // the parent ended before the line above
  ::dup2(out, STDOUT_FILENO);
  ::execv("/proc/self/exe", arguments);
  ::_exit(127);
}

}  // namespace

ChildProcesses::ChildProcesses(const std::vector<std::vector<std::string>>& arguments) {
  for (const auto& list : arguments) {
    std::array<int, 2> ends{};
    if (::pipe2(ends.data(), O_CLOEXEC) != 0) fail(ExitCode::io, "cannot make a pipe for a child process");
    std::vector<std::string> words{"amble"};
    words.insert(words.end(), list.begin(), list.end());
    std::vector<char*> pointers;
    pointers.reserve(words.size() + 1);
    for (std::string& word : words) pointers.push_back(word.data());
    pointers.push_back(nullptr);
    const pid_t parent = ::getpid(), pid = ::fork();
    if (pid == 0) become_child(parent, ends[1], pointers.data());
    ::close(ends[1]);
    if (pid < 0) {
      ::close(ends[0]);
      fail(ExitCode::io, "cannot start a child process");
    }
    children_.push_back({.pid = pid, .out = ends[0], .unread = {}});
  }
}

ChildProcesses::~ChildProcesses() {
  for (const Child& child : children_) {
    if (child.out >= 0) ::close(child.out);
    if (child.pid < 0) continue;
    ::kill(child.pid, SIGTERM);
    ::waitpid(child.pid, nullptr, 0);
  }
}

void ChildProcesses::read_lines(Child& child, const std::function<void(const std::string& line)>& on_line) {
  std::array<char, 4096> bytes{};
  const ssize_t count = ::read(child.out, bytes.data(), bytes.size());
  if (count < 0 && errno == EINTR) return;
  if (count <= 0) {
    ::close(std::exchange(child.out, -1));
    return;
  }
  child.unread.append(bytes.data(), to_index(count));
  for (std::size_t end; (end = child.unread.find('\n')) != std::string::npos;) {
    on_line(child.unread.substr(0, end));
    child.unread.erase(0, end + 1);
  }
}

std::vector<ChildProcesses::Exit> ChildProcesses::wait(
    const std::function<void(const std::string& line)>& on_line, const std::atomic<bool>& stop) {
  bool signalled = false;
  const auto reading = [](const Child& child) { return child.out >= 0; };
  while (std::ranges::any_of(children_, reading)) {
    if (stop && !std::exchange(signalled, true))
      for (const Child& child : children_) ::kill(child.pid, SIGTERM);
    std::vector<pollfd> polled;
    for (const Child& child : children_) polled.push_back({.fd = child.out, .events = POLLIN, .revents = 0});
    constexpr int interval_ms = 200;
    if (::poll(polled.data(), polled.size(), interval_ms) <= 0) continue;
    for (std::size_t i = 0; i < children_.size(); ++i)
      if (children_[i].out >= 0 && polled[i].revents != 0) read_lines(children_[i], on_line);
  }
  std::vector<Exit> exits;
  for (Child& child : children_) {
    int status = 0;
    while (::waitpid(child.pid, &status, 0) < 0 && errno == EINTR) {
    }
    child.pid = -1;
    exits.push_back(WIFSIGNALED(status) ? Exit{.code = -1, .signal = WTERMSIG(status)}
                                        : Exit{.code = WEXITSTATUS(status), .signal = 0});
  }
  return exits;
}

}  // namespace amble::cli
