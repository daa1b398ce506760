#pragma once

#include <pthread.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/syscall.h>
#include <unistd.h>

namespace amble::io {

/// Makes the calling thread one that steps back behind the process's other threads: a lower priority (nice 10
/// more, of this thread alone), and no signals, which go to the others.
inline void be_background_thread() {
  const auto thread = static_cast<id_t>(::syscall(SYS_gettid));
  const int before = ::getpriority(PRIO_PROCESS, thread);
  static_cast<void>(::setpriority(PRIO_PROCESS, thread, before + 10));  // more than 19 is 19
  sigset_t all;
  ::sigfillset(&all);
  ::pthread_sigmask(SIG_BLOCK, &all, nullptr);
}

}  // namespace amble::io
