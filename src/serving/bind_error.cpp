#include "amble/serving/bind_error.hpp"

#include <fmt/format.h>
#include <netdb.h>
#include <sys/socket.h>
#include <unistd.h>

#include <cerrno>
#include <system_error>

#include "amble/core/error.hpp"
#include "amble/io/text.hpp"

namespace amble::serving {
namespace {

/// Why none of the places that an address means can be taken: an errno.
int reason_of(const addrinfo* places) {
  int reason = EADDRNOTAVAIL;
  for (const addrinfo* place = places; place != nullptr; place = place->ai_next) {
    const int fd = ::socket(place->ai_family, place->ai_socktype | SOCK_CLOEXEC, place->ai_protocol);
    const bool taken = fd >= 0 && ::bind(fd, place->ai_addr, place->ai_addrlen) == 0 && ::listen(fd, 1) == 0;
    reason = taken ? EADDRINUSE : errno;  // free by now: it was in use before
    if (fd >= 0) ::close(fd);
  }
  return reason;
}

}  // namespace

void fail_to_bind(const std::string& address, bool given_address, int port, bool given_port) {
  addrinfo hints{};
  hints.ai_socktype = SOCK_STREAM;
  hints.ai_flags = AI_PASSIVE;
  addrinfo* places = nullptr;
  const std::string named = io::printable(address);
  if (::getaddrinfo(address.c_str(), std::to_string(port).c_str(), &hints, &places) != 0)
    fail(ExitCode::bad_input, "--address {}: no such address; expected one of this computer, such as 0.0.0.0",
         named);
  const int reason = reason_of(places);
  ::freeaddrinfo(places);
  if (reason == EADDRINUSE && given_port)
    fail(ExitCode::bad_input, "--port {}: in use at {}; name another, or none, for a free one", port, named);
  if (reason == EACCES && given_port)
    fail(ExitCode::bad_input, "--port {}: not permitted; those from 1024 on are", port);
  if (reason == EADDRNOTAVAIL && given_address)
    fail(ExitCode::bad_input, "--address {}: not an address of this computer", named);
  fail(ExitCode::io, "cannot serve pages at {}: {}", named, std::generic_category().message(reason));
}

}  // namespace amble::serving
