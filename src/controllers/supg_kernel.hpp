#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "amble/controllers/modulation.hpp"

/// The loops of SUPGs over the lanes of a batch, compiled for several instruction sets; the best that the CPU
/// has is chosen at run time. Each operation is rounded by itself, so they all give the same bits. Masks have
/// all bits or none. What is written must not overlap what is read, unless that is said.
namespace amble::controllers {

/// What is the same for the timers of all lanes.
struct TimerRules {
  std::int32_t period = 0, end_of_cycle = 0, wraps = 0, airborne_needed = 0, by_touch = 0, phase = 0,
               refractory = 0;
};

/// The timers of a leg, lane by lane.
struct TimerLanes {
  const float* contact;
  const std::int32_t* by_chance;
  const std::int32_t* first_timer;
  std::int32_t* timer;
  std::int32_t* airborne;
  std::int32_t* wait;
  std::int32_t* fired;
};

/// The timers of the paper's SUPGs in the next tick, in ticks; a trigger takes them to `start`.
void run_ticks(const TimerRules& rules, std::int32_t start, const TimerLanes& lanes, int count);

/// Those of modulated SUPGs, in parts of a tick, but for where triggers take them: by `advance`. `continued`:
/// what they would be without a jump; `left`: of the refractory time, ticks. Whether a trigger fired.
bool run_parts(const TimerRules& rules, const std::int32_t* advance, const TimerLanes& lanes,
               std::int32_t* continued, std::int32_t* left, int count);

/// A row of readings, and how they are sensed.
struct SensedRow {
  const float* reading;  ///< null: all are 0
  float gain, shift;
  float* sensed;
};
/// LegSensor::sensed() of each.
void run_sensed(std::span<const SensedRow> rows, int count);

/// weight_of_level() of each row and each of the levels, row by row; `stride` is that of both.
void run_weights(const float* sensed, std::size_t stride, int rows, float* weights, int count);

/// advance_parts(ρ) by lane, ρ = Σ rate × sensed within ± 1, row by row of both.
void run_rates(const float* rates, const float* sensed, std::size_t stride, int rows, std::int32_t* advance,
               int count);

/// The same of ρ = sum + (sines × cosine − cosines × sine), where `sines` is not null.
struct PulledRates {
  const float *sum, *sine, *cosine, *sines, *cosines;
};
void run_pulled_rates(const PulledRates& rates, std::int32_t* advance, int count);

/// How a joint's targets are changed: y + (y − middle) a + half b, a and b within ± 1.
struct Reshaping {
  const float *amplitude, *shift;
  float middle_rad, half_rad;
};
void run_reshape(const Reshaping& how, float* targets_rad, int count);

/// A row within a range; `to` may be `from`.
struct LimitedRow {
  const float* from;
  float lower, upper;
  float* to;
};
void run_limits(std::span<const LimitedRow> rows, int count);

/// What SeamSmoother does with a joint's jumps; `jumped` has all bits or none. Into `targets_rad`.
struct Residual {
  float decay, lower_rad, upper_rad;
  const float *continued_rad, *present_rad;
  const std::int32_t* jumped;
  float* residual_rad;
};
void run_residual(const Residual& of, float* targets_rad, int count);

/// One stage of its filter, z ← z + share (y − z), y ← z, without what is within ± 1e−9 rad.
void run_filter(float share, float* z_rad, float* targets_rad, int count);

}  // namespace amble::controllers
