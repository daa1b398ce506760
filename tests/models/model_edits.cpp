#include "tests/models/model_edits.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <utility>

namespace amble::tests {
namespace {

using morphology::XmlElement;

std::string described(const XmlElement& element) {
  return fmt::format("<{} {}>", element.name,
                     element.attribute_or("name", "of line " + std::to_string(element.line)));
}

XmlElement parsed(const std::string& text) {
  return morphology::parse_xml(text, "part");
}

}  // namespace

std::vector<XmlElement*> ModelEditor::elements(Element& root, const std::string& name) {
  std::vector<Element*> found;
  root.visit([&](Element& element, Element* parent) {
    if (parent != nullptr && (name.empty() || element.name == name)) found.push_back(&element);
  });
  return found;
}

std::vector<std::string> ModelEditor::names(Element& root, const std::string& element) {
  std::vector<std::string> found;
  for (const Element* each : elements(root, element))
    if (auto name = each->attribute("name")) found.push_back(*name);
  if (found.empty()) found.push_back("none");
  return found;
}

void ModelEditor::edit(Element& root) {
  for (std::size_t left = 1 + below(3); left > 0; --left) edit_once(root);
}

void ModelEditor::edit_once(Element& root) {
  const bool urdf = root.name == "robot";
  switch (below(12)) {
    case 0:
    case 1:
      return change_number(root);
    case 2:
      return change_word(root);
    case 3:
      return remove_attribute(root);
    case 4:
      return remove_element(root);
    case 5:
      return double_element(root);
    case 6:
      return urdf ? add_to_urdf(root) : move_body(root);
    case 7:
      return urdf ? add_to_urdf(root) : wrap_in_frame(root);
    case 8:
    case 9:
      return urdf ? add_to_urdf(root) : add_to_body(root);
    default:
      return urdf ? add_to_urdf(root) : add_section(root);
  }
}

void ModelEditor::change_number(Element& root) {
  const auto all = elements(root);
  if (all.empty()) return;
  Element& element = *any_of(all);
  if (element.attributes.empty()) return;
  auto& [key, value] = element.attributes[below(element.attributes.size())];
  char* end = nullptr;
  const double number = std::strtod(value.c_str(), &end);
  if (end == value.c_str()) return;
  const std::vector<double> factors{0.0, -1.0, 0.001, 1000.0, 1e-12, 1e30, 0.5, 2.0};
  const std::string before = value;
  const std::string rest = end;
  switch (below(10)) {
    case 0:
      value = "nan" + rest;
      break;
    case 1:
      value = rest;
      break;  // one number too few
    case 2:
      value = "1 " + value;
      break;  // one too many
    default:
      value = fmt::format("{}{}", number * any_of(factors), rest);
  }
  did(fmt::format("{} {}='{}' becomes '{}'", described(element), key, before, value));
}

void ModelEditor::change_word(Element& root) {
  static const std::vector<std::string> words{
      "",         "sphere",     "capsule",  "box",    "cylinder",  "ellipsoid", "mesh", "plane",
      "hinge",    "slide",      "ball",     "free",   "true",      "false",     "none", "fixed",
      "revolute", "continuous", "floating", "planar", "prismatic", "a b",       "Ä",    "../up"};
  std::vector<Element*> worded;
  for (Element* element : elements(root))
    if (element->attribute("type") || element->attribute("name") || element->attribute("link"))
      worded.push_back(element);
  if (worded.empty()) return;
  Element& element = *any_of(worded);
  const std::string key = element.attribute("type") && below(2) == 0 ? "type"
                          : element.attribute("name")                ? "name"
                                                                     : "link";
  const std::string& word = any_of(words);
  did(fmt::format("{} {} becomes '{}'", described(element), key, word));
  element.remove_attribute(key);
  element.set(key, word);
}

void ModelEditor::remove_attribute(Element& root) {
  const auto all = elements(root);
  if (all.empty()) return;
  Element& element = *any_of(all);
  if (element.attributes.empty()) return;
  const std::string key = element.attributes[below(element.attributes.size())].first;
  did(fmt::format("{} loses {}", described(element), key));
  element.remove_attribute(key);
}

void ModelEditor::remove_element(Element& root) {
  const auto all = elements(root);
  if (all.empty()) return;
  const Element* unwanted = any_of(all);
  did("without " + described(*unwanted));
  root.prune([&](const Element& element, const Element&) { return &element == unwanted; });
}

void ModelEditor::double_element(Element& root) {
  const auto all = elements(root);
  if (all.empty()) return;
  const Element* original = any_of(all);
  Element copy = *original;
  const bool renamed = below(3) > 0;
  if (renamed)
    for (Element* part : elements(copy))
      if (auto name = part->attribute("name")) {
        part->remove_attribute("name");
        part->set("name", *name + "_2");
      }
  if (auto name = copy.attribute("name"); name && renamed) {
    copy.remove_attribute("name");
    copy.set("name", *name + "_2");
  }
  did(fmt::format("{} twice{}", described(*original), renamed ? ", the second renamed" : ""));
  root.visit([&](Element& parent, Element*) {
    for (std::size_t c = 0; c < parent.children.size(); ++c)
      if (&parent.children[c] == original) {
        parent.children.insert(parent.children.begin() + static_cast<std::ptrdiff_t>(c) + 1, std::move(copy));
        return;
      }
  });
}

void ModelEditor::move_body(Element& root) {
  const auto bodies = elements(root, "body");
  if (bodies.size() < 2) return;
  const Element* moved = any_of(bodies);
  Element copy = *moved;
  Element* target = any_of(bodies);
  bool inside = false;
  moved->visit([&](const Element& part) { inside = inside || &part == target; });
  if (inside) return;
  did(fmt::format("{} moves into {}", described(*moved), described(*target)));
  const std::string target_name = target->attribute_or("name", "");
  root.prune([&](const Element& element, const Element&) { return &element == moved; });
  for (Element* body : elements(root, "body"))
    if (body->attribute_or("name", "") == target_name) {
      body->children.push_back(std::move(copy));
      return;
    }
}

void ModelEditor::wrap_in_frame(Element& root) {
  const auto bodies = elements(root, "body");
  if (bodies.empty()) return;
  Element& body = *any_of(bodies);
  if (body.children.empty()) return;
  Element& child = body.children[below(body.children.size())];
  if (child.name == "inertial" || child.name == "freejoint") return;
  did("a frame around " + described(child));
  Element frame = parsed(below(2) == 0 ? R"(<frame pos="0.01 0 0"/>)" : R"(<frame euler="0 0 10"/>)");
  frame.children.push_back(child);
  child = std::move(frame);
}

void ModelEditor::add_to_body(Element& root) {
  static const std::vector<std::string> parts{
      R"(<joint type="hinge" axis="0 1 0" range="-10 10"/>)",
      R"(<joint name="added_slide" type="slide" axis="0 0 1" range="0 0.1"/>)",
      R"(<joint name="added_ball" type="ball"/>)",
      R"(<joint name="added_spring" axis="0 1 0" range="-5 5" stiffness="20" damping="0.1"/>)",
      R"(<site name="added_site"/>)",
      R"(<camera name="added_camera"/>)",
      R"(<light name="added_light"/>)",
      R"(<geom name="added_look" type="box" size="0.01 0.01 0.01" contype="0" conaffinity="0" mass="0"/>)",
      R"(<geom name="added_ellipsoid" type="ellipsoid" size="0.02 0.03 0.04" mass="0.1"/>)",
      R"(<geom name="added_plane" type="plane" size="1 1 1"/>)",
      R"(<geom name="added_mesh" type="mesh" mesh="missing"/>)",
      R"(<inertial pos="0 0 0" mass="0.5" diaginertia="0.001 0.001 0.001"/>)",
      R"(<inertial pos="0 0 0" mass="0.5" diaginertia="0.001 0.001 0.1"/>)",
      R"(<body name="added_empty" pos="0 0 0.01"/>)",
      R"(<body name="added_arm" pos="0 0 0.05"><joint name="added_arm_joint" axis="0 0 1" range="-30 30"/><geom name="added_arm_geom" size="0.02" mass="0.05"/></body>)",
      R"(<body name="added_bare"><joint name="added_bare_joint" axis="0 1 0"/></body>)",
      R"(<body mocap="true" name="added_mocap"><geom size="0.01"/></body>)",
      R"(<composite type="rope" count="3 1 1"/>)",
      R"(<plugin plugin="some.thing"/>)",
      R"(<unknown/>)"};
  auto bodies = elements(root, "body");
  for (Element* world : elements(root, "worldbody")) bodies.push_back(world);
  if (bodies.empty()) return;
  Element& body = *any_of(bodies);
  const std::string& part = any_of(parts);
  did(fmt::format("{} gets {}", described(body), part));
  body.children.push_back(parsed(part));
}

void ModelEditor::add_section(Element& root) {
  const auto joint = [&] { return any_of(names(root, "joint")); };
  const auto body = [&] { return any_of(names(root, "body")); };
  const auto geom = [&] { return any_of(names(root, "geom")); };
  const std::string a = joint(), b = joint(), one = body(), other = body();
  const std::vector<std::string> sections{
      fmt::format(R"(<equality><joint name="added_couple" joint1="{}" joint2="{}"/></equality>)", a, b),
      fmt::format(R"(<equality><joint joint1="{}" polycoef="0.1 0 0 0 0"/></equality>)", a),
      fmt::format(
          R"(<equality><connect name="added_connect" body1="{}" body2="{}" anchor="0 0 0"/></equality>)", one,
          other),
      fmt::format(R"(<equality><weld body1="{}" body2="{}" active="false"/></equality>)", one, other),
      fmt::format(
          R"(<tendon><fixed name="added_tendon" stiffness="3"><joint joint="{}" coef="1"/><joint joint="{}" coef="-1"/></fixed></tendon>)",
          a, b),
      fmt::format(R"(<tendon><fixed name="added_measure"><joint joint="{}" coef="1"/></fixed></tendon>)", a),
      fmt::format(R"(<actuator><motor name="added_motor" joint="{}" gear="3"/></actuator>)", a),
      fmt::format(R"(<actuator><position joint="{}" kp="20"/></actuator>)", a),
      fmt::format(R"(<actuator><velocity joint="{}" kv="2"/></actuator>)", a),
      fmt::format(R"(<actuator><adhesion body="{}" ctrlrange="0 1"/></actuator>)", one),
      fmt::format(
          R"(<actuator><general joint="{}" gaintype="fixed" biastype="affine" gainprm="20" biasprm="0 -20 -1"/></actuator>)",
          a),
      fmt::format(R"(<contact><exclude body1="{}" body2="{}"/></contact>)", one, other),
      fmt::format(R"(<contact><pair geom1="{}" geom2="floor"/></contact>)", geom()),
      fmt::format(R"(<sensor><jointpos joint="{}"/></sensor>)", a),
      R"(<sensor><touch site="gone"/></sensor>)",
      R"(<keyframe><key name="added_key" qpos="0 0 1"/></keyframe>)",
      R"(<custom><numeric name="n" data="1"/></custom>)",
      R"(<option timestep="0.001" gravity="0 0 -3.7"/>)",
      R"(<option density="1.2" viscosity="0.00002"/>)",
      R"(<compiler angle="radian"/>)",
      R"(<compiler coordinate="local" inertiafromgeom="true"/>)",
      R"(<default><geom contype="0" conaffinity="0"/></default>)",
      R"(<default><joint damping="0.5" armature="0.01"/></default>)",
      R"(<size nconmax="50"/>)",
      R"(<asset><mesh name="missing" file="missing.stl"/></asset>)",
      R"(<asset><texture type="skybox" builtin="gradient" width="1" height="6"/></asset>)",
      R"(<include file="missing.xml"/>)",
      R"(<statistic extent="1"/>)"};
  const std::string& section = any_of(sections);
  did("gets " + section);
  root.children.push_back(parsed(section));
}

void ModelEditor::add_to_urdf(Element& root) {
  const auto links = elements(root, "link"), joints = elements(root, "joint");
  if (links.empty() || joints.empty()) return;
  Element& link = *any_of(links);
  Element& joint = *any_of(joints);
  const std::string link_name = link.attribute_or("name", "none"),
                    joint_name = joint.attribute_or("name", "none");
  const std::vector<std::string> in_link{
      R"(<visual><geometry><box size="0.1 0.1 0"/></geometry></visual>)",
      R"(<visual><geometry><mesh filename="package://gone/look.dae"/></geometry></visual>)",
      R"(<collision name="added_hull"><geometry><mesh filename="gone.stl"/></geometry></collision>)",
      R"(<collision><origin xyz="0 0 0.01"/><geometry><sphere radius="0.01"/></geometry></collision>)",
      R"(<collision><geometry><capsule radius="0.01" length="0.1"/></geometry></collision>)",
      R"(<inertial><mass value="0.1"/><inertia ixx="1" iyy="1" izz="1" ixy="0" ixz="0" iyz="0"/></inertial>)"};
  const std::vector<std::string> in_joint{
      R"(<safety_controller k_velocity="1"/>)", R"(<calibration rising="0"/>)",
      fmt::format(R"(<mimic joint="{}" multiplier="-1"/>)", any_of(names(root, "joint"))),
      R"(<limit lower="0" upper="0" effort="0" velocity="0"/>)",
      R"(<limit lower="1" upper="-1" effort="5" velocity="0.1"/>)"};
  const std::vector<std::string> in_root{
      fmt::format(R"(<transmission name="t"><joint name="{}"/><actuator name="m"/></transmission>)",
                  joint_name),
      fmt::format(R"(<gazebo reference="{}"><mu1>0.2</mu1></gazebo>)", link_name),
      R"(<material name="red"><color rgba="1 0 0 1"/></material>)", R"(<unknown/>)",
      R"(<mujoco><compiler strippath="true"/></mujoco>)"};
  switch (below(4)) {
    case 0: {
      const std::string& part = any_of(in_link);
      did(fmt::format("link {} gets {}", link_name, part));
      link.children.push_back(parsed(part));
      return;
    }
    case 1: {
      const std::string& part = any_of(in_joint);
      did(fmt::format("joint {} gets {}", joint_name, part));
      joint.children.push_back(parsed(part));
      return;
    }
    case 2: {
      const std::string& part = any_of(in_root);
      did("gets " + part);
      root.children.push_back(parsed(part));
      return;
    }
    default: {
      static const std::vector<std::string> types{"fixed",     "revolute", "continuous",
                                                  "prismatic", "floating", "planar"};
      const std::string& type = any_of(types);
      did(fmt::format("a bare link by a {} joint at {}", type, link_name));
      root.children.push_back(parsed(R"(<link name="added_link"/>)"));
      root.children.push_back(parsed(fmt::format(
          R"(<joint name="added_joint" type="{}"><parent link="{}"/><child link="added_link"/><axis xyz="0 1 0"/><limit lower="-1" upper="1" effort="1" velocity="5"/></joint>)",
          type, link_name)));
    }
  }
}

}  // namespace amble::tests
