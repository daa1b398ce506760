/* Reset of a RISC-V machine without any library. */
#include <stdint.h>

int main(void);
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

__attribute__((naked, used, section(".start"))) void start(void) {
  __asm__ volatile("la sp, stack_end\ncall main\n1: j 1b");
}
