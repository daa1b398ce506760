#pragma once

#if defined(__SSE__)
#include <xmmintrin.h>
#endif

namespace amble::physics::batch {

/// While it lives, this thread reads and writes denormal numbers as zero: they cost a hundredfold. Only
/// x86 has it; elsewhere denormals stay, and bits may differ from x86 where they occur.
class DenormalsAreZero {
 public:
#if defined(__SSE__)
  DenormalsAreZero() : before_(_mm_getcsr()) {
    _mm_setcsr(before_ | flush_to_zero | denormals_are_zero);
  }
  ~DenormalsAreZero() {
    _mm_setcsr(before_);
  }
#else
  DenormalsAreZero() {}
#endif
  DenormalsAreZero(const DenormalsAreZero&) = delete;
  DenormalsAreZero& operator=(const DenormalsAreZero&) = delete;

#if defined(__SSE__)
 private:
  static constexpr unsigned flush_to_zero = 0x8000, denormals_are_zero = 0x0040;
  unsigned before_;
#endif
};

}  // namespace amble::physics::batch
