#include "amble/morphology/original_model.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <mujoco/mujoco.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "amble/core/error.hpp"
#include "amble/core/index.hpp"
#include "amble/morphology/mass_text.hpp"
#include "amble/morphology/model_shapes.hpp"
#include "amble/morphology/mujoco_handlers.hpp"
#include "amble/morphology/start_pose.hpp"

namespace amble::morphology {
namespace {

constexpr std::uint64_t largest_meshes_bytes = 32'000'000;

/// Makes of a model's text one that is whole by itself.
class ModelKeeper {
 public:
  ModelKeeper(const ModelFile& file, ReadingNotes& notes)
      : file_(file), model_(*file.model), text_(file.text), notes_(notes) {}

  std::shared_ptr<const robot::OriginalModel> keep(const ReadingOptions& options, const ModelParts& parts,
                                                   const robot::RobotSpec& robot) {
    if (file_.root_is_welded) refuse("a URDF has no physics of its own");
    refuse_bound_root(parts);
    text_.children.insert(text_.children.end(), file_.aside.begin(), file_.aside.end());
    text_.prune([](const XmlElement& element, const XmlElement&) { return element.name == "keyframe"; });
    keep_memory();
    keep_integrator();
    keep_actuators();
    keep_masses();
    keep_meshes();
    if (!has_ground()) add_ground();
    kept_.mjcf = write_xml(text_).text;
    kept_.start = StartPose(file_, options).positions();
    number(parts, robot);
    check();
    notes_.add(Reading::kept,
               fmt::format("the model itself, for the engine mujoco-model: {} bytes of MJCF, {} "
                           "meshes that collide or weigh, of {} bytes",
                           kept_.mjcf.size(), kept_.meshes.size(), mesh_bytes_));
    return std::make_shared<const robot::OriginalModel>(std::move(kept_));
  }

 private:
  template <typename... Args>
  [[noreturn]] void refuse(fmt::format_string<Args...> text, Args&&... args) const {
    fail(ExitCode::bad_input,
         "{}: the model cannot be kept for the engine mujoco-model (keep_model = true): {}",
         file_.path.string(), fmt::format(text, std::forward<Args>(args)...));
  }

  void note(std::string text) {
    notes_.add(Reading::replaced, "in the engine mujoco-model " + std::move(text));
  }

  bool collides(int g) const {
    return morphology::collides(model_, g) && !is_placeholder(model_, g, file_.missing_meshes);
  }

  bool removed(std::string_view element, std::string_view key, std::string_view value = {}) const {
    return std::ranges::any_of(file_.removed, [&](const RemovedAttribute& attribute) {
      return attribute.element == element && attribute.key == key &&
             (value.empty() || attribute.value == value);
    });
  }

  void refuse_bound_root(const ModelParts& parts) const {
    if (parts.model_joints.empty()) refuse("the robot has no joints");
    const int root = model_.body_rootid[model_.jnt_bodyid[parts.model_joints[0]]];
    if (!moves_as_root(model_, root))
      refuse("its root '{}' moves neither by a free joint nor by slides and hinges, and so cannot walk",
             std::string_view(model_.names + model_.name_bodyadr[root]));
  }

  /// What newer models say of memory is unknown to this MuJoCo.
  void keep_memory() {
    for (XmlElement& section : text_.children) {
      if (section.name != "size") continue;
      std::erase_if(section.attributes, [](const auto& attribute) {
        return attribute.first != "nconmax" && attribute.first != "njmax" && attribute.first != "nstack";
      });
    }
  }

  void keep_integrator() {
    if (!removed("option", "integrator", "implicitfast")) return;
    XmlElement option{.name = "option", .file = text_.file};
    option.set("integrator", "implicit");
    text_.children.push_back(std::move(option));
    note("the integrator is `implicit`: this MuJoCo does not know implicitfast");
  }

