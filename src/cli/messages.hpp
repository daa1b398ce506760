#pragma once

#include <string>
#include <string_view>

namespace amble::cli {

/// Writes to the standard error, unbuffered. Write errors are ignored: a full log must not stop a run.
void print_message(std::string_view text);

/// Width of the terminal that the standard error is, in characters; 0 if it is none, or tells no width.
int terminal_columns();
/// The text, or if it has more characters than `most` its beginning with an ellipsis; 0: any number will do.
std::string shortened(std::string_view text, int most);

/// Opens each of the three standard streams that the caller has closed on /dev/null, such that access fails;
/// otherwise the next file to be opened would get its descriptor, and messages would end up in that file. To
/// be called before any file is opened.
void reserve_standard_streams();

}  // namespace amble::cli
