#pragma once

#include <map>
#include <string>

#include "amble/morphology/mass_text.hpp"
#include "amble/morphology/reading_notes.hpp"

struct mjModel_;

namespace amble::morphology {

/// Gives bodies whose mass or moments are missing those of their shapes, of those that collide if there are
/// any: with the mass that the file gives, else filled with water; without shapes those of a ball of water of
/// that mass. What has neither mass nor shape keeps no mass. `missing_meshes`: by MuJoCo's name.
void mend_masses(mjModel_& model, const MissingMasses& missing,
                 const std::map<std::string, std::string>& missing_meshes, ReadingNotes& notes);

}  // namespace amble::morphology
