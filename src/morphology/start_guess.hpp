#pragma once

#include <string>
#include <vector>

#include "amble/morphology/leg_choice.hpp"
#include "amble/morphology/leg_guess.hpp"
#include "amble/morphology/model_file.hpp"
#include "amble/morphology/model_parts.hpp"

namespace amble::morphology {

/// Whether a root is turned first so that its legs point down.
enum class Upright { no, from_side, from_any };

/// How the start pose of a robot is made.
struct StartPlan {
  std::string keyframe = {};  ///< empty: the model's default pose
  bool stands = false;        ///< the legs are bent by find_stand_pose()
  double reach = 0.85;        ///< of find_stand_pose(); on one or two legs two thirds nearer to 1
  LegSearch search = LegSearch::by_ground;
  Upright upright = Upright::no;
};

/// The plans for a model, the usual one first: its own start pose (a keyframe called home, stand, standing,
/// init or default, else the first, else its default pose), other keyframes, the default pose, and poses that
/// are made.
std::vector<StartPlan> start_plans(const ModelFile& file);

/// A start by a plan, with the legs in it.
struct StartGuess {
  StartPlan plan;
  ReadingOptions options;
  ModelParts parts;
  LegsGuess legs;
  std::vector<std::string> slightly_outside;   ///< joints that went to the nearest angle within their stops
  std::vector<std::string> outside;            ///< joints that are far outside, and went inside
  std::vector<std::string> joined;             ///< joints within legs that are welded: toes, levers
  std::vector<std::string> tiny;               ///< joints of links that weigh next to nothing, welded
  std::vector<std::string> off_ground;         ///< legs that do not end near the ground
  std::string turned;                          ///< why the root is turned; empty: it is not
  double reach = 0.0;                          ///< with which find_stand_pose() was asked
  double uneven_share = 0.0, off_share = 0.0;  ///< of StandPose
};

/// `before`: as of extract_parts(). Throws UserError as extract_parts().
StartGuess guess_start(const ModelFile& file, const StartPlan& plan, const ModelParts* before = nullptr);

/// What a start has otherwise than the model, a line each; `why_not`: what speaks against the model's own
/// start.
std::vector<std::string> settled(const StartGuess& start, const std::string& why_not);

/// Where the start angles come from.
std::string why_start_angles(const StartGuess& start, const std::string& why_not);

/// A joint that is less than this outside its stops in the model starts at the stop, within 1e-4 rad; one
/// that is farther out at a fifth of its range, at most 0.4 rad, inside.
inline constexpr double slight_rad = 0.1, inside_stops_share = 0.2, most_inside_stops_rad = 0.4;

}  // namespace amble::morphology
