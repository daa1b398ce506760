#pragma once

#include "amble/figures/cppn_graph.hpp"

namespace amble::tests {

/// bias (0), inputs leg (1) and time (2), outputs pattern (3) and offset (4), hidden gaussian (5) → sigmoid
/// (6); a disabled link leg → offset.
inline figures::CppnGraph cppn() {
  using enum figures::CppnRole;
  return {
      .nodes = {{0, bias, "linear", "bias"},
                {1, input, "linear", "leg"},
                {2, input, "linear", "time"},
                {3, output, "sine", "pattern"},
                {4, output, "bipolar_sigmoid", "offset"},
                {9, hidden, "gaussian", ""},
                {12, hidden, "bipolar_sigmoid", ""}},
      .links = {
          {0, 5, 1.0, true}, {2, 5, -1.5, true}, {5, 6, 0.5, true}, {6, 3, 3.0, true}, {1, 4, 0.75, false}}};
}

}  // namespace amble::tests
