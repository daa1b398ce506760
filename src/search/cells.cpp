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

/// Position in the descriptor's range, 0 … 1 within it.
double place_of(const DescriptorSettings& descriptor, float value) {
  return (double{value} - descriptor.least) / (descriptor.most - descriptor.least);
}

float scaled(const DescriptorSettings& descriptor, float value) {
  return static_cast<float>(std::clamp(place_of(descriptor, value), 0.0, 1.0));
}

/// Of which dimensions the range is a whole circle.
std::vector<bool> closed_of(std::span<const DescriptorSettings> descriptors,
                            std::span<const Circle> circles) {
  std::vector<bool> closed(descriptors.size(), false);
  for (std::size_t i = 0; i < std::min(descriptors.size(), circles.size()); ++i) {
    const double range = descriptors[i].most - descriptors[i].least, near = 1e-6 * range;
    closed[i] =
        std::abs(circles[i].turn - range) < near && std::abs(circles[i].lowest - descriptors[i].least) < near;
  }
  return closed;
}

}  // namespace

GridCells::GridCells(std::span<const DescriptorSettings> descriptors, std::span<const Circle> circles)
    : descriptors_(descriptors.begin(), descriptors.end()), closed_(closed_of(descriptors, circles)) {
  for (const DescriptorSettings& descriptor : descriptors_)
    count_ *= static_cast<std::uint32_t>(descriptor.bins);
}

std::uint32_t GridCells::of(std::span<const float> descriptor) const {
  AMBLE_CHECK(descriptor.size() == descriptors_.size(), "one value per dimension");
  std::uint32_t cell = 0;
  for (std::size_t i = 0; i < descriptors_.size(); ++i) {
    const DescriptorSettings& dimension = descriptors_[i];
    const double place = place_of(dimension, descriptor[i]);
    const double bin = std::clamp(std::floor(place * dimension.bins), 0.0, dimension.bins - 1.0);
    cell = cell * static_cast<std::uint32_t>(dimension.bins) + static_cast<std::uint32_t>(bin);
  }
  return cell;
}

double GridCells::share_inside(std::span<const float> descriptor, double deviation) const {
  double share = 1.0;
  for (std::size_t i = 0; i < descriptors_.size(); ++i) {
    const DescriptorSettings& dimension = descriptors_[i];
    const double place = place_of(dimension, descriptor[i]);
    const double bin = std::clamp(std::floor(place * dimension.bins), 0.0, dimension.bins - 1.0);
    // The outermost bins have what is beyond them as well, unless that is at the other end.
    const bool goes_round = closed_[i] && dimension.bins > 1;
    const double below =
        bin > 0.0 || goes_round ? statistics::normal_cdf((bin / dimension.bins - place) / deviation) : 0.0;
    const double above = bin < dimension.bins - 1.0 || goes_round
                             ? statistics::normal_cdf((place - (bin + 1.0) / dimension.bins) / deviation)
                             : 0.0;
    share *= 1.0 - below - above;
  }
  return share;
}

/// k-d tree (Bentley 1975) over points in the unit cube: exact nearest neighbour.
class CentroidTree {
 public:
  CentroidTree(std::span<const float> points, std::size_t dimensions)
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

namespace {

/// Half the edge of a cube with a cell's share of the volume.
double half_edge(std::size_t cells, std::size_t dimensions) {
  return 0.5 * std::pow(static_cast<double>(cells), -1.0 / static_cast<double>(dimensions));
}

/// CentroidCells::reaches_: a cell reaches an end of a dimension if its centroid, moved there, is still in
/// it.
std::vector<std::uint8_t> reached_ends(const CentroidTree& tree, std::span<const float> centroids,
                                       std::size_t dimensions) {
  const std::size_t count = centroids.size() / dimensions;
  const double near = 4.0 * half_edge(count, dimensions);  // cells are hardly so long, and looking costs time
  std::vector<std::uint8_t> reaches;
  reaches.reserve(2 * centroids.size());
  std::vector<float> point(dimensions);
  for (std::size_t cell = 0; cell < count; ++cell) {
    std::ranges::copy(centroids.subspan(cell * dimensions, dimensions), point.begin());
    for (float& coordinate : point)
      for (const float end : {0.0f, 1.0f}) {
        const float own = std::exchange(coordinate, end);
        reaches.push_back(std::abs(end - own) < near && tree.nearest(point.data()) == cell);
        coordinate = own;
      }
  }
  return reaches;
}

}  // namespace

CentroidCells::CentroidCells(std::span<const DescriptorSettings> descriptors, std::vector<float> centroids,
                             std::span<const Circle> circles)
    : descriptors_(descriptors.begin(), descriptors.end()),
      closed_(closed_of(descriptors, circles)),
      dimensions_(descriptors.size()),
      centroids_(std::move(centroids)),
      tree_(std::make_unique<const CentroidTree>(centroids_, dimensions_)),
      reaches_(reached_ends(*tree_, centroids_, dimensions_)) {
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
  const std::size_t first = of(descriptor) * dimensions_;
  const double half = half_edge(count(), dimensions_);
  double share = 1.0;
  for (std::size_t i = 0; i < dimensions_; ++i) {
    const double place = place_of(descriptors_[i], descriptor[i]),
                 from_centre = place - double{centroids_[first + i]};
    const std::uint8_t* const reaches = &reaches_[2 * (first + i)];
    const bool ends_below = reaches[0] || place <= 0.0, ends_above = reaches[1] || place >= 1.0;
    double below = ends_below ? 0.0 : statistics::normal_cdf((-half - from_centre) / deviation);
    double above = ends_above ? 0.0 : statistics::normal_cdf((from_centre - half) / deviation);
    if (closed_[i] && ends_below != ends_above) {
      // Behind the end comes the other end.
      if (ends_below) below = statistics::normal_cdf(-place / deviation);
      if (ends_above) above = statistics::normal_cdf((place - 1.0) / deviation);
    }
    share *= 1.0 - below - above;
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
  std::vector<std::uint32_t> nearest(samples, std::numeric_limits<std::uint32_t>::max());
  for (int round = 0; round < most_rounds; ++round) {
    const CentroidTree cells(centroids, dimensions);
    bool changed = false;
    std::vector<double> sums(count * dimensions);
    std::vector<std::size_t> members(count);
    for (std::size_t i = 0; i < samples; ++i) {
      const std::span<const float> point = std::span(points).subspan(i * dimensions, dimensions);
      const std::uint32_t cell = cells.nearest(point.data());
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

std::unique_ptr<const Cells> make_cells(const MapElitesSettings& settings, std::span<const Circle> circles) {
  if (settings.archive == Archive::grid) return std::make_unique<GridCells>(settings.descriptors, circles);
  const auto count = static_cast<std::size_t>(settings.cells);
  return std::make_unique<CentroidCells>(settings.descriptors,
                                         spread_centroids(count, settings.descriptors.size(),
                                                          static_cast<std::size_t>(settings.centroid_samples),
                                                          static_cast<std::uint64_t>(settings.centroid_seed)),
                                         circles);
}

}  // namespace amble::search