  /// kv of position actuators and torque limits of joints, which this MuJoCo does not know.
  void keep_actuators() {
    std::vector<XmlElement*> actuators;
    for (XmlElement& section : text_.children) {
      if (section.name != "actuator") continue;
      for (XmlElement& actuator : section.children) actuators.push_back(&actuator);
    }
    if (actuators.size() != to_index(model_.nu)) return;  // not understood: as this MuJoCo reads them
    for (int a = 0; a < model_.nu; ++a) {
      if (model_.actuator_trntype[a] != mjTRN_JOINT && model_.actuator_trntype[a] != mjTRN_JOINTINPARENT)
        continue;
      const int joint = model_.actuator_trnid[2 * a];
      const auto hint = file_.motors.find(model_.names + model_.name_jntadr[joint]);
      if (hint == file_.motors.end()) continue;
      XmlElement& actuator = *actuators[to_index(a)];
      if (actuator.name == "position" && hint->second.kv_nm_s_per_rad > 0.0 && removed("position", "kv"))
        add_damping(actuator, model_.actuator_gainprm[mjNGAIN * a], hint->second.kv_nm_s_per_rad);
      if (actuator.name == "position" && hint->second.damping_ratio > 0.0 && removed("position", "dampratio"))
        add_damping(actuator, model_.actuator_gainprm[mjNGAIN * a],
                    kv_of_ratio(a, hint->second.damping_ratio));
      if (hint->second.max_torque_nm > 0.0 && removed("joint", "actuatorfrcrange"))
        limit(actuator, a, hint->second.max_torque_nm);
    }
    if (removed("position", "kv")) note("position actuators with kv are general ones of the same law");
    if (removed("position", "dampratio"))
      note("position actuators with dampratio are general ones with the damping that follows from it");
    if (removed("body", "gravcomp")) note("gravity is not compensated: this MuJoCo does not know gravcomp");
  }

  /// As newer versions compute it: with kp and the inertia about the joint in the reference pose, through the
  /// gear, the damping of which it is that share of the critical one.
  double kv_of_ratio(int a, double ratio) const {
    const double gear = model_.actuator_gear[6 * a], kp = model_.actuator_gainprm[mjNGAIN * a];
    const double inertia = model_.dof_M0[model_.jnt_dofadr[model_.actuator_trnid[2 * a]]] / (gear * gear);
    return ratio * 2.0 * std::sqrt(kp * inertia);
  }

  static void add_damping(XmlElement& actuator, double kp, double kv) {
    actuator.name = "general";
    for (const char* key : {"kp", "kv", "gaintype", "gainprm", "biastype", "biasprm"})
      actuator.remove_attribute(key);
    actuator.set("gaintype", "fixed");
    actuator.set("gainprm", fmt::format("{}", kp));
    actuator.set("biastype", "affine");
    actuator.set("biasprm", fmt::format("0 {} {}", -kp, -kv));
  }

  void limit(XmlElement& actuator, int a, double max_torque_nm) {
    int of_joint = 0;
    for (int other = 0; other < model_.nu; ++other)
      of_joint += model_.actuator_trntype[other] == model_.actuator_trntype[a] &&
                  model_.actuator_trnid[2 * other] == model_.actuator_trnid[2 * a];
    const double gear = std::abs(model_.actuator_gear[6 * a]);
    if (of_joint > 1 || gear == 0.0) {
      note("actuatorfrcrange of joints with several actuators is missing: this MuJoCo does not know it");
      return;
    }
    double lower = -max_torque_nm / gear, upper = max_torque_nm / gear;
    if (model_.actuator_forcelimited[a] != 0) {
      lower = std::max(lower, model_.actuator_forcerange[2 * a]);
      upper = std::min(upper, model_.actuator_forcerange[2 * a + 1]);
    }
    for (const char* key : {"forcelimited", "forcerange"}) actuator.remove_attribute(key);
    actuator.set("forcelimited", "true");
    actuator.set("forcerange", fmt::format("{} {}", lower, upper));
    note("a joint's actuatorfrcrange is its actuator's force range");
  }

  // ---- masses

