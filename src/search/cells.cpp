#include "amble/search/cells.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

#include "amble/core/check.hpp"
#include "amble/core/random.hpp"
#include "amble/statistics/distributions.hpp"

namespace amble::search {
namespace {

/// Position in the descriptor's range, 0 … 1.
float scaled(const DescriptorSettings& descriptor, float value) {
  const double share = (double{value} - descriptor.least) / (descriptor.most - descriptor.least);
  return static_cast<float>(std::clamp(share, 0.0, 1.0));
}

}  // namespace

GridCells::GridCells(std::span<const DescriptorSettings> descriptors)
    : descriptors_(descriptors.begin(), descriptors.end()) {
  for (const DescriptorSettings& descriptor : descriptors_)
    count_ *= static_cast<std::uint32_t>(descriptor.bins);
}

std::uint32_t GridCells::of(std::span<const float> descriptor) const {
  AMBLE_CHECK(descriptor.size() == descriptors_.size(), "one value per dimension");
  std::uint32_t cell = 0;
  for (std::size_t i = 0; i < descriptors_.size(); ++i) {
    const DescriptorSettings& dimension = descriptors_[i];
    const double share = (double{descriptor[i]} - dimension.least) / (dimension.most - dimension.least);
    const double bin = std::clamp(std::floor(share * dimension.bins), 0.0, dimension.bins - 1.0);
    cell = cell * static_cast<std::uint32_t>(dimension.bins) + static_cast<std::uint32_t>(bin);
  }
  return cell;
}

double GridCells::share_inside(std::span<const float> descriptor, double deviation) const {
  double share = 1.0;
  for (std::size_t i = 0; i < descriptors_.size(); ++i) {
    const DescriptorSettings& dimension = descriptors_[i];
    const double place = (double{descriptor[i]} - dimension.least) / (dimension.most - dimension.least);
    const double bin = std::clamp(std::floor(place * dimension.bins), 0.0, dimension.bins - 1.0);
    // The outermost bins have what is beyond them as well.
    const double below = bin > 0.0 ? statistics::normal_cdf((bin / dimension.bins - place) / deviation) : 0.0;
    const double above = bin < dimension.bins - 1.0
                             ? statistics::normal_cdf((place - (bin + 1.0) / dimension.bins) / deviation)
                             : 0.0;
    share *= 1.0 - below - above;
  }
  return share;
}

/// k-d tree (Bentley 1975) over points in the unit cube: exact nearest neighbour.
class CentroidCells::Tree {
 public:
  Tree(std::span<const float> points, std::size_t dimensions)
      : points_(points), dimensions_(dimensions), order_(points.size() / dimensions), split_(order_.size()) {
    std::iota(order_.begin(), order_.end(), 0u);
    build(0, order_.size());
  }

  std::uint32_t nearest(const float* point) const {
    Best best;
    search(0, order_.size(), point, best);
    return best.index;
  }

 private:
  struct Best {
    double distance = std::numeric_limits<double>::infinity();
    std::uint32_t index = 0;
  };

  const float* at(std::uint32_t index) const { return points_.data() + index * dimensions_; }

  /// The middle of order_[first, last) is the node; those before it are not above it in its dimension, those
  /// after it not below.
  void build(std::size_t first, std::size_t last) {
    if (first >= last) return;
    std::size_t widest = 0;
    float width = -1.0f;
    for (std::size_t d = 0; d < dimensions_; ++d) {
      float low = 2.0f, high = -1.0f;
      for (std::size_t i = first; i < last; ++i) {
        low = std::min(low, at(order_[i])[d]);
        high = std::max(high, at(order_[i])[d]);
      }
      if (high - low > width) width = high - low, widest = d;
    }
    const std::size_t middle = first + (last - first) / 2;
    const auto begin = order_.begin();
    std::nth_element(begin + static_cast<std::ptrdiff_t>(first), begin + static_cast<std::ptrdiff_t>(middle),
                     begin + static_cast<std::ptrdiff_t>(last), [&](std::uint32_t a, std::uint32_t b) {
                       return std::pair(at(a)[widest], a) < std::pair(at(b)[widest], b);
                     });
    split_[middle] = static_cast<std::uint8_t>(widest);
    build(first, middle);
    build(middle + 1, last);
  }

