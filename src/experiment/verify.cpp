#include "amble/experiment/verify.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <vector>

#include "amble/core/error.hpp"
#include "amble/experiment/replay.hpp"
#include "amble/io/file.hpp"

namespace amble::experiment {
namespace {

/// What differs between the recorded trial and the new one, in words; empty if nothing.
std::vector<std::string> differences(const Champion& champion, const Replay& again) {
  std::vector<std::string> found;
  const auto [old_end, new_end] = std::ranges::mismatch(champion.trace, again.trace);
  if (old_end != champion.trace.end() || new_end != again.trace.end()) {
    const auto step = old_end - champion.trace.begin() + 1;
    found.push_back(fmt::format("first differing step {} (t = {:.2f} s)", step,
                                static_cast<double>(step) * champion.problem.trial.timestep_s));
  }
  if (champion.result.distance_m != again.result.distance_m)
    found.push_back(
        fmt::format("distance {} m recorded, {} m now", champion.result.distance_m, again.result.distance_m));
  if (champion.result.outcome != again.result.outcome || champion.result.steps != again.result.steps) {
    const auto words = [](const TrialResult& result) {
      return fmt::format("{} after {} steps", record::outcome_names[static_cast<std::size_t>(result.outcome)],
                         result.steps);
    };
    found.push_back(fmt::format("{} recorded, {} now", words(champion.result), words(again.result)));
  }
  return found;
}

}  // namespace

std::optional<Verdict> verify_champion(const std::filesystem::path& path, const std::atomic<bool>& stop) {
  const std::string text = io::read_file(path);
  try {
    const auto [champion, altered] = parse_champion(text, path.string(), io::Altered::accept);
    const auto again = replay(champion.problem, champion.genome, {}, stop);
    if (!again) return std::nullopt;
    auto found = differences(champion, *again);
    if (altered) found.insert(found.begin(), "the file was altered (checksum)");
    if (found.empty())
      return Verdict{
          true, fmt::format("agrees: {:.3f} m, {} steps", again->result.distance_m, again->result.steps)};
    return Verdict{false, fmt::format("differs: {}", fmt::join(found, "; "))};
  } catch (const UserError& error) {
    return Verdict{false, fmt::format("unsound: {}", error.what())};
  }
}

}  // namespace amble::experiment
