#include "amble/cppn/settings.hpp"

namespace amble::cppn {

void Settings::describe(io::SettingsVisitor& visitor) {
  visitor.choice("linear", linear, linear_names,
                 {"what the activation function \"linear\" computes: |x| (absolute) or x (identity)",
                  "the authors' code: |x|; Morse et al. 2013, sec. 4: \"linear\""});
  visitor.flag("recurrent", recurrent,
               {"whether links may close cycles; such CPPNs run 2 × hidden nodes + 1 synchronous passes from "
                "a cleared state",
                "HyperSharpNEAT"});
}

}  // namespace amble::cppn
