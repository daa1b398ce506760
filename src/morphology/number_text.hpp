#pragma once

#include <optional>
#include <string>
#include <vector>

#include "amble/morphology/reading_notes.hpp"
#include "amble/morphology/xml_tree.hpp"

namespace amble::morphology {

/// The numbers that an attribute's value lists, up to the first that is none.
std::vector<double> numbers_of(const std::string& text);

/// The number that a text begins with if it is finite, else 0.
double number_or_zero(const std::optional<std::string>& text);

/// The same if it is positive and below 1e9, else 0.
double positive_or_zero(const std::optional<std::string>& text);

/// Of a range of forces or torques: how much it allows to both sides, or, where it has only one, to that; 0
/// if that is no motor's, 1e9 or more.
double weaker_side(double lower, double upper);

/// Puts limits right that are the wrong way round, of joints and, in MJCF, of whatever has a range, and notes
/// joints without stops: those whose limits leave no range, which MuJoCo takes for none, and a URDF's without
/// <limit>.
void mend_limits(XmlElement& root, bool urdf, ReadingNotes& notes);

/// Four digits after the point, rounded towards `start` and never past it; `start` itself as it is.
double inward(double value, double start);

/// Whole millimetres; of less than a centimetre three digits.
double rounded_down(double length_m);

/// Whole tenths of millimetres; of less than a millimetre two digits.
double rounded_up(double length_m);

}  // namespace amble::morphology
