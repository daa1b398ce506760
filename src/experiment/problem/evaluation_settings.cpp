#include "amble/experiment/problem/evaluation_settings.hpp"

namespace amble::experiment {

void EvaluationSettings::describe(io::SettingsVisitor& visitor) {
  visitor.choice(
      "draw", draw, draw_names,
      {"when noise and uneven ground are drawn: anew in each generation, or once for the whole run"});
  visitor.number(
      "finalists", finalists, {0.0, 1.0},
      {"share of a generation, its best, that is tried again before anything is selected; 0: none"});
  visitor.integer("finalist_episodes", finalist_episodes, {1, 500},
                  {"further trials of each of them; what counts is noise.score of all its trials"});
}

}  // namespace amble::experiment
