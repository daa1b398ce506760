#pragma once

#include <deque>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "amble/controllers/controller.hpp"
#include "amble/controllers/kind_settings.hpp"
#include "amble/controllers/sensing.hpp"
#include "amble/controllers/supg_settings.hpp"
#include "amble/io/own_settings.hpp"
#include "amble/io/settings.hpp"
#include "amble/substrate/settings.hpp"

namespace amble::controllers {

/// Which architecture, its substrate, and the settings of each; those of other kinds are without effect.
struct ControllerSettings {
  std::string kind = "supg";       ///< the name of a ControllerKind
  substrate::Settings substrate;   ///< nodes, and what the CPPN says of them; all kinds but oscillators
  SupgSettings supg;               ///< kinds "supg" and "mixed"
  NetworkSettings network;         ///< kind "network": static neurons
  CtrnnSettings ctrnn;             ///< kind "ctrnn": continuous-time neurons
  SensingSettings sensing = {};    ///< how sensors are read: by default at once and exactly
  OscillatorSettings oscillators;  ///< kind "oscillators": a sine for each joint
  MixedSettings mixed = {};        ///< kind "mixed": how strongly neurons and sensors act on SUPGs
  DifferentialSettings differential = {};  ///< steering by hand around what any kind does; off
  SwitchingSettings switching = {};        ///< kind "supg": gaits to switch between, as commanded; off
  io::OwnSettings own;                     ///< a kind that a program or a plugin has added

  /// The table [controller]. AMBLE_CHECK: the kind is known, as it is after reading.
  void describe(io::SettingsVisitor& visitor);
};

/// A kind of controller that configs can choose.
struct ControllerKind {
  std::string name;  ///< value of controller.kind: a–z, 0–9, "-" and "_"
  std::string what;  ///< in the description of controller.kind, e.g. "continuous-time neurons (ctrnn)"
  /// Must be there (AMBLE_CHECK). `settings.substrate` has its lists, `settings.own` all of `numbers`. Throws
  /// SettingError where settings and robot do not fit.
  std::function<std::unique_ptr<const Architecture>(const ControllerSettings& settings,
                                                    const robot::RobotSpec& robot, double timestep_s)>
      make;
  /// Makes its substrate from a robot (automatic.hpp); empty: it has no rule for that.
  std::function<substrate::Settings(const robot::RobotSpec& robot)> automatic = {};
  std::vector<io::OwnNumber> numbers = {};  ///< its settings: [controller.own]
  /// Tables of a config that it reads and other kinds may not, "controller.supg"; empty: it is not known.
  std::vector<std::string> tables = {};
};

/// All kinds, in the order in which they are listed to users.
const std::deque<ControllerKind>& controller_kinds();

/// Adds a kind, from then on one of those that configs can choose. Before the first config is read; not
/// thread safe. Throws UserError for a name that is taken or cannot be one.
void register_controller(ControllerKind kind);

/// The substrate with its lists: those of the settings, or with `layout = "auto"` those that the settings'
/// kind makes from the robot (automatic.hpp). Throws SettingError where both are given, where the kind has no
/// rule for that, and where the rule does not fit the robot.
substrate::Settings substrate_of(const ControllerSettings& settings, const robot::RobotSpec& robot);

/// By the settings' kind; `timestep_s` > 0 is that of the trial. Throws UserError where settings and robot do
/// not fit. What the genomes of SwitchingSettings do it cannot know: with_gaits() adds it.
std::unique_ptr<const Architecture> make_architecture(const ControllerSettings& settings,
                                                      const robot::RobotSpec& robot, double timestep_s);

/// `made` by make_architecture(), which from now on switches between the gaits of `settings.switching`;
/// `gaits`: these in order, as `made` decodes them. Throws SettingError where such a controller cannot.
std::unique_ptr<const Architecture> with_gaits(std::unique_ptr<const Architecture> made,
                                               std::vector<std::unique_ptr<Parameters>> gaits,
                                               const ControllerSettings& settings,
                                               const robot::RobotSpec& robot);

}  // namespace amble::controllers
