#include "amble/neat/distance.hpp"

#include <algorithm>
#include <cmath>

namespace amble::neat {

double compatibility_distance(const Genome& a, const Genome& b, const DistanceSettings& settings) {
  std::ptrdiff_t disjoint = 0, matching = 0;
  double weight_difference = 0.0;
  auto i = a.links.begin(), j = b.links.begin();
  while (i != a.links.end() && j != b.links.end()) {
    if (i->innovation == j->innovation) {
      ++matching;
      weight_difference += std::abs(i++->weight - j++->weight);
    } else {
      ++disjoint;
      i->innovation < j->innovation ? ++i : ++j;
    }
  }
  // One list is exhausted: the rest of the other is newer than all of it (excess).
  const auto excess = (a.links.end() - i) + (b.links.end() - j);

  double genes = 1.0;
  if (settings.normalised) {
    genes = static_cast<double>(std::max<std::size_t>({a.links.size(), b.links.size(), 1}));
    weight_difference /= static_cast<double>(std::max<std::ptrdiff_t>(matching, 1));
  }
  return (settings.excess * static_cast<double>(excess) + settings.disjoint * static_cast<double>(disjoint)) /
             genes +
         settings.weight * weight_difference;
}

}  // namespace amble::neat
