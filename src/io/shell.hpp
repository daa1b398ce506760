#pragma once

#include <string>
#include <string_view>

namespace amble::io {

/// `text` in single quotes, within which shells take everything literally.
std::string shell_quoted(std::string_view text);

/// `text` as one word of a command that a reader may paste into a shell (bash, zsh, dash, fish): as it is
/// where that works, else in quotes. With control characters it is $'…', which bash and zsh read, so that it
/// stays on one line. For all commands that are printed.
std::string shell_word(std::string_view text);

}  // namespace amble::io
