#pragma once

namespace amble::browser {

/// In which all walk here: the engine that needs no library.
inline constexpr const char* engine = "batch";

}  // namespace amble::browser
