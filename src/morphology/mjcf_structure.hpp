#pragma once

#include <set>
#include <string>

#include "amble/morphology/reading_notes.hpp"
#include "amble/morphology/xml_tree.hpp"

namespace amble::morphology {

/// `name`, or with ".1", ".2", … behind it if it is taken; it is then.
std::string free_name(std::set<std::string>& taken, const std::string& name);

/// What newer versions of MuJoCo, exporters and people write of a model's tree of bodies, as the installed
/// MuJoCo and amble read it. All of it is noted.

/// A <frame> moves what is in it. In a body it becomes a body that is fixed to it; in the world what is in it
/// is moved itself, since only there bodies are free.
void resolve_frames(XmlElement& root, ReadingNotes& notes);

/// MuJoCo fuses the root link of a URDF into the world unless it is told otherwise, and what it then writes
/// is a world of shapes and several legs. Puts a body around them.
void wrap_fused_root(XmlElement& root, ReadingNotes& notes);

/// Names joints and bodies that have no name. Joints, but those of the root, after their body, else "joint".
/// Bodies after the first of their joints that the author named, else after their parent, with their number
/// among its bodies; in the world "root", or "body" if nothing of it moves.
void name_parts(XmlElement& root, ReadingNotes& notes);

}  // namespace amble::morphology
