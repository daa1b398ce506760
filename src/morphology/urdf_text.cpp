#include "amble/morphology/urdf_text.hpp"

#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "amble/core/error.hpp"
#include "amble/morphology/mass_text.hpp"
#include "amble/morphology/mesh_file.hpp"
#include "amble/morphology/mesh_store.hpp"
#include "amble/morphology/number_text.hpp"

namespace amble::morphology {
namespace {

namespace fs = std::filesystem;

/// MuJoCo fuses a URDF's root link into the world, and its mass is lost, unless the compiler option
/// fusestatic is off; and leaves out what is only to look at, unless discardvisual is. These options go into
/// an element <mujoco>, which most URDF files do not have. Returns the folder that it names for meshes.
fs::path set_options(XmlElement& root) {
  if (root.child("mujoco") == nullptr)
    root.children.insert(root.children.begin(),
                         XmlElement{.name = "mujoco", .file = root.file, .line = root.line});
  XmlElement& extension = *root.child("mujoco");
  if (extension.child("compiler") == nullptr)
    extension.children.insert(extension.children.begin(),
                              XmlElement{.name = "compiler", .file = root.file, .line = root.line});
  XmlElement& compiler = *extension.child("compiler");
  compiler.set("fusestatic", "false");
  compiler.set("strippath", "false");
  if (!compiler.attribute("discardvisual")) compiler.set("discardvisual", "false");
  fs::path folder = plain_path(compiler.attribute_or("meshdir", ""));
  compiler.remove_attribute("meshdir");
  return folder;
}

/// Whether a visual shape is one of those that collide.
bool collides_too(const XmlElement& visual, const XmlElement& link) {
  const auto text_of = [](const XmlElement* part) {
    if (part == nullptr) return std::string();
    XmlElement copy = *part;
    return write_xml(copy).text;
  };
  return std::ranges::any_of(link.children, [&](const XmlElement& other) {
    return other.name == "collision" &&
           text_of(other.child("geometry")) == text_of(visual.child("geometry")) &&
           text_of(other.child("origin")) == text_of(visual.child("origin"));
  });
}

/// What MuJoCo refuses of a shape's size; empty: nothing.
std::string size_problem(const XmlElement& shape) {
  const XmlElement* geometry = shape.child("geometry");
  if (geometry == nullptr || geometry->children.empty()) return "without a geometry";
  const XmlElement& form = geometry->children.front();
  for (const char* key : {"size", "radius", "length"})
    for (const double size : numbers_of(form.attribute_or(key, "")))
      if (!(size > 0.0))
        return fmt::format("a {} with {}=\"{}\"", form.name, key, form.attribute_or(key, ""));
  const std::string scale = form.attribute_or("scale", "");
  for (const double factor : numbers_of(scale))
    if (factor == 0.0) return fmt::format("a {} with scale=\"{}\"", form.name, scale);
  return {};
}

std::optional<std::string> mesh_name(const XmlElement& shape) {
  const XmlElement* geometry = shape.child("geometry");
  const XmlElement* mesh = geometry != nullptr ? geometry->child("mesh") : nullptr;
  return mesh != nullptr ? mesh->attribute("filename") : std::nullopt;
}

/// Meshes of a URDF, by the names that it gives them.
class UrdfMeshes {
 public:
  UrdfMeshes(ModelText& text, const fs::path& path, fs::path mesh_folder, ReadingNotes& notes)
      : text_(text), folder_(path.parent_path()), mesh_folder_(std::move(mesh_folder)), notes_(notes) {}

