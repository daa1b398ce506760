#include "amble/search/search.hpp"

#include "amble/search/objective.hpp"

namespace amble::search {

void Settings::describe(io::SettingsVisitor& visitor) {
  visitor.choice(
      "kind", kind, kind_names,
      {"what selects parents: the objective itself (distance walked)", "Morse et al. 2013, sec. 4"});
}

std::unique_ptr<Search> make_search(const Settings& settings) {
  switch (settings.kind) {
    case Kind::objective:
      return std::make_unique<ObjectiveSearch>();
  }
  return nullptr;
}

}  // namespace amble::search
