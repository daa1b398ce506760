#pragma once

#include "amble/morphology/xml_tree.hpp"

namespace amble::morphology {

/// Faults of a model's tree that MuJoCo refuses without saying where they are.

/// Refuses parts of one kind with the same name: a URDF's links and joints; an MJCF's bodies, joints, geoms,
/// sites and meshes. Throws UserError with name and both places.
void refuse_repeated_names(const XmlElement& root, bool urdf);

/// Refuses a URDF whose joints name no links or links that are not there, or whose links are no tree: a link
/// behind two joints, or links that hang on each other in a loop. Throws UserError with their names.
void refuse_odd_tree(const XmlElement& root);

}  // namespace amble::morphology
