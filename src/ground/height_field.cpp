#include "amble/ground/height_field.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "amble/core/hash.hpp"
#include "amble/core/index.hpp"
#include "amble/core/random.hpp"
#include "amble/ground/kinds.hpp"

namespace amble::ground {
namespace {

constexpr double blend_m = 0.3;  ///< from the flat start to the full heights

Stream stream_of(const Settings& settings, const Key& key) {
  const auto own = static_cast<std::uint64_t>(settings.seed);
  if (settings.vary == Vary::never && key.set == 0) return {own, Purpose::ground};
  const std::array<std::uint64_t, 2> both{own, key.seed};
  const bool varies = settings.vary == Vary::generations;
  return {hash_bytes(both.data(), sizeof both), Purpose::ground, varies ? 1 + key.generation : 0, key.set};
}

double scale_of(const Settings& settings, const Key& key) {
  if (settings.grow_generations == 0 || key.set != 0) return settings.height_m;
  return settings.height_m * std::min(1.0, static_cast<double>(key.generation) / settings.grow_generations);
}

/// A field at quarters of its cells. Row by row for each of the 4 × 4 places in a cell, each row twice, so
/// that a shifted row is contiguous.
class FineField {
 public:
  static constexpr int parts = 4;  ///< per cell, along x and along y

  explicit FineField(const HeightField& field) : rows_m_(to_index(parts * parts * size) * row) {
    std::array<float, size> near{}, far{};
    for (int j = 0; j < size; ++j)
      for (int a = 0; a < parts; ++a) {
        const float s = static_cast<float>(a) / parts;
        for (int i = 0; i < size; ++i) {
          near[to_index(i)] = field.node(i, j) + s * (field.node(i + 1, j) - field.node(i, j));
          far[to_index(i)] = field.node(i, j + 1) + s * (field.node(i + 1, j + 1) - field.node(i, j + 1));
        }
        for (int b = 0; b < parts; ++b) {
          const float t = static_cast<float>(b) / parts;
          float* const to = at(a, b, j);
          for (std::size_t i = 0; i < near.size(); ++i) to[i] = near[i] + t * (far[i] - near[i]);
          std::copy_n(to, size, to + size);
        }
      }
  }

  /// Raises each node of `offset` to `rise_m` over the place that is p and q quarters of a cell from it.
  void raise(HeightField& offset, int p, int q, float rise_m) const {
    constexpr int whole = parts * size;  // makes what is wrapped positive
    const int i = (p + whole) / parts % size, a = (p + whole) % parts, b = (q + whole) % parts;
    for (int j = 0; j < size; ++j) {
      const float* const from = at(a, b, (j + (q + whole) / parts) % size) + i;
      float* const to = &offset.node(0, j);
      for (int k = 0; k < size; ++k) to[k] = std::max(to[k], rise_m + from[k]);
    }
  }

 private:
  static constexpr int size = HeightField::cells;
  static constexpr std::size_t row = 2 * to_index(size);

  float* at(int a, int b, int j) { return rows_m_.data() + to_index((b * parts + a) * size + j) * row; }
  const float* at(int a, int b, int j) const {
    return rows_m_.data() + to_index((b * parts + a) * size + j) * row;
  }

  std::vector<float> rows_m_;
};

}  // namespace

HeightField::HeightField(double cell_m)
    : cell_m_(cell_m), heights_m_(std::size_t{cells} * std::size_t{cells}) {}

float HeightField::highest_m() const {
  return *std::ranges::max_element(heights_m_);
}

HeightField::Sample HeightField::at(double x_m, double y_m) const {
  const double u = x_m / cell_m_, v = y_m / cell_m_;
  const double left = std::floor(u), front = std::floor(v);
  // Whole periods are taken off first, so that any finite place fits into an int.
  const int i = static_cast<int>(left - cells * std::floor(left / cells));
  const int j = static_cast<int>(front - cells * std::floor(front / cells));
  const double s = u - left, t = v - front;
  const double a = node(i, j), b = node(i + 1, j), c = node(i, j + 1), d = node(i + 1, j + 1);
  const double near = a + s * (b - a), far = c + s * (d - c);
  return {.height_m = near + t * (far - near),
          .slope_x = ((b - a) + t * ((d - c) - (b - a))) / cell_m_,
          .slope_y = (far - near) / cell_m_};
}

Key normalised(const Settings& settings, Key key) {
  if (settings.vary == Vary::generations) return key;
  if (key.set == 0) key.seed = 0;
  key.generation =
      key.set == 0 ? std::min(key.generation, static_cast<std::uint32_t>(settings.grow_generations)) : 0;
  return key;
}

HeightField make_field(const Settings& settings, const Key& key) {
  HeightField field(settings.cell_m);
  if (!settings.has_field()) return field;
  const double period_m = field.period_m(), scale_m = scale_of(settings, key);
  const Kind& kind = kind_of(settings);
  Settings all = settings;
  all.own.complete(kind.numbers);
  const Shape shape = kind.shape(all, period_m, stream_of(settings, key));
  constexpr int half = HeightField::cells / 2;
  for (int j = -half; j < half; ++j)
    for (int i = -half; i < half; ++i) {
      const double x_m = i * settings.cell_m, y_m = j * settings.cell_m;
      double height_m = scale_m * shape(x_m, y_m);
      if (!kind.concentric) {
        const double away_m = std::sqrt(x_m * x_m + y_m * y_m) - settings.start_radius_m;
        height_m *= smooth(std::clamp(away_m / blend_m, 0.0, 1.0));
      }
      field.node(i, j) = static_cast<float>(height_m);
    }
  return field;
}

HeightField offset_field(const HeightField& field, double radius_m) {
  if (radius_m == 0.0) return field;
  const FineField fine(field);
  HeightField offset(field.cell_m());
  std::ranges::fill(offset.heights_m(), -HUGE_VALF);
  // The ball's lower half as samples on the fine grid, thinned for large balls; about 200 samples then.
  const double quarter_m = field.cell_m() / FineField::parts;
  const int stride = std::max(1, static_cast<int>(radius_m / 8.0 / quarter_m));
  const int reach = static_cast<int>(radius_m / quarter_m) / stride * stride;
  for (int q = -reach; q <= reach; q += stride)
    for (int p = -reach; p <= reach; p += stride) {
      const double x_m = p * quarter_m, y_m = q * quarter_m;
      const double square = radius_m * radius_m - x_m * x_m - y_m * y_m;
      if (square >= 0.0) fine.raise(offset, p, q, static_cast<float>(std::sqrt(square)));
    }
  return offset;
}

}  // namespace amble::ground
