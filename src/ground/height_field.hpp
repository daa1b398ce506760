#pragma once

#include <cstdint>
#include <vector>

#include "amble/ground/settings.hpp"

namespace amble::ground {

/// Heights over a square grid of the plane, repeated in both directions without end; bilinear in each cell.
class HeightField {
 public:
  static constexpr int cells = 256;  ///< along x and along y: a power of two

  /// All heights 0.
  explicit HeightField(double cell_m);

  double cell_m() const { return cell_m_; }
  double period_m() const { return cells * cell_m_; }
  float highest_m() const;

  /// Node (i, j) is at x = i cell_m, y = j cell_m; any integers.
  float& node(int i, int j) { return heights_m_[index(i, j)]; }
  float node(int i, int j) const { return heights_m_[index(i, j)]; }
  /// Row by row, x faster than y.
  const std::vector<float>& heights_m() const { return heights_m_; }
  std::vector<float>& heights_m() { return heights_m_; }

  struct Sample {
    double height_m;
    double slope_x, slope_y;  ///< partial derivatives
  };
  /// At any finite place, m.
  Sample at(double x_m, double y_m) const;

 private:
  static std::size_t index(int i, int j) {
    constexpr unsigned mask = cells - 1;
    return (static_cast<unsigned>(j) & mask) * std::size_t{cells} + (static_cast<unsigned>(i) & mask);
  }

  double cell_m_;
  std::vector<float> heights_m_;
};

/// Names one field among those of the same settings. It is the same on every CPU, to the bit.
struct Key {
  std::uint64_t seed = 0;        ///< of the run; without effect only with Vary::never and set 0
  std::uint32_t generation = 0;  ///< for the curriculum of set 0, and with Vary::generations
  std::uint32_t set = 0;         ///< 0: that of evolution; others: grounds unseen during evolution

  friend bool operator==(const Key&, const Key&) = default;
};

/// The same for all keys that give the same field.
Key normalised(const Settings& settings, Key key);

/// The field of these settings; of the plane, one of height 0. A curriculum scales that of evolution (set 0)
/// by generation / grow_generations; all others have their full heights.
HeightField make_field(const Settings& settings, const Key& key);

/// Where the centre of a ball of radius `radius_m` is when it touches `field`: the lowest heights at which it
/// is nowhere in the ground (the Minkowski sum of the ground and the ball). The slope of this field at the
/// ball's centre is that of the ground where the ball touches it.
HeightField offset_field(const HeightField& field, double radius_m);

}  // namespace amble::ground
