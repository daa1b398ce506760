#pragma once

#include <string>

#include "amble/report/report.hpp"

namespace amble::report {

/// The sections of a page, each as markup; empty where there is nothing to show.
std::string claims_section(const Report& report);
std::string distance_section(const Report& report);
std::string typical_section(const Report& report);
std::string curves_section(const Report& report);
std::string survival_section(const Report& report);
std::string stop_rules_section(const Report& report);
std::string sizes_section(const Report& report);
std::string gaits_section(const Report& report);
std::string mutants_section(const Report& report);
std::string transfer_section(const Report& report);
std::string pairs_section(const Report& report);
std::string provenance_section(const Report& report);

/// "configs/authors/supg.toml" of a path to it from elsewhere; of other files the name alone.
std::string config_text(const std::string& path);

/// "300 s in the engine ode, on the ground of rough.toml, 10 episodes (median)"; with all engines in which
/// runs have the test.
std::string test_text(const Report& report, const ledger::TestSpec& test);

}  // namespace amble::report
