#include "amble/morphology/mjcf_structure.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <mujoco/mujoco.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <numbers>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "amble/morphology/mjcf_defaults.hpp"
#include "amble/morphology/number_text.hpp"
#include "amble/robot/pose.hpp"

namespace amble::morphology {
namespace {

bool is_one_of(std::string_view name, std::initializer_list<std::string_view> names) {
  return std::ranges::find(names, name) != names.end();
}

std::set<std::string> names_of(const XmlElement& root, std::string_view kind) {
  std::set<std::string> names;
  root.visit([&](const XmlElement& element) {
    if (element.name == kind) names.insert(element.attribute_or("name", ""));
  });
  return names;
}

std::string text_of(Vec3 v) {
  return fmt::format("{} {} {}", v.x, v.y, v.z);
}

Vec3 vec3_of(const std::vector<double>& n, Vec3 otherwise, std::size_t at = 0) {
  return n.size() >= at + 3 ? Vec3{n[at], n[at + 1], n[at + 2]} : otherwise;
}

/// Poses as MJCF writes them.
class MjcfPoses {
 public:
  explicit MjcfPoses(const XmlElement& root) {
    for (const XmlElement& section : root.children) {
      if (section.name != "compiler") continue;
      if (const auto unit = section.attribute("angle")) degrees_ = *unit != "radian";
      if (const auto sequence = section.attribute("eulerseq"); sequence && sequence->size() == 3)
        sequence_ = *sequence;
    }
  }

  robot::Pose pose(const XmlElement& element) const {
    return {vec3_of(numbers_of(element.attribute_or("pos", "")), {}), rotation(element)};
  }

  static void set(XmlElement& element, const robot::Pose& pose) {
    element.set("pos", text_of(pose.position_m));
    for (const char* key : {"axisangle", "xyaxes", "zaxis", "euler"}) element.remove_attribute(key);
    const Quat q = pose.rotation;
    element.set("quat", fmt::format("{} {} {} {}", q.w, q.x, q.y, q.z));
  }

 private:
  double radians(double angle) const { return degrees_ ? angle * std::numbers::pi / 180.0 : angle; }

  static Quat about(Vec3 axis, double angle) {
    const double length = norm(axis);
    if (!(length > 0.0)) return {};
    const double s = std::sin(0.5 * angle) / length;
    return {std::cos(0.5 * angle), s * axis.x, s * axis.y, s * axis.z};
  }

  Quat rotation(const XmlElement& element) const {
    const auto given = [&](const char* key) { return numbers_of(element.attribute_or(key, "")); };
    if (const auto n = given("quat"); n.size() == 4) return unit({n[0], n[1], n[2], n[3]});
    if (const auto n = given("axisangle"); n.size() == 4) return about({n[0], n[1], n[2]}, radians(n[3]));
    if (const auto n = given("euler"); n.size() == 3) return euler(n);
    if (const auto n = given("xyaxes"); n.size() == 6) return of_axes(vec3_of(n, {}), vec3_of(n, {}, 3));
    if (const auto n = given("zaxis"); n.size() == 3) {
      mjtNum turn[4], axis[3] = {n[0], n[1], n[2]};
      mju_quatZ2Vec(turn, axis);
      return {turn[0], turn[1], turn[2], turn[3]};
    }
    return {};
  }

  static Quat unit(Quat q) {
    const double length = std::sqrt(q.w * q.w + q.x * q.x + q.y * q.y + q.z * q.z);
    if (!(length > 0.0)) return {};
    return {q.w / length, q.x / length, q.y / length, q.z / length};
  }

  /// Small letters turn with what was turned before, capitals about fixed axes.
  Quat euler(const std::vector<double>& angles) const {
    Quat turned;
    for (std::size_t i = 0; i < 3; ++i) {
      const char axis = static_cast<char>(std::tolower(static_cast<unsigned char>(sequence_[i])));
      const Quat one = about({axis == 'x' ? 1.0 : 0.0, axis == 'y' ? 1.0 : 0.0, axis == 'z' ? 1.0 : 0.0},
                             radians(angles[i]));
      turned = std::islower(static_cast<unsigned char>(sequence_[i])) != 0 ? turned * one : one * turned;
    }
    return turned;
  }

  static Quat of_axes(Vec3 x, Vec3 y) {
    if (!(norm(x) > 0.0)) return {};
    x = (1.0 / norm(x)) * x;
    y = y - dot(x, y) * x;
    if (!(norm(y) > 0.0)) return {};
    y = (1.0 / norm(y)) * y;
    const Vec3 z = cross(x, y);
    const mjtNum matrix[9] = {x.x, y.x, z.x, x.y, y.y, z.y, x.z, y.z, z.z};
    mjtNum turn[4];
    mju_mat2Quat(turn, matrix);
    return {turn[0], turn[1], turn[2], turn[3]};
  }

  bool degrees_ = true;
  std::string sequence_ = "xyz";
};

class FrameResolver {
 public:
  explicit FrameResolver(const XmlElement& root)
      : poses_(root), defaults_(root), body_names_(names_of(root, "body")) {}

