#pragma once

#include <cstddef>

#include "amble/controllers/sum_table.hpp"

/// The neurons' updates of a tick, compiled for several instruction sets; the best that the CPU has is chosen
/// at run time. docs/CONTROLLERS.md explains why they all give the same bits.
namespace amble::controllers {

/// What a tick of all lanes works on. Rows are those of LaneRows: `stride` floats from one to the next.
struct NeuralRows {
  const SumTable& from_sensors;
  const SumTable& from_neurons;
  const float* sensors;
  float* values;   ///< of the neurons; levels before levels that they feed
  float* sensed;   ///< scratch, neuron by neuron: the part of their sums that stays during the tick
  float* scratch;  ///< neuron by neuron
  int neurons, lanes;
  std::size_t stride;
  float slope;
};

/// What neurons with a differential equation have besides, neuron by neuron.
struct CtrnnRows {
  float* y;  ///< the state; with the rate equation NeuralRows::values
  const float* bias;
  const float* rate;
  float* trial;   ///< scratch, where Runge and Kutta or the potential equation need it
  float* change;  ///< scratch, four times all neurons
};

/// Neurons without cycles, from the sensors on.
void run_levels(const NeuralRows& rows);
/// `passes` updates of all neurons together, from 0.
void run_passes(const NeuralRows& rows, int passes);

/// `steps` steps of τ dy/dt = −y + s(Σ w y − bias) by Euler, from y or from 0.
void run_rate_euler(const NeuralRows& rows, const CtrnnRows& ctrnn, int steps, bool from_zero);
/// The same for either equation and by either method, from y.
void run_general(const NeuralRows& rows, const CtrnnRows& ctrnn, int steps, bool potential, bool runge_kutta);

/// Weighted sums from +0: sums[neuron] = Σ weight × value, both as rows of as many floats.
void run_sums(const SumTable& table, const float* values, float* sums, int lanes);
/// to[neuron] = y + step (tanh(Σ weight × value + bias) − y) with y = from[neuron], 0 within ± 1e−9. `to`
/// must not overlap what is read.
void run_tanh_euler(const SumTable& table, const float* values, const float* bias, const float* step,
                    const float* from, float* to, int lanes);

/// Replaces `count` values by their logistic function.
void logistic_array(float* values, std::size_t count, float slope);

}  // namespace amble::controllers
