#pragma once

#include "amble/core/random.hpp"
#include "amble/neat/genome.hpp"
#include "amble/search/settings.hpp"

namespace amble::search {

/// A copy of `parent` whose weights moved along the line to `mate` (Vassiliades & Mouret 2018, "iso+line"):
/// those of links that both have by the difference too, others by their own step alone. No weight is held to
/// a limit.
neat::Genome moved_along_line(const neat::Genome& parent, const neat::Genome& mate,
                              const LineSettings& settings, Stream& stream);

}  // namespace amble::search
