#include "amble/core/random.hpp"

#include <Random123/philox.h>

#include <cmath>

#include "amble/core/check.hpp"
#include "amble/core/elementary.hpp"
#include "amble/core/index.hpp"

namespace amble {

Stream::Stream(std::uint64_t seed, Purpose purpose, std::uint32_t generation, std::uint32_t individual)
    : key_{static_cast<std::uint32_t>(seed), static_cast<std::uint32_t>(seed >> 32)},
      counter_{0, static_cast<std::uint32_t>(purpose), generation, individual} {}

void Stream::refill() {
  const r123::Philox4x32 philox;
  const auto out = philox({{counter_[0], counter_[1], counter_[2], counter_[3]}}, {{key_[0], key_[1]}});
  for (std::size_t i = 0; i < 4; ++i) block_[i] = out[i];
  ++counter_[0];
  AMBLE_CHECK(counter_[0] != 0, "a random stream ran out of numbers");
  used_ = 0;
}

std::uint32_t Stream::next_u32() {
  if (used_ == 4) refill();
  return block_[to_index(used_++)];
}

std::uint64_t Stream::next_u64() {
  const std::uint64_t high = next_u32();
  return high << 32 | next_u32();
}

double Stream::uniform() {
  return static_cast<double>(next_u64() >> 11) * 0x1.0p-53;
}

double Stream::uniform(double low, double high) {
  return low + (high - low) * uniform();
}

std::uint32_t Stream::below(std::uint32_t count) {
  AMBLE_CHECK(count > 0, "below(0) has no value");
  // Lemire 2019: the high half of x × count, rejecting the products that would favour some values.
  std::uint64_t product = std::uint64_t{next_u32()} * count;
  if (static_cast<std::uint32_t>(product) < count) {
    const std::uint32_t threshold = (0u - count) % count;
    while (static_cast<std::uint32_t>(product) < threshold) product = std::uint64_t{next_u32()} * count;
  }
  return static_cast<std::uint32_t>(product >> 32);
}

bool Stream::chance(double probability) {
  return uniform() < probability;
}

double Stream::normal() {
  if (has_spare_normal_) {
    has_spare_normal_ = false;
    return spare_normal_;
  }
  // √(−2 ln u₁) (cos, sin)(2π u₂) with u₁ in (0, 1].
  const double radius = std::sqrt(-2.0 * portable::log(1.0 - uniform()));
  const auto [sine, cosine] = portable::of_turns(uniform());
  spare_normal_ = radius * sine;
  has_spare_normal_ = true;
  return radius * cosine;
}

}  // namespace amble
