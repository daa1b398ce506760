#pragma once

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

/// Tables and functions.
void add_supg(const ControllerTables& tables, const CSourceOptions& options, CText& text);
void add_neural(const ControllerTables& tables, CText& text);

void add_self_test(const ControllerTables& tables, const Trace& trace, const CSourceOptions& options,
                   CText& text);

}  // namespace amble::exporting