  void take_all() {
    XmlElement& root = text_.root;
    root.prune([&](const XmlElement& element, const XmlElement& parent) { return drops(element, parent); });
    if (!unseen_.empty())
      notes_.add(Reading::left_out, fmt::format("what is only to look at and whose mesh cannot be read: {}",
                                                fmt::join(unseen_, ", ")));
    if (!sizeless_.empty())
      notes_.add(Reading::left_out, fmt::format("shapes without size: {}", fmt::join(sizeless_, ", ")));
    root.visit([&](XmlElement& element, XmlElement* parent) {
      const auto name = element.attribute("filename");
      if (element.name != "mesh" || !name || parent == nullptr || parent->name != "geometry") return;
      if (const auto scale = numbers_of(element.attribute_or("scale", "")); scale.size() == 1)
        element.set("scale", fmt::format("{0} {0} {0}", scale[0]));
      take_mesh(text_, element, "filename", *name, file_of(*name), notes_);
    });
    if (!elsewhere_.empty())
      notes_.add(Reading::replaced,
                 fmt::format("paths of meshes, by what is there: {}", fmt::join(elsewhere_, ", ")));
  }

 private:
  /// Whether a visual shape goes: those stay that can be shown and do not repeat what collides.
  bool drops(const XmlElement& shape, const XmlElement& link) {
    const bool visual = shape.name == "visual";
    if (!visual && (shape.name != "collision" || link.name != "link")) return false;
    const std::string of = link.attribute_or("name", "");
    if (visual && (link.name != "link" || collides_too(shape, link))) return true;
    if (const std::string problem = size_problem(shape); !problem.empty()) {
      sizeless_.push_back(
          fmt::format("the {} shape of '{}', {}", visual ? "visual" : "collision", of, problem));
      return true;
    }
    const auto mesh = mesh_name(shape);
    if (!visual || !mesh) return false;
    const fs::path path = file_of(*mesh);
    const std::string problem = path.empty() ? "not found" : text_.meshes.problem(path, notes_);
    if (!problem.empty()) unseen_.push_back(fmt::format("{} of '{}' ({})", *mesh, of, problem));
    return !problem.empty();
  }

  fs::path file_of(const std::string& name) {
    const auto [at, is_new] = found_.try_emplace(name);
    if (!is_new) return at->second;
    const std::string plain = plain_path(name);
    at->second = first_file(places_of_urdf_mesh(folder_, mesh_folder_, plain));
    if (!at->second.empty()) {
      at->second = fs::absolute(at->second).lexically_normal();
      if (fs::path(plain).filename() != at->second.filename() || name.find('\\') != std::string::npos)
        elsewhere_.push_back(fmt::format("{} ({})", name, at->second.filename().string()));
    }
    return at->second;
  }

