#include "amble/cli/messages.hpp"

#include <fcntl.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>

namespace amble::cli {

void print_message(std::string_view text) {
  std::fwrite(text.data(), 1, text.size(), stderr);
  std::fflush(stderr);
}

int terminal_columns() {
  winsize size{};
  return ::ioctl(STDERR_FILENO, TIOCGWINSZ, &size) == 0 ? size.ws_col : 0;
}

std::string shortened(std::string_view text, int most) {
  const auto begins_character = [](char c) { return (static_cast<unsigned char>(c) & 0xc0) != 0x80; };
  if (most <= 0 || std::ranges::count_if(text, begins_character) <= most) return std::string(text);
  std::size_t end = 0;
  for (int characters = 0; end < text.size(); ++end)
    if (begins_character(text[end]) && ++characters == most) break;
  return std::string(text.substr(0, end)) + "…";
}

void reserve_standard_streams() {
  // Opened the wrong way round, so that writing fails as it would on a closed stream.
  for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO})
    if (::fcntl(stream, F_GETFD) < 0) ::open("/dev/null", stream == STDIN_FILENO ? O_WRONLY : O_RDONLY);
}

}  // namespace amble::cli
