#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

/// Looking up the targets of SUPGs (rad) in their tables, for all legs and lanes of a batch: leg by leg, each
/// over the lanes. As in supg_kernel.hpp, all instruction sets give the same bits.
namespace amble::controllers {

/// Entries of the paper's SUPGs at their timers; three numbers behind each are read.
struct TargetEntries {
  const float* const* tables;  ///< the leg's targets at timer 0
  const std::int32_t* timers;  ///< ticks
  std::span<float* const> to;  ///< leg by leg, type by type: a row of lanes; null: none
};
void run_entries(const TargetEntries& entries, int types, int lanes);

/// Tables of modulated SUPGs (Modulation), and what their channels say.
struct TargetTables {
  const float* const* tables;  ///< the leg's entry at timer −1
  int stride_bits, width, channels;
  const float* says;  ///< channel by channel
  std::size_t says_stride;
};
/// The targets of those from `first` to `end` − 1 at their timers (parts of a tick, −1: stopped), type by
/// type, rows of `count`.
void run_targets(const TargetTables& tables, const std::int32_t* timers, int first, int end, int count,
                 float* targets_rad);

}  // namespace amble::controllers
