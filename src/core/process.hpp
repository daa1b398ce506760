#pragma once

#include <unistd.h>

namespace amble {

/// The process in which an object was made. Threads do not come along into a process that is forked from it:
/// what has threads must neither be used nor destroyed there, as joining them would never end.
class MakingProcess {
 public:
  bool is_this() const { return ::getpid() == id_; }

 private:
  pid_t id_ = ::getpid();
};

}  // namespace amble
