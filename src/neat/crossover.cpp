#include "amble/neat/crossover.hpp"

#include <algorithm>
#include <iterator>
#include <optional>

#include "amble/neat/graph.hpp"

namespace amble::neat {
namespace {

/// All nodes of both parents, by rising id; where both have a node it is the fitter's.
std::vector<NodeGene> united_nodes(const Genome& fitter, const Genome& weaker) {
  std::vector<NodeGene> nodes;
  std::ranges::set_union(fitter.nodes, weaker.nodes, std::back_inserter(nodes), {}, &NodeGene::id,
                         &NodeGene::id);
  return nodes;
}

/// The link that the child already has between these nodes, under whatever number.
LinkGene* link_between(Genome& child, std::uint32_t from, std::uint32_t to) {
  const auto found = std::ranges::find_if(
      child.links, [&](const LinkGene& link) { return link.from == from && link.to == to; });
  return found == child.links.end() ? nullptr : &*found;
}

/// Decides which links of the weaker parent alone the child gets.
class WeakerLinks {
 public:
  WeakerLinks(const Genome& child, const Genome& fitter, const CrossoverSettings& settings, bool recurrent,
              Stream& stream)
      : child_(child),
        settings_(settings),
        stream_(stream),
        all_(stream.chance(settings.weaker_genes_probability)) {
    if (recurrent) return;
    graph_ = Graph::without_links(child);
    for (const LinkGene& link : fitter.links) graph_->add(child.index_of(link.from), child.index_of(link.to));
  }

  bool take(const LinkGene& link) {
    const bool wanted = settings_.weaker_genes == WeakerGenes::all_or_none
                            ? all_
                            : stream_.chance(settings_.weaker_genes_probability);
    if (!wanted || !graph_) return wanted;
    const int from = child_.index_of(link.from), to = child_.index_of(link.to);
    if (graph_->would_close_cycle(from, to)) return false;
    graph_->add(from, to);
    return true;
  }

 private:
  const Genome& child_;
  const CrossoverSettings& settings_;
  Stream& stream_;
  bool all_;
  std::optional<Graph> graph_;  ///< of the child, where cycles are barred
};

}  // namespace

Genome crossover(const Genome& fitter, const Genome& weaker, const CrossoverSettings& settings,
                 bool recurrent, Stream& stream) {
  Genome child{.nodes = united_nodes(fitter, weaker), .links = {}};
  child.links.reserve(fitter.links.size() + weaker.links.size());
  WeakerLinks weaker_links(child, fitter, settings, recurrent, stream);
  const auto inherit = [&](LinkGene link) {
    if (!link.enabled) link.enabled = stream.chance(settings.enable_probability);
    if (LinkGene* const same = link_between(child, link.from, link.to)) {
      same->weight = link.weight;
      same->enabled = link.enabled;
    } else {
      child.links.push_back(link);
    }
  };

  auto f = fitter.links.begin();
  auto w = weaker.links.begin();
  while (f != fitter.links.end() || w != weaker.links.end()) {
    const bool only_fitter =
        w == weaker.links.end() || (f != fitter.links.end() && f->innovation < w->innovation);
    const bool only_weaker =
        f == fitter.links.end() || (w != weaker.links.end() && w->innovation < f->innovation);
    if (only_fitter) {
      inherit(*f++);
    } else if (only_weaker) {
      if (weaker_links.take(*w) && link_between(child, w->from, w->to) == nullptr) inherit(*w);
      ++w;
    } else {
      LinkGene link = stream.chance(0.5) ? *f : *w;
      link.enabled = f->enabled && w->enabled;
      inherit(link);
      ++f;
      ++w;
    }
  }
  remove_unlinked_hidden_nodes(child);
  return child;
}

}  // namespace amble::neat
