/* Vectors and reset of a Cortex-M without any library. The linker script (cortex_m.ld) names the sections. */
#include <stdint.h>

extern uint32_t data_in_flash[], data_begin[], data_end[], bss_begin[], bss_end[], stack_end[];
int main(void);
void systick_handler(void);

__attribute__((weak)) void systick_handler(void) {}

/* What the compiler may call for copies and clears of structs. */
void *memset(void *to, int byte, __SIZE_TYPE__ count);
void *memcpy(void *to, const void *from, __SIZE_TYPE__ count);

__attribute__((optimize("no-tree-loop-distribute-patterns"))) void *memset(void *to, int byte,
                                                                           __SIZE_TYPE__ count) {
  unsigned char *at = to;
  while (count-- > 0) *at++ = (unsigned char)byte;
  return to;
}

__attribute__((optimize("no-tree-loop-distribute-patterns"))) void *memcpy(void *to, const void *from,
                                                                           __SIZE_TYPE__ count) {
  unsigned char *at = to;
  const unsigned char *source = from;
  while (count-- > 0) *at++ = *source++;
  return to;
}

static void reset(void) {
  const uint32_t *from = data_in_flash;
  for (uint32_t *to = data_begin; to < data_end;) *to++ = *from++;
  for (uint32_t *to = bss_begin; to < bss_end;) *to++ = 0;
#ifdef __ARM_FP
  /* CPACR: full access to the FPU. */
  *(volatile uint32_t *)0xe000ed88u |= 0xfu << 20;
  __asm__ volatile("dsb\nisb");
#endif
  main();
  for (;;) {
  }
}

static void stop(void) {
  for (;;) {
  }
}

typedef void (*vector)(void);
/* The first is the stack pointer; then reset, faults, and at place 15 SysTick. */
__attribute__((section(".vectors"), used)) static const vector vectors[16] = {
    (vector)(uintptr_t)stack_end, reset, stop, stop, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, systick_handler};
