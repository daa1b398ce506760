#pragma once

#include <cstddef>
#include <cstdint>

// What a page calls (viewer/src/amble.js), by these names. Texts are UTF-8. One session at a time. In a
// browser what is thrown ends the module, with its message (runtime.cpp); a page starts it anew.
extern "C" {

/// Room for `size` bytes of text that a function below takes; each takes what was written there last.
char* amble_text(std::size_t size);
/// What the last function that gives a text gave.
const char* amble_result();
std::size_t amble_result_size();

/// Takes a champion file.
void amble_open();
void amble_restart(int as_evolved);
void amble_push(double x_n_s, double y_n_s, double z_n_s);
void amble_lift(double height_m);
void amble_command(double speed_m_s, double turn_rad_s);
/// Take the settings as JSON.
void amble_set_ground();
void amble_set_damage();
int amble_step(int count);

/// Give texts: browser::Session.
void amble_describe();
void amble_inputs();
/// XXH3 of the session's trace in hexadecimal digits: the same for the same bits in all steps.
void amble_hash();

/// browser::Evolution. The first takes a champion file, the second settings as JSON.
void amble_evolution_of();
void amble_evolve();
int amble_evolution_advance(int steps);
/// Give texts: progress as JSON, and the file of the best.
void amble_evolution_progress();
void amble_evolution_champion();

const double* amble_state();
const float* amble_heights();
int amble_steps_as_recorded();
/// 1 if this module multiplies and adds with one rounding, as the native program does.
int amble_is_exact();
}
