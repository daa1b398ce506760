#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "amble/core/random.hpp"
#include "amble/search/behaviours.hpp"
#include "amble/search/evaluation.hpp"

namespace amble::search {

using Rows = std::vector<std::vector<float>>;

/// What behaviours may look like, harmless and degenerate.
enum class Shape { normal, small_whole_numbers, all_equal, straight_paths, huge, tiny, far_and_close, mixed };
inline constexpr std::array shapes{
    Shape::normal, Shape::small_whole_numbers, Shape::all_equal, Shape::straight_paths, Shape::huge,
    Shape::tiny,   Shape::far_and_close,       Shape::mixed};

inline std::vector<float> random_row(Shape shape, std::size_t length, Stream& stream) {
  std::vector<float> row(length);
  const double speed = stream.normal();
  for (std::size_t i = 0; i < length; ++i) {
    double value = 0.0;
    switch (shape) {
      case Shape::normal:
        value = stream.normal();
        break;
      case Shape::small_whole_numbers:
        value = stream.below(3);
        break;
      case Shape::all_equal:
        value = 0.1 * static_cast<double>(i + 1);
        break;
      case Shape::straight_paths:
        value = speed * static_cast<double>(i);
        break;
      case Shape::huge:
        value = stream.uniform(-3e38, 3e38);
        break;
      case Shape::tiny:
        value = stream.uniform(-1e-37, 1e-37) * (stream.chance(0.5) ? 1.0 : 1e-6);
        break;
      case Shape::far_and_close:
        value = 1e4 + 1e-3 * stream.normal();
        break;
      case Shape::mixed:
        return random_row(shapes[stream.below(shapes.size() - 1)], length, stream);
    }
    row[i] = static_cast<float>(value);
  }
  return row;
}

inline Rows random_rows(Shape shape, std::size_t count, std::size_t length, Stream& stream) {
  Rows rows;
  while (rows.size() < count) rows.push_back(random_row(shape, length, stream));
  return rows;
}

inline Behaviours to_behaviours(const Rows& rows) {
  Behaviours behaviours(rows.front().size(), rows.size());
  for (const auto& row : rows) behaviours.append(row);
  return behaviours;
}

/// One generation's evaluations; the objective is the index.
inline std::vector<Evaluation> evaluations(const Rows& rows) {
  std::vector<Evaluation> result;
  for (const auto& row : rows)
    result.push_back({.objective = static_cast<double>(result.size()), .behaviour = row});
  return result;
}

}  // namespace amble::search
