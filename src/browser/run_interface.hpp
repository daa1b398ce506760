#pragma once

#include <cstddef>

// Runs in pages, as browser/interface.hpp: texts and bytes come by amble_text() and go by amble_result().
extern "C" {

/// Takes a robot.json or a champion's file; gives browser::robot_facts.
void amble_robot_facts();
/// Takes a plan (browser::Plan), of which all below is.
void amble_run_plan();

/// Trials: take the genomes of a generation, advance (1: all have ended), give what became of them.
void amble_trials_begin(int generation);
int amble_trials_advance(int steps);
void amble_trials_told();

/// A run of the plan from its beginning; or from files that were given before, each as its path, a zero byte
/// and its content.
void amble_run_begin();
void amble_run_file();
void amble_run_resume();
/// Takes a plan: the run goes on with it.
void amble_run_change();

std::size_t amble_run_candidates();
void amble_run_candidates_of(std::size_t first, std::size_t count);
void amble_run_take(std::size_t first);
void amble_run_describe();
/// Gives the progress.
void amble_run_tell(double wall_s);
void amble_run_progress();
void amble_run_champion();
void amble_run_first();
void amble_run_elite(unsigned cell);
/// Gives the paths of the run's files as a JSON list; takes a path and gives that file as it was then.
void amble_run_files();
void amble_run_give_file();
}
