/* Two bare processors in QEMU: a Cortex-M0 (nRF51, BBC micro:bit), whose ticks are those of SysTick, and RV32IMC as in
 * an ESP32-C3, whose ticks are those of RISC-V's machine timer. The robot is armed after half a second, its feet are those of
 * somebody who walks on the spot, and the servos' pulses go to the standard output by semihosting. */
#include "robot.h"
#include "script.h"
#include "sense.h"
#include "semihosting.h"

enum { arm_tick = AT(50), last_tick = AT(600) };

static robot walker;
static uint32_t ticks_done, missed;

#ifdef __riscv

/* Low words; the machine "virt" counts at 10 MHz, so they go round after seven minutes. */
#define MTIME (*(volatile uint32_t *)0x0200bff8u)
#define MTIMECMP ((volatile uint32_t *)0x02004000u)
enum { counts_per_tick = 10 * WALKER_TICK_US, machine_timer = 1 << 7 };

static uint32_t start;

static void start_ticks(void) {
  start = MTIME;
  __asm__ volatile(".option push\n.option arch, +zicsr\ncsrs mie, %0\n.option pop" : : "r"(machine_timer));
}

static uint32_t ticks_now(void) { return (MTIME - start) / counts_per_tick; }

/* The timer wakes the processor; no interrupt is taken. */
static void sleep(void) {
  MTIMECMP[1] = 0xffffffffu;
  MTIMECMP[0] = start + (ticks_done + 1u) * counts_per_tick;
  MTIMECMP[1] = 0;
  __asm__ volatile("wfi");
}

#else

#define SYSTICK ((volatile uint32_t *)0xe000e010u)
enum { clock_hz = 16000000 };

static volatile uint32_t ticks;

void systick_handler(void);
void systick_handler(void) { ++ticks; }

static void start_ticks(void) {
  SYSTICK[1] = (uint32_t)((uint64_t)clock_hz * WALKER_TICK_US / 1000000u) - 1u;
  SYSTICK[2] = 0;
  SYSTICK[0] = 7; /* the processor's clock, with interrupts */
}

static uint32_t ticks_now(void) { return ticks; }

static void sleep(void) { __asm__ volatile("wfi"); }

#endif

static void print_number(const char *before, int32_t number) {
  char text[12];
  int at = 11;
  uint32_t left = (uint32_t)(number < 0 ? -number : number);
  text[at] = 0;
  do {
    text[--at] = (char)('0' + left % 10u);
    left /= 10u;
  } while (left > 0);
  if (number < 0) text[--at] = '-';
  semihosting_print(before);
  semihosting_print(text + at);
}

static int wait_for_tick(void) {
  missed += ticks_now() - ticks_done;
  while (ticks_now() == ticks_done) sleep();
  ticks_done = ticks_now();
  return ticks_done <= last_tick;
}

int board_read(walker_sensors *sensors) {
#if WALKER_READS_TOUCH
  uint32_t leg;
  for (leg = 0; leg < WALKER_LEGS; ++leg) sensors->touch[leg] = (uint8_t)script_touch(ticks_done, leg);
#else
  (void)sensors;
#endif
  return 1;
}

#if ROBOT_READS_MORE
int robot_sense(walker_sensors *sensors) {
  script_sense(sensors, ticks_done);
  return 1;
}
#endif

int board_stop_pressed(void) { return 0; }
int board_arm_pressed(void) { return script_pressed(ticks_done, arm_tick); }
int board_get_character(void) { return -1; }
void board_print(const char *text) { semihosting_print(text); }

int board_outputs(int on) {
  (void)on;
  return 1;
}

int board_pulse(uint8_t pin, int16_t pulse_us) {
  if (ticks_done % 50u != 0) return 1;
  if (pin == robot_servos[0].pin) {
    print_number("tick ", (int32_t)ticks_done);
    semihosting_print(": pulses, us");
  }
  print_number(" ", pulse_us);
  if (pin == robot_servos[WALKER_JOINTS - 1].pin) semihosting_print("\n");
  return 1;
}

int main(void) {
  start_ticks();
  robot_init(&walker);
  while (wait_for_tick()) robot_tick(&walker, ticks_done * WALKER_TICK_US);
  print_number("", last_tick);
  print_number(" ticks, late ", (int32_t)missed);
  semihosting_print("\n");
  semihosting_exit(missed == 0);
  return 0;
}
