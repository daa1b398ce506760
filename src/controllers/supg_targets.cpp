#include "amble/controllers/supg_targets.hpp"

#include <algorithm>
#include <bit>
#include <cstring>

#include "amble/controllers/modulation.hpp"
#include "amble/core/simd_targets.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "amble/controllers/supg_targets.cpp"
#include <hwy/foreach_target.h>

#include "amble/controllers/for_lanes-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace amble::controllers::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

/// Four numbers that lie together, of as many types of joints: a type that GCC and Clang have for every
/// processor.
using Four = float __attribute__((vector_size(16)));

HWY_INLINE Four four_at(const float* from) {
  Four four;
  std::memcpy(&four, from, sizeof four);
  return four;
}

HWY_INLINE Four between(const float* from, const float* next, float share) {
  const Four here = four_at(from);
  return here + share * (four_at(next) - here);
}

/// Four lanes' numbers become four types' numbers.
HWY_INLINE void transpose(Four (&rows)[4]) {
  const Four ab_low = __builtin_shufflevector(rows[0], rows[1], 0, 4, 1, 5),
             ab_high = __builtin_shufflevector(rows[0], rows[1], 2, 6, 3, 7);
  const Four cd_low = __builtin_shufflevector(rows[2], rows[3], 0, 4, 1, 5),
             cd_high = __builtin_shufflevector(rows[2], rows[3], 2, 6, 3, 7);
  rows[0] = __builtin_shufflevector(ab_low, cd_low, 0, 1, 4, 5);
  rows[1] = __builtin_shufflevector(ab_low, cd_low, 2, 3, 6, 7);
  rows[2] = __builtin_shufflevector(ab_high, cd_high, 0, 1, 4, 5);
  rows[3] = __builtin_shufflevector(ab_high, cd_high, 2, 3, 6, 7);
}

/// The entries of a leg.
HWY_INLINE void write_entries(const float* const* tables, const std::int32_t* timers, int types, int lanes,
                              float* const* to) {
  const auto entry = [&](int lane, int type) HWY_ATTR {
    return four_at(tables[lane] + static_cast<std::ptrdiff_t>(timers[lane]) * types + type);
  };
  for (int type = 0; type < types; type += 4) {
    const int some = std::min(4, types - type);
    int lane = 0;
    for (; lane + 4 <= lanes; lane += 4) {
      Four rows[4] = {entry(lane, type), entry(lane + 1, type), entry(lane + 2, type), entry(lane + 3, type)};
      transpose(rows);
      for (int i = 0; i < some; ++i)
        if (to[type + i] != nullptr) std::memcpy(to[type + i] + lane, &rows[i], sizeof rows[i]);
    }
    for (; lane < lanes; ++lane) {
      const Four y = entry(lane, type);
      for (int i = 0; i < some; ++i)
        if (to[type + i] != nullptr) to[type + i][lane] = y[i];
    }
  }
}

void entries(const TargetEntries& of, int types, int lanes) {
  const auto legs = types > 0 ? static_cast<int>(of.to.size()) / types : 0;
  for (int leg = 0; leg < legs; ++leg)
    write_entries(of.tables + leg * lanes, of.timers + leg * lanes, types, lanes, of.to.data() + leg * types);
}

/// Four types at a time, the rows of what target(lane, type) says for the lanes from `lane` to `end`.
template <typename Target>
HWY_INLINE void write_lane_by_lane(Target target, int lane, int end, int types, std::ptrdiff_t lanes,
                                   float* to) {
  for (int type = 0; type < types; type += 4) {
    float* const row = to + type * lanes;
    int at = lane;
    for (; at + 4 <= end; at += 4) {
      Four rows[4] = {target(at, type), target(at + 1, type), target(at + 2, type), target(at + 3, type)};
      transpose(rows);
      for (int i = 0; i < 4; ++i) std::memcpy(row + i * lanes + at, &rows[i], sizeof rows[i]);
    }
    for (; at < end; ++at) {
      const Four y = target(at, type);
      for (int i = 0; i < 4; ++i) row[i * lanes + at] = y[i];
    }
  }
}

/// The measures of tables with `known` channels and at most four types of joints, or of any if that is
/// negative.
template <int known>
struct Measures {
  HWY_INLINE explicit Measures(const TargetTables&) {}
  static constexpr int channels = known, width = 4, stride_bits = std::bit_width(4u * (known + 1u) - 1u),
                       least_stride = 1 << stride_bits;
};
template <>
struct Measures<-1> {
  HWY_INLINE explicit Measures(const TargetTables& tables)
      : channels(tables.channels), width(tables.width), stride_bits(tables.stride_bits) {}
  int channels, width, stride_bits;
  static constexpr int least_stride = 16;  // of what can be looked up by vectors
};

