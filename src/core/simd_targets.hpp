// Which instruction sets kernels on simd-inl.hpp are compiled for; included before Highway's headers.
#pragma once

// Left out: those that would only repeat the code of their neighbours, those without a fused multiply-add
// (SSSE3, SSE4: emulated, they are too slow to be worth half of the time it takes to compile), and those
// whose vectors cannot be members of a class (SVE; aarch64 has NEON). With AMBLE_FEW_INSTRUCTION_SETS
// (sanitizers) AVX2 and the baseline represent the rest.
#define AMBLE_SCALABLE_TARGETS (HWY_SVE | HWY_SVE2 | HWY_SVE_256 | HWY_SVE2_128 | HWY_RVV)
#ifdef AMBLE_FEW_INSTRUCTION_SETS
#define HWY_DISABLED_TARGETS (HWY_SSSE3 | HWY_SSE4 | HWY_AVX3 | HWY_AVX3_DL | AMBLE_SCALABLE_TARGETS)
#else
#define HWY_DISABLED_TARGETS (HWY_SSSE3 | HWY_SSE4 | HWY_AVX3_DL | AMBLE_SCALABLE_TARGETS)
#endif
