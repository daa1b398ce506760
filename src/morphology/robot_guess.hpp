#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "amble/morphology/model_file.hpp"
#include "amble/morphology/start_guess.hpp"

namespace amble::morphology {

/// A robot file that was guessed from a model.
struct RobotGuess {
  std::string name;
  std::string toml;                  ///< each guess with its reason as a comment
  std::vector<std::string> settled;  ///< what was made otherwise than the model has it, a line each
  std::vector<std::string> asked;    ///< what the user must give, as the model does not have it
  std::vector<std::string> doubts;   ///< what of the model's masses and motors is hardly meant
};

/// Guesses all that a robot file has to say of a model (robots/README.md). `model` is the model's path as the
/// file will name it; `why_not`: what speaks against the model's own start where the plan is another. With
/// `keep` the robot is to carry its model, if it can (keep_model()). Throws UserError as extract_parts().
RobotGuess guess_robot(const ModelFile& file, const std::filesystem::path& model, const StartGuess& start,
                       const std::string& why_not = {}, bool keep = false);
/// The same with the first of start_plans().
RobotGuess guess_robot(const ModelFile& file, const std::filesystem::path& model, bool keep = false);

}  // namespace amble::morphology
