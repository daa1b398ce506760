#pragma once

#include <string_view>

namespace amble::cli {

/// Writes to the standard error, unbuffered. Write errors are ignored: a full log must not stop a run.
void print_message(std::string_view text);

/// Opens each of the three standard streams that the caller has closed on /dev/null, such that access fails;
/// otherwise the next file to be opened would get its descriptor, and messages would end up in that file. To
/// be called before any file is opened.
void reserve_standard_streams();

}  // namespace amble::cli
