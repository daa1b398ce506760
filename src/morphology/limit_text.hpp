#pragma once

#include "amble/morphology/reading_notes.hpp"
#include "amble/morphology/xml_tree.hpp"

namespace amble::morphology {

/// Puts limits right that are the wrong way round, of joints and, in MJCF, of whatever has a range, and notes
/// joints without stops: those whose limits leave no range, which MuJoCo takes for none, and a URDF's without
/// <limit>.
void mend_limits(XmlElement& root, bool urdf, ReadingNotes& notes);

}  // namespace amble::morphology
