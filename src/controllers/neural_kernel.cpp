#include "amble/controllers/neural_kernel.hpp"

#include <algorithm>
#include <utility>

// Instruction sets that would only repeat the code of their neighbours, or have no fixed width.
#define HWY_DISABLED_TARGETS (HWY_SSSE3 | HWY_AVX3_DL | HWY_SVE | HWY_SVE2 | HWY_RVV)
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "amble/controllers/neural_kernel.cpp"
#include <hwy/foreach_target.h>

#include "amble/controllers/logistic-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace amble::controllers::HWY_NAMESPACE {

/// The rows of one vector's lanes.
struct Pass {
  const NeuralRows& rows;
  int lane;

  template <typename Float>
  HWY_INLINE Float* at(Float* base, int neuron) const {
    return base + static_cast<std::size_t>(neuron) * rows.stride + lane;
  }
  HWY_INLINE V get(const float* base, int neuron) const { return load(at(base, neuron)); }
  HWY_INLINE void put(V v, float* base, int neuron) const { store(v, at(base, neuron)); }

  /// sum + Σ weight × value, link by link.
  HWY_INLINE V add(const LinkTable& table, int neuron, const float* values, V sum) const {
    const float* const weights = rows.weights + lane;
    values += lane;
    const LinkTable::Link* link = table.links.data() + table.begin[static_cast<std::size_t>(neuron)];
    const LinkTable::Link* const end = table.links.data() + table.begin[static_cast<std::size_t>(neuron) + 1];
    for (; link != end; ++link) sum = fma(load(weights + link->weight), load(values + link->source), sum);
    return sum;
  }
  HWY_INLINE V add_sensors(int neuron, V sum) const {
    return add(rows.from_sensors, neuron, rows.sensors, sum);
  }
  HWY_INLINE V add_neurons(int neuron, const float* values, V sum) const {
    return add(rows.from_neurons, neuron, values, sum);
  }
  void copy(const float* from, float* to) const {
    for (int n = 0; n < rows.neurons; ++n) put(get(from, n), to, n);
  }
};

template <typename Work>
HWY_INLINE void for_lanes(const NeuralRows& rows, Work work) {
  for (int lane = 0; lane < rows.lanes; lane += width) work(Pass{rows, lane});
}

void levels(const NeuralRows& rows) {
  const Logistic logistic(rows.slope);
  for_lanes(rows, [&](const Pass& pass) HWY_ATTR {
    for (int n = 0; n < rows.neurons; ++n)
      pass.put(logistic(pass.add_neurons(n, rows.values, pass.add_sensors(n, set(0.0f)))), rows.values, n);
  });
}

/// One pass; whether any value changed by a bit.
HWY_INLINE bool update(const Pass& pass, const Logistic& logistic, const float* from, float* to) {
  const Ints i;
  auto changed = hn::Zero(i);
  for (int n = 0; n < pass.rows.neurons; ++n) {
    const V before = pass.get(from, n);
    const V after = logistic(pass.add_neurons(n, from, pass.get(pass.rows.sensed, n)));
    changed = hn::Or(changed, hn::Xor(hn::BitCast(i, before), hn::BitCast(i, after)));
    pass.put(after, to, n);
  }
  return !hn::AllTrue(i, hn::Eq(changed, hn::Zero(i)));
}

void passes(const NeuralRows& rows, int count) {
  const Logistic logistic(rows.slope);
  for_lanes(rows, [&](const Pass& pass) HWY_ATTR {
    // All neurons are 0 before the first pass, which therefore sums the sensors alone.
    float *from = rows.values, *to = rows.scratch;
    for (int n = 0; n < rows.neurons; ++n) {
      const V sum = pass.add_sensors(n, set(0.0f));
      pass.put(sum, rows.sensed, n);
      pass.put(logistic(sum), from, n);
    }
    // A pass depends on the values before it alone: once it leaves them as they are, so do all that follow.
    bool changed = true;
    for (int done = 1; done < count && changed; ++done) {
      changed = update(pass, logistic, from, to);
      std::swap(from, to);
    }
    if (from != rows.values) pass.copy(from, rows.values);
  });
}

/// A step of each neuron as soon as its sum is known.
void rate_euler(const NeuralRows& rows, const CtrnnRows& ctrnn, int steps, bool from_zero) {
  const Logistic logistic(rows.slope);
  for_lanes(rows, [&](const Pass& pass) HWY_ATTR {
    float *from = rows.values, *to = rows.scratch;
    for (int n = 0; n < rows.neurons; ++n) {
      const V sum = pass.add_sensors(n, hn::Sub(set(0.0f), pass.get(ctrnn.bias, n)));
      pass.put(sum, rows.sensed, n);
      // From y = 0 the first step's sums are those of the sensors, and it leads to rate × s.
      if (from_zero) pass.put(hn::Mul(pass.get(ctrnn.rate, n), logistic(sum)), from, n);
    }
    for (int step = from_zero ? 1 : 0; step < steps; ++step) {
      for (int n = 0; n < rows.neurons; ++n) {
        const V aim = logistic(pass.add_neurons(n, from, pass.get(rows.sensed, n)));
        const V y = pass.get(from, n);
        pass.put(fma(pass.get(ctrnn.rate, n), hn::Sub(aim, y), y), to, n);
      }
      std::swap(from, to);
    }
    if (from != rows.values) pass.copy(from, rows.values);
  });
}

