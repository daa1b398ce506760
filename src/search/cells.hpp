#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "amble/core/circle.hpp"
#include "amble/search/settings.hpp"

namespace amble::search {

/// A partition of the space of descriptors into cells. Values outside a descriptor's range belong to its
/// first or last bin, or count as at that end of the range. Const, shared by all threads.
class Cells {
 public:
  virtual ~Cells() = default;
  virtual std::uint32_t count() const = 0;
  /// The cell of a descriptor: as many finite numbers as there are descriptors.
  virtual std::uint32_t of(std::span<const float> descriptor) const = 0;
  /// Probability that a descriptor known with a normal error of this standard deviation in each dimension, >
  /// 0 and in units of its range, is in the cell of `descriptor`.
  virtual double share_inside(std::span<const float> descriptor, double deviation) const = 0;
};

/// A grid (Mouret & Clune 2015): each descriptor's range in bins of equal width. The cell's number is
/// that of its bins as digits, the last descriptor's first: bin 0 of all is cell 0, bin 1 of the last cell 1.
class GridCells : public Cells {
 public:
  /// `circles` as in make_cells().
  explicit GridCells(std::span<const DescriptorSettings> descriptors, std::span<const Circle> circles = {});
  std::uint32_t count() const override { return count_; }
  std::uint32_t of(std::span<const float> descriptor) const override;
  double share_inside(std::span<const float> descriptor, double deviation) const override;

 private:
  std::vector<DescriptorSettings> descriptors_;
  std::vector<bool> closed_;  ///< by dimension: its ends are the same place
  std::uint32_t count_ = 1;
};

class CentroidTree;  // cells.cpp

/// The cells nearest to centroids (CVT-MAP-Elites, Vassiliades, Chatzilygeroudis & Mouret 2018), each
/// descriptor scaled to 0 … 1 over its range. Of equally near centroids the one with the lowest number.
class CentroidCells : public Cells {
 public:
  /// `centroids`: one after the other, in 0 … 1. `circles` as in make_cells().
  CentroidCells(std::span<const DescriptorSettings> descriptors, std::vector<float> centroids,
                std::span<const Circle> circles = {});
  ~CentroidCells() override;
  std::uint32_t count() const override { return static_cast<std::uint32_t>(centroids_.size() / dimensions_); }
  std::uint32_t of(std::span<const float> descriptor) const override;
  /// As if the cell were a cube around its centroid, with its share of the volume, that goes on beyond the
  /// ends of ranges which the cell reaches, or to those of a whole circle.
  double share_inside(std::span<const float> descriptor, double deviation) const override;
  std::span<const float> centroids() const { return centroids_; }

 private:
  std::vector<DescriptorSettings> descriptors_;
  std::vector<bool> closed_;  ///< by dimension: its ends are the same place
  std::size_t dimensions_;
  std::vector<float> centroids_;
  std::unique_ptr<const CentroidTree> tree_;
  std::vector<std::uint8_t>
      reaches_;  ///< by cell, dimension and end, the lower one first: 1 where it reaches it
};

/// Centroids spread evenly over the unit cube: Lloyd's algorithm on `samples` uniform points, from as many of
/// them as there are centroids, until no point changes its centroid or for 50 rounds. Depends on its
/// arguments alone.
std::vector<float> spread_centroids(std::size_t count, std::size_t dimensions, std::size_t samples,
                                    std::uint64_t seed);

/// As the settings say. `circles`: of each descriptor; those beyond the last are lines. Where a range is a
/// whole circle, from end to end, what leaves it at one end is in another cell, at the other end.
std::unique_ptr<const Cells> make_cells(const MapElitesSettings& settings,
                                        std::span<const Circle> circles = {});

}  // namespace amble::search
