#pragma once

#include <array>

/// Two poles on a cart, by the equations and constants of Wieland (1991) as Gomez and Miikkulainen (1999) and
/// Stanley and Miikkulainen (2002) use them: Runge-Kutta of fourth order in steps of 0.01 s, a force of up to
/// 10 N every 0.02 s, poles of 1 m and 0.1 m.
class Poles {
 public:
  /// Cart's position (m) and speed, first pole's angle (rad) and speed, second pole's.
  using State = std::array<double, 6>;

  State state{0.0, 0.0, four_degrees, 0.0, 0.0, 0.0};

  /// `push` in [−1, 1].
  void step(double push);
  /// Whether the cart is within 2.4 m and both poles within 36° of upright.
  bool stands() const;

  static constexpr double four_degrees = 0.07, limit_m = 2.4, limit_rad = 0.6283185307179586;
};
