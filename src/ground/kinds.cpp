#include "amble/ground/kinds.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>

#include "amble/core/check.hpp"
#include "amble/core/index.hpp"
#include "amble/core/registry.hpp"

namespace amble::ground {
namespace {

/// Random numbers in [0, 1) at the nodes of a square lattice that repeats after `count` nodes.
class Lattice {
 public:
  Lattice(int count, Stream& stream) : count_(count), values_(to_index(count) * to_index(count)) {
    for (double& value : values_) value = stream.uniform();
  }

  int count() const { return count_; }
  double at(int i, int j) const {
    return values_[to_index(j % count_) * to_index(count_) + to_index(i % count_)];
  }

  /// At (u, v) ≥ 0 in units of the lattice; `ease` maps the place in a square, from 0 to 1.
  double between(double u, double v, double (*ease)(double)) const {
    const int i = static_cast<int>(u), j = static_cast<int>(v);
    const double s = ease(u - i), t = ease(v - j);
    const double near = at(i, j) + s * (at(i + 1, j) - at(i, j));
    const double far = at(i, j + 1) + s * (at(i + 1, j + 1) - at(i, j + 1));
    return near + t * (far - near);
  }

 private:
  int count_;
  std::vector<double> values_;
};

/// A place in squares, as many as fit into a period, each about length_m long.
class Squares {
 public:
  Squares(const Settings& settings, double period_m)
      : period_m_(period_m),
        count_(std::max(1, static_cast<int>(std::lround(period_m / settings.length_m)))) {}

  int count() const { return count_; }
  double of(double x_m, int count) const { return (x_m / period_m_ + 0.5) * count; }
  double of(double x_m) const { return of(x_m, count_); }

 private:
  double period_m_;
  int count_;
};

/// Smooth: three octaves of value noise, the longest length_m.
Shape hills(const Settings& settings, double period_m, Stream stream) {
  const Squares squares(settings, period_m);
  const auto first = std::make_shared<const Lattice>(squares.count(), stream);
  const auto second = std::make_shared<const Lattice>(2 * squares.count(), stream);
  const auto third = std::make_shared<const Lattice>(4 * squares.count(), stream);
  return [=](double x_m, double y_m) {
    double sum = 0.0, amplitude = 4.0 / 7.0;  // the amplitudes add up to 1
    for (const Lattice* octave : {first.get(), second.get(), third.get()}) {
      const int n = octave->count();
      sum += amplitude * octave->between(squares.of(x_m, n), squares.of(y_m, n), smooth);
      amplitude *= 0.5;
    }
    return sum - 0.5;
  };
}

/// A random height every length_m, straight between them.
Shape rough(const Settings& settings, double period_m, Stream stream) {
  const Squares squares(settings, period_m);
  const auto lattice = std::make_shared<const Lattice>(squares.count(), stream);
  return [=](double x_m, double y_m) {
    return lattice->between(squares.of(x_m), squares.of(y_m), [](double t) { return t; }) - 0.5;
  };
}

/// Square plateaus of random heights, length_m wide.
Shape stones(const Settings& settings, double period_m, Stream stream) {
  const Squares squares(settings, period_m);
  const auto lattice = std::make_shared<const Lattice>(squares.count(), stream);
  return [=](double x_m, double y_m) {
    return lattice->at(static_cast<int>(squares.of(x_m)), static_cast<int>(squares.of(y_m))) - 0.5;
  };
}

/// Half of the squares of length_m, at random, have a box half as wide, height_m high.
Shape blocks(const Settings& settings, double period_m, Stream stream) {
  const Squares squares(settings, period_m);
  const auto lattice = std::make_shared<const Lattice>(squares.count(), stream);
  return [=](double x_m, double y_m) {
    const double u = squares.of(x_m), v = squares.of(y_m);
    const int i = static_cast<int>(u), j = static_cast<int>(v);
    const bool inside = std::abs(u - i - 0.5) < 0.25 && std::abs(v - j - 0.5) < 0.25;
    return inside && lattice->at(i, j) < 0.5 ? 1.0 : 0.0;
  };
}

/// What is around the flat start: how far away it is along x or y, whichever is farther, in whole lengths and
/// the rest of one.
struct Ring {
  int number;  ///< from 0
  double rest_m;
};

template <typename Height>
Shape concentric(const Settings& settings, double period_m, Height height) {
  const double start_m = settings.start_radius_m, length_m = settings.length_m;
  const int last = static_cast<int>((0.5 * period_m - start_m) / length_m);
  return [=](double x_m, double y_m) {
    const double away_m = std::max(std::abs(x_m), std::abs(y_m)) - start_m;
    if (away_m < 0.0) return 0.0;
    const int number = static_cast<int>(away_m / length_m);
    return height(Ring{number, away_m - number * length_m}, last);
  };
}

/// Steps up and down again, height_m high and length_m deep.
Shape stairs(const Settings& settings, double period_m, const Stream&) {
  return concentric(settings, period_m, [](Ring ring, int last) {
    return static_cast<double>(std::max(0, std::min(1 + ring.number, last - ring.number)));
  });
}

/// Walls, height_m high, one every length_m.
Shape hurdles(const Settings& settings, double period_m, const Stream&) {
  return concentric(settings, period_m, [length_m = settings.length_m](Ring ring, int last) {
    return ring.number < last && ring.rest_m >= length_m - hurdle_m ? 1.0 : 0.0;
  });
}

// amble's own kinds. A new one is a row here and its function.
Registry<Kind>& all_kinds() {
  static Registry<Kind> all("ground", {{"plane", {}},
                                       {"hills", hills},
                                       {"rough", rough},
                                       {"stones", stones},
                                       {"blocks", blocks},
                                       {"stairs", stairs, true},
                                       {"hurdles", hurdles, true}});
  return all;
}

}  // namespace

void register_ground(Kind kind) {
  AMBLE_CHECK(kind.shape, "a ground needs a function that makes its shape");
  all_kinds().add(std::move(kind));
}

const Kind& kind_of(const Settings& settings) {
  const Kind* const kind = all_kinds().find(settings.kind);
  AMBLE_CHECK(kind != nullptr, "ground.kind is one of the kinds");
  return *kind;
}

const std::deque<Kind>& kinds() {
  return all_kinds().rows();
}

}  // namespace amble::ground
