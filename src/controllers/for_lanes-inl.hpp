// Loops over lanes, for each instruction set: included once per target through Highway's foreach_target.
#if defined(AMBLE_CONTROLLERS_FOR_LANES_INL_HPP) == defined(HWY_TARGET_TOGGLE)
#ifdef AMBLE_CONTROLLERS_FOR_LANES_INL_HPP
#undef AMBLE_CONTROLLERS_FOR_LANES_INL_HPP
#else
#define AMBLE_CONTROLLERS_FOR_LANES_INL_HPP
#endif

#include "amble/core/simd-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace amble::controllers::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

using simd::HWY_NAMESPACE::Floats;
using simd::HWY_NAMESPACE::width;
using OneFloat = hn::CappedTag<float, 1>;  // for lanes that are left over

/// work(tag, lane) for so many lanes at a time as the tag has.
template <typename Work>
HWY_INLINE void for_lanes(int count, Work work) {
  int lane = 0;
  for (; lane + width <= count; lane += width) work(Floats(), lane);
  for (; lane < count; ++lane) work(OneFloat(), lane);
}

}  // namespace amble::controllers::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // toggled by HWY_TARGET_TOGGLE
