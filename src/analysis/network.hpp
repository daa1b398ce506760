#pragma once

#include <string>

#include "amble/analysis/substrate_figure.hpp"

namespace amble::analysis {

/// A network of neurons as a recording holds it. The links are those that are expressed, of kind 0 where the
/// weight is positive and 1 where it is negative; their strength is the weight's share of the largest.
struct NeuralNetwork {
  Substrate substrate;
  int possible_links = 0;
};

/// Throws UserError(ExitCode::bad_file) naming `what`: a key missing or of the wrong type, an index out of
/// range.
NeuralNetwork parse_network(const std::string& controller_json, const std::string& what);

}  // namespace amble::analysis
