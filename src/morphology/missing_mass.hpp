#pragma once

#include <set>

#include "amble/morphology/model_text.hpp"
#include "amble/morphology/reading_notes.hpp"

struct mjModel_;

namespace amble::morphology {

/// Gives bodies whose mass or moments are missing those of their shapes, of those that collide if there are
/// any: with the mass that the file gives, else filled with water; without shapes those of a ball of water of
/// that mass. What has neither mass nor shape keeps no mass. So do bodies that weigh what their geoms do,
/// where a mesh of these could not be read: they keep the mass. Moments that would need a body larger than
/// the robot become those of the shapes, too. `text`: what the model was compiled from. Returns the bodies
/// that were changed, by MuJoCo's number.
std::set<int> mend_masses(mjModel_& model, const ModelText& text, ReadingNotes& notes);

}  // namespace amble::morphology
