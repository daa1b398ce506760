#pragma once

#include <bit>
#include <cmath>
#include <string>

#include "amble/core/random.hpp"
#include "tests/io/sample_settings.hpp"

namespace amble::test {

/// Settings with random values of every kind, each within its range: any finite double, any int64, texts with
/// all sorts of characters.
inline Sample random_sample(Stream& stream) {
  const auto text = [&] {
    static constexpr std::array<std::string_view, 12> pieces{
        "a", "\"", "\\", "\n", "\t", "#", "=", "é", "🦿", "'", "\x7f", std::string_view("\0", 1)};
    std::string result;
    for (std::uint32_t n = stream.below(8); n > 0; --n) result += pieces[stream.below(pieces.size())];
    return result;
  };
  const auto bits = [&] {
    while (true) {
      const auto value = std::bit_cast<double>(stream.next_u64());
      if (std::isfinite(value)) return value;
    }
  };
  Sample sample;
  sample.inner = {stream.uniform(), static_cast<std::int64_t>(stream.next_u64())};
  sample.deep = {std::ldexp(stream.uniform(), -1000), static_cast<std::int64_t>(stream.next_u64())};
  sample.name = text();
  sample.population = 2 + static_cast<int>(stream.below(999999));
  sample.friction = stream.chance(0.1) ? std::numeric_limits<double>::infinity() : std::abs(bits());
  sample.elitism = stream.chance(0.5);
  sample.colour = static_cast<Colour>(stream.below(3));
  sample.weights.resize(stream.below(5));
  for (double& weight : sample.weights) weight = stream.chance(0.2) ? -0.0 : stream.uniform(-10.0, 10.0);
  sample.legs.clear();
  for (std::uint32_t n = stream.below(4); n > 0; --n) sample.legs.push_back(text());
  sample.knots.resize(stream.below(4));
  for (auto& knot : sample.knots) {
    knot = {text(), std::vector<double>(stream.below(3)), stream.chance(0.3) ? 0.5 : stream.uniform(),
            stream.chance(0.5)};
    for (double& x : knot.at) x = stream.uniform(-10.0, 10.0);
  }
  return sample;
}

/// All values of the settings in one text in which every bit of every number counts.
inline std::string fingerprint(const Sample& s) {
  std::string result;
  const auto add = [&](const void* data, std::size_t size) {
    result.append(static_cast<const char*>(data), size);
  };
  const auto add_text = [&](const std::string& text) { result += std::to_string(text.size()) + ":" + text; };
  for (const double number : {s.inner.rate, s.deep.rate, s.friction}) add(&number, sizeof number);
  for (const std::int64_t seed : {s.inner.seed, s.deep.seed}) add(&seed, sizeof seed);
  add_text(s.name);
  result +=
      std::to_string(s.population) + (s.elitism ? "+" : "-") + std::to_string(static_cast<int>(s.colour));
  result += std::to_string(s.weights.size()) + ",";
  for (const double weight : s.weights) add(&weight, sizeof weight);
  for (const std::string& leg : s.legs) add_text(leg);
  for (const Knot& knot : s.knots) {
    add_text(knot.name);
    result += std::to_string(knot.at.size()) + (knot.tight ? "+" : "-");
    add(&knot.length, sizeof knot.length);
    for (const double x : knot.at) add(&x, sizeof x);
  }
  return result;
}

}  // namespace amble::test
