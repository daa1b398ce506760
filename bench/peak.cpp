#include "bench/table.hpp"
#include "bench/walkers.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "bench/peak.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace amble::bench::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

/// Twelve sums hide the latency of a fused multiply-add and fit into the registers of every instruction set.
constexpr int sums = 12;

/// Returns how many FLOP it did; `factor` is below 1.
double multiply_add(int rounds, float factor, float* result) {
  const hn::CappedTag<float, 16> d;
  using V = hn::Vec<decltype(d)>;
  const V f = hn::Set(d, factor);
  V s0 = f, s1 = f, s2 = f, s3 = f, s4 = f, s5 = f, s6 = f, s7 = f, s8 = f, s9 = f, s10 = f, s11 = f;
  for (int i = 0; i < rounds; ++i) {
    s0 = hn::MulAdd(s0, f, f);
    s1 = hn::MulAdd(s1, f, f);
    s2 = hn::MulAdd(s2, f, f);
    s3 = hn::MulAdd(s3, f, f);
    s4 = hn::MulAdd(s4, f, f);
    s5 = hn::MulAdd(s5, f, f);
    s6 = hn::MulAdd(s6, f, f);
    s7 = hn::MulAdd(s7, f, f);
    s8 = hn::MulAdd(s8, f, f);
    s9 = hn::MulAdd(s9, f, f);
    s10 = hn::MulAdd(s10, f, f);
    s11 = hn::MulAdd(s11, f, f);
#if defined(__GNUC__) && HWY_ARCH_X86
    // Sums that start alike are not one sum to the compiler.
    __asm__ volatile(""
                     : "+x"(s0.raw), "+x"(s1.raw), "+x"(s2.raw), "+x"(s3.raw), "+x"(s4.raw), "+x"(s5.raw),
                       "+x"(s6.raw), "+x"(s7.raw), "+x"(s8.raw), "+x"(s9.raw), "+x"(s10.raw), "+x"(s11.raw));
#endif
  }
  const V sum = hn::Add(
      hn::Add(hn::Add(s0, s1), hn::Add(s2, s3)),
      hn::Add(hn::Add(hn::Add(s4, s5), hn::Add(s6, s7)), hn::Add(hn::Add(s8, s9), hn::Add(s10, s11))));
  *result = hn::GetLane(sum);
  return 2.0 * sums * static_cast<double>(hn::Lanes(d)) * rounds;
}

}  // namespace amble::bench::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace amble::bench {

HWY_EXPORT(multiply_add);

double peak_flop_per_s() {
  double flop = 0.0;
  volatile float result = 0.0f;
  const double seconds = seconds_per_call([&] {
    float sum = 0.0f;
    flop = HWY_DYNAMIC_DISPATCH(multiply_add)(1000000, 0.5f, &sum);
    result = sum;
  });
  return flop / seconds;
}

}  // namespace amble::bench
#endif
