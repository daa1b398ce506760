#pragma once

#include <atomic>
#include <optional>
#include <vector>

#include "amble/experiment/champion.hpp"
#include "amble/experiment/corrected_map.hpp"
#include "amble/experiment/repertoire.hpp"

namespace amble::experiment {

/// An elite as one of the gaits among which a walker switches, by what it does in new trials.
struct PickedGait {
  std::uint32_t number = 0;  ///< of the elite in the map
  double speed_m_s = 0.0;
  double turn_rad_s = 0.0;
};

/// What a map's elites are tried by, and how a walker heeds its heading, where nothing else is said.
inline constexpr int usual_gait_trials = 16;
inline constexpr double usual_heading_gain = 1.0;

/// Throws UserError: runs of this config make no map whose elites a walker can switch between, which takes
/// MAP-Elites, descriptors `own_speed` and `yaw_rate`, and SUPGs.
void check_can_switch(const Config& config);

/// At most `count` ≥ 1 gaits that cover what a map's elites can do, by the corrected map: first the fastest
/// of those that turn least, then one after the other the elite that is farthest from all picked, speed and
/// turn each in parts of the range of all. Of several elites in a cell of the corrected map the best counts;
/// those that fell short of half of the best objective do not. Throws UserError: the map's descriptors have
/// no `own_speed` and `yaw_rate`, or no elite is left.
std::vector<PickedGait> pick_gaits(const Repertoire& repertoire, const CorrectedMap& corrected, int count);

/// A champion that switches between these gaits as it is commanded (controllers/switching.hpp), with its
/// trials of 15 s under random commands within what the gaits can do. Nothing if `stop` was set. Throws
/// UserError: the map's controller cannot switch.
std::optional<Champion> switching_champion(const Repertoire& repertoire, const std::vector<PickedGait>& gaits,
                                           double heading_gain, int jobs, const std::atomic<bool>& stop);

}  // namespace amble::experiment
