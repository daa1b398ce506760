#include "amble/search/settings.hpp"

#include <algorithm>
#include <cmath>

#include "amble/core/error.hpp"
#include "amble/search/distance_estimates.hpp"

namespace amble::search {
namespace {

/// A range of a descriptor by which values can be divided.
constexpr double least_range = 1e-9;
/// As many numbers as a place of a map can have.
constexpr std::size_t most_descriptors = 255;
/// Genomes at most of which each is compared with each: seconds a round.
constexpr int most_compared = 20000;

constexpr std::string_view authors = "the authors' code", paper = "Morse et al. 2013, sec. 4";

}  // namespace

void NoveltySettings::describe(io::SettingsVisitor& visitor) {
  visitor.integer(
      "path_stride", path_stride, {1, 1e6},
      {"a behaviour is the path of the centre of mass (x, y), sampled once in every so many steps",
       "the authors' code: 2; Morse et al. 2013, sec. 4: 1"});
  visitor.integer("path_first_step", path_first_step, {1, 1e6},
                  {"in which of them, counted from 1; at most path_stride", "the authors' code: 1"});
  visitor.choice("distance", distance, distance_names,
                 {"distance of two behaviours: the sum of squared differences, or its root",
                  "the authors' code: squared; Morse et al. 2013, sec. 4: root (\"Cartesian distance\")"});
  visitor.choice("compare_with", compare_with, neighbours_names,
                 {"the behaviours among which the nearest neighbours are searched",
                  "the authors' code: archive; Lehman & Stanley 2011: archive_and_population"});
  visitor.integer(
      "neighbours", neighbours, {1, 1e6},
      {"novelty is the sum of the distances to so many nearest neighbours; absent ones count 0", paper});
  visitor.number("threshold", threshold, {1e-9, 1e12},
                 {"a candidate of higher novelty is added to the archive; the value in generation 0", paper});
  visitor.integer("first_members", first_members, {0, 1e6},
                  {"while the archive has fewer members, every candidate is added", authors});
  visitor.flag("count_first_members", count_first_members,
               {"whether candidates added for that reason alone count when the threshold adapts",
                "the authors' code: false; Lehman's code: true"});
  visitor.integer("raise_above", raise_above, {0, 1e6},
                  {"a generation that adds more members than this raises the threshold", authors});
  visitor.number("raise_factor", raise_factor, {1, 1e3}, {"by this factor", authors});
  visitor.integer("lower_after", lower_after, {1, 1e6},
                  {"the threshold is lowered when so many generations in a row have added no candidate",
                   "the authors' code: 4; Lehman's code: 10"});
  visitor.choice("lowering", lowering, lowering_names,
                 {"and then again in each further such generation, or after as many more",
                  "the authors' code: each_generation; Lehman's code: count_anew"});
  visitor.number("lower_factor", lower_factor, {1e-3, 1},
                 {"by this factor", "the authors' code: 0.8; Lehman's code: 0.95"});
  visitor.number("lowest_threshold", lowest_threshold, {0, 1e12},
                 {"but not below this", "the authors' code: none; Lehman's code: 0.25"});
  visitor.integer("archive_limit", archive_limit, {1, 1e9},
                  {"most members of the archive; then none is added"});
}

void NoveltySettings::validate(std::size_t behaviour_length) const {
  if (path_first_step > path_stride)
    fail_setting({"search.novelty.path_first_step", "search.novelty.path_stride"},
                 "search.novelty.path_first_step = {}: expected at most search.novelty.path_stride, {}",
                 path_first_step, path_stride);
  if (behaviour_length == 0)
    fail_setting({"search.novelty.path_stride", "trial.duration_s"},
                 "search.novelty.path_stride = {}: expected at most the steps of a trial", path_stride);
  if (behaviour_length > longest_behaviour)
    fail_setting(
        {"search.novelty.path_stride", "trial.duration_s"},
        "search.novelty.path_stride = {}: behaviours of {} numbers; expected at most {}, by a larger stride",
        path_stride, behaviour_length, longest_behaviour);
}

void NoveltySettings::check_memory(std::size_t behaviour_length, int population, double memory_bytes) const {
  // A member needs its behaviour, its norm (twice while a generation is judged), and a product with each
  // candidate.
  const double per_member = static_cast<double>(behaviour_length) * sizeof(float) + 2.0 * sizeof(double) +
                            static_cast<double>(population) * sizeof(float);
  // A generation, and what it needs to be compared with itself.
  const double size = population;
  const double generation = size * (static_cast<double>(behaviour_length) * sizeof(float) +
                                    2.0 * sizeof(double) + size * sizeof(float));
  const double bytes = per_member * archive_limit + generation;
  constexpr double giga = 1e9;
  if (bytes <= memory_bytes) return;
  if (generation > memory_bytes)
    fail_setting({"population.size"},
                 "population.size = {}: the distances between so many behaviours need {:.1f} GB; expected "
                 "less, for the {:.1f} GB that this process may use",
                 population, generation / giga, memory_bytes / giga);
  // The products with the candidates may be more than the behaviours themselves.
  const double without_population = per_member - static_cast<double>(population) * sizeof(float);
  if (without_population * archive_limit + generation <= memory_bytes)
    fail_setting({"population.size", "search.novelty.archive_limit"},
                 "population.size = {} × search.novelty.archive_limit = {}: the distances between them need "
                 "{:.1f} GB; "
                 "expected less of either, for the {:.1f} GB that this process may use",
                 population, archive_limit, bytes / giga, memory_bytes / giga);
  fail_setting(
      {"search.novelty.archive_limit"},
      "search.novelty.archive_limit = {}: that many behaviours of {} numbers need {:.1f} GB; expected at "
      "most {:.0f}, for the {:.1f} GB that this process may use",
      archive_limit, behaviour_length, bytes / giga, std::floor((memory_bytes - generation) / per_member),
      memory_bytes / giga);
}

void DescriptorSettings::describe(io::SettingsVisitor& visitor) {
  visitor.text("quantity", quantity, {"one of the quantities of docs/SCORES.md"});
  visitor.text("leg", leg, {"of which leg, by its name in the robot file; \"\": the mean over all legs"});
  visitor.number("least", least, {-1e9, 1e9}, {"lower end of its range; less falls into the first bin"});
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
  visitor.integer("centroid_samples", centroid_samples, {1, most_cells},
                  {"points from which the centroids are made; at least as many as cells"});
  visitor.integer("centroid_seed", centroid_seed, {0, 1e18},
                  {"seed of these points: runs with other seeds still have the same cells"});
  visitor.integer("batch", batch, {1, 1e6}, {"genomes evaluated in a round (a generation)"});
  visitor.integer(
      "initial", initial, {1, 1e9},
      {"random genomes in the first rounds, rounded up to whole rounds, less the challengers among them "
       "(trials); none where variation is cma"});
  visitor.choice(
      "select", select, selection_names,
      {"parents: any elite; of two elites that with the better objective, or the more curious; or any of a "
       "pool beside the map of genomes that are unlike all better ones",
       "curiosity: Cully & Demiris 2018; dominated: Bahlous-Boldi et al. 2025, arXiv 2502.00593"});
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
  visitor.choice(
      "variation", variation, variation_names,
      {.what = "new genomes: by NEAT's mutation; or weights alone, which genome.weight_limit then only "
               "bounds where "
               "they begin: along the line to another elite, or by CMA-ES towards what improves the map",
       .source =
           "line: Vassiliades & Mouret 2018; cma: CMA-MAE, Fontaine & Nikolaidis 2023, arXiv 2205.10752",
       .first_is_implied = true});
  visitor.table("pool", pool,
                {.what = "the pool of select = \"dominated\"; without effect under others",
                 .defaults_are_implied = true});
  visitor.table("line", line,
                {.what = "variation along lines; without effect under others", .defaults_are_implied = true});
  visitor.table("cma", cma,
                {.what = "variation by CMA-ES; without effect under others", .defaults_are_implied = true});
}

void PoolSettings::describe(io::SettingsVisitor& visitor) {
  visitor.integer("size", size, {2, 1e4}, {"genomes that it holds", "arXiv 2502.00593: 1024"});
  visitor.integer(
      "neighbours", neighbours, {1, 100},
      {"how many of the nearest better ones count for how unlike a genome is", "k of arXiv 2502.00593"});
}

void LineSettings::describe(io::SettingsVisitor& visitor) {
  visitor.number("iso_sigma", iso_sigma, {0.0, 1e3},
                 {"standard deviation of each weight's own step", "σ₁ of Vassiliades & Mouret 2018"});
  visitor.number(
      "line_sigma", line_sigma, {0.0, 1e3},
      {"standard deviation of the step that all weights share, as a share of the way to the other elite",
       "σ₂ of Vassiliades & Mouret 2018: 0.2"});
}

void CmaEmitterSettings::describe(io::SettingsVisitor& visitor) {
  visitor.integer("emitters", emitters, {1, 1e4},
                  {"distributions; what reevaluate_share leaves of the batch is shared out evenly, at least "
                   "4 candidates each"});
  visitor.number("step", step, {1e-9, 1e3},
                 {"standard deviation of each weight where an emitter begins", "σ₀ of arXiv 2205.10752"});
  visitor.number("learning_rate", learning_rate, {0.0, 1.0},
                 {"how much of the way a cell's threshold goes to the objective of a candidate that exceeds "
                  "it; 1: nearly CMA-ME, but that new cells do not come before all others",
                  "α of arXiv 2205.10752: 0.01"});
  visitor.number(
      "least_threshold", least_threshold, {-1e9, 1e9},
      {"threshold of a cell at first: what a candidate there must exceed", "min_f of arXiv 2205.10752"});
}

void MapElitesSettings::validate() const {
  if (descriptors.empty())
    fail_setting({"search.map_elites.descriptors"},
                 "search.map_elites.descriptors: expected at least one, e.g. {{ quantity = \"duty_factor\", "
                 "bins = 20 }}");
  for (const DescriptorSettings& descriptor : descriptors)
    if (!(descriptor.most - descriptor.least >= least_range))
      fail_setting(
          {"search.map_elites.descriptors"},
          "search.map_elites.descriptors: {}: least = {}, most = {}: expected a range of at least {}",
          descriptor.quantity, descriptor.least, descriptor.most, least_range);
  if (descriptors.size() > most_descriptors)
    fail_setting({"search.map_elites.descriptors"},
                 "search.map_elites.descriptors: {} of them; expected at most {}", descriptors.size(),
                 most_descriptors);
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
  const auto whole = static_cast<std::size_t>(batch);
  if (const std::size_t again = reevaluations(whole), tried = trials > 1 ? most_challengers() : 0;
      again + tried >= whole)
    fail_setting({"search.map_elites.batch", "search.map_elites.reevaluate_share"},
                 "search.map_elites.batch = {}: {} elites and {} candidates that are tried again, as their "
                 "shares say, leave no room for new genomes; expected more",
                 batch, again, tried);
  if (select == Selection::dominated && std::int64_t{pool.size} + batch > most_compared)
    fail_setting({"search.map_elites.batch", "search.map_elites.select"},
                 "search.map_elites.batch = {}: expected at most {} under select = \"dominated\", which "
                 "compares each genome of a round and of its pool with each",
                 batch, most_compared - pool.size);
  if (variation != Variation::mutation) validate_variation();
  if (archive == Archive::cvt && centroid_samples < cells)
    fail_setting({"search.map_elites.centroid_samples", "search.map_elites.cells"},
                 "search.map_elites.centroid_samples = {}: expected at least search.map_elites.cells, {}",
                 centroid_samples, cells);
}

int MapElitesSettings::candidates_per_emitter() const {
  const int samples = batch - static_cast<int>(std::lround(reevaluate_share * batch));
  return cma.emitters > 0 && samples % cma.emitters == 0 ? samples / cma.emitters : 0;
}

void MapElitesSettings::validate_variation() const {
  const std::string_view name = variation_names[static_cast<std::size_t>(variation)];
  if (crossover_probability > 0.0)
    fail_setting({"search.map_elites.crossover_probability", "search.map_elites.variation"},
                 "search.map_elites.crossover_probability = {}: expected 0 under variation = \"{}\", which "
                 "does not mix links",
                 crossover_probability, name);
  if (variation != Variation::cma) return;
  constexpr int least_candidates = 4;
  if (candidates_per_emitter() < least_candidates)
    fail_setting(
        {"search.map_elites.batch", "search.map_elites.cma.emitters"},
        "search.map_elites.batch = {}: expected what reevaluate_share = {} leaves of it to be a multiple of "
        "search.map_elites.cma.emitters = {}, at least {} each",
        batch, reevaluate_share, cma.emitters, least_candidates);
  if (trials > 1)
    fail_setting(
        {"search.map_elites.trials", "search.map_elites.variation"},
        "search.map_elites.trials = {}: expected 1 under variation = \"cma\", whose candidates enter at once",
        trials);
  if (select != Selection::uniform)
    fail_setting({"search.map_elites.select", "search.map_elites.variation"},
                 "search.map_elites.select = \"{}\": expected \"uniform\" under variation = \"cma\", which "
                 "draws no parents",
                 selection_names[static_cast<std::size_t>(select)]);
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
