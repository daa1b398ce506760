#include "amble/search/line.hpp"

namespace amble::search {

neat::Genome moved_along_line(const neat::Genome& parent, const neat::Genome& mate,
                              const LineSettings& settings, Stream& stream) {
  neat::Genome child = parent;
  const double along = settings.line_sigma * stream.normal();
  auto other = mate.links.begin();
  for (neat::LinkGene& link : child.links) {
    while (other != mate.links.end() && other->innovation < link.innovation) ++other;
    const bool both = other != mate.links.end() && other->innovation == link.innovation;
    const double way = both ? other->weight - link.weight : 0.0;
    link.weight += settings.iso_sigma * stream.normal() + along * way;
  }
  return child;
}

}  // namespace amble::search
