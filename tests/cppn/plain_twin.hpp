#pragma once

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include "amble/cppn/activation.hpp"
#include "amble/cppn/settings.hpp"
#include "amble/neat/genome.hpp"

/// The arithmetic of amble::cppn written down once more, one number at a time, without vectors, without
/// leaving anything out: Network must give the same bits.
namespace amble::cppn::plain {

namespace c = constants;

inline float exp_of_negative(float z) {
  z = std::max(z, c::lowest_exponent);
  const float k = (z * c::log2_e + c::rounder) - c::rounder;
  const float r = (z - k * c::ln2_high) - k * c::ln2_low;
  const float q = (((c::e6 * r + c::e5) * r + c::e4) * r + c::e3) * r + c::e2;
  return std::ldexp((q * (r * r) + r) + 1.0f, static_cast<int>(k));
}

inline float sine(float x) {
  float r = 0.0f;
  if (std::fabs(x) > c::near_sine) {
    r = sine_angle_of_large(x);
  } else {
    const float k = ((x + x) * c::one_over_pi + c::rounder) - c::rounder;
    r = (((x + x) - k * c::pi_high) - k * c::pi_middle) - k * c::pi_low;
    if (static_cast<int>(k) % 2 != 0) r = -r;
  }
  const float r2 = r * r;
  return (((c::s9 * r2 + c::s7) * r2 + c::s5) * r2 + c::s3) * r2 * r + r;
}

inline float activated(neat::Activation function, Linear linear, float x) {
  switch (function) {
    case neat::Activation::bipolar_sigmoid: {
      const float t = exp_of_negative(-std::fabs(x));
      return std::copysign((1.0f - t) / (1.0f + t), x);
    }
    case neat::Activation::gaussian: {
      const float a = 2.5f * x;
      return 2.0f * exp_of_negative(-(a * a)) - 1.0f;
    }
    case neat::Activation::sine:
      return sine(x);
    case neat::Activation::linear:
      break;
  }
  return std::clamp(linear == Linear::absolute ? std::fabs(x) : x, -largest_linear, largest_linear);
}

/// Outputs after synchronous passes from a cleared state, all nodes in all passes. As many passes as the
/// genome has computed nodes (or more) settle every feed-forward CPPN.
inline std::vector<float> evaluate(const neat::Genome& genome, Linear linear,
                                   const std::vector<float>& inputs, int passes) {
  std::vector<float> values(genome.nodes.size(), 0.0f);
  values[0] = 1.0f;
  std::copy(inputs.begin(), inputs.end(), values.begin() + 1);
  for (int pass = 0; pass < passes; ++pass) {
    std::vector<float> sums(values.size(), 0.0f);
    for (const neat::LinkGene& link : genome.links)
      if (link.enabled)
        sums[static_cast<std::size_t>(genome.index_of(link.to))] +=
            static_cast<float>(link.weight) * values[static_cast<std::size_t>(genome.index_of(link.from))];
    for (std::size_t i = 1 + inputs.size(); i < values.size(); ++i)
      values[i] = activated(genome.nodes[i].activation, linear, sums[i]);
  }
  std::vector<float> outputs;
  for (std::size_t i = 0; i < genome.nodes.size(); ++i)
    if (genome.nodes[i].kind == neat::NodeKind::output) outputs.push_back(values[i]);
  return outputs;
}

inline int recurrent_passes(const neat::Genome& genome, Passes passes) {
  const int hidden = genome.count(neat::NodeKind::hidden);
  return passes == Passes::twice_hidden_plus_1 ? 2 * hidden + 1 : 2 * hidden + 3;
}

inline std::uint32_t bits(float value) {
  return std::bit_cast<std::uint32_t>(value);
}

}  // namespace amble::cppn::plain
