#include "poles.hpp"

#include <cmath>
#include <cstddef>

namespace {

constexpr double gravity_m_s2 = -9.8, cart_kg = 1.0, friction_of_hinges = 0.000002;

struct Pole {
  double kg, half_length_m;
};
constexpr Pole poles[2] = {{0.1, 0.5}, {0.01, 0.05}};

Poles::State rates(const Poles::State& s, double force_n) {
  double force_sum = 0.0, mass_sum = 0.0, gravity_terms[2];
  for (std::size_t i = 0; i < 2; ++i) {
    const auto [kg, half_length_m] = poles[i];
    const double angle = s[2 + 2 * i], speed = s[3 + 2 * i], sine = std::sin(angle), cosine = std::cos(angle);
    const double hinge = friction_of_hinges * speed / (kg * half_length_m);
    gravity_terms[i] = gravity_m_s2 * sine + hinge;
    force_sum += kg * half_length_m * speed * speed * sine + 0.75 * kg * cosine * gravity_terms[i];
    mass_sum += kg * (1.0 - 0.75 * cosine * cosine);
  }
  const double acceleration = (force_n + force_sum) / (mass_sum + cart_kg);
  Poles::State d{s[1], acceleration, s[3], 0.0, s[5], 0.0};
  for (std::size_t i = 0; i < 2; ++i)
    d[3 + 2 * i] =
        -0.75 * (acceleration * std::cos(s[2 + 2 * i]) + gravity_terms[i]) / poles[i].half_length_m;
  return d;
}

Poles::State plus(Poles::State s, double h, const Poles::State& d) {
  for (std::size_t i = 0; i < s.size(); ++i) s[i] += h * d[i];
  return s;
}

}  // namespace

void Poles::step(double push) {
  constexpr double h = 0.01;
  for (int half = 0; half < 2; ++half) {
    const State a = rates(state, 10.0 * push), b = rates(plus(state, h / 2, a), 10.0 * push),
                c = rates(plus(state, h / 2, b), 10.0 * push), d = rates(plus(state, h, c), 10.0 * push);
    state = plus(plus(plus(plus(state, h / 6, a), h / 3, b), h / 3, c), h / 6, d);
  }
}

bool Poles::stands() const {
  return std::abs(state[0]) < limit_m && std::abs(state[2]) < limit_rad && std::abs(state[4]) < limit_rad;
}
