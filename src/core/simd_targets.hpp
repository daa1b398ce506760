// Which instruction sets kernels on simd-inl.hpp are compiled for; included before Highway's headers.
#pragma once

// Left out: those that would only repeat the code of their neighbours, those without a fused multiply-add
// (SSSE3, SSE4: emulated, they are too slow to be worth half of the time it takes to compile), and those
// without a fixed width. With AMBLE_FEW_INSTRUCTION_SETS (sanitizers) AVX2 and the baseline represent the
// rest.
#ifdef AMBLE_FEW_INSTRUCTION_SETS
#define HWY_DISABLED_TARGETS (HWY_SSSE3 | HWY_SSE4 | HWY_AVX3 | HWY_AVX3_DL | HWY_SVE | HWY_SVE2 | HWY_RVV)
#else
#define HWY_DISABLED_TARGETS (HWY_SSSE3 | HWY_SSE4 | HWY_AVX3_DL | HWY_SVE | HWY_SVE2 | HWY_RVV)
#endif
