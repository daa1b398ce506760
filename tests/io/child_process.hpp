#pragma once

#include <sys/wait.h>
#include <unistd.h>

#include <exception>
#include <utility>

namespace amble::test {

/// Runs `action` in a forked process and returns what it returned (0 … 250); 251 if it threw, 252 if it was
/// killed.
template <typename Action>
int in_child_process(Action&& action) {
  const pid_t child = ::fork();
  if (child == 0) {
    int result = 251;
    try {
      result = std::forward<Action>(action)();
    } catch (const std::exception&) {
    }
    ::_exit(result);
  }
  int status = 0;
  ::waitpid(child, &status, 0);
  return WIFEXITED(status) ? WEXITSTATUS(status) : 252;
}

}  // namespace amble::test
