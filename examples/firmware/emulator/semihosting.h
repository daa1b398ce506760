/* Semihosting: files and the standard output of the machine that debugs or emulates. Arm "Semihosting for
 * AArch32 and AArch64"; RISC-V uses the same calls. */
#ifndef SEMIHOSTING_H
#define SEMIHOSTING_H

#include <stdint.h>

enum { SEMIHOSTING_OPEN = 0x01, SEMIHOSTING_WRITE0 = 0x04, SEMIHOSTING_WRITE = 0x05, SEMIHOSTING_READ = 0x06, SEMIHOSTING_EXIT = 0x18 };

static inline uintptr_t semihosting_call(uintptr_t operation, uintptr_t argument) {
#ifdef __riscv
  register uintptr_t a0 __asm__("a0") = operation;
  register uintptr_t a1 __asm__("a1") = argument;
  __asm__ volatile(
      ".option push\n.option norvc\n.balign 16\nslli x0, x0, 0x1f\nebreak\nsrai x0, x0, 7\n.option pop"
      : "+r"(a0)
      : "r"(a1)
      : "memory");
  return a0;
#else
  register uintptr_t r0 __asm__("r0") = operation;
  register uintptr_t r1 __asm__("r1") = argument;
  __asm__ volatile("bkpt 0xab" : "+r"(r0) : "r"(r1) : "memory");
  return r0;
#endif
}

static inline void semihosting_print(const char *text) {
  semihosting_call(SEMIHOSTING_WRITE0, (uintptr_t)text);
}

/* Opens a file of the host; modes as of fopen: 1 is "rb", 5 "wb". */
static inline uintptr_t semihosting_open(const char *name, uintptr_t name_length, uintptr_t mode) {
  const uintptr_t arguments[3] = {(uintptr_t)name, mode, name_length};
  return semihosting_call(SEMIHOSTING_OPEN, (uintptr_t)arguments);
}

/* Number of bytes that were not read or written. */
static inline uintptr_t semihosting_transfer(uintptr_t operation, uintptr_t file, void *data, uintptr_t size) {
  const uintptr_t arguments[3] = {file, (uintptr_t)data, size};
  return semihosting_call(operation, (uintptr_t)arguments);
}

static inline void semihosting_exit(int good) {
  semihosting_call(SEMIHOSTING_EXIT, good ? 0x20026u : 0x20023u);
  for (;;) {
  }
}

#endif