  int resolve(XmlElement& section) {
    in_world(section, {}, "");
    return count_;
  }

 private:
  void in_world(XmlElement& place, const robot::Pose& at, const std::string& childclass) {
    std::vector<XmlElement> children;
    for (XmlElement& child : place.children) {
      if (child.name == "frame") {
        ++count_;
        in_world(child, at * poses_.pose(child), child.attribute_or("childclass", childclass));
        for (XmlElement& part : child.children) children.push_back(std::move(part));
        continue;
      }
      if (child.name == "body") in_body(child, "");
      if (place.name == "frame") put(child, at, childclass);
      children.push_back(std::move(child));
    }
    place.children = std::move(children);
  }

  /// Moves what stands in a frame of the world: bodies themselves, the rest with a body around it.
  void put(XmlElement& element, const robot::Pose& at, const std::string& childclass) {
    if (element.name != "body") {
      XmlElement around{.name = "body", .file = element.file, .line = element.line};
      around.set("name", free_name(body_names_, "frame"));
      around.children.push_back(std::move(element));
      element = std::move(around);
    }
    MjcfPoses::set(element, at * poses_.pose(element));
    if (!childclass.empty() && !element.attribute("childclass")) element.set("childclass", childclass);
  }

  void in_body(XmlElement& body, const std::string& above) {
    const std::string childclass = body.attribute_or("childclass", above);
    const bool has_inertial = body.child("inertial") != nullptr;
    std::vector<XmlElement> children;
    for (XmlElement& child : body.children) {
      if (child.name == "body") in_body(child, childclass);
      if (child.name != "frame") {
        children.push_back(std::move(child));
        continue;
      }
      ++count_;
      for (XmlElement& part : lifted(child, childclass)) children.push_back(std::move(part));
      children.push_back(as_body(std::move(child), body, has_inertial));
      in_body(children.back(), childclass);
    }
    body.children = std::move(children);
  }

  /// Joints and inertia of a frame, and of frames within it, are those of its body. `outer`: where it stands.
  std::vector<XmlElement> lifted(XmlElement& frame, const std::string& above,
                                 const robot::Pose& outer = {}) const {
    const robot::Pose at = outer * poses_.pose(frame);
    const std::string childclass = frame.attribute_or("childclass", above);
    std::vector<XmlElement> parts;
    for (XmlElement& part : frame.children) {
      if (part.name == "frame")
        for (XmlElement& inner : lifted(part, childclass, at)) parts.push_back(std::move(inner));
      if (part.name == "inertial") MjcfPoses::set(part, at * poses_.pose(part));
      if (part.name == "joint") {
        const auto given = [&](const char* key) {
          return numbers_of(defaults_.attribute(part, key, childclass).value_or(""));
        };
        const Vec3 position = at * vec3_of(given("pos"), {}), axis = vec3_of(given("axis"), {0, 0, 1});
        part.set("pos", text_of(position));
        part.set("axis", text_of(rotate(at.rotation, axis)));
      }
      if (!is_one_of(part.name, {"inertial", "joint", "freejoint"})) continue;
      if (part.name == "joint" && !childclass.empty() && !part.attribute("class"))
        part.set("class", childclass);
      parts.push_back(part);
      part.name.clear();
    }
    std::erase_if(frame.children, [](const XmlElement& part) { return part.name.empty(); });
    return parts;
  }

  XmlElement as_body(XmlElement frame, const XmlElement& body, bool has_inertial) {
    frame.name = "body";
    const std::string of = body.attribute_or("name", "");
    const std::string name = frame.attribute_or("name", of.empty() ? "frame" : of + ".frame");
    frame.set("name", free_name(body_names_, name));
    // The body's own inertia is that of its frames as well.
    if (has_inertial) {
      XmlElement none{.name = "inertial", .file = frame.file, .line = frame.line};
      for (const auto& [key, value] : {std::pair{"pos", "0 0 0"}, {"mass", "0"}, {"diaginertia", "0 0 0"}})
        none.set(key, value);
      frame.children.insert(frame.children.begin(), std::move(none));
    }
    return frame;
  }

  MjcfPoses poses_;
  MjcfDefaults defaults_;
  std::set<std::string> body_names_;
  int count_ = 0;
};

bool holds(const XmlElement& element, std::string_view kind) {
  bool found = false;
  element.visit([&](const XmlElement& part) { found = found || part.name == kind; });
  return found;
}

/// The sections of the world, of which there may be several.
std::vector<XmlElement*> worlds(XmlElement& root) {
  std::vector<XmlElement*> all;
  for (XmlElement& section : root.children)
    if (section.name == "worldbody") all.push_back(&section);
  return all;
}

/// Whether it moves on hinges or slides of its own.
bool is_limb(const XmlElement& body) {
  return body.name == "body" && std::ranges::any_of(body.children, [](const XmlElement& child) {
           return child.name == "joint" && !is_one_of(child.attribute_or("type", "hinge"), {"free", "ball"});
         });
}

/// Names bodies; `given`: joints that the author named.
class BodyNamer {
 public:
  BodyNamer(std::set<std::string> given, std::set<std::string> taken)
      : given_(std::move(given)), taken_(std::move(taken)) {}