  /// What was mended of masses, because a mesh or a number is missing, is not in the text. Placeholders of
  /// meshes touch nothing.
  void keep_masses() {
    if (!file_.mended_bodies.empty()) {
      const auto from_geoms = [](const XmlElement& section) {
        return section.name == "compiler" && section.attribute_or("inertiafromgeom", "auto") == "true";
      };
      if (std::ranges::any_of(text_.children, from_geoms))
        refuse("inertiafromgeom=\"true\", and masses had to be mended");
      int number = 0;
      for (XmlElement& section : text_.children)
        if (section.name == "worldbody") keep_masses(section, number);
    }
    text_.visit([&](XmlElement& geom, XmlElement*) {
      if (geom.name != "geom" || !file_.missing_meshes.contains(geom.attribute_or("mesh", ""))) return;
      geom.set("contype", "0");
      geom.set("conaffinity", "0");
    });
  }

  void keep_masses(XmlElement& parent, int& number) {
    for (XmlElement& body : parent.children) {
      if (body.name != "body") continue;
      const int b = ++number;
      if (file_.mended_bodies.contains(b) && b < model_.nbody && model_.body_mass[b] > 0.0) {
        std::erase_if(body.children, [](const XmlElement& child) { return child.name == "inertial"; });
        XmlElement inertial{.name = "inertial", .file = body.file, .line = body.line};
        const auto numbers = [](const double* values, int count) {
          return fmt::format("{}", fmt::join(values, values + count, " "));
        };
        inertial.set("pos", numbers(model_.body_ipos + 3 * b, 3));
        inertial.set("quat", numbers(model_.body_iquat + 4 * b, 4));
        inertial.set("mass", numbers(model_.body_mass + b, 1));
        inertial.set("diaginertia", numbers(model_.body_inertia + 3 * b, 3));
        body.children.insert(body.children.begin(), std::move(inertial));
      }
      keep_masses(body, number);
    }
  }

  // ---- meshes

  void keep_meshes() {
    std::vector<XmlElement*> meshes;
    for (XmlElement& section : text_.children) {
      if (section.name != "asset") continue;
      for (XmlElement& asset : section.children)
        if (asset.name == "mesh") meshes.push_back(&asset);
    }
    const std::vector<bool> needed = needed_meshes(meshes);
    for (std::size_t m = 0; m < meshes.size(); ++m) {
      const auto file = meshes[m]->attribute("file");
      if (!file) continue;
      if (!needed[m])
        make_small(*meshes[m]);
      else
        take(*file);
    }
  }

  void take(const std::string& file) {
    const auto found = file_.meshes.find(file);
    if (found == file_.meshes.end()) refuse("its mesh {} was not read", file);
    if (!kept_.meshes.try_emplace(file, *found->second).second) return;
    mesh_bytes_ += found->second->size();
    if (mesh_bytes_ > largest_meshes_bytes)
      refuse("its meshes that collide or weigh have more than {} MB", largest_meshes_bytes / 1'000'000);
  }

  /// In place of one that neither collides nor weighs.
  static void make_small(XmlElement& mesh) {
    for (const char* key : {"file", "vertex", "face", "normal", "texcoord", "scale", "content_type"})
      mesh.remove_attribute(key);
    mesh.set("vertex", "0 0 0 .001 0 0 0 .001 0 0 0 .001");
  }

  /// Whether something collides or weighs with the shape of each mesh.
  std::vector<bool> needed_meshes(const std::vector<XmlElement*>& meshes) const {
    if (meshes.size() != to_index(model_.nmesh)) return std::vector<bool>(meshes.size(), true);
    const std::vector<bool> has_inertia = bodies_with_inertial(text_, model_.nbody);
    std::vector<bool> needed(meshes.size()), shown(meshes.size());
    for (int g = 0; g < model_.ngeom; ++g) {
      const int mesh = model_.geom_dataid[g];
      if (model_.geom_type[g] != mjGEOM_MESH || mesh < 0) continue;
      shown[to_index(mesh)] = true;
      if (collides(g) || !has_inertia[to_index(model_.geom_bodyid[g])]) needed[to_index(mesh)] = true;
    }
    // One that shapes a primitive geom is no geom's.
    text_.visit([&](const XmlElement& element) {
      for (std::size_t m = 0; element.name == "geom" && m < meshes.size(); ++m)
        if (!shown[m] && element.attribute_or("mesh", "") == meshes[m]->attribute_or("name", ""))
          needed[m] = true;
    });
    return needed;
  }

