#pragma once

#include "amble/morphology/reading_notes.hpp"
#include "amble/morphology/xml_tree.hpp"

namespace amble::morphology {

/// What newer versions of MuJoCo, exporters and people write of a model's tree of bodies, as the installed
/// MuJoCo and amble read it. All of it is noted.

/// A <frame> moves what is in it. In a body it becomes a body that is fixed to it; in the world what is in it
/// is moved itself, since only there bodies are free.
void resolve_frames(XmlElement& root, ReadingNotes& notes);

/// MuJoCo fuses the root link of a URDF into the world unless it is told otherwise, and what it then writes
/// is a world of shapes and several legs. Puts a body around them.
void wrap_fused_root(XmlElement& root, ReadingNotes& notes);

/// Names joints that have no name after their body, but those of the root.
void name_joints(XmlElement& root, ReadingNotes& notes);

}  // namespace amble::morphology
