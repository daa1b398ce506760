#pragma once

#include <string>

#include "amble/exporting/controller_tables.hpp"
#include "amble/exporting/provenance.hpp"
#include "amble/exporting/trace.hpp"

namespace amble::exporting {

enum class Arithmetic {
  float32,
  /// For SUPGs: targets as int16, touches as bytes, no floating point at all.
  fixed
};

struct CSourceOptions {
  /// With which all names begin, e.g. "walker": a C identifier. The header is called PREFIX.h.
  std::string prefix;
  Arithmetic arithmetic = Arithmetic::float32;
  std::string start;  ///< a sentence on when the first tick is
};

struct CSource {
  std::string header, source;
};

/// The controller in C99, one header and one source, without heap and libraries (docs/EXPORT.md). The ticks
/// of `trace`, which must have at least one, are its self-test. Throws UserError: fixed point of
/// anything but SUPGs that nobody steers by hand.
CSource c_source(const ControllerTables& tables, const robot::RobotSpec& robot, const Provenance& provenance,
                 const Trace& trace, const CSourceOptions& options);

/// The most fraction bits of fixed point targets with which all joints' ranges fit into 16 bits, at most 15.
int fraction_bits(const ControllerTables& tables);
/// The number nearest to target × 2^fraction_bits that is within the joint's range.
int fixed_target(const CommandedJoint& joint, float target_rad, int fraction_bits);

}  // namespace amble::exporting
