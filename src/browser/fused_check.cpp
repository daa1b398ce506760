#include "amble/browser/fused_check.hpp"

#include "amble/core/simd_targets.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "amble/browser/fused_check.cpp"
#include <hwy/foreach_target.h>

#include "amble/core/simd-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace amble::browser::HWY_NAMESPACE {

using namespace simd::HWY_NAMESPACE;

/// Products whose last bits are lost unless they are added unrounded, and two whose sums, rounded to double
/// first, would be rounded twice.
bool check() {
  struct Case {
    float a, b, c, sum;
  };
  constexpr Case cases[] = {
      {0x1.000002p0f, 0x1.000002p0f, -0x1.000004p0f, 0x1p-46f},
      {0x1.fffffep0f, 0x1.fffffep0f, -0x1.fffffcp1f, 0x1p-46f},
      {0x1.000002p0f, 0x1.fffffep-1f, -1.0f, 0x1.fffffcp-25f},
      {0x1.babeaep0f, 0x1.180732p0f, 0x1.66515ap8f, 0x1.6835a6p8f},
      {0x1.54924ep0f, 0x1.fd2d2ep0f, 0x1.edf76ep8f, 0x1.f09cd2p8f},
  };
  HWY_ALIGN float a[width], b[width], c[width], sum[width];
  bool fused = true;
  for (const Case& one : cases) {
    for (int i = 0; i < width; ++i) {
      volatile float hidden = one.a;  // not to be computed when compiled
      a[i] = hidden;
      b[i] = one.b;
      c[i] = one.c;
    }
    store(fma(load(a), load(b), load(c)), sum);
    for (int i = 0; i < width; ++i) fused = fused && sum[i] == one.sum;
    store(fnma(load(a), load(b), load(c)), sum);
    for (int i = 0; i < width; ++i) a[i] = -a[i];
    store(fma(load(a), load(b), load(c)), b);
    for (int i = 0; i < width; ++i) fused = fused && sum[i] == b[i];
  }
  return fused;
}

}  // namespace amble::browser::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace amble::browser {

HWY_EXPORT(check);

bool is_fused() {
  return HWY_DYNAMIC_DISPATCH(check)();
}

}  // namespace amble::browser
#endif
