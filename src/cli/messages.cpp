#include "amble/cli/messages.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <cstdio>

namespace amble::cli {

void print_message(std::string_view text) {
  std::fwrite(text.data(), 1, text.size(), stderr);
  std::fflush(stderr);
}

void reserve_standard_streams() {
  // Opened the wrong way round, so that writing fails as it would on a closed stream.
  for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO})
    if (::fcntl(stream, F_GETFD) < 0) ::open("/dev/null", stream == STDIN_FILENO ? O_WRONLY : O_RDONLY);
}

}  // namespace amble::cli
