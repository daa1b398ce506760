#include "amble/controllers/neural_kernel.hpp"

#include <algorithm>
#include <utility>

#include "amble/core/simd_targets.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "amble/controllers/neural_kernel.cpp"
#include <hwy/foreach_target.h>

#include "amble/controllers/logistic-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace amble::controllers::HWY_NAMESPACE {

/// The rows of one vector's lanes. A neuron is named by where its rows begin.
struct Pass {
  const NeuralRows& rows;
  int lane;

  HWY_INLINE V get(const float* base, std::size_t neuron) const { return load(base + neuron + lane); }
  HWY_INLINE void put(V v, float* base, std::size_t neuron) const { store(v, base + neuron + lane); }

  template <typename Work>
  HWY_INLINE void for_neurons(Work work) const {
    const std::size_t end = static_cast<std::size_t>(rows.neurons) * rows.stride;
    for (std::size_t n = 0; n < end; n += rows.stride) work(n);
  }
  void copy(const float* from, float* to) const {
    for_neurons([&](std::size_t n) HWY_ATTR { put(get(from, n), to, n); });
  }
};

/// Where a table is read next.
struct Cursor {
  const std::uint32_t* neuron;
  const std::uint32_t* source;
  const float* weight;
};

/// The next `count` neurons of a group, whose sums do not depend on each other.
template <int count, typename Start, typename Activate, typename Work>
HWY_INLINE void sum_some(int links, const float* values, Cursor& at, Start start, Activate activate,
                         Work work) {
  std::size_t neurons[count];
  V sums[count];
  for (int i = 0; i < count; ++i) {
    neurons[i] = at.neuron[i];
    sums[i] = start(neurons[i]);
  }
  for (int k = 0; k < links; ++k)
    for (int i = 0; i < count; ++i)
      sums[i] = fma(load(at.weight + (i * links + k) * LaneRows::line_lanes),
                    load(values + at.source[i * links + k]), sums[i]);
  at.neuron += count;
  at.source += count * links;
  at.weight += count * links * LaneRows::line_lanes;
  activate(sums);
  for (int i = 0; i < count; ++i) work(neurons[i], sums[i]);
}

/// The sums of one group, whose neurons have `known` links each, or `links` if that is negative.
template <int known, typename Start, typename Activate, typename Work>
HWY_INLINE void sum_group(const SumTable::Group& group, const float* values, Cursor& at, Start start,
                          Activate activate, Work work) {
  const int links = known >= 0 ? known : group.links;
  Cursor next = at;
  int left = group.neurons;
  for (; left >= 2; left -= 2) sum_some<2>(links, values, next, start, activate, work);
  if (left > 0) sum_some<1>(links, values, next, start, activate, work);
  at = next;
}

/// work(neuron, x) for all neurons of a table, x = start(neuron) + Σ weight × value, link by link, as
/// activate() leaves it: two neurons at a time, so that one's operations fill the gaps between the other's.
template <typename Start, typename Activate, typename Work>
HWY_INLINE void for_sums(const SumTable& table, const float* values, int lane, Start start, Activate activate,
                         Work work) {
  constexpr int line = LaneRows::line_lanes;
  Cursor at{table.neurons.data(), table.sources.data(),
            table.weights.row(lane / line * table.capacity) + lane % line};
  values += lane;
  for (const SumTable::Group& group : table.groups) {
    switch (group.links) {
      case 0:
        sum_group<0>(group, values, at, start, activate, work);
        break;
      case 1:
        sum_group<1>(group, values, at, start, activate, work);
        break;
      case 2:
        sum_group<2>(group, values, at, start, activate, work);
        break;
      case 3:
        sum_group<3>(group, values, at, start, activate, work);
        break;
      case 4:
        sum_group<4>(group, values, at, start, activate, work);
        break;
      case 5:
        sum_group<5>(group, values, at, start, activate, work);
        break;
      case 6:
        sum_group<6>(group, values, at, start, activate, work);
        break;
      default:
        sum_group<-1>(group, values, at, start, activate, work);
    }
  }
}

/// What for_sums() can do with a sum.
constexpr auto as_it_is = [](auto&) {};
HWY_INLINE auto by(const Logistic& logistic) {
  return [&logistic](auto& sums) HWY_ATTR { logistic.replace(sums); };
}