/// Where lanes' timers are in their tables: at an entry, and how far on the way to the next. These are worked
/// out for many lanes before any is looked up, so that no address is waited for.
struct Places {
  static constexpr int most = 64;
  const float* entries[most];
  float shares[most];
  const float* says;  ///< there, channel by channel
  std::size_t says_stride;

  HWY_INLINE Places(const TargetTables& tables, int stride_bits, const std::int32_t* timers, int first,
                    int count)
      : says(tables.channels > 0 ? tables.says + first : nullptr), says_stride(tables.says_stride) {
    std::int32_t at[most];
    for_lanes(count, [&](auto f, int lane) HWY_ATTR {
      const hn::RebindToSigned<decltype(f)> i;
      const auto timer = hn::LoadU(i, timers + first + lane), one = hn::Set(i, 1);
      const auto stands = hn::Lt(timer, hn::Zero(i));
      const auto entry = hn::IfThenZeroElse(stands, hn::Add(hn::ShiftRight<parts_bits>(timer), one));
      const auto part = hn::IfThenZeroElse(stands, hn::And(timer, hn::Set(i, parts_per_tick - 1)));
      hn::StoreU(entry, i, at + lane);
      hn::StoreU(hn::Mul(hn::ConvertTo(f, part), hn::Set(f, 1.0f / parts_per_tick)), f, shares + lane);
    });
    for (int lane = 0; lane < count; ++lane)
      entries[lane] = tables.tables[first + lane] + (static_cast<std::ptrdiff_t>(at[lane]) << stride_bits);
  }
};

/// Four types' targets of a lane.
template <typename Of>
HWY_INLINE Four target_at(const Of& of, const Places& at, int lane, int type) {
  const std::size_t next = std::size_t{1} << of.stride_bits;
  const float *entry = at.entries[lane] + type, *says = of.channels > 0 ? at.says + lane : nullptr;
  const float share = at.shares[lane];
  Four y = between(entry, entry + next, share);
  for (int channel = 0; channel < of.channels; ++channel, says += at.says_stride) {
    entry += of.width;
    y += between(entry, entry + next, share) * *says;
  }
  return y;
}

#if HWY_MAX_BYTES >= 32
/// Rows and columns of 128 bits change places: vector j becomes what was at place j in each.
template <typename D, typename Vec = hn::Vec<D>>
HWY_INLINE void transpose_blocks(D f, Vec (&v)[hn::MaxLanes(D()) / 4]) {
  if constexpr (hn::MaxLanes(D()) == 8) {
    const Vec low = hn::ConcatLowerLower(f, v[1], v[0]);
    v[1] = hn::ConcatUpperUpper(f, v[1], v[0]);
    v[0] = low;
  } else {
    const Vec even01 = hn::OddEvenBlocks(hn::SwapAdjacentBlocks(v[1]), v[0]),
              odd01 = hn::OddEvenBlocks(v[1], hn::SwapAdjacentBlocks(v[0])),
              even23 = hn::OddEvenBlocks(hn::SwapAdjacentBlocks(v[3]), v[2]),
              odd23 = hn::OddEvenBlocks(v[3], hn::SwapAdjacentBlocks(v[2]));
    v[0] = hn::ConcatLowerLower(f, even23, even01);
    v[1] = hn::ConcatLowerLower(f, odd23, odd01);
    v[2] = hn::ConcatUpperUpper(f, even23, even01);
    v[3] = hn::ConcatUpperUpper(f, odd23, odd01);
  }
}

/// As many numbers as a vector has, together in an entry.
template <typename D>
HWY_INLINE hn::Vec<D> between(D f, const float* from, std::size_t next, float share) {
  const auto here = hn::LoadU(f, from);
  return hn::Add(here, hn::Mul(hn::Set(f, share), hn::Sub(hn::LoadU(f, from + next), here)));
}

/// Four types' targets of the lanes k, k + 4, k + 8 … of as many as a vector has numbers.
template <int k, typename D, typename Of>
HWY_INLINE hn::Vec<D> targets_at(D f, const Of& of, const Places& at, int lane) {
  constexpr int blocks = static_cast<int>(hn::MaxLanes(f)) / 4;
  const std::size_t next = std::size_t{1} << of.stride_bits;
  const float* const* const entries = at.entries + lane + k;
  const float* const shares = at.shares + lane + k;
  auto y = hn::Zero(f);
  for (int group = 0; group <= of.channels; group += blocks) {
    hn::Vec<D> there[blocks];
    for (int b = 0; b < blocks; ++b) there[b] = between(f, entries[4 * b] + 4 * group, next, shares[4 * b]);
    transpose_blocks(f, there);
    for (int b = 0; b < blocks; ++b) {
      const int channel = group + b - 1;
      if (channel >= of.channels) break;
      if (channel < 0) {
        y = there[b];
        continue;
      }
      const auto says = hn::LoadU(f, at.says + static_cast<std::size_t>(channel) * at.says_stride + lane);
      y = hn::Add(y, hn::Mul(there[b], hn::Broadcast<k>(says)));
    }
  }
  return y;
}

