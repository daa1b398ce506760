#pragma once

#include <array>
#include <string_view>

#include "amble/io/settings.hpp"

namespace amble::cppn {

/// What the activation function "linear" computes: the paper's word, or what the authors' code did (|x|).
enum class Linear { absolute, identity };
inline constexpr std::array<std::string_view, 2> linear_names{"absolute", "identity"};

struct Settings {
  Linear linear = Linear::absolute;
  /// Whether links may close cycles. A CPPN is then run for 2 × hidden nodes + 1 synchronous passes from a
  /// cleared state (HyperSharpNEAT).
  bool recurrent = true;

  void describe(io::SettingsVisitor& visitor);
};

}  // namespace amble::cppn
