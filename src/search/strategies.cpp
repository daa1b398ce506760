#include "amble/search/strategies.hpp"

#include <algorithm>
#include <array>

#include "amble/core/check.hpp"
#include "amble/search/generational.hpp"
#include "amble/search/map_elites.hpp"
#include "amble/search/novelty.hpp"
#include "amble/search/objective.hpp"

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

void validate_novelty(const Settings& settings, std::size_t behaviour_length) {
  settings.novelty.validate(behaviour_length);
}

void check_novelty_memory(const Settings& settings, const SearchSpace& space, double memory_bytes) {
  settings.novelty.check_memory(space.behaviour_length, space.neat.population.size, memory_bytes);
}

int population(const Settings&, const neat::Settings& neat) {
  return neat.population.size;
}

int batch(const Settings& settings, const neat::Settings&) {
  return settings.map_elites.batch;
}

void any(const Settings&, std::size_t) {}
void any_memory(const Settings&, const SearchSpace&, double) {}

// The table of strategies. A new one is a row here, a class derived from Strategy, and, if it has settings, a
// member of Settings with its line in Settings::describe.
constexpr std::array kinds{
    StrategyKind{"objective", "", make_objective, population, any, any_memory},
    StrategyKind{"novelty", "path", make_novelty, population, validate_novelty, check_novelty_memory},
    StrategyKind{"map-elites", "descriptors", make_map_elites, batch, validate_map_elites,
                 check_map_elites_memory},
};

}  // namespace

void Settings::describe(io::SettingsVisitor& visitor) {
  visitor.row_name("kind", kind, kinds,
                   {"what selects parents: the objective itself (distance walked), novelty of behaviour, or "
                    "being the best of one's kind (a map of gaits)",
                    "Morse et al. 2013, sec. 4"});
  visitor.table("novelty", novelty, {"novelty search; without effect under other kinds"});
  visitor.table("map_elites", map_elites, {"MAP-Elites; without effect under other kinds"});
}

const StrategyKind& strategy_kind(const Settings& settings) {
  const auto row = std::ranges::find(kinds, settings.kind, &StrategyKind::name);
  AMBLE_CHECK(row != kinds.end(), "search.kind is one of the table's");
  return *row;
}

}  // namespace amble::search
