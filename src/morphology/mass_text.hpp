#pragma once

#include <map>
#include <string>
#include <vector>

#include "amble/morphology/reading_notes.hpp"
#include "amble/morphology/xml_tree.hpp"

namespace amble::morphology {

/// Bodies whose mass or moments are missing or 0, which MuJoCo refuses where they move: while it compiles
/// they have small ones, and mend_masses() puts those of the shapes in their place. By name, or "#3" where
/// body 3 of the model has none.
struct MissingMass {
  double mass_kg = 0.0;  ///< as the file gives it; 0: it does not
};
using MissingMasses = std::map<std::string, MissingMass>;

/// Principal moments that no body can have, one larger than the sum of the others, make MuJoCo refuse a
/// model, URDF or MJCF. Files that were drawn or written by hand have them. Their mean takes their place, as
/// by MuJoCo's balanceinertia. Negative masses and moments become 0.
void balance_inertias(XmlElement& root, bool urdf, ReadingNotes& notes);

/// Whether each body of an MJCF tree has an <inertial> that counts, by MuJoCo's number; the world has.
/// Without one a body's mass is that of its geoms. All false if the tree has another number of bodies than
/// `count`.
std::vector<bool> bodies_with_inertial(const XmlElement& root, int count);

/// URDF: an <inertial> without <mass> or without <inertia> gets small ones, and is one of `missing`.
void complete_inertials(XmlElement& root, MissingMasses& missing);

/// MJCF: bodies whose <inertial> has no moments get small ones. False if none had to.
bool fill_empty_inertials(XmlElement& root, MissingMasses& missing);

/// Gives the body that MuJoCo named, and all that are like it, small masses and moments. False if it has got
/// them before, or is not there.
bool give_small_mass(XmlElement& root, bool urdf, const std::string& name, int id, MissingMasses& missing);

}  // namespace amble::morphology
