#include "amble/search/search.hpp"

#include "amble/search/novelty.hpp"
#include "amble/search/objective.hpp"

namespace amble::search {

void Settings::describe(io::SettingsVisitor& visitor) {
  visitor.choice("kind", kind, kind_names,
                 {"what selects parents: the objective itself (distance walked), or novelty of behaviour",
                  "Morse et al. 2013, sec. 4"});
  visitor.table("novelty", novelty, {"novelty search; without effect under other kinds"});
}

std::unique_ptr<Search> make_search(const Settings& settings, std::size_t behaviour_length) {
  switch (settings.kind) {
    case Kind::objective:
      return std::make_unique<ObjectiveSearch>();
    case Kind::novelty:
      return std::make_unique<NoveltySearch>(settings.novelty, behaviour_length);
  }
  return nullptr;
}

}  // namespace amble::search
