#pragma once

#include <string_view>

namespace amble::cli {

/// To the standard error, at once. What cannot be written there is lost: a log that is full is no reason to
/// stop a run.
void say(std::string_view text);

/// Gives each of the three standard streams that the caller has closed a place of its own, which refuses what
/// does not belong there; else the next file to be opened would take it, and messages would end up in that
/// file. To be called before any file is opened.
void hold_standard_streams();

}  // namespace amble::cli
