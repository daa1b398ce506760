#include "amble/exporting/c_source.hpp"

#include <algorithm>
#include <cmath>

#include "amble/core/check.hpp"
#include "amble/core/error.hpp"
#include "amble/exporting/c_parts.hpp"

namespace amble::exporting {
namespace {

std::vector<std::string> enumerators(const std::vector<std::string>& names, const std::string& prefix,
                                     const char* kind) {
  UniqueNames unique;
  std::vector<std::string> found;
  found.reserve(names.size());
  for (const std::string& name : names)
    found.push_back(upper_case(unique.of(prefix + "_" + kind + "_" + upper_case(name))));
  return found;
}

}  // namespace

std::vector<std::string> c_joint_names(const ControllerTables& tables, const std::string& prefix) {
  std::vector<std::string> names;
  for (const CommandedJoint& joint : tables.joints) names.push_back(joint.name);
  return enumerators(names, prefix, "JOINT");
}

std::vector<std::string> c_leg_names(const ControllerTables& tables, const std::string& prefix) {
  return enumerators(tables.legs, prefix, "LEG");
}

int fraction_bits(const ControllerTables& tables) {
  double largest_rad = 0.0;
  for (const CommandedJoint& joint : tables.joints)
    largest_rad = std::max({largest_rad, std::abs(joint.lower_rad), std::abs(joint.upper_rad)});
  int bits = 15;
  while (bits > 0 && std::ceil(std::ldexp(largest_rad, bits)) > 32767.0) --bits;
  if (std::ldexp(largest_rad, bits) > 32767.0)
    fail(ExitCode::bad_input, "a target of {} rad does not fit into 16 bits", largest_rad);
  return bits;
}

int fixed_target(const CommandedJoint& joint, float target_rad, int fraction_bits) {
  const double lower = std::ceil(std::ldexp(joint.lower_rad, fraction_bits)),
               upper = std::floor(std::ldexp(joint.upper_rad, fraction_bits));
  const double nearest = std::nearbyint(std::ldexp(static_cast<double>(target_rad), fraction_bits));
  // A range narrower than a bit has no number in it: then the nearest.
  return static_cast<int>(lower <= upper ? std::clamp(nearest, lower, upper) : nearest);
}

CSource c_source(const ControllerTables& tables, const robot::RobotSpec& robot, const Provenance& provenance,
                 const Trace& trace, const CSourceOptions& options) {
  AMBLE_CHECK(!trace.ticks.empty(), "a self-test needs a tick");
  AMBLE_CHECK(c_identifier(options.prefix) == options.prefix, "the prefix is a C identifier");
  if (tables.differential && options.arithmetic == Arithmetic::fixed)
    fail(ExitCode::bad_input,
         "--fixed: the controller is steered by hand, which is not exported in fixed point");
  CText text(options.prefix), walker(options.prefix);
  text.line("/* Controller exported by amble {}. See {}.h. */", in_comment(provenance.amble), options.prefix);
  text.line("#include \"{}.h\"", options.prefix);
  text.line("");
  const ControllerTables of_walker = walker_tables(tables);
  if (std::holds_alternative<SupgTables>(tables.parts)) {
    add_supg(of_walker, options, walker);
  } else {
    if (options.arithmetic == Arithmetic::fixed)
      fail(ExitCode::bad_input,
           "--fixed: the controller is of kind {}: expected supg, whose tables alone are "
           "exported in fixed point",
           tables.kind);
    if (std::holds_alternative<NeuralTables>(tables.parts))
      add_neural(of_walker, walker);
    else
      add_oscillators(of_walker, walker);
  }
  if (tables.differential) {
    text.append(c_walker_text(walker.take(), options.prefix));
    add_differential(tables, text);
  } else {
    text.append(walker.take());
  }
  add_self_test(tables, trace, options, text);
  return {.header = c_header(tables, robot, provenance, trace, options), .source = text.take()};
}

}  // namespace amble::exporting