  void search(std::size_t first, std::size_t last, const float* point, Best& best) const {
    if (first >= last) return;
    const std::size_t middle = first + (last - first) / 2, d = split_[middle];
    const std::uint32_t index = order_[middle];
    double distance = 0.0;
    for (std::size_t i = 0; i < dimensions_; ++i) {
      const double difference = double{at(index)[i]} - double{point[i]};
      distance += difference * difference;
    }
    if (std::pair(distance, index) < std::pair(best.distance, best.index)) best = {distance, index};
    const double beyond = double{point[d]} - double{at(index)[d]};
    const bool below = beyond < 0.0;
    below ? search(first, middle, point, best) : search(middle + 1, last, point, best);
    // Equal: a centroid just as near may have a lower number.
    if (beyond * beyond <= best.distance)
      below ? search(middle + 1, last, point, best) : search(first, middle, point, best);
  }

  std::span<const float> points_;
  std::size_t dimensions_;
  std::vector<std::uint32_t> order_;
  std::vector<std::uint8_t> split_;  ///< dimension of each node
};

CentroidCells::CentroidCells(std::span<const DescriptorSettings> descriptors, std::vector<float> centroids)
    : descriptors_(descriptors.begin(), descriptors.end()),
      dimensions_(descriptors.size()),
      centroids_(std::move(centroids)),
      tree_(std::make_unique<const Tree>(centroids_, dimensions_)) {
  AMBLE_CHECK(dimensions_ > 0 && dimensions_ < 256 && !centroids_.empty(), "there is a cell");
}

CentroidCells::~CentroidCells() = default;

std::uint32_t CentroidCells::of(std::span<const float> descriptor) const {
  AMBLE_CHECK(descriptor.size() == dimensions_, "one value per dimension");
  std::array<float, 256> point;
  for (std::size_t i = 0; i < dimensions_; ++i) point[i] = scaled(descriptors_[i], descriptor[i]);
  return tree_->nearest(point.data());
}

double CentroidCells::share_inside(std::span<const float> descriptor, double deviation) const {
  const float* const centroid = centroids_.data() + of(descriptor) * dimensions_;
  const double half = 0.5 * std::pow(count(), -1.0 / static_cast<double>(dimensions_));
  double share = 1.0;
  for (std::size_t i = 0; i < dimensions_; ++i) {
    const double from_centre = double{scaled(descriptors_[i], descriptor[i])} - double{centroid[i]};
    share *= statistics::normal_cdf((half - from_centre) / deviation) -
             statistics::normal_cdf((-half - from_centre) / deviation);
  }
  return share;
}

std::vector<float> spread_centroids(std::size_t count, std::size_t dimensions, std::size_t samples,
                                    std::uint64_t seed) {
  AMBLE_CHECK(count > 0 && count <= samples && dimensions > 0, "as many points as centroids");
  constexpr int most_rounds = 50;
  Stream stream(seed, Purpose::centroids);
  std::vector<float> points(samples * dimensions);
  for (float& value : points) value = static_cast<float>(stream.uniform());
  std::vector<float> centroids(points.begin(),
                               points.begin() + static_cast<std::ptrdiff_t>(count * dimensions));
  const std::vector<DescriptorSettings> unit(dimensions);
  std::vector<std::uint32_t> nearest(samples, std::numeric_limits<std::uint32_t>::max());
  for (int round = 0; round < most_rounds; ++round) {
    const CentroidCells cells(unit, centroids);
    bool changed = false;
    std::vector<double> sums(count * dimensions);
    std::vector<std::size_t> members(count);
    for (std::size_t i = 0; i < samples; ++i) {
      const std::span<const float> point = std::span(points).subspan(i * dimensions, dimensions);
      const std::uint32_t cell = cells.of(point);
      changed |= std::exchange(nearest[i], cell) != cell;
      ++members[cell];
      for (std::size_t d = 0; d < dimensions; ++d) sums[cell * dimensions + d] += double{point[d]};
    }
    if (!changed) break;
    for (std::size_t cell = 0; cell < count; ++cell)
      for (std::size_t d = 0; d < dimensions && members[cell] > 0; ++d)
        centroids[cell * dimensions + d] =
            static_cast<float>(sums[cell * dimensions + d] / static_cast<double>(members[cell]));
  }
  return centroids;
}

std::unique_ptr<const Cells> make_cells(const MapElitesSettings& settings) {
  if (settings.archive == Archive::grid) return std::make_unique<GridCells>(settings.descriptors);
  const auto count = static_cast<std::size_t>(settings.cells);
  return std::make_unique<CentroidCells>(
      settings.descriptors, spread_centroids(count, settings.descriptors.size(),
                                             static_cast<std::size_t>(settings.centroid_samples),
                                             static_cast<std::uint64_t>(settings.centroid_seed)));
}

}  // namespace amble::search
