#include "amble/morphology/urdf_text.hpp"

#include <fmt/ranges.h>
#include <mujoco/mujoco.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "amble/core/error.hpp"

namespace amble::morphology {
namespace {

namespace fs = std::filesystem;

/// MuJoCo fuses a URDF's root link into the world, and its mass is lost, unless the compiler option
/// fusestatic is off; and leaves out what is only to look at, unless discardvisual is. These options go into
/// an element <mujoco>, which most URDF files do not have.
void set_options(XmlElement& root, const fs::path& path) {
  XmlElement* extension = root.child("mujoco");
  if (extension == nullptr) {
    XmlElement mujoco{.name = "mujoco", .file = root.file, .line = root.line};
    mujoco.children.push_back(
        {.name = "compiler",
         .attributes = {{"fusestatic", "false"}, {"strippath", "false"}, {"discardvisual", "false"}},
         .file = root.file,
         .line = root.line});
    root.children.insert(root.children.begin(), std::move(mujoco));
    return;
  }
  XmlElement* compiler = extension->child("compiler");
  if (compiler == nullptr || compiler->attribute_or("fusestatic", "true") != "false")
    fail(ExitCode::bad_input,
         "{}: the element <mujoco> must hold <compiler fusestatic=\"false\"/>, or the root link is lost",
         path.string());
  if (!compiler->attribute("discardvisual")) compiler->set("discardvisual", "false");
}

/// The file that a URDF means by a mesh's name, which may be package://PACKAGE/PATH: beside the URDF, in one
/// of the folders above it, with or without the package's name, or of that name in a folder `meshes`. Empty
/// if there is none.
fs::path mesh_of_urdf(const fs::path& folder, std::string name,
                      bool (*wanted)(const fs::path&) = is_readable_mesh) {
  for (const std::string_view scheme : {"package://", "file://"})
    if (name.starts_with(scheme)) name.erase(0, scheme.size());
  const fs::path whole(name);
  fs::path rest;  // without the package's name
  for (auto part = whole.begin(); part != whole.end(); ++part)
    if (part != whole.begin()) rest /= *part;
  std::vector<fs::path> candidates;
  fs::path above = fs::absolute(folder.empty() ? "." : folder).lexically_normal();
  constexpr int most_folders = 8;
  for (int i = 0; i < most_folders && above.has_relative_path(); ++i, above = above.parent_path()) {
    candidates.push_back(above / whole);
    candidates.push_back(above / rest);
  }
  candidates.insert(candidates.end(), {folder / whole.filename(), folder / "meshes" / whole.filename(),
                                       folder / ".." / "meshes" / whole.filename()});
  for (const fs::path& candidate : candidates)
    if (wanted(candidate)) return fs::absolute(candidate).lexically_normal();
  return {};
}

/// A mesh that is not there, as it is to be told.
std::string missing_mesh(const fs::path& folder, const std::string& name) {
  return mesh_of_urdf(folder, name, is_text_stl).empty() ? name : name + text_stl_remark;
}

std::optional<std::string> mesh_name(const XmlElement& shape) {
  const XmlElement* geometry = shape.child("geometry");
  const XmlElement* mesh = geometry != nullptr ? geometry->child("mesh") : nullptr;
  return mesh != nullptr ? mesh->attribute("filename") : std::nullopt;
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

/// Leaves of the visual shapes those that can be shown and do not repeat what collides.
void choose_visuals(XmlElement& root, const fs::path& folder, ReadingNotes& notes) {
  std::set<std::string> missing;
  root.prune([&](const XmlElement& element, const XmlElement& parent) {
    if (element.name != "visual") return false;
    if (parent.name != "link" || element.child("geometry") == nullptr || collides_too(element, parent))
      return true;
    const auto mesh = mesh_name(element);
    if (!mesh || !mesh_of_urdf(folder, *mesh).empty()) return false;
    missing.insert(fs::path(missing_mesh(folder, *mesh)).filename().string());
    return true;
  });
  if (!missing.empty())
    notes.add(Reading::left_out, fmt::format("what is only to look at and whose mesh is missing, or neither "
                                             "STL, OBJ nor MSH: {}",
                                             fmt::join(missing, ", ")));
}

/// Principal moments that no body can have, one larger than the sum of the others, make MuJoCo refuse a
/// model. Files that were drawn or written by hand have them. Their mean takes their place, as by MuJoCo's
/// balanceinertia.
void balance_inertias(XmlElement& root, ReadingNotes& notes) {
  std::vector<std::string> balanced;
  root.visit([&](XmlElement& link, XmlElement*) {
    XmlElement* inertial = link.name == "link" ? link.child("inertial") : nullptr;
    XmlElement* inertia = inertial != nullptr ? inertial->child("inertia") : nullptr;
    if (inertia == nullptr) return;
    const auto read = [&](const char* key) {
      return std::strtod(inertia->attribute_or(key, "0").c_str(), nullptr);
    };
    const double xx = read("ixx"), yy = read("iyy"), zz = read("izz"), xy = read("ixy"), xz = read("ixz"),
                 yz = read("iyz");
    const std::array<mjtNum, 9> matrix{xx, xy, xz, xy, yy, yz, xz, yz, zz};
    std::array<mjtNum, 3> moments{};  // falling
    std::array<mjtNum, 9> axes{};
    std::array<mjtNum, 4> turn{};
    mju_eig3(moments.data(), axes.data(), turn.data(), matrix.data());
    if (!(xx + yy + zz > 0.0) || moments[1] + moments[2] >= moments[0]) return;
    balanced.push_back(link.attribute_or("name", ""));
    const std::string mean = fmt::format("{:.6g}", (xx + yy + zz) / 3.0);
    for (const char* key : {"ixx", "iyy", "izz"}) inertia->set(key, mean);
    for (const char* key : {"ixy", "ixz", "iyz"}) inertia->set(key, "0");
  });
  if (!balanced.empty())
    notes.add(Reading::replaced,
              fmt::format("principal moments of inertia that no body can have, by their mean: {}",
                          fmt::join(balanced, ", ")));
}

/// Joints whose limits leave no range, which MuJoCo takes for joints without stops.
void note_lost_limits(XmlElement& root, ReadingNotes& notes) {
  std::vector<std::string> crossed, empty;
  root.visit([&](XmlElement& joint, XmlElement*) {
    const std::string type = joint.attribute_or("type", "");
    const XmlElement* const limit = joint.child("limit");
    if (joint.name != "joint" || (type != "revolute" && type != "prismatic") || limit == nullptr) return;
    const auto read = [&](const char* key) {
      return std::strtod(limit->attribute_or(key, "0").c_str(), nullptr);
    };
    const double lower = read("lower"), upper = read("upper");
    if (lower > upper)
      crossed.push_back(fmt::format("{} ({} to {})", joint.attribute_or("name", ""), lower, upper));
    else if (lower == upper)
      empty.push_back(joint.attribute_or("name", ""));
  });
  if (!crossed.empty())
    notes.add(Reading::replaced,
              fmt::format("limits whose lower is above their upper: these joints have no stops: {}",
                          fmt::join(crossed, ", ")));
  if (!empty.empty())
    notes.add(Reading::replaced,
              fmt::format("limits that leave no range, as exporters write them where none are "
                          "known: these joints have no stops: {}",
                          fmt::join(empty, ", ")));
}

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

}  // namespace

void clean_urdf(ModelText& text, const fs::path& path, ReadingNotes& notes) {
  XmlElement& root = text.root;
  if (root.name != "robot") fail(ExitCode::bad_input, "{}: a URDF needs an element <robot>", path.string());
  refuse_unknown_joints(root, path);
  set_options(root, path);
  choose_visuals(root, path.parent_path(), notes);
  root.prune([&](const XmlElement& element, const XmlElement& parent) {
    if (element.name == "mimic")
      notes.add(Reading::left_out,
                fmt::format("mimic of joint '{}': it moves on its own", parent.attribute_or("name", "")));
    if (element.name == "transmission")
      notes.add(Reading::left_out, "transmissions: the robot file has the servos");
    if (element.name == "gazebo") notes.add(Reading::left_out, "settings of Gazebo");
    return element.name == "mimic" || element.name == "transmission" || element.name == "gazebo";
  });
  balance_inertias(root, notes);
  note_lost_limits(root, notes);
  std::set<std::string> missing;
  root.visit([&](XmlElement& element, XmlElement*) {
    if (element.name == "joint") {
      MotorHint& motor = text.motors[element.attribute_or("name", "")];
      if (const XmlElement* limit = element.child("limit")) {
        motor.max_torque_nm = positive_or_zero(limit->attribute("effort"));
        motor.max_speed_rad_s = positive_or_zero(limit->attribute("velocity"));
      }
    }
    if (element.name != "mesh" || !element.attribute("filename")) return;
    const fs::path file = mesh_of_urdf(path.parent_path(), *element.attribute("filename"));
    if (file.empty()) missing.insert(missing_mesh(path.parent_path(), *element.attribute("filename")));
    element.set("filename", file.string());
  });
  if (!missing.empty())
    fail(ExitCode::io,
         "{}: collision meshes that are missing, or neither STL, OBJ nor MSH: {}; they are looked for beside "
         "the URDF, in the folders above it, and in meshes/",
         path.string(), fmt::join(missing, ", "));
}

}  // namespace amble::morphology
