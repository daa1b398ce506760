#include "amble/cppn/settings.hpp"

namespace amble::cppn {

void Settings::describe(io::SettingsVisitor& visitor) {
  visitor.choice("linear", linear, linear_names,
                 {"what the activation function \"linear\" computes: |x| (absolute) or x (identity)",
                  "the authors' code: |x|; Morse et al. 2013, sec. 4: \"linear\""});
  visitor.flag("recurrent", recurrent,
               {"whether links may close cycles; such CPPNs run synchronous passes from a cleared state",
                "HyperSharpNEAT"});
  visitor.choice("passes", passes, passes_names,
                 {"how many passes these are, h being the number of hidden nodes; without effect unless "
                  "recurrent",
                  "the authors' code: 2h+3 (twice the nodes other than inputs and outputs, plus 1, where the "
                  "bias counts as one of them)"});
}

}  // namespace amble::cppn
