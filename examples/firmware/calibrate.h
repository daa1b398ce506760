/* Finding a servo's numbers, one joint at a time, by lines of text:
 *   joint N   its servo goes to its zero; all others are without pulses
 *   +N, -N    moves it by N us, at most 100
 *   zero      this is angle 0, the start pose
 *   at N      it stands N degrees from the start pose by the right-hand rule of walker.h: sign and us_per_rad
 *   least     it goes no further to short pulses
 *   most      it goes no further to long pulses
 *   table     all numbers, as C for my_robot.c
 *   quit      ends */
#ifndef CALIBRATE_H
#define CALIBRATE_H

#include "servos.h"

#ifdef __cplusplus
extern "C" {
#endif

/* A joint as the export has it. */
typedef struct {
  const char *enumerator;                 /* "WALKER_JOINT_FL_KNEE" */
  int32_t least, most;                    /* targets, in 2^-fraction_bits rad */
} calibrated_joint;

typedef struct {
  servo *servos; /* by joint; changed */
  const calibrated_joint *joints;
  int count, fraction_bits;
  int joint;         /* that is chosen; -1: none */
  int16_t pulse_us;  /* where it shall be */
  void (*print)(const char *text);
} calibration;

/* Begins: no joint is chosen. */
void calibrate_begin(calibration *c);
/* Obeys a line without its end. 0: it was `quit`. */
int calibrate_line(calibration *c, const char *line);

#ifdef __cplusplus
}
#endif

#endif
