#pragma once

#include <cstdint>

#if defined(__SSE__)
#include <xmmintrin.h>
#endif

namespace amble::physics::batch {

/// While it lives, this thread reads and writes denormal numbers as zero: they cost a hundredfold. Where a
/// processor has no such switch (WebAssembly) denormals stay, and bits differ from x86 where they occur. On
/// aarch64 they differ where a result that is not normal would have been rounded up to the least normal
/// number: x86 asks after rounding, aarch64 before.
class DenormalsAreZero {
 public:
  DenormalsAreZero() : before_(control()) { set_control(before_ | switched); }
  ~DenormalsAreZero() { set_control(before_); }
  DenormalsAreZero(const DenormalsAreZero&) = delete;
  DenormalsAreZero& operator=(const DenormalsAreZero&) = delete;

 private:
#if defined(__SSE__)
  using Control = unsigned;
  static constexpr Control switched = 0x8000 | 0x0040;  // results; operands
  static Control control() {
    return _mm_getcsr();
  }
  static void set_control(Control value) {
    _mm_setcsr(value);
  }
#elif defined(__aarch64__)
  using Control = std::uint64_t;
  static constexpr Control switched = Control{1} << 24;  // FZ: results and operands
  static Control control() {
    Control value;
    asm volatile("mrs %0, fpcr" : "=r"(value));
    return value;
  }
  static void set_control(Control value) {
    asm volatile("msr fpcr, %0" : : "r"(value) : "memory");
  }
#else
  using Control = unsigned;
  static constexpr Control switched = 0;
  static Control control() {
    return 0;
  }
  static void set_control(Control) {}
#endif

  Control before_;
};

}  // namespace amble::physics::batch
