#pragma once

#include <string_view>

/// Texts of an exported network's functions, which repeat src/controllers/neural_kernel.cpp to the bit. In
/// each, CText::block() fills in the prefix for `$p` and `$P`.
namespace amble::exporting {

float controllers_log2_e();
float largest_exponent();

extern const std::string_view c_rounding, c_float_bits, c_fused, c_logistic, c_sum, c_sense,
    c_negative_arc_tangent, c_clock_sine;
extern const std::string_view c_levels, c_passes;
extern const std::string_view c_pulls_rate, c_pulls_potential, c_euler_step, c_runge_kutta_step,
    c_ctrnn_begin_rate, c_ctrnn_begin_potential, c_ctrnn_clear, c_ctrnn_steps, c_ctrnn_end_potential;
extern const std::string_view c_step_begin, c_step_end;

}  // namespace amble::exporting
