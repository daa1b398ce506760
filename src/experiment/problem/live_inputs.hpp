#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "amble/experiment/problem/champion.hpp"
#include "amble/experiment/problem/live_trial.hpp"

namespace amble::experiment {

/// A live session, so that it can be run again anywhere.
struct LiveInputs {
  std::string champion;       ///< of the text of its champion's file: hex(hash_text(text))
  std::string engine;         ///< in which it walked
  std::vector<Input> inputs;  ///< by rising step
  std::vector<std::uint32_t>
      trace;  ///< a hash per step (trial::TraceObserver): how long it was, and its bits
};

/// The text of an inputs file (docs/FORMATS.md).
std::string inputs_text(const LiveInputs& session);
/// Throws UserError(ExitCode::bad_file): foreign, truncated, altered, of another version, inputs out of order
/// or after the last step.
LiveInputs parse_inputs(const std::string& text, const std::string& what);

struct LiveReplay {
  int steps = 0;
  std::optional<int> first_difference = {};  ///< the first step whose hash is another; nothing: the same bits
  bool fallen = false;                       ///< at the end
  double distance_m = 0.0;                   ///< of the centre of mass from the start, over the ground
};

/// The session again. `champion` walks in its engine (parse_champion_for()). Throws UserError for inputs that
/// do not fit the robot.
LiveReplay replay_live(const Champion& champion, const LiveInputs& session);

}  // namespace amble::experiment