/// Equation and method as they come.
struct General {
  const Pass& pass;
  const CtrnnRows& ctrnn;
  const Logistic& logistic;
  bool potential;

  HWY_INLINE float* change(int k) const {
    return ctrnn.change + static_cast<std::size_t>(k * pass.rows.neurons) * pass.rows.stride;
  }

  /// The neurons' values that belong to y.
  const float* values_of(const float* y) const {
    if (!potential) return y;
    for (int n = 0; n < pass.rows.neurons; ++n)
      pass.put(logistic(hn::Add(pass.get(y, n), pass.get(ctrnn.bias, n))), pass.rows.values, n);
    return pass.rows.values;
  }

  /// F(y) − y of a neuron.
  HWY_INLINE V pull(int n, const float* y, const float* values) const {
    V aim = pass.add_neurons(n, values, pass.get(pass.rows.sensed, n));
    if (!potential) aim = logistic(aim);
    return hn::Sub(aim, pass.get(y, n));
  }

  void find_change(const float* y, float* to) const {
    const float* const values = values_of(y);
    for (int n = 0; n < pass.rows.neurons; ++n)
      pass.put(hn::Mul(pass.get(ctrnn.rate, n), pull(n, y, values)), to, n);
  }

  void euler_step() const {
    const float* const values = values_of(ctrnn.y);
    for (int n = 0; n < pass.rows.neurons; ++n)
      pass.put(fma(pass.get(ctrnn.rate, n), pull(n, ctrnn.y, values), pass.get(ctrnn.y, n)), ctrnn.trial, n);
    pass.copy(ctrnn.trial, ctrnn.y);
  }

  const float* ahead(int k, float share) const {
    for (int n = 0; n < pass.rows.neurons; ++n)
      pass.put(fma(set(share), pass.get(change(k), n), pass.get(ctrnn.y, n)), ctrnn.trial, n);
    return ctrnn.trial;
  }
  void runge_kutta_step() const {
    find_change(ctrnn.y, change(0));
    find_change(ahead(0, 0.5f), change(1));
    find_change(ahead(1, 0.5f), change(2));
    find_change(ahead(2, 1.0f), change(3));
    const V two = set(2.0f), sixth = set(1.0f / 6.0f);
    for (int n = 0; n < pass.rows.neurons; ++n) {
      V sum = fma(two, pass.get(change(1), n), pass.get(change(0), n));
      sum = hn::Add(fma(two, pass.get(change(2), n), sum), pass.get(change(3), n));
      pass.put(fma(sum, sixth, pass.get(ctrnn.y, n)), ctrnn.y, n);
    }
  }
};

void general(const NeuralRows& rows, const CtrnnRows& ctrnn, int steps, bool potential, bool runge_kutta) {
  const Logistic logistic(rows.slope);
  for_lanes(rows, [&](const Pass& pass) HWY_ATTR {
    const General method{pass, ctrnn, logistic, potential};
    for (int n = 0; n < rows.neurons; ++n) {
      const V start = potential ? set(0.0f) : hn::Sub(set(0.0f), pass.get(ctrnn.bias, n));
      pass.put(pass.add_sensors(n, start), rows.sensed, n);
    }
    for (int step = 0; step < steps; ++step) runge_kutta ? method.runge_kutta_step() : method.euler_step();
    method.values_of(ctrnn.y);
  });
}

void logistic_values(float* values, std::size_t count, float slope) {
  const Logistic logistic(slope);
  HWY_ALIGN float some[width] = {};
  for (std::size_t i = 0; i < count; i += width) {
    const std::size_t here = std::min<std::size_t>(width, count - i);
    std::copy_n(values + i, here, some);
    store(logistic(load(some)), some);
    std::copy_n(some, here, values + i);
  }
}

}  // namespace amble::controllers::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace amble::controllers {

HWY_EXPORT(levels);
HWY_EXPORT(passes);
HWY_EXPORT(rate_euler);
HWY_EXPORT(general);
HWY_EXPORT(logistic_values);

void run_levels(const NeuralRows& rows) {
  HWY_DYNAMIC_DISPATCH(levels)(rows);
}

void run_passes(const NeuralRows& rows, int passes) {
  HWY_DYNAMIC_DISPATCH(passes)(rows, passes);
}

void run_rate_euler(const NeuralRows& rows, const CtrnnRows& ctrnn, int steps, bool from_zero) {
  HWY_DYNAMIC_DISPATCH(rate_euler)(rows, ctrnn, steps, from_zero);
}

void run_general(const NeuralRows& rows, const CtrnnRows& ctrnn, int steps, bool potential,
                 bool runge_kutta) {
  HWY_DYNAMIC_DISPATCH(general)(rows, ctrnn, steps, potential, runge_kutta);
}

void logistic_array(float* values, std::size_t count, float slope) {
  HWY_DYNAMIC_DISPATCH(logistic_values)(values, count, slope);
}

}  // namespace amble::controllers
#endif
