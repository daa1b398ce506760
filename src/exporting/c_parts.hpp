#pragma once

#include <string_view>

#include "amble/exporting/c_source.hpp"
#include "amble/exporting/c_text.hpp"

/// The parts of an exported C source.
namespace amble::exporting {

/// Names of the enumerators of joints and legs, e.g. WALKER_JOINT_FL_KNEE.
std::vector<std::string> c_joint_names(const ControllerTables& tables, const std::string& prefix);
std::vector<std::string> c_leg_names(const ControllerTables& tables, const std::string& prefix);

std::string c_header(const ControllerTables& tables, const robot::RobotSpec& robot,
                     const Provenance& provenance, const Trace& trace, const CSourceOptions& options);

/// Members of the struct PREFIX_state.
void add_supg_state(const SupgTables& tables, CText& text);
void add_neural_state(const NeuralTables& tables, CText& text);
void add_oscillator_state(const OscillatorTables& tables, CText& text);

/// Tables and functions.
void add_supg(const ControllerTables& tables, const CSourceOptions& options, CText& text);
void add_neural(const ControllerTables& tables, CText& text);
void add_oscillators(const ControllerTables& tables, CText& text);

/// What senses commands: members of the state, functions, what else PREFIX_init and PREFIX_step do.
/// Nothing for other controllers. `sensors`: the name of the step's argument.
void add_command_state(const ControllerTables& tables, CText& text);
void add_commands(const ControllerTables& tables, CText& text);
std::string c_command_init(const ControllerTables& tables);
std::string c_command_step(const ControllerTables& tables, const char* sensors);

/// For a controller that is steered by hand: members of the state, the tables that the walker's text is made
/// of (what senses commands is in it if it hears them itself, and else around it), that text with names of
/// its own for what it does at first and in a step, and all around it.
void add_differential_state(const ControllerTables& tables, CText& text);
ControllerTables walker_tables(const ControllerTables& tables);
std::string c_walker_text(std::string text, const std::string& prefix);
void add_differential(const ControllerTables& tables, CText& text);

/// For SUPGs whose targets are smoothed: members of the state, tables and functions, and what else the
/// function PREFIX_init does. `timer`: the type of timers.
void add_seam_state(const SupgTables::Seam& seam, CText& text);
void add_seam(const SupgTables& supg, const std::string& timer, CText& text);
std::string c_seam_init(const SupgTables::Seam& seam);
/// Parts of it: the joints' ranges and what limits to them, the smoothing itself, what begins without
/// residuals.
void add_limits(const std::vector<std::array<float, 2>>& limits_rad, CText& text);
void add_smoothing(const SupgTables::Seam& seam, CText& text);
std::string c_residual_init();

/// For SUPGs whose contacts are guessed: members of the state, the function that guesses, what else the
/// function PREFIX_init does (with `leg` and `joint`), and the end of a step.
void add_contact_state(const SupgTables::Contact& contact, CText& text);
void add_contacts(const SupgTables::Contact& contact, CText& text);
std::string c_contact_init(const SupgTables::Contact& contact);
std::string c_contact_end(const SupgTables::Contact& contact);

/// For modulated SUPGs: members of the state, and all behind the targets' table.
void add_modulated_state(const SupgTables& tables, CText& text);
void add_modulated(const ControllerTables& tables, CText& text);

/// What is around the SUPGs of a mixed controller: members of the state, tables and functions, the sum
/// that is ρ, and what else the functions PREFIX_init (with `leg`) and PREFIX_step (at its end) do.
void add_mixed_state(const SupgTables::Mixed& mixed, CText& text);
void add_mixed(const SupgTables& supg, CText& text);
std::string c_mixed_growth(const SupgTables::Mixed& mixed);
std::string c_mixed_init(const SupgTables::Mixed& mixed);
std::string c_mixed_end(const SupgTables::Mixed& mixed);
/// The member of the struct PREFIX_sensors, or of the state, a variable of that name, that a sensor reads.
std::string c_sensor_member(const substrate::Sensor& sensor, std::string_view state = "state");

void add_self_test(const ControllerTables& tables, const Trace& trace, const CSourceOptions& options,
                   CText& text);

}  // namespace amble::exporting
