#include "amble/controllers/factory.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <string_view>
#include <utility>

#include "amble/controllers/automatic.hpp"
#include "amble/controllers/automatic_variants.hpp"
#include "amble/controllers/ctrnn.hpp"
#include "amble/controllers/differential.hpp"
#include "amble/controllers/mixed.hpp"
#include "amble/controllers/network.hpp"
#include "amble/controllers/oscillators.hpp"
#include "amble/controllers/supg.hpp"
#include "amble/controllers/switching.hpp"
#include "amble/core/check.hpp"
#include "amble/core/error.hpp"
#include "amble/core/registry.hpp"

namespace amble::controllers {
namespace {

/// Makes an architecture from the substrate and its own settings.
template <typename Made, auto own_settings>
std::unique_ptr<const Architecture> make(const ControllerSettings& settings, const robot::RobotSpec& robot,
                                         double timestep_s) {
  return std::make_unique<Made>(settings.*own_settings, settings.substrate, robot, timestep_s,
                                settings.sensing);
}

std::unique_ptr<const Architecture> make_oscillators(const ControllerSettings& settings,
                                                     const robot::RobotSpec& robot, double timestep_s) {
  return std::make_unique<OscillatorArchitecture>(settings.oscillators, robot, timestep_s);
}

std::unique_ptr<const Architecture> make_mixed(const ControllerSettings& settings,
                                               const robot::RobotSpec& robot, double timestep_s) {
  return std::make_unique<MixedArchitecture>(settings.supg, settings.mixed, settings.substrate, robot,
                                             timestep_s, settings.sensing);
}

// amble's own architectures. A new one is a row here, a class derived from Architecture, perhaps a function
// that makes its substrate from a robot, and, if it has settings, a member of ControllerSettings with its
// line below.
Registry<ControllerKind>& kinds() {
  static Registry<ControllerKind> all(
      "controller",
      {{"supg",
        "single-unit pattern generators (supg)",
        make<SupgArchitecture, &ControllerSettings::supg>,
        automatic_supg,
        {},
        {"controller.supg", "controller.substrate"}},
       {"network",
        "static neurons (network; with a sine among the sensors the sine wave architecture)",
        make<NetworkArchitecture, &ControllerSettings::network>,
        automatic_network,
        {},
        {"controller.network", "controller.substrate"}},
       {"ctrnn",
        "continuous-time neurons (ctrnn)",
        make<CtrnnArchitecture, &ControllerSettings::ctrnn>,
        automatic_ctrnn,
        {},
        {"controller.ctrnn", "controller.substrate"}},
       {"mixed",
        "SUPGs, neurons and sensors in one substrate, with the settings of supg as well (mixed)",
        make_mixed,
        automatic_mixed,
        {},
        {"controller.supg", "controller.mixed", "controller.substrate"}},
       {"oscillators",
        "a sine for each joint, without a substrate (oscillators)",
        make_oscillators,
        {},
        {},
        {"controller.oscillators"}}});
  return all;
}

std::string kind_description() {
  std::string text = "architecture of the controller: ";
  const auto& rows = kinds().rows();
  for (std::size_t i = 0; i < rows.size(); ++i)
    text += (i == 0 ? "" : i + 1 == rows.size() ? " or " : ", ") + rows[i].what;
  return text;
}

const ControllerKind& kind_of(const ControllerSettings& settings) {
  const ControllerKind* const kind = kinds().find(settings.kind);
  AMBLE_CHECK(kind != nullptr, "controller.kind is one of the kinds");
  return *kind;
}

/// Refuses what would be replaced.
void check_without_lists(const substrate::Settings& settings) {
  const std::array<std::pair<std::string_view, bool>, 5> lists{{{"coordinates", settings.coordinates.empty()},
                                                                {"outputs", settings.outputs.empty()},
                                                                {"nodes", settings.nodes.empty()},
                                                                {"links", settings.links.empty()},
                                                                {"properties", settings.properties.empty()}}};
  for (const auto& [key, empty] : lists) {
    if (empty) continue;
    const std::string path = "controller.substrate." + std::string(key);
    fail_setting({path},
                 "{} is given, but controller.substrate.layout = \"auto\" makes it from the robot: leave it "
                 "out, or write controller.substrate = \"auto\" in place of the whole table",
                 path);
  }
}

/// Refuses what settings of the kind change in a substrate that is made from the robot, if a listed one is
/// not so.
void check_listed(const ControllerSettings& settings) {
  const substrate::Settings& listed = settings.substrate;
  const auto refuse = [](const std::string& key, const std::string& instead) {
    fail_setting(
        {key},
        "{}: the nodes of controller.substrate are listed; expected {}, or controller.substrate = \"auto\"",
        key, instead);
  };
  if (settings.kind == "ctrnn" && settings.ctrnn.motor_bias == MotorBias::evolved &&
      std::ranges::any_of(listed.properties, has_constant_bias))
    refuse("controller.ctrnn.motor_bias", "the property bias with an output there");
  if (settings.kind == "mixed" && settings.mixed.neurons == LegNeurons::none &&
      std::ranges::any_of(listed.nodes, is_leg_neuron))
    refuse("controller.mixed.neurons", "nodes without neurons there");
  if (settings.kind != "ctrnn" || settings.ctrnn.sensors.empty()) return;
  const bool made = std::ranges::any_of(listed.nodes, [](const substrate::NodeSettings& node) {
    return node.group == sense_group || node.group == turn_group;
  });
  if (!made) refuse("controller.ctrnn.sensors", "nodes with sensors there");
}

/// What settings of the kind change in the substrate that is made from the robot.
void vary(const ControllerSettings& settings, const robot::RobotSpec& robot, substrate::Settings& made) {
  if (settings.kind == "ctrnn") {
    add_module_senses(robot, settings.ctrnn.sensors, made);
    if (settings.ctrnn.motor_bias == MotorBias::evolved) evolve_motor_biases(made);
  }
  if (settings.kind == "mixed" && settings.mixed.neurons == LegNeurons::none) remove_neurons(made);
}

/// Refuses what hand-made steering would falsify.
void check_differential(const ControllerSettings& settings) {
  if ((settings.kind == "supg" || settings.kind == "mixed") &&
      settings.supg.contact.source == ContactSource::tracking)
    fail_setting({"controller.differential", "controller.supg.contact.source"},
                 "controller.supg.contact.source = \"tracking\": contacts are guessed from targets, which "
                 "controller.differential changes; expected another source");
}

}  // namespace

void ControllerSettings::describe(io::SettingsVisitor& visitor) {
  const std::string architectures = kind_description();
  visitor.row_name("kind", kind, kinds().rows(), {architectures, "Morse et al. 2013, sec. 3 and 4"});
  visitor.table("substrate", substrate,
                {.what = "the nodes of the controller, and what the CPPN says of them",
                 .source = "Morse et al. 2013, sec. 2.2",
                 .short_for = "layout"});
  visitor.table("supg", supg, {"single-unit pattern generators", "Morse et al. 2013, sec. 3"});
  visitor.table("network", network, {"static neurons", "Morse et al. 2013, sec. 4"});
  visitor.table("ctrnn", ctrnn, {"continuous-time recurrent neural networks", "Morse et al. 2013, sec. 4"});
  visitor.table(
      "sensing", sensing,
      {.what = "how sensors are read: at once and exactly by default", .defaults_are_implied = true});
  visitor.table("oscillators", oscillators,
                {.what = "a sine for each joint",
                 .source = "Raffin et al., arXiv 2310.05808",
                 .defaults_are_implied = true});
  visitor.table("mixed", mixed,
                {.what = "how strongly neurons and sensors act on SUPGs in one substrate with them",
                 .source = "Morse et al. 2013, sec. 6, name it as future work",
                 .defaults_are_implied = true});
  visitor.table(
      "differential", differential,
      {.what = "steering by hand around a controller, whether it senses commands or not: the legs on the "
               "inner side of a turn swing less far; off by default",
       .defaults_are_implied = true});
  visitor.table("switching", switching,
                {.what = "gaits among which SUPGs switch at their triggers, as commanded; off by default",
                 .defaults_are_implied = true});
  if (const auto& numbers = kind_of(*this).numbers; !numbers.empty()) {
    visitor.begin("own", {"settings of this kind, which is not one of amble's own"});
    own.describe(visitor, numbers);
    visitor.end();
  }
}

const std::deque<ControllerKind>& controller_kinds() {
  return kinds().rows();
}

void register_controller(ControllerKind kind) {
  AMBLE_CHECK(kind.make, "a controller needs a function that makes it");
  kinds().add(std::move(kind));
}

substrate::Settings substrate_of(const ControllerSettings& settings, const robot::RobotSpec& robot) {
  substrate::Settings substrate = settings.substrate;
  if (substrate.layout == substrate::LayoutSource::listed) {
    check_listed(settings);
    return substrate;
  }
  check_without_lists(substrate);
  if (!kind_of(settings).automatic)
    fail_setting({"controller.substrate.layout", "controller.substrate", "controller.kind"},
                 "controller.substrate.layout = \"auto\": a controller of kind {} has no automatic substrate",
                 settings.kind);
  substrate::Settings made = kind_of(settings).automatic(robot);
  vary(settings, robot, made);
  substrate.layout = substrate::LayoutSource::listed;
  substrate.coordinates = std::move(made.coordinates);
  substrate.outputs = std::move(made.outputs);
  substrate.nodes = std::move(made.nodes);
  substrate.links = std::move(made.links);
  substrate.properties = std::move(made.properties);
  return substrate;
}

std::unique_ptr<const Architecture> make_architecture(const ControllerSettings& settings,
                                                      const robot::RobotSpec& robot, double timestep_s) {
  ControllerSettings listed = settings;
  listed.substrate = substrate_of(settings, robot);
  listed.own.complete(kind_of(settings).numbers);
  auto made = kind_of(settings).make(listed, robot, timestep_s);
  if (!settings.differential.any()) return made;
  check_differential(settings);
  return std::make_unique<DifferentialArchitecture>(std::move(made), settings.differential, robot,
                                                    timestep_s);
}

std::unique_ptr<const Architecture> with_gaits(std::unique_ptr<const Architecture> made,
                                               std::vector<std::unique_ptr<Parameters>> gaits,
                                               const ControllerSettings& settings,
                                               const robot::RobotSpec& robot) {
  if (settings.differential.any())
    fail_setting({"controller.switching", "controller.differential"},
                 "controller.switching and controller.differential both steer; expected one of them");
  const auto* const supg = dynamic_cast<const SupgArchitecture*>(made.get());
  if (supg == nullptr || settings.kind != "supg")
    fail_setting({"controller.switching", "controller.kind"},
                 "controller.switching: controllers of kind {} cannot switch gaits; expected kind supg",
                 settings.kind);
  std::unique_ptr<const SupgArchitecture> walker(supg);
  static_cast<void>(made.release());  // it is the same
  return std::make_unique<SwitchingArchitecture>(std::move(walker), settings.switching, std::move(gaits),
                                                 robot);
}

}  // namespace amble::controllers