  ModelText& text_;
  fs::path folder_, mesh_folder_;
  ReadingNotes& notes_;
  std::map<std::string, fs::path> found_;
  std::vector<std::string> unseen_, sizeless_, elsewhere_;
};

/// MuJoCo 2.2 reads on after a type that it does not know, and dies of it.
void refuse_unknown_joints(const XmlElement& root, const fs::path& path) {
  static constexpr std::array<std::string_view, 6> types{"revolute", "continuous", "prismatic",
                                                         "fixed",    "floating",   "planar"};
  for (const XmlElement& joint : root.children) {
    if (joint.name != "joint") continue;
    const std::string type = joint.attribute_or("type", "");
    if (std::ranges::find(types, type) == types.end())
      fail(ExitCode::bad_input, "{}:{}: joint '{}' has the type '{}': expected one of {}", path.string(),
           joint.line, joint.attribute_or("name", ""), type, fmt::join(types, ", "));
  }
}

/// A shape with another form, `along_m` from its middle along its axis.
XmlElement with_form(const XmlElement& shape, XmlElement form, double along_m) {
  XmlElement made = shape;
  made.child("geometry")->children = {std::move(form)};
  if (along_m == 0.0) return made;
  made.remove_attribute("name");
  if (made.child("origin") == nullptr)
    made.children.push_back(XmlElement{.name = "origin", .file = shape.file, .line = shape.line});
  XmlElement& origin = *made.child("origin");
  std::vector<double> xyz = numbers_of(origin.attribute_or("xyz", "0 0 0")),
                      rpy = numbers_of(origin.attribute_or("rpy", "0 0 0"));
  xyz.resize(3), rpy.resize(3);
  const Quat rotation =
      axis_angle({0, 0, 1}, rpy[2]) * axis_angle({0, 1, 0}, rpy[1]) * axis_angle({1, 0, 0}, rpy[0]);
  const Vec3 at = Vec3{xyz[0], xyz[1], xyz[2]} + rotate(rotation, {0.0, 0.0, along_m});
  origin.set("xyz", fmt::format("{} {} {}", at.x, at.y, at.z));
  return made;
}

/// Capsules, which MuJoCo knows in MJCF alone, as a cylinder and two balls. Throws UserError for other shapes
/// that it does not know.
void replace_capsules(XmlElement& root, ReadingNotes& notes) {
  constexpr std::array<std::string_view, 4> known{"box", "cylinder", "sphere", "mesh"};
  std::vector<std::string> replaced;
  for (XmlElement& link : root.children) {
    if (link.name != "link") continue;
    const std::size_t before = replaced.size();
    std::vector<XmlElement> parts;
    for (XmlElement& shape : link.children) {
      const XmlElement* const geometry =
          shape.name == "visual" || shape.name == "collision" ? shape.child("geometry") : nullptr;
      const XmlElement* const form =
          geometry != nullptr && !geometry->children.empty() ? &geometry->children.front() : nullptr;
      if (form == nullptr || std::ranges::find(known, form->name) != known.end()) {
        parts.push_back(std::move(shape));
        continue;
      }
      const std::string of = link.attribute_or("name", "");
      if (form->name != "capsule" && shape.name == "visual") {
        notes.add(Reading::left_out, fmt::format("what is only to look at: <{}> of '{}'", form->name, of));
        continue;
      }
      if (form->name != "capsule")
        fail(ExitCode::bad_input, "{}:{}: link '{}': <{}>: expected a box, cylinder, sphere, capsule or mesh",
             form->file, form->line, of, form->name);
      XmlElement cylinder = *form, ball = *form;
      cylinder.name = "cylinder";
      ball.name = "sphere";
      ball.remove_attribute("length");
      const double half_m = 0.5 * number_or_zero(form->attribute_or("length", "0"));
      parts.push_back(with_form(shape, std::move(cylinder), 0.0));
      for (const double along_m : {-half_m, half_m}) parts.push_back(with_form(shape, ball, along_m));
      replaced.push_back(of);
    }
    link.children = std::move(parts);
    // So that its mass is that of its shapes as mend_masses() counts them: balls are half within a cylinder.
    if (replaced.size() > before && link.child("inertial") == nullptr)
      link.children.push_back(XmlElement{.name = "inertial", .file = link.file, .line = link.line});
  }
  if (!replaced.empty())
    notes.add(Reading::replaced,
              fmt::format("capsules, by a cylinder and two balls: of {}", fmt::join(replaced, ", ")));
}

/// A root without anything, from which the robot hangs by a floating or planar joint, is the world by another
/// name: MuJoCo knows no such joint below a link, and amble's root is free by itself.
void remove_floating_roots(XmlElement& root, ReadingNotes& notes) {
  for (;;) {
    std::set<std::string> children;
    for (const XmlElement& joint : root.children)
      if (const XmlElement* child = joint.name == "joint" ? joint.child("child") : nullptr)
        children.insert(child->attribute_or("link", ""));
    const auto is_empty_root = [&](const XmlElement& link) {
      const std::string name = link.attribute_or("name", "");
      return link.name == "link" && name != "world" && !children.contains(name) &&
             link.child("inertial") == nullptr && link.child("collision") == nullptr &&
             link.child("visual") == nullptr;
    };
    const auto link = std::ranges::find_if(root.children, is_empty_root);
    if (link == root.children.end()) return;
    const std::string name = link->attribute_or("name", "");
    const auto hangs = [&](const XmlElement& joint) {
      const XmlElement* parent = joint.name == "joint" ? joint.child("parent") : nullptr;
      return parent != nullptr && parent->attribute_or("link", "") == name;
    };
    const auto joint = std::ranges::find_if(root.children, hangs);
    if (joint == root.children.end() || std::ranges::count_if(root.children, hangs) > 1) return;
    const std::string type = joint->attribute_or("type", "");
    if (type != "floating" && type != "planar") return;
    notes.add(Reading::replaced,
              fmt::format("the {} joint '{}' below the empty link '{}': the root is free to move", type,
                          joint->attribute_or("name", ""), name));
    const auto is_root = [&](const XmlElement& element) {
      return element.name == "link" && element.attribute_or("name", "") == name;
    };
    std::erase_if(root.children,
                  [&](const XmlElement& element) { return hangs(element) || is_root(element); });
  }
}

/// Which joints have motors, as ROS is told: those of <transmission> (in it or beside, in older files), and
/// those of <ros2_control> that take commands.
void read_motors(ModelText& text, ReadingNotes& notes) {
  bool transmissions = false, control = false;
  const auto is_command = [](const XmlElement& part) { return part.name == "command_interface"; };
  text.root.visit([&](const XmlElement& element) {
    transmissions = transmissions || element.name == "transmission";
    control = control || element.name == "ros2_control";
    if (element.name != "transmission" && element.name != "ros2_control") return;
    for (const XmlElement& joint : element.children)
      if (joint.name == "joint" &&
          (element.name == "transmission" || std::ranges::any_of(joint.children, is_command)))
        text.motors_named.insert(joint.attribute_or("name", ""));
  });
  if (transmissions) notes.add(Reading::left_out, "transmissions: the robot file has the servos");
  if (control) notes.add(Reading::left_out, "ros2_control: the robot file has the servos");
}

/// What MuJoCo does not read of them.
void read_limits(ModelText& text, ReadingNotes& notes) {
  bool safety_controllers = false;
  for (const XmlElement& joint : text.root.children) {
    if (joint.name != "joint") continue;
    MotorHint& motor = text.motors[joint.attribute_or("name", "")];
    if (const XmlElement* limit = joint.child("limit")) {
      motor.max_torque_nm = positive_or_zero(limit->attribute("effort"));
      motor.max_speed_rad_s = positive_or_zero(limit->attribute("velocity"));
    }
    if (const XmlElement* safety = joint.child("safety_controller")) {
      safety_controllers = true;
      const double lower = number_or_zero(safety->attribute("soft_lower_limit")),
                   upper = number_or_zero(safety->attribute("soft_upper_limit"));
      if (lower < upper) motor.soft_limits_rad = {lower, upper};
    }
  }
  if (safety_controllers)
    notes.add(Reading::left_out,
              "safety controllers: `amble robot --init` reads their soft limits as ranges of command");
}

}  // namespace

void clean_urdf(ModelText& text, const fs::path& path, ReadingNotes& notes) {
  XmlElement& root = text.root;
  refuse_unknown_joints(root, path);
  remove_floating_roots(root, notes);
  replace_capsules(root, notes);
  const fs::path mesh_folder = set_options(root);
  read_motors(text, notes);
  root.prune([&](const XmlElement& element, const XmlElement& parent) {
    if (element.name == "mimic") {
      const std::string joint = parent.attribute_or("name", "");
      text.mimics.emplace_back(joint, element.attribute_or("joint", ""));
      notes.add(Reading::left_out, fmt::format("mimic of joint '{}': it moves on its own", joint));
    }
    if (element.name == "gazebo") notes.add(Reading::left_out, "settings of Gazebo");
    return element.name == "mimic" || element.name == "transmission" || element.name == "gazebo";
  });
  UrdfMeshes(text, path, mesh_folder, notes).take_all();
  complete_inertials(root, text.missing_masses);
  balance_inertias(root, true, notes);
  mend_limits(root, true, notes);
  read_limits(text, notes);
}

}  // namespace amble::morphology
