#pragma once

#include <string>

namespace amble::serving {

/// Throws the UserError that says why a server cannot be at an address and port, which are those that were
/// asked for: `given_address`, `given_port` whether the user named them.
[[noreturn]] void fail_to_bind(const std::string& address, bool given_address, int port, bool given_port);

}  // namespace amble::serving
