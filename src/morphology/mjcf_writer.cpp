#include "amble/morphology/mjcf_writer.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <mujoco/mujoco.h>
#include <algorithm>
#include <cmath>
#include <iterator>
#include <set>
#include <string_view>
#include <utility>

#include "amble/core/index.hpp"
#include "amble/io/quoting.hpp"
#include "amble/morphology/model_file.hpp"

namespace amble::morphology {
namespace {

/// An angle that no joint reaches.
constexpr double no_stop_rad = 1e6;

std::string numbers(Vec3 v) {
  return fmt::format("{} {} {}", v.x, v.y, v.z);
}
std::string numbers(Quat q) {
  return fmt::format("{} {} {} {}", q.w, q.x, q.y, q.z);
}

std::string size_of(const robot::Geom& geom) {
  switch (geom.shape) {
    case robot::Shape::sphere:
      return fmt::format(R"(type="sphere" size="{}")", geom.size_m.x);
    case robot::Shape::capsule:
      return fmt::format(R"(type="capsule" size="{} {}")", geom.size_m.x, geom.size_m.y);
    case robot::Shape::cylinder:
      return fmt::format(R"(type="cylinder" size="{} {}")", geom.size_m.x, geom.size_m.y);
    case robot::Shape::box:
      return fmt::format(R"(type="box" size="{}")", numbers(geom.size_m));
    case robot::Shape::mesh:
      return R"(type="mesh")";
  }
  return {};
}

class Writer {
 public:
  Writer(const robot::RobotSpec& robot, const MjcfAdditions& additions)
      : robot_(robot), additions_(additions) {}

  Mjcf write() {
    const double friction = std::isinf(robot_.contact.friction) ? grip : robot_.contact.friction;
    line("<mujoco model=\"{}\">", io::escape_xml(robot_.name));
    line("  <compiler angle=\"radian\" inertiafromgeom=\"false\"/>");
    line("  <option gravity=\"{}\" {}/>", numbers(robot_.gravity_m_s2), additions_.option);
    line("  <default>");
    // Legs collide with the ground (contype 1), and with each other only where both attributes are set.
    line("    <geom contype=\"{}\" conaffinity=\"1\" condim=\"{}\" friction=\"{}\"/>",
         robot_.self_collision ? 1 : 0, friction > 0.0 ? 3 : 1, friction);
    line("  </default>");
    write_meshes();
    line("  <worldbody>");
    line(R"(    <geom name="ground" type="plane" size="0 0 1" contype="1" conaffinity="0"/>)");
    write_body(0, 4);
    line("  </worldbody>");
    mjcf_.text += additions_.sections;
    line("</mujoco>");
    return std::move(mjcf_);
  }

 private:
  template <typename... Args>
  void line(fmt::format_string<Args...> text, Args&&... args) {
    fmt::format_to(std::back_inserter(mjcf_.text), text, std::forward<Args>(args)...);
    mjcf_.text += '\n';
  }

  /// The attribute, if the name is one and no other part of the kind has it: MuJoCo requires unique names.
  static std::string name_attribute(std::set<std::string>& used, const std::string& name) {
    return !name.empty() && used.insert(name).second ? fmt::format("name=\"{}\" ", io::escape_xml(name)) : "";
  }

  static std::string mesh_name(int geom) { return fmt::format("mesh{}", geom); }

  void write_meshes() {
    const auto is_mesh = [](const robot::Geom& geom) { return geom.shape == robot::Shape::mesh; };
    if (std::ranges::none_of(robot_.geoms, is_mesh)) return;
    line("  <asset>");
    for (int g = 0; g < static_cast<int>(robot_.geoms.size()); ++g) {
      const robot::Geom& geom = robot_.geoms[to_index(g)];
      if (!is_mesh(geom)) continue;
      std::string vertices, faces;
      for (const Vec3 vertex : geom.vertices_m) vertices += numbers(vertex) + " ";
      for (const auto& face : geom.triangles) faces += fmt::format("{} ", fmt::join(face, " "));
      line(R"(    <mesh name="{}" vertex="{}" face="{}"/>)", mesh_name(g), vertices, faces);
    }
    line("  </asset>");
  }

  static std::string added(const std::vector<std::string>& attributes, int index) {
    return attributes.empty() ? std::string() : attributes[to_index(index)];
  }