template <typename Work>
HWY_INLINE void for_lanes(const NeuralRows& rows, Work work) {
  for (int lane = 0; lane < rows.lanes; lane += width) work(Pass{rows, lane});
}

/// Writes the part of the sums that stays during the tick to `sensed`: −bias, or 0 without, and the sensors'.
template <typename Work>
HWY_INLINE void sense(const Pass& pass, const float* bias, Work work) {
  for_sums(
      pass.rows.from_sensors, pass.rows.sensors, pass.lane,
      [&](std::size_t n) HWY_ATTR { return bias ? hn::Sub(set(0.0f), pass.get(bias, n)) : set(0.0f); },
      as_it_is,
      [&](std::size_t n, V sum) HWY_ATTR {
        pass.put(sum, pass.rows.sensed, n);
        work(n, sum);
      });
}

void levels(const NeuralRows& rows) {
  const Logistic logistic(rows.slope);
  for_lanes(rows, [&](const Pass& pass) HWY_ATTR {
    sense(pass, nullptr, [](std::size_t, V) HWY_ATTR {});
    float *const values = rows.values, *const sensed = rows.sensed;
    for_sums(
        rows.from_neurons, values, pass.lane, [=](std::size_t n) HWY_ATTR { return pass.get(sensed, n); },
        by(logistic), [=](std::size_t n, V value) HWY_ATTR { pass.put(value, values, n); });
  });
}

/// One pass; whether any value changed by a bit.
HWY_INLINE bool update(const Pass& pass, const Logistic& logistic, const float* from, float* to) {
  const Ints i;
  const float* const sensed = pass.rows.sensed;
  auto changed = hn::Zero(i);
  for_sums(
      pass.rows.from_neurons, from, pass.lane, [&](std::size_t n) HWY_ATTR { return pass.get(sensed, n); },
      by(logistic),
      [&](std::size_t n, V after) HWY_ATTR {
        changed = hn::Or(changed, hn::Xor(hn::BitCast(i, pass.get(from, n)), hn::BitCast(i, after)));
        pass.put(after, to, n);
      });
  return !hn::AllTrue(i, hn::Eq(changed, hn::Zero(i)));
}

