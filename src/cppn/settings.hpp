#pragma once

#include <array>
#include <string_view>

#include "amble/io/settings.hpp"

/// CPPNs: genomes as networks that are queried at many points.
namespace amble::cppn {

/// What the activation function "linear" computes.
enum class Linear {
  absolute,  ///< |x| (the authors' code)
  identity   ///< x (Morse et al. 2013, sec. 4: "linear")
};
/// As configs write them, by Linear.
inline constexpr std::array<std::string_view, 2> linear_names{"absolute", "identity"};

/// How many synchronous passes a recurrent CPPN runs, h being the number of its hidden nodes.
enum class Passes {
  twice_hidden_plus_1,  ///< 2 h + 1
  twice_hidden_plus_3   ///< 2 h + 3 (the authors' code, where the bias counts as one of them)
};
/// As configs write them, by Passes.
inline constexpr std::array<std::string_view, 2> passes_names{"2h+1", "2h+3"};

/// How a genome is evaluated.
struct Settings {
  Linear linear = Linear::absolute;  ///< what the function "linear" is
  /// Whether links may close cycles. A CPPN is then run for synchronous passes from a cleared state
  /// (HyperSharpNEAT).
  bool recurrent = true;
  Passes passes = Passes::twice_hidden_plus_3;  ///< without effect unless `recurrent`

  /// Synchronous passes of a recurrent CPPN with this number of hidden nodes.
  int passes_with(int hidden_nodes) const {
    return 2 * hidden_nodes + (passes == Passes::twice_hidden_plus_3 ? 3 : 1);
  }
  void describe(io::SettingsVisitor& visitor);  ///< the table [cppn]
};

}  // namespace amble::cppn
