#pragma once

#include <string>
#include <string_view>

namespace amble::serving {

/// Whether a Host header names this computer by localhost, 127.0.0.1 or [::1], with or without a port. A page
/// from elsewhere whose name was made to point here ("DNS rebinding") has its own name there.
bool names_loopback(std::string_view host);

/// 128 random bits of the system as 32 hexadecimal digits. Throws UserError(ExitCode::io).
std::string random_token();

/// Whether they are equal, in a time that depends on the length of `expected` alone.
bool same_token(std::string_view expected, std::string_view given);

/// The value of a cookie in a Cookie header; empty if it is not there.
std::string_view cookie(std::string_view header, std::string_view name);

}  // namespace amble::serving
