/* Runs the Arduino's program on an ATmega2560 in simavr, with switches at its pins as script.h says and a PCA9685 on its
 * I2C bus, whose registers are written down (esp_idf_fake.c says how, check_run.c the line C). A tick is what the
 * program's light (pin 13) says. Before the late tick its main program is held up where it sleeps, while
 * interrupts go on. With the word `hang` behind the program it is held up for good, walking, at 6 s; what the hardware
 * watchdog makes of that is judged here. With `lost` the chip does not answer for a while, and the log is that of
 * esp_idf_fake.c with -DLOSES_BUS. */
#include <avr_extint.h>
#include <avr_ioport.h>
#include <avr_twi.h>
#include <avr_uart.h>
#include <sim_avr.h>
#include <sim_cycle_timers.h>
#include <sim_elf.h>
#include <sim_interrupts.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "script.h"

enum { clock_hz = 16000000, chip_address = 0x40, legs = 4, channels = 12, led0 = 0x06, all_led_off_h = 0xfd };
enum { mode1 = 0x00, pre_scale = 0xfe, asleep = 0x10, auto_increment = 0x20, at_50_hz = 121 };

static avr_t *avr;
static avr_irq_t *bus;
static long tick = -1;
static int held; /* 1: soon, 2: is or was */
static avr_cycle_count_t held_until;

static long now_us(void) { return (long)(avr->cycle / (clock_hz / 1000000)); }

/* For a run with `hang`. */
enum { hang_tick = 600, ticks_after_reset = 100 };
static int hangs, loses_bus, pulses_before, pulses_after;
static long hung_us, reset_us;

static void fail(const char *what) {
  fprintf(stderr, "run_arduino: %s\n", what);
  exit(1);
}

/* ---- switches ---- */

static void set_pin(char port, int bit, int level) {
  avr_raise_irq(avr_io_getirq(avr, AVR_IOCTL_IOPORT_GETIRQ(port), bit), (uint32_t)level);
}

/* Pins 22 to 25 are A0 to A3, 2 is E4, 3 is E5. */
static void set_switches(uint32_t at) {
  int leg;
  for (leg = 0; leg < legs; ++leg) set_pin('A', leg, !script_touch(at, (uint32_t)leg));
  set_pin('E', 4, script_stops(at));
  set_pin('E', 5, !script_arms(at));
}

/* Pins that could interrupt, 2 and 3 among them, take simavr most of its time while they are low. A reset forgets it. */
static void ignore_low_pins(void) {
  uint8_t interrupt;
  for (interrupt = 0; interrupt < 8; ++interrupt) avr_extint_set_strict_lvl_trig(avr, interrupt, 0);
}

static void type_line(const char *line) {
  for (; line && *line; ++line) avr_raise_irq(avr_io_getirq(avr, AVR_IOCTL_UART_GETIRQ('0'), UART_IRQ_INPUT), (uint8_t)*line);
}

static void light_changed(avr_irq_t *irq, uint32_t value, void *param) {
  static uint32_t before = 0;
  (void)irq, (void)param;
  if (value == before) return; /* the pin becomes an output */
  before = value;
  ++tick;
  set_switches((uint32_t)tick);
  if (hangs && reset_us == 0 && hung_us > 0) reset_us = now_us();
  if (hangs) return;
  if (tick < script_ticks && !loses_bus) printf("T %ld %ld\n", tick, now_us());
  type_line(script_line((uint32_t)tick));
}

/* ---- PCA9685 ---- */

static int outputs_are_on;

static void begin_line(void) {
  if (loses_bus)
    printf("%.2f s: ", (double)(tick < 0 ? 0 : tick) * WALKER_TICK_US / 1e6);
  else
    printf("S ");
}

/* OE is at pin 4, which is G5. A resistor pulls it up. */
static void outputs_changed(avr_irq_t *irq, uint32_t value, void *param) {
  (void)irq, (void)param;
  if (outputs_are_on == !value) return;
  outputs_are_on = !value;
  if (!loses_bus) return;
  begin_line();
  puts(value ? "OE cuts the servos off" : "OE lets pulses through");
}

static struct {
  int selected, bytes, where;
  uint8_t registers[256];
} chip;

static void end_transfer(void) {
  const int channel = (chip.where - 1 - led0) / 4;
  const uint8_t *r;
  chip.selected = 0;
  if (chip.bytes != 5 || channel < 0 || channel >= 16) return;
  if (chip.registers[pre_scale] != at_50_hz || chip.registers[mode1] != auto_increment) fail("the chip is not at 50 Hz");
  r = &chip.registers[led0 + 4 * channel];
  if (r[0] != 0 || r[1] != 0) fail("a pulse does not begin at 0");
  if (outputs_are_on && !(r[3] & 0x10)) ++*(hung_us > 0 ? &pulses_after : &pulses_before);
  if (!hangs && !loses_bus) printf("C %d %d\n", channel, !outputs_are_on || r[3] & 0x10 ? 0 : r[2] + 256 * r[3]);
  if (held == 0 && hangs && tick == hang_tick && channel == channels - 1) held = 1;
  if (held == 0 && !hangs && tick + 1 == late_tick && channel == channels - 1) held = 1;
}