  void name_in(XmlElement& parent) {
    int number = 0;
    for (XmlElement& child : parent.children) {
      if (child.name != "body") continue;
      ++number;
      if (child.attribute_or("name", "").empty()) {
        child.set("name", free_name(taken_, name_of(child, parent, number)));
        named_.push_back(child.attribute_or("name", ""));
      }
      name_in(child);
    }
  }

  const std::vector<std::string>& named() const { return named_; }

 private:
  std::string name_of(const XmlElement& body, const XmlElement& parent, int number) const {
    if (parent.name == "worldbody") return holds(body, "joint") || holds(body, "freejoint") ? "root" : "body";
    for (const XmlElement& child : body.children)
      if (std::string joint = child.attribute_or("name", ""); child.name == "joint" && given_.contains(joint))
        return joint;
    return fmt::format("{}_{}", parent.attribute_or("name", ""), number);
  }

  std::set<std::string> given_, taken_;
  std::vector<std::string> named_;
};

void name_joints_of(XmlElement& body, bool is_root, std::set<std::string>& names,
                    std::vector<std::string>& named) {
  for (XmlElement& child : body.children) {
    if (child.name == "body") name_joints_of(child, body.name == "worldbody", names, named);
    const bool nameless = child.name == "joint" && child.attribute_or("name", "").empty();
    if (!nameless || is_root || body.name == "worldbody") continue;
    const std::string of = body.attribute_or("name", "");
    child.set("name", free_name(names, of.empty() ? "joint" : of));
    named.push_back(child.attribute_or("name", ""));
  }
}

}  // namespace

std::string free_name(std::set<std::string>& taken, const std::string& name) {
  if (taken.insert(name).second) return name;
  for (int k = 1;; ++k)
    if (std::string next = fmt::format("{}.{}", name, k); taken.insert(next).second) return next;
}

void resolve_frames(XmlElement& root, ReadingNotes& notes) {
  bool any = false;
  for (const XmlElement& section : root.children)
    any = any || (section.name == "worldbody" && holds(section, "frame"));
  if (!any) return;
  const XmlElement original = root;  // whose defaults are looked up meanwhile
  FrameResolver resolver(original);
  int count = 0;
  for (XmlElement* world : worlds(root)) count = resolver.resolve(*world);
  notes.add(Reading::replaced, fmt::format("{} <frame>: what is in them is moved as they say", count));
}

void wrap_fused_root(XmlElement& root, ReadingNotes& notes) {
  const std::vector<XmlElement*> all = worlds(root);
  if (all.size() != 1) return;
  XmlElement& world = *all[0];
  const MjcfDefaults defaults(root);
  const auto is_shape = [&](const XmlElement& geom) {
    return geom.name == "geom" &&
           !is_one_of(defaults.attribute(geom, "type", "").value_or("sphere"), {"plane", "hfield"});
  };
  const auto is_body = [](const XmlElement& child) { return child.name == "body"; };
  const auto limbs = std::ranges::count_if(world.children, is_limb);
  const bool others = std::ranges::any_of(world.children, [&](const XmlElement& child) {
    return is_body(child) && !is_limb(child) && (holds(child, "joint") || holds(child, "freejoint"));
  });
  if (limbs < 2 || others || std::ranges::none_of(world.children, is_shape)) return;
  std::set<std::string> names = names_of(root, "body");
  XmlElement body{.name = "body", .file = world.file, .line = world.line};
  body.set("name", free_name(names, "root"));
  std::vector<XmlElement> rest;
  int shapes = 0;
  for (XmlElement& child : world.children) {
    const bool shape = is_shape(child),
               of_robot = shape || (is_body(child) && child.attribute_or("mocap", "") != "true");
    shapes += shape ? 1 : 0;
    (of_robot ? body.children : rest).push_back(std::move(child));
  }
  const std::string name = body.attribute_or("name", "");
  rest.push_back(std::move(body));
  world.children = std::move(rest);
  notes.add(
      Reading::replaced,
      fmt::format("the world's {} shapes and {} limbs by one body '{}' around them: its root link was fused "
                  "into the world, as MuJoCo does with a URDF unless told fusestatic=\"false\"; its mass is "
                  "that of its shapes",
                  shapes, limbs, name));
}

void name_parts(XmlElement& root, ReadingNotes& notes) {
  std::set<std::string> names = names_of(root, "joint");
  names.erase("");
  BodyNamer bodies(names, names_of(root, "body"));
  std::vector<std::string> joints;
  for (XmlElement* world : worlds(root)) {
    name_joints_of(*world, false, names, joints);
    bodies.name_in(*world);
  }
  if (!joints.empty())
    notes.add(Reading::replaced,
              fmt::format("joints without a name, by that of their body: {}", fmt::join(joints, ", ")));
  if (!bodies.named().empty())
    notes.add(Reading::replaced,
              fmt::format("bodies without a name, by that of their joint, or that of their parent and a "
                          "number: {}",
                          fmt::join(bodies.named(), ", ")));
}

}  // namespace amble::morphology