  static std::string positive_attribute(std::string_view name, double value) {
    return value > 0.0 ? fmt::format(R"( {}="{}")", name, value) : "";
  }

  static std::string spring(const robot::Joint& joint) {
    if (joint.stiffness_nm_per_rad == 0.0) return "";
    return fmt::format(R"( stiffness="{}" springref="{}")", joint.stiffness_nm_per_rad, joint.rest_rad);
  }

  void write_body(int b, int indent) {
    const robot::Body& body = robot_.bodies[to_index(b)];
    const std::string margin(to_index(indent), ' ');
    mjcf_.bodies.push_back(b);
    line("{}<body {}pos=\"{}\" quat=\"{}\">", margin, name_attribute(body_names_, body.name),
         numbers(body.position_m), numbers(body.rotation));
    if (b == 0) line("{}  <freejoint/>", margin);
    line(R"({}  <inertial pos="{}" quat="{}" mass="{}" diaginertia="{}"/>)", margin, numbers(body.com_m),
         numbers(body.inertia_rotation), body.mass_kg, numbers(body.inertia_kg_m2));
    for (const int j : robot_.joints_of_body(b)) write_joint(j, margin);
    for (int g = 0; g < static_cast<int>(robot_.geoms.size()); ++g)
      if (robot_.geoms[to_index(g)].body == b) write_geom(g, margin);
    for (int child = b + 1; child < static_cast<int>(robot_.bodies.size()); ++child)
      if (robot_.bodies[to_index(child)].parent == b) write_body(child, indent + 2);
    line("{}</body>", margin);
  }

  void write_joint(int j, const std::string& margin) {
    const robot::Joint& joint = robot_.joints[to_index(j)];
    mjcf_.joints.push_back(j);
    std::string name = joint.name;
    for (int k = 0; name.empty() || !joint_names_.insert(name).second; ++k)
      name = fmt::format("{}.{}", joint.name, j + k);
    mjcf_.joint_names.push_back(name);
    // MuJoCo has no range that is open at one end.
    const auto stop = [](double angle_rad) { return std::clamp(angle_rad, -no_stop_rad, no_stop_rad); };
    const bool limited = std::isfinite(joint.lower_rad) || std::isfinite(joint.upper_rad);
    line(R"({}  <joint name="{}" type="hinge" pos="{}" axis="{}"{}{}{}{}{}{}/>)", margin,
         io::escape_xml(name), numbers(joint.anchor_m), numbers(joint.axis),
         limited
             ? fmt::format(R"( limited="true" range="{} {}")", stop(joint.lower_rad), stop(joint.upper_rad))
             : R"( limited="false")",
         positive_attribute("armature", joint.armature_kg_m2),
         positive_attribute("damping", joint.damping_nm_s_per_rad),
         positive_attribute("frictionloss", joint.friction_loss_nm), spring(joint),
         added(additions_.joints, j));
  }

  void write_geom(int g, const std::string& margin) {
    const robot::Geom& geom = robot_.geoms[to_index(g)];
    mjcf_.geoms.push_back(g);
    const std::string mesh =
        geom.shape == robot::Shape::mesh ? fmt::format(R"( mesh="{}")", mesh_name(g)) : std::string();
    line(R"({}  <geom {}{}{} pos="{}" quat="{}" rgba="{} {} {} {}"{}{}/>)", margin,
         name_attribute(geom_names_, geom.name), size_of(geom), mesh, numbers(geom.position_m),
         numbers(geom.rotation), geom.rgba[0], geom.rgba[1], geom.rgba[2], geom.rgba[3],
         geom.collides ? "" : R"( contype="0" conaffinity="0")", added(additions_.geoms, g));
  }

