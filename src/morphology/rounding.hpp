#pragma once

namespace amble::morphology {

/// Four digits after the point, rounded towards zero from `start`.
double inward(double value, double start);

/// Whole millimetres; of less than a centimetre three digits.
double rounded_down(double length_m);

/// Whole tenths of millimetres; of less than a millimetre two digits.
double rounded_up(double length_m);

}  // namespace amble::morphology
