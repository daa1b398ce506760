#pragma once

#include <array>
#include <string_view>

#include "amble/io/settings.hpp"

namespace amble::cppn {

/// What the activation function "linear" computes: |x| as in the authors' code, or x as in the paper.
enum class Linear { absolute, identity };
inline constexpr std::array<std::string_view, 2> linear_names{"absolute", "identity"};

/// How many synchronous passes a recurrent CPPN runs, h being the number of its hidden nodes.
enum class Passes { twice_hidden_plus_1, twice_hidden_plus_3 };
inline constexpr std::array<std::string_view, 2> passes_names{"2h+1", "2h+3"};

struct Settings {
  Linear linear = Linear::absolute;
  /// Whether links may close cycles. A CPPN is then run for synchronous passes from a cleared state
  /// (HyperSharpNEAT).
  bool recurrent = true;
  Passes passes = Passes::twice_hidden_plus_3;

  /// Synchronous passes of a recurrent CPPN with this number of hidden nodes.
  int passes_with(int hidden_nodes) const {
    return 2 * hidden_nodes + (passes == Passes::twice_hidden_plus_3 ? 3 : 1);
  }
  void describe(io::SettingsVisitor& visitor);
};

}  // namespace amble::cppn
