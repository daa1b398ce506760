#pragma once

namespace amble::io {

/// What to do with a sealed file of which only the checksum is wrong.
enum class Altered { refuse, accept };

}  // namespace amble::io
