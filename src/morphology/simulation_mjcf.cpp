#include "amble/morphology/simulation_mjcf.hpp"

#include <fmt/format.h>
#include <mujoco/mujoco.h>

#include <algorithm>

#include "amble/core/index.hpp"
#include "amble/io/xml.hpp"
#include "amble/morphology/mjcf_writer.hpp"
#include "amble/morphology/model_file.hpp"

namespace amble::morphology {
namespace {

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
