/* The exported controller "walker" on a bare processor: reads the file walker.in of the host, writes walker.out
 * (both as tests/exporting/replay.c has them), and prints the instructions of a step, mean and most. To be run
 * in QEMU with -icount, where SysTick and minstret count instructions. */
#include "semihosting.h"
#include "walker.h"

enum { inputs = WALKER_JOINTS + WALKER_LEGS + 3 };
#ifdef WALKER_NEURONS
enum { states = WALKER_NEURONS };
#else
enum { states = 2 * WALKER_LEGS };
#endif

static walker_state state;
static walker_sensors sensors;
static walker_targets targets;
static float in[inputs], out[WALKER_JOINTS + states];

#ifdef __riscv
static void start_counting(void) {}
static uint32_t now(void) {
  uint32_t count;
  __asm__ volatile(".option push\n.option arch, +zicsr\ncsrr %0, minstret\n.option pop" : "=r"(count));
  return count;
}
static uint32_t since(uint32_t then) { return now() - then; }
#else
#define SYSTICK ((volatile uint32_t *)0xe000e010u)
static void start_counting(void) {
  SYSTICK[1] = 0xffffffu;
  SYSTICK[2] = 0;
  SYSTICK[0] = 5; /* the processor's clock, no interrupt */
}
static uint32_t now(void) { return SYSTICK[2]; }
static uint32_t since(uint32_t then) { return (then - now()) & 0xffffffu; }
#endif

/* Counts of 200 instructions, beside those of reading the counter. */
__attribute__((noinline)) static uint32_t counts_per_200(uint32_t *of_reading) {
  uint32_t then = now();
  *of_reading = since(then);
  then = now();
  __asm__ volatile(".rept 200\nnop\n.endr");
  return since(then) - *of_reading;
}

static void print_number(const char *before, uint32_t number) {
  char text[12];
  int at = 11;
  text[at] = 0;
  do {
    text[--at] = (char)('0' + number % 10);
    number /= 10;
  } while (number > 0);
  semihosting_print(before);
  semihosting_print(text + at);
}

static void sense(void) {
  int i;
  (void)i;
#if WALKER_READS_ANGLES
  for (i = 0; i < WALKER_JOINTS; ++i) sensors.angle_rad[i] = in[i];
#endif
#if WALKER_READS_TOUCH
  for (i = 0; i < WALKER_LEGS; ++i) {
#ifdef WALKER_FRACTION_BITS
    sensors.touch[i] = in[WALKER_JOINTS + i] > 0.5f;
#else
    sensors.touch[i] = in[WALKER_JOINTS + i];
#endif
  }
#endif
#if WALKER_READS_ATTITUDE
  sensors.roll_rad = in[WALKER_JOINTS + WALKER_LEGS];
  sensors.pitch_rad = in[WALKER_JOINTS + WALKER_LEGS + 1];
  sensors.yaw_rad = in[WALKER_JOINTS + WALKER_LEGS + 2];
#endif
}

static void answer(void) {
  int i;
  for (i = 0; i < WALKER_JOINTS; ++i) {
#ifdef WALKER_FRACTION_BITS
    out[i] = (float)targets.angle[i] / (float)(1L << WALKER_FRACTION_BITS);
#else
    out[i] = targets.angle_rad[i];
#endif
  }
#ifdef WALKER_NEURONS
  for (i = 0; i < WALKER_NEURONS; ++i) out[WALKER_JOINTS + i] = state.neuron[i];
#else
  for (i = 0; i < WALKER_LEGS; ++i) {
    out[WALKER_JOINTS + i] = (float)state.timer[i];
    out[WALKER_JOINTS + WALKER_LEGS + i] = (float)state.trigger[i];
  }
#endif
}

int main(void) {
  const uintptr_t from = semihosting_open("walker.in", 9, 1), to = semihosting_open("walker.out", 10, 5);
  uint32_t of_reading, per_200, ticks = 0, most = 0;
  uint64_t all = 0;
  start_counting();
  per_200 = counts_per_200(&of_reading);
  walker_init(&state);
  while (semihosting_transfer(SEMIHOSTING_READ, from, in, sizeof in) == 0) {
    uint32_t then, count;
    sense();
    then = now();
    walker_step(&state, &sensors, &targets);
    count = since(then) - of_reading;
    all += count;
    if (count > most) most = count;
    ++ticks;
    answer();
    semihosting_transfer(SEMIHOSTING_WRITE, to, out, sizeof out);
  }
  print_number("instructions ", ticks ? (uint32_t)(all * 200 / per_200 / ticks) : 0);
  print_number(" ", (uint32_t)((uint64_t)most * 200 / per_200));
  semihosting_print("\n");
  semihosting_exit(1);
  return 0;
}