  // ---- the ground

  bool has_ground() const {
    for (int g = 0; g < model_.ngeom; ++g)
      if (is_ground(model_, g)) return true;
    return false;
  }

  /// In a body of its own behind all others, so that no number changes.
  void add_ground() {
    XmlElement plane{.name = "geom", .file = text_.file}, body{.name = "body", .file = text_.file};
    for (const auto& [key, value] : {std::pair{"type", "plane"},
                                     {"size", "0 0 1"},
                                     {"contype", "2147483647"},
                                     {"conaffinity", "2147483647"},
                                     {"condim", "3"},
                                     {"priority", "0"},
                                     {"friction", "1 0.005 0.0001"},
                                     {"solmix", "1"},
                                     {"solref", "0.02 1"},
                                     {"solimp", "0.9 0.95 0.001 0.5 2"},
                                     {"margin", "0"},
                                     {"gap", "0"}})
      plane.set(key, value);
    body.children.push_back(std::move(plane));
    XmlElement world{.name = "worldbody", .file = text_.file};
    world.children.push_back(std::move(body));
    text_.children.push_back(std::move(world));
    note("the ground is the plane z = 0 with MuJoCo's own friction (1): the model has none there");
  }

  // ---- numbers

  void number(const ModelParts& parts, const robot::RobotSpec& robot) {
    for (const robot::Joint& joint : robot.joints) {
      const auto found = std::ranges::find(parts.joints, joint.name, &robot::Joint::name);
      kept_.joints.push_back(parts.model_joints[to_index(found - parts.joints.begin())]);
    }
    kept_.geoms = parts.model_geoms;
  }

  /// It must be compiled as what the robot was made from.
  void check() const {
    ModelPointer compiled;
    try {
      compiled = compile_mjcf(kept_.mjcf, file_.path.string(), kept_.meshes);
    } catch (const UserError& error) {
      refuse("{}", error.what());
    }
    const mjModel& own = *compiled;
    const int ground = own.ngeom - model_.ngeom;
    if (own.njnt != model_.njnt || own.nq != model_.nq || own.nu != model_.nu || ground < 0 || ground > 1 ||
        !std::equal(own.jnt_type, own.jnt_type + own.njnt, model_.jnt_type) ||
        !std::equal(own.geom_type, own.geom_type + model_.ngeom, model_.geom_type))
      refuse("its parts are numbered differently when it is compiled by itself");
  }

  const ModelFile& file_;
  const mjModel& model_;
  XmlElement text_;
  ReadingNotes& notes_;
  robot::OriginalModel kept_;
  std::uint64_t mesh_bytes_ = 0;
};

}  // namespace

std::shared_ptr<const robot::OriginalModel> keep_model(const ModelFile& file, const ReadingOptions& options,
                                                       const ModelParts& parts, const robot::RobotSpec& robot,
                                                       ReadingNotes& notes) {
  return ModelKeeper(file, notes).keep(options, parts, robot);
}

std::string keeping_lines(const ModelFile& file, const ReadingOptions& options, const ModelParts& parts,
                          const robot::RobotSpec& robot) {
  if (file.root_is_welded) return {};
  try {
    ReadingNotes notes;
    keep_model(file, options, parts, robot, notes);
  } catch (const UserError& error) {
    return fmt::format("# Not in the engine mujoco-model: {}\n", error.what());
  }
  return "# Runs and champions carry the MJCF itself, and can walk in its own physics: --engine "
         "mujoco-model.\n"
         "keep_model = true\n";
}

}  // namespace amble::morphology
