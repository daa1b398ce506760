#include "amble/cppn/kernels.hpp"

#include <algorithm>
#include <cstring>

#include "amble/core/simd_targets.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "amble/cppn/kernels.cpp"
#include <hwy/foreach_target.h>

#include "amble/core/index.hpp"
#include "amble/cppn/activation-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace amble::cppn::HWY_NAMESPACE {

constexpr std::size_t block = Points::block;

template <Vector (*function)(Vector)>
void apply(float* values, std::size_t count) {
  const Floats d;
  const std::size_t lanes = hn::Lanes(d), whole = count / lanes * lanes;
  for (std::size_t i = 0; i < whole; i += lanes)
    hn::StoreU(function(hn::LoadU(d, values + i)), d, values + i);
  if (whole == count) return;
  HWY_ALIGN float rest[hn::MaxLanes(d)] = {};
  std::copy(values + whole, values + count, rest);
  hn::Store(function(hn::Load(d, rest)), d, rest);
  std::copy(rest, rest + (count - whole), values + whole);
}

void activate_values(neat::Activation function, Linear linear, float* values, std::size_t count) {
  switch (function) {
    case neat::Activation::bipolar_sigmoid:
      return apply<bipolar_sigmoid>(values, count);
    case neat::Activation::gaussian:
      return apply<gaussian>(values, count);
    case neat::Activation::sine:
      return apply<sine>(values, count);
    case neat::Activation::linear:
      return linear == Linear::absolute ? apply<absolute>(values, count) : apply<identity>(values, count);
  }
}

/// f(Σ_k w_k v_k) of one node at the points of a block: sums from zero in the order of the links, each
/// product and sum rounded. Four vectors at a time, because each operation waits for the one before it.
template <void (*function)(Vector&, Vector&, Vector&, Vector&)>
HWY_INLINE void compute(const Program::Link* links, int count, const Tile* source, float* values) {
  const Floats d;
  const std::size_t lanes = hn::Lanes(d);
  for (std::size_t i = 0; i < block; i += 4 * lanes) {
    Vector s0 = hn::Zero(d), s1 = s0, s2 = s0, s3 = s0;
    for (int k = 0; k < count; ++k) {
      const float* from = source[links[k].from_slot].value + i;
      const Vector weight = hn::Set(d, links[k].weight);
      s0 = hn::Add(s0, hn::Mul(weight, hn::Load(d, from)));
      s1 = hn::Add(s1, hn::Mul(weight, hn::Load(d, from + lanes)));
      s2 = hn::Add(s2, hn::Mul(weight, hn::Load(d, from + 2 * lanes)));
      s3 = hn::Add(s3, hn::Mul(weight, hn::Load(d, from + 3 * lanes)));
    }
    function(s0, s1, s2, s3);
    hn::Store(s0, d, values + i);
    hn::Store(s1, d, values + i + lanes);
    hn::Store(s2, d, values + i + 2 * lanes);
    hn::Store(s3, d, values + i + 3 * lanes);
  }
}

void compute_node(const Program& program, const Program::Node& node, const Tile* source, float* values) {
  const Program::Link* const links = program.links.data() + node.first_link;
  switch (node.activation) {
    case neat::Activation::bipolar_sigmoid:
      return compute<apply_to_four<bipolar_sigmoid>>(links, node.link_count, source, values);
    case neat::Activation::gaussian:
      return compute<apply_to_four<gaussian>>(links, node.link_count, source, values);
    case neat::Activation::sine:
      return compute<sines_of_four>(links, node.link_count, source, values);
    case neat::Activation::linear:
      return program.linear == Linear::absolute
                 ? compute<apply_to_four<absolute>>(links, node.link_count, source, values)
                 : compute<apply_to_four<identity>>(links, node.link_count, source, values);
  }
}

/// One synchronous pass, v(t) in `target` from v(t − 1) in `source`.
void run_pass(const Program& program, int pass, const Tile* source, Tile* target) {
  for (const Program::Node& node : program.nodes)
    if (pass >= node.first_pass && pass <= node.last_pass)
      compute_node(program, node, source, target[node.slot].value);
}

/// All passes, block by block. Two buffers take turns as v(t − 1) and v(t); in place they are the same one.
void run(const Program& program, const Points& points, float* results, Tile* scratch) {
  Tile* const even = scratch;
  Tile* const odd = program.in_place ? scratch : scratch + program.slots;
  std::fill(even[0].value, even[0].value + block, 1.0f);
  for (std::size_t first = 0; first < to_index(points.capacity()); first += block) {
    for (int i = 0; i < program.inputs; ++i) std::copy_n(points.input(i) + first, block, even[1 + i].value);
    // v(0) = 0 but for bias and inputs, which both buffers hold.
    if (!program.in_place) {
      std::copy(even, even + 1 + program.inputs, odd);
      std::memset(even + 1 + program.inputs, 0, sizeof(Tile) * to_index(program.slots - 1 - program.inputs));
    }
    for (int pass = 1; pass <= program.passes; ++pass)
      run_pass(program, pass, pass % 2 == 1 ? even : odd, pass % 2 == 1 ? odd : even);
    const Tile* const last = program.passes % 2 == 1 ? odd : even;
    for (std::size_t output = 0; output < program.output_slots.size(); ++output)
      std::copy_n(last[program.output_slots[output]].value, block,
                  results + output * to_index(points.capacity()) + first);
  }
}

}  // namespace amble::cppn::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace amble::cppn {

HWY_EXPORT(run);
HWY_EXPORT(activate_values);

void run_program(const Program& program, const Points& points, float* results, Tile* scratch) {
  HWY_DYNAMIC_DISPATCH(run)(program, points, results, scratch);
}

void activate_array(neat::Activation function, Linear linear, float* values, std::size_t count) {
  HWY_DYNAMIC_DISPATCH(activate_values)(function, linear, values, count);
}

}  // namespace amble::cppn
#endif