/// Four rows, of lanes 0, 4 … in a, 1, 5 … in b and so on, type by type.
template <typename D, typename Vec = hn::Vec<D>>
HWY_INLINE void write_rows(D f, Vec a, Vec b, Vec c, Vec d, std::ptrdiff_t lanes, float* to) {
  const Vec ac_low = hn::InterleaveLower(f, a, c), ac_high = hn::InterleaveUpper(f, a, c),
            bd_low = hn::InterleaveLower(f, b, d), bd_high = hn::InterleaveUpper(f, b, d);
  hn::StoreU(hn::InterleaveLower(f, ac_low, bd_low), f, to);
  hn::StoreU(hn::InterleaveUpper(f, ac_low, bd_low), f, to + lanes);
  hn::StoreU(hn::InterleaveLower(f, ac_high, bd_high), f, to + 2 * lanes);
  hn::StoreU(hn::InterleaveUpper(f, ac_high, bd_high), f, to + 3 * lanes);
}

/// Writes the first of `some` lanes, as many as fill vectors that hold several groups of an entry. How many.
template <typename Of>
HWY_INLINE int write_wide(const Of& of, const Places& at, int some, std::ptrdiff_t lanes, float* to) {
  constexpr int wide = std::min(width, Of::least_stride);
  int lane = 0;
  if constexpr (wide > 4) {
    // Without channels most of a vector would be looked up for nothing.
    if (of.width != 4 || of.channels == 0 || 1 << of.stride_bits < wide) return 0;
    const hn::CappedTag<float, wide> f;
    for (; lane + wide <= some; lane += wide)
      write_rows(f, targets_at<0>(f, of, at, lane), targets_at<1>(f, of, at, lane),
                 targets_at<2>(f, of, at, lane), targets_at<3>(f, of, at, lane), lanes, to + lane);
  }
  return lane;
}
#else
template <typename Of>
HWY_INLINE int write_wide(const Of&, const Places&, int, std::ptrdiff_t, float*) {
  return 0;
}
#endif

template <int known>
HWY_INLINE void targets_of(const TargetTables& tables, const std::int32_t* timers, int first, int end,
                           std::ptrdiff_t lanes, float* targets_rad) {
  const Measures<known> of(tables);
  for (; first < end; first += Places::most) {
    const int some = std::min(Places::most, end - first);
    const Places at(tables, of.stride_bits, timers, first, some);
    float* const to = targets_rad + first;
    const int written = write_wide(of, at, some, lanes, to);
    write_lane_by_lane([&](int lane, int type) HWY_ATTR { return target_at(of, at, lane, type); }, written,
                       some, of.width, lanes, to);
  }
}

void targets(const TargetTables& tables, const std::int32_t* timers, int first, int end, int count,
             float* targets_rad) {
  const unsigned used = 4u * static_cast<unsigned>(tables.channels + 1);
  const bool packed = tables.width == 4 && tables.stride_bits == static_cast<int>(std::bit_width(used - 1u));
  switch (packed ? tables.channels : -1) {
    case 0:
      return targets_of<0>(tables, timers, first, end, count, targets_rad);
    case 1:
      return targets_of<1>(tables, timers, first, end, count, targets_rad);
    case 2:
      return targets_of<2>(tables, timers, first, end, count, targets_rad);
    case 3:
      return targets_of<3>(tables, timers, first, end, count, targets_rad);
    default:
      return targets_of<-1>(tables, timers, first, end, count, targets_rad);
  }
}

}  // namespace amble::controllers::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace amble::controllers {

HWY_EXPORT(entries);
HWY_EXPORT(targets);

void run_entries(const TargetEntries& of, int types, int lanes) {
  HWY_DYNAMIC_DISPATCH(entries)(of, types, lanes);
}

void run_targets(const TargetTables& tables, const std::int32_t* timers, int first, int end, int count,
                 float* targets_rad) {
  HWY_DYNAMIC_DISPATCH(targets)(tables, timers, first, end, count, targets_rad);
}

}  // namespace amble::controllers
#endif
