#include "amble/search/strategies.hpp"

#include <fmt/format.h>

#include <utility>

#include "amble/core/check.hpp"
#include "amble/core/error.hpp"
#include "amble/core/registry.hpp"
#include "amble/search/cma_es.hpp"
#include "amble/search/generational.hpp"
#include "amble/search/map_elites.hpp"
#include "amble/search/novelty.hpp"

namespace amble::search {
namespace {

std::unique_ptr<Strategy> generational(const SearchSpace& space, std::unique_ptr<Criterion> criterion) {
  return std::make_unique<GenerationalSearch>(
      neat::Population(space.neat, space.inputs, space.outputs, space.recurrent, space.seed),
      std::move(criterion));
}

std::unique_ptr<Strategy> make_objective(const Settings&, const SearchSpace& space) {
  return generational(space, std::make_unique<ObjectiveSearch>());
}

std::unique_ptr<Strategy> make_novelty(const Settings& settings, const SearchSpace& space) {
  return generational(space, std::make_unique<NoveltySearch>(settings.novelty, space.behaviour_length));
}

std::unique_ptr<Strategy> make_map_elites(const Settings& settings, const SearchSpace& space) {
  return std::make_unique<MapElites>(settings.map_elites, space);
}

std::unique_ptr<Strategy> make_cma_es(const Settings& settings, const SearchSpace& space) {
  return std::make_unique<CmaEs>(settings.cma_es, space);
}

void validate_cma_es(const Settings& settings, std::size_t) {
  if (settings.cma_es.least_step >= settings.cma_es.step)
    fail_setting(
        {"search.cma_es.least_step", "search.cma_es.step"},
        "search.cma_es.least_step = {}: expected less than search.cma_es.step = {}, or the search would "
        "begin again in each round",
        settings.cma_es.least_step, settings.cma_es.step);
}

void validate_novelty(const Settings& settings, std::size_t behaviour_length) {
  settings.novelty.validate(behaviour_length);
}

void check_novelty_memory(const Settings& settings, const SearchSpace& space, double memory_bytes) {
  settings.novelty.check_memory(space.behaviour_length, space.neat.population.size, memory_bytes);
}

void validate_map_elites(const Settings& settings, std::size_t) {
  settings.map_elites.validate();
}

void check_map_elites_memory(const Settings& settings, const SearchSpace& space, double memory_bytes) {
  if (space.neat.innovations.scope == neat::InnovationScope::run)
    fail_setting(
        {"innovations.scope", "search.kind"},
        "innovations.scope = \"run\": expected \"generation\": the list of a run's innovations grows "
        "without bound under search.kind = \"map-elites\"");
  // This assumes that genomes grow to four times the links they start with.
  const double links = 4.0 * (space.inputs + 1.0) * space.outputs;
  const double elite_bytes = 160.0 + 13.0 * links + 4.0 * static_cast<double>(space.behaviour_length);
  const MapElitesSettings& map = settings.map_elites;
  const double cells = map.cell_count();
  const double weights = (space.inputs + 1.0) * space.outputs;
  double beside = 0.0;  // what is kept beside the map
  if (map.variation == Variation::cma)
    beside = map.cma.emitters * 16.0 * weights * weights + cells * sizeof(double);
  if (map.select == Selection::dominated) beside = (map.pool.size + map.batch) * 2.0 * elite_bytes;
  if (beside > memory_bytes)
    fail_setting({"search.map_elites.cma.emitters", "search.map_elites.pool.size"},
                 "search.map_elites: {} could need {:.1f} GB, this process may use {:.1f} GB: expected fewer",
                 map.variation == Variation::cma
                     ? fmt::format("cma.emitters = {} for CPPNs of {:.0f} weights", map.cma.emitters, weights)
                     : fmt::format("pool.size = {} and a batch of {}", map.pool.size, map.batch),
                 beside / 1e9, memory_bytes / 1e9);
  const double samples = map.archive == Archive::cvt ? map.centroid_samples : 0.0;
  const double spread = samples * (4.0 * static_cast<double>(map.descriptors.size()) + 4.0);
  if (spread > memory_bytes)
    fail_setting({"search.map_elites.centroid_samples"},
                 "search.map_elites.centroid_samples = {}: need {:.1f} GB, this process may use {:.1f} GB: "
                 "expected fewer",
                 map.centroid_samples, spread / 1e9, memory_bytes / 1e9);
  if (const double needed = cells * (elite_bytes + 8.0) + beside; needed > memory_bytes)
    fail_setting({"search.map_elites.descriptors", "search.map_elites.cells"},
                 "search.map_elites: {} cells could need {:.1f} GB, this process may use {:.1f} GB: expected "
                 "fewer cells",
                 map.cell_count(), needed / 1e9, memory_bytes / 1e9);
}

int population(const Settings&, const neat::Settings& neat) {
  return neat.population.size;
}

int batch(const Settings& settings, const neat::Settings&) {
  return settings.map_elites.batch;
}

/// With functions in place of those that were left out.
StrategyKind completed(StrategyKind kind) {
  AMBLE_CHECK(kind.make, "a search needs a function that makes it");
  if (!kind.candidates) kind.candidates = population;
  if (!kind.validate) kind.validate = [](const Settings&, std::size_t) {};
  if (!kind.check_memory) kind.check_memory = [](const Settings&, const SearchSpace&, double) {};
  if (!kind.numbers.empty())
    kind.make = [make = std::move(kind.make), numbers = kind.numbers](const Settings& settings,
                                                                      const SearchSpace& space) {
      Settings all = settings;
      all.own.complete(numbers);
      return make(all, space);
    };
  return kind;
}

/// Tables of a search by generations of NEAT.
std::vector<std::string> with_neat(std::vector<std::string> own) {
  own.insert(own.end(), {"mutation", "crossover", "speciation", "reproduction"});
  return own;
}

// amble's own strategies. A new one is a row here, a class derived from Strategy, and, if it has settings, a
// member of Settings with its line in Settings::describe.
Registry<StrategyKind>& kinds() {
  static Registry<StrategyKind> all(
      "search",
      {completed({.name = "objective", .behaviour = "", .make = make_objective, .tables = with_neat({})}),
       completed({.name = "novelty",
                  .behaviour = "path",
                  .make = make_novelty,
                  .validate = validate_novelty,
                  .check_memory = check_novelty_memory,
                  .tables = with_neat({"search.novelty"})}),
       completed({.name = "map-elites",
                  .behaviour = "descriptors",
                  .make = make_map_elites,
                  .candidates = batch,
                  .validate = validate_map_elites,
                  .check_memory = check_map_elites_memory,
                  .tables = {"search.map_elites", "mutation", "crossover"}}),
       completed({.name = "cma-es",
                  .behaviour = "",
                  .make = make_cma_es,
                  .validate = validate_cma_es,
                  .tables = {"search.cma_es"}})});
  return all;
}

}  // namespace

void Settings::describe(io::SettingsVisitor& visitor) {
  visitor.row_name(
      "kind", kind, kinds().rows(),
      {"what selects parents: the objective itself (distance walked), novelty of behaviour, or "
       "being the best of one's kind (a map of gaits, filled as search.map_elites.variation says); or the "
       "objective, by CMA-ES on the weights of a CPPN that does not grow",
       "Morse et al. 2013, sec. 4; arXiv 1604.00772"});
  visitor.table("novelty", novelty, {"novelty search; without effect under other kinds"});
  visitor.table("map_elites", map_elites, {"MAP-Elites; without effect under other kinds"});
  visitor.table("cma_es", cma_es,
                {.what = "CMA-ES; without effect under other kinds", .defaults_are_implied = true});
  if (const auto& numbers = strategy_kind(*this).numbers; !numbers.empty()) {
    visitor.begin("own", {"settings of this kind, which is not one of amble's own"});
    own.describe(visitor, numbers);
    visitor.end();
  }
}

const std::deque<StrategyKind>& strategy_kinds() {
  return kinds().rows();
}

void register_search(StrategyKind kind) {
  kinds().add(completed(std::move(kind)));
}

const StrategyKind& strategy_kind(const Settings& settings) {
  const StrategyKind* const kind = kinds().find(settings.kind);
  AMBLE_CHECK(kind != nullptr, "search.kind is one of the kinds");
  return *kind;
}

}  // namespace amble::search