  const robot::RobotSpec& robot_;
  const MjcfAdditions& additions_;
  Mjcf mjcf_;
  std::set<std::string> body_names_{"world"}, joint_names_, geom_names_{"ground"};
};

/// ODE's erp and cfm as MuJoCo's reference and impedance; the formulas are told in
/// src/physics/mujoco/model.cpp. `diagonal`: MuJoCo's estimate of an inverse inertia.
std::string softness(const robot::Contact& contact, double h, double diagonal, std::string_view kind) {
  const double d = std::clamp(diagonal / (diagonal + contact.cfm_s_per_kg / h), mjMINIMP, mjMAXIMP);
  return fmt::format(R"( solref{0}="{1} {2}" solimp{0}="{3} {3} 0.001 0.5 2")", kind,
                     -contact.erp / (h * h) * d, -d / h, d);
}

std::string actuator(const robot::Joint& joint, const std::string& name, double h) {
  const robot::Servo& servo = joint.servo;
  double kp = servo.kp_nm_per_rad, kd = servo.kd_nm_s_per_rad + kp * h;
  if (servo.mode == robot::ServoMode::velocity) {
    kd = servo.max_torque_nm / motor_slip_rad_s;
    kp = kd * servo.gain_per_s;
  }
  const robot::AngleRange range = joint.command_range();
  const std::string control = joint.driven() ? fmt::format(R"(ctrllimited="true" ctrlrange="{} {}")",
                                                           range.lower_rad, range.upper_rad)
                                             : R"(ctrllimited="false")";
  return fmt::format(
      R"(    <general name="{0}" joint="{0}" gainprm="{1}" biastype="affine" biasprm="0 {2} {3}" {4} )"
      R"(forcelimited="true" forcerange="{5} {6}"/>)"
      "\n",
      io::escape_xml(name), kp, -kp, -kd, control, -servo.max_torque_nm, servo.max_torque_nm);
}

std::string keyframe(const robot::RobotSpec& robot) {
  const robot::Body& root = robot.bodies[0];
  std::string angles, targets;
  for (const robot::Joint& joint : robot.joints) {
    const robot::AngleRange range = joint.command_range();
    angles += " 0";
    if (joint.has_motor()) targets += fmt::format("{} ", std::clamp(0.0, range.lower_rad, range.upper_rad));
  }
  if (!targets.empty()) targets.pop_back();
  return fmt::format(
      "  <keyframe>\n    <key name=\"start\" qpos=\"{} {} {} {} {} {} {}{}\" ctrl=\"{}\"/>\n"
      "  </keyframe>\n",
      root.position_m.x, root.position_m.y, root.position_m.z, root.rotation.w, root.rotation.x,
      root.rotation.y, root.rotation.z, angles, targets);
}

}  // namespace

Mjcf write_mjcf(const robot::RobotSpec& robot, const MjcfAdditions& additions) {
  return Writer(robot, additions).write();
}

std::string simulation_mjcf(const robot::RobotSpec& robot, double timestep_s) {
  const Mjcf plain = write_mjcf(robot);
  const ModelPointer model = compile_mjcf(plain.text, robot.name);
  MjcfAdditions more;
  more.option = fmt::format(
      R"(timestep="{}" integrator="implicit" solver="Newton" cone="elliptic" iterations="20" tolerance="1e-10")",
      timestep_s / steps_per_tick);
  more.joints.resize(robot.joints.size());
  more.geoms.resize(robot.geoms.size());
  std::vector<std::string> actuators(robot.joints.size());
  for (std::size_t place = 0; place < plain.joints.size(); ++place) {
    const std::size_t j = to_index(plain.joints[place]);
    const double inverse_inertia = model->dof_invweight0[model->jnt_dofadr[place + 1]];
    more.joints[j] = softness(robot.contact, timestep_s, inverse_inertia, "limit") +
                     softness(robot.contact, timestep_s, inverse_inertia, "friction");
    if (robot.joints[j].has_motor())
      actuators[j] = actuator(robot.joints[j], plain.joint_names[place], timestep_s);
  }
  for (std::size_t place = 0; place < plain.geoms.size(); ++place) {
    const double inverse_mass = model->body_invweight0[2 * model->geom_bodyid[place + 1]];
    more.geoms[to_index(plain.geoms[place])] =
        R"( priority="1")" + softness(robot.contact, timestep_s, inverse_mass, "");
  }
  more.sections = "  <actuator>\n";
  for (const std::string& line : actuators) more.sections += line;
  more.sections += "  </actuator>\n" + keyframe(robot);
  more.sections += fmt::format(
      "  <custom>\n    <numeric name=\"control_period_s\" data=\"{}\"/>\n  </custom>\n", timestep_s);
  return write_mjcf(robot, more).text;
}

}  // namespace amble::morphology