void passes(const NeuralRows& rows, int count) {
  const Logistic logistic(rows.slope);
  for_lanes(rows, [&](const Pass& pass) HWY_ATTR {
    // All neurons are 0 before the first pass, which therefore sums the sensors alone.
    float *from = rows.values, *to = rows.scratch;
    sense(pass, nullptr, [&](std::size_t n, V sum) HWY_ATTR { pass.put(logistic(sum), from, n); });
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
HWY_INLINE void rate_euler_step(const SumTable& table, const Logistic& logistic, int lane,
                                const float* sensed, const float* rate, const float* from, float* to) {
  for_sums(
      table, from, lane, [=](std::size_t n) HWY_ATTR { return load(sensed + n + lane); }, by(logistic),
      [=](std::size_t n, V aim) HWY_ATTR {
        const V y = load(from + n + lane);
        store(fma(load(rate + n + lane), hn::Sub(aim, y), y), to + n + lane);
      });
}

void rate_euler(const NeuralRows& rows, const CtrnnRows& ctrnn, int steps, bool from_zero) {
  const Logistic logistic(rows.slope);
  for_lanes(rows, [&](const Pass& pass) HWY_ATTR {
    float *from = rows.values, *to = rows.scratch;
    // From y = 0 the first step's sums are those of the sensors, and it leads to rate × s.
    sense(pass, ctrnn.bias, [&](std::size_t n, V sum) HWY_ATTR {
      if (from_zero) pass.put(hn::Mul(pass.get(ctrnn.rate, n), logistic(sum)), from, n);
    });
    for (int step = from_zero ? 1 : 0; step < steps; ++step) {
      rate_euler_step(rows.from_neurons, logistic, pass.lane, rows.sensed, ctrnn.rate, from, to);
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
    pass.for_neurons([&](std::size_t n) HWY_ATTR {
      pass.put(logistic(hn::Add(pass.get(y, n), pass.get(ctrnn.bias, n))), pass.rows.values, n);
    });
    return pass.rows.values;
  }

  /// work(neuron, F(y) − y) for all neurons.
  template <typename Work>
  HWY_INLINE void pulls(const float* y, Work work) const {
    for_sums(
        pass.rows.from_neurons, values_of(y), pass.lane,
        [&](std::size_t n) HWY_ATTR { return pass.get(pass.rows.sensed, n); }, as_it_is,
        [&](std::size_t n, V sum)
            HWY_ATTR { work(n, hn::Sub(potential ? sum : logistic(sum), pass.get(y, n))); });
  }

  void find_change(const float* y, float* to) const {
    pulls(y,
          [&](std::size_t n, V pull) HWY_ATTR { pass.put(hn::Mul(pass.get(ctrnn.rate, n), pull), to, n); });
  }

  void euler_step() const {
    pulls(ctrnn.y, [&](std::size_t n, V pull) HWY_ATTR {
      pass.put(fma(pass.get(ctrnn.rate, n), pull, pass.get(ctrnn.y, n)), ctrnn.trial, n);
    });
    pass.copy(ctrnn.trial, ctrnn.y);
  }

  const float* ahead(int k, float share) const {
    pass.for_neurons([&](std::size_t n) HWY_ATTR {
      pass.put(fma(set(share), pass.get(change(k), n), pass.get(ctrnn.y, n)), ctrnn.trial, n);
    });
    return ctrnn.trial;
  }
  void runge_kutta_step() const {
    find_change(ctrnn.y, change(0));
    find_change(ahead(0, 0.5f), change(1));
    find_change(ahead(1, 0.5f), change(2));
    find_change(ahead(2, 1.0f), change(3));
    const V two = set(2.0f), sixth = set(1.0f / 6.0f);
    pass.for_neurons([&](std::size_t n) HWY_ATTR {
      V sum = fma(two, pass.get(change(1), n), pass.get(change(0), n));
      sum = hn::Add(fma(two, pass.get(change(2), n), sum), pass.get(change(3), n));
      pass.put(fma(sum, sixth, pass.get(ctrnn.y, n)), ctrnn.y, n);
    });
  }
};

void general(const NeuralRows& rows, const CtrnnRows& ctrnn, int steps, bool potential, bool runge_kutta) {
  const Logistic logistic(rows.slope);
  for_lanes(rows, [&](const Pass& pass) HWY_ATTR {
    const General method{pass, ctrnn, logistic, potential};
    sense(pass, potential ? nullptr : ctrnn.bias, [](std::size_t, V) HWY_ATTR {});
    for (int step = 0; step < steps; ++step) runge_kutta ? method.runge_kutta_step() : method.euler_step();
    method.values_of(ctrnn.y);
  });
}

void sums(const SumTable& table, const float* values, float* to, int lanes) {
  for (int lane = 0; lane < lanes; lane += width)
    for_sums(
        table, values, lane, [](std::size_t) HWY_ATTR { return zero(); }, as_it_is,
        [=](std::size_t n, V sum) HWY_ATTR { store(sum, to + n + lane); });
}

void tanh_euler(const SumTable& table, const float* values, const float* bias, const float* step,
                const float* from, float* to, int lanes) {
  const Logistic logistic(2.0f);
  const V two = set(2.0f), one = set(1.0f), dust = set(1e-9f);
  for (int lane = 0; lane < lanes; lane += width)
    for_sums(
        table, values, lane, [=](std::size_t n) HWY_ATTR { return load(bias + n + lane); }, by(logistic),
        [=](std::size_t n, V s) HWY_ATTR {
          // tanh x = 2 s(x) − 1 for the logistic function of slope 2.
          const V y = load(from + n + lane), aim = hn::Sub(hn::Mul(two, s), one);
          const V next = fma(load(step + n + lane), hn::Sub(aim, y), y);
          store(hn::IfThenElse(hn::Lt(hn::Abs(next), dust), zero(), next), to + n + lane);
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
HWY_EXPORT(sums);
HWY_EXPORT(tanh_euler);

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

void run_sums(const SumTable& table, const float* values, float* to, int lanes) {
  HWY_DYNAMIC_DISPATCH(sums)(table, values, to, lanes);
}

void run_tanh_euler(const SumTable& table, const float* values, const float* bias, const float* step,
                    const float* from, float* to, int lanes) {
  HWY_DYNAMIC_DISPATCH(tanh_euler)(table, values, bias, step, from, to, lanes);
}

void logistic_array(float* values, std::size_t count, float slope) {
  HWY_DYNAMIC_DISPATCH(logistic_values)(values, count, slope);
}

}  // namespace amble::controllers
#endif