static void bus_changed(avr_irq_t *irq, uint32_t value, void *param) {
  avr_twi_msg_irq_t message;
  (void)irq, (void)param;
  message.u.v = value;
  if (message.u.twi.msg & TWI_COND_STOP && chip.selected) end_transfer();
  if (message.u.twi.msg & TWI_COND_START) {
    chip.selected = message.u.twi.addr >> 1 == chip_address && !(loses_bus && script_loses_bus((uint32_t)tick));
    chip.bytes = 0;
    if (chip.selected) avr_raise_irq(bus + TWI_IRQ_INPUT, avr_twi_irq_msg(TWI_COND_ACK, message.u.twi.addr, 1));
  }
  if (!chip.selected || !(message.u.twi.msg & TWI_COND_WRITE)) return;
  avr_raise_irq(bus + TWI_IRQ_INPUT, avr_twi_irq_msg(TWI_COND_ACK, message.u.twi.addr, 1));
  if (chip.bytes++ == 0) {
    chip.where = message.u.twi.data;
  } else {
    /* The divider is taken only while the chip sleeps. */
    if (chip.where == pre_scale && !(chip.registers[mode1] & asleep)) fail("the divider is set while the chip is awake");
    chip.registers[chip.where++ & 0xff] = message.u.twi.data;
  }
}

/* ---- serial port ---- */

static void printed(avr_irq_t *irq, uint32_t value, void *param) {
  static char line[128];
  static size_t length;
  (void)irq, (void)param;
  if (value != '\n') {
    if (length + 1 < sizeof line) line[length++] = (char)value;
    return;
  }
  line[length] = 0;
  length = 0;
  if (hangs) return;
  begin_line();
  puts(line);
}

static void connect(void) {
  uint32_t flags = 0;
  ignore_low_pins();
  bus = avr_io_getirq(avr, AVR_IOCTL_TWI_GETIRQ(0), 0);
  avr_irq_register_notify(bus + TWI_IRQ_OUTPUT, bus_changed, NULL);
  avr_irq_register_notify(avr_io_getirq(avr, AVR_IOCTL_IOPORT_GETIRQ('B'), 7), light_changed, NULL);
  avr_irq_register_notify(avr_io_getirq(avr, AVR_IOCTL_IOPORT_GETIRQ('G'), 5), outputs_changed, NULL);
  avr_ioctl(avr, AVR_IOCTL_UART_SET_FLAGS('0'), &flags);
  avr_irq_register_notify(avr_io_getirq(avr, AVR_IOCTL_UART_GETIRQ('0'), UART_IRQ_OUTPUT), printed, NULL);
  set_switches(0);
}

/* A processor that sleeps does not wait for the host's clock. */
static void sleep_fast(avr_t *of, avr_cycle_count_t cycles) {
  (void)of, (void)cycles;
}

/* One step; the main program stands still while it is held up. */
static void step(void) {
  static avr_flashaddr_t held_at;
  static avr_run_t usual_run;
  if (held == 1 && avr->state == cpu_Sleeping) {
    held = 2;
    held_at = avr->pc;
    usual_run = avr->run;
    held_until = hangs ? (avr_cycle_count_t)-1 : avr->cycle + (avr_cycle_count_t)late_by_us * (clock_hz / 1000000);
    hung_us = hangs ? now_us() : 0;
  }
  /* The watchdog resets by another function to run. */
  if (held == 2 && avr->run == usual_run && avr->state == cpu_Running && avr->pc == held_at && avr->cycle < held_until) {
    avr->cycle += 4;
    avr_cycle_timer_process(avr);
    avr_service_interrupts(avr);
    return;
  }
  if (avr_run(avr) == cpu_Crashed) fail("the processor crashed");
  if (held == 2 && hangs && avr->run == usual_run && avr->pc < 4) ignore_low_pins();
}

int main(int argc, char **argv) {
  static elf_firmware_t firmware;
  hangs = argc == 3 && strcmp(argv[2], "hang") == 0;
  loses_bus = argc == 3 && strcmp(argv[2], "lost") == 0;
  if (argc != 2 + hangs + loses_bus || elf_read_firmware(argv[1], &firmware) != 0) fail("expected the program, an ELF file");
  avr = avr_make_mcu_by_name("atmega2560");
  if (!avr) fail("simavr knows no ATmega2560");
  avr_init(avr);
  firmware.frequency = clock_hz;
  avr_load_firmware(avr, &firmware);
  avr->sleep = sleep_fast;
  avr->log = LOG_ERROR;
  connect();
  if (!hangs) {
    while (tick < (loses_bus ? bus_over : script_ticks)) step();
    return 0;
  }
  while (reset_us == 0 && now_us() < 10000000) step();
  for (tick = script_ticks; reset_us > 0 && tick < script_ticks + ticks_after_reset;) step();
  printf("hung while walking, at %.2f s; runs again %.2f s later; pulses in the next second: %d\n", (double)hung_us / 1e6, (double)(reset_us - hung_us) / 1e6, pulses_after);
  return reset_us == 0 || pulses_before == 0 || pulses_after > 0;
}
