#include "amble/search/map_elites_settings.hpp"

#include <algorithm>
#include <cmath>

#include "amble/core/error.hpp"

namespace amble::search {

void DescriptorSettings::describe(io::SettingsVisitor& visitor) {
  visitor.text("quantity", quantity, {"one of the quantities of docs/SCORES.md"});
  visitor.text("leg", leg, {"of which leg, by its name in the robot file; \"\": the mean over all legs"});
  visitor.number("least", least, {-1e9, 1e9}, {"lower end of its range; less counts as this"});
  visitor.number("most", most, {-1e9, 1e9}, {"upper end of its range"});
  visitor.integer("bins", bins, {1, 1e6}, {"bins of equal width in a grid"});
}

void MapElitesSettings::describe(io::SettingsVisitor& visitor) {
  visitor.tables("descriptors", descriptors,
                 {"dimensions of the map (docs/REPERTOIRES.md); there must be one",
                  "duty factor of each leg: Cully et al. 2015; Tarapore et al. 2016"});
  visitor.choice("archive", archive, archive_names,
                 {"cells of the map: a grid of bins, or the surroundings of evenly spread centroids",
                  "Mouret & Clune 2015; Vassiliades, Chatzilygeroudis & Mouret 2018"});
  visitor.integer("cells", cells, {1, most_cells}, {"number of centroids of a cvt archive"});
  visitor.integer("centroid_samples", centroid_samples, {1, 1e8},
                  {"points from which the centroids are made; at least as many as cells"});
  visitor.integer("centroid_seed", centroid_seed, {0, 1e18},
                  {"seed of these points: runs with other seeds still have the same cells"});
  visitor.integer("batch", batch, {1, 1e6}, {"genomes evaluated in a round (a generation)"});
  visitor.integer("initial", initial, {1, 1e9},
                  {"random genomes in the first rounds, rounded up to whole rounds"});
  visitor.choice("select", select, selection_names,
                 {"parents: any elite, or of two elites that with the better objective, or the more curious",
                  "curiosity: Cully & Demiris 2018"});
  visitor.number("crossover_probability", crossover_probability, {0, 1},
                 {"of children with two parents; all others are mutated copies", "Tarapore et al. 2016: 0"});
  visitor.number("reevaluate_share", reevaluate_share, {0, 0.9},
                 {"share of each batch in which elites are evaluated again, those with the fewest "
                  "evaluations first; makes sense under noise"});
  visitor.integer(
      "trials", trials, {1, 1e6},
      {"evaluations, each under another generation's noise, that a candidate needs at least before it "
       "enters the map; from 2 on it must be worth more than the elite there, if their descriptors are "
       "known no better than they are (docs/REPERTOIRES.md)",
       "Justesen, Risi & Mouret 2019; Flageat & Cully 2023"});
  visitor.number(
      "challenger_share", challenger_share, {0, 0.9},
      {"share of each batch at most in which candidates that would enter are tried again, the most "
       "promising ones; without effect if trials = 1"});
}

void MapElitesSettings::validate() const {
  if (descriptors.empty())
    fail_setting({"search.map_elites.descriptors"},
                 "search.map_elites.descriptors: expected at least one, e.g. {{ quantity = \"duty_factor\", "
                 "bins = 20 }}");
  for (const DescriptorSettings& descriptor : descriptors)
    if (!(descriptor.least < descriptor.most))
      fail_setting({"search.map_elites.descriptors"},
                   "search.map_elites.descriptors: {}: least = {} is not below most = {}",
                   descriptor.quantity, descriptor.least, descriptor.most);
  if (cell_count() == 0)
    fail_setting({"search.map_elites.descriptors"},
                 "search.map_elites.descriptors: expected at most {} cells; archive = \"cvt\" has as many as "
                 "wanted in any number of dimensions",
                 most_cells);
  if (trials > 1 && challenger_share + reevaluate_share > 0.95)
    fail_setting(
        {"search.map_elites.challenger_share", "search.map_elites.reevaluate_share"},
        "search.map_elites.challenger_share + reevaluate_share = {}: expected at most 0.95, or hardly a new "
        "genome is tried",
        challenger_share + reevaluate_share);
  if (trials > 1 && most_challengers() == 0)
    fail_setting(
        {"search.map_elites.challenger_share", "search.map_elites.trials"},
        "search.map_elites.challenger_share = {}: expected more if trials = {}: no candidate could be tried "
        "again",
        challenger_share, trials);
  if (archive == Archive::cvt && centroid_samples < cells)
    fail_setting({"search.map_elites.centroid_samples", "search.map_elites.cells"},
                 "search.map_elites.centroid_samples = {}: expected at least search.map_elites.cells, {}",
                 centroid_samples, cells);
}

std::uint32_t MapElitesSettings::cell_count() const {
  if (archive == Archive::cvt) return static_cast<std::uint32_t>(cells);
  std::uint64_t count = 1;
  for (const DescriptorSettings& descriptor : descriptors) {
    count *= static_cast<std::uint64_t>(descriptor.bins);
    if (count > most_cells) return 0;
  }
  return static_cast<std::uint32_t>(count);
}

std::size_t MapElitesSettings::most_challengers() const {
  return static_cast<std::size_t>(std::lround(challenger_share * batch));
}

std::size_t MapElitesSettings::reevaluations(std::size_t elites) const {
  return std::min(elites, static_cast<std::size_t>(std::lround(reevaluate_share * batch)));
}

}  // namespace amble::search
