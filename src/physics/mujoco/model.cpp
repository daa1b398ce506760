#include "amble/physics/mujoco/model.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "amble/core/index.hpp"
#include "amble/io/quoting.hpp"
#include "amble/morphology/mjcf_writer.hpp"
#include "amble/robot/collision_points.hpp"

namespace amble::physics::mujoco {
namespace {

using robot::Geom;
using robot::RobotSpec;
using robot::Shape;

/// Gives MuJoCo's constraints the law of ODE's. ODE solves for the velocity v⁺ after the step (manual, "Soft
/// constraint and constraint force mixing")
///     v⁺ = (erp/h) depth − cfm f,
/// MuJoCo for the acceleration a (documentation, "Computation", "Constraint model": reference acceleration,
/// impedance and regularizer)
///     a = a_ref − R f,   a_ref = −b v + k depth,   v⁺ = v + h a,
/// where R = A (1 − d) / d with an impedance d < 1, A being the diagonal of J M⁻¹ Jᵀ that the compiler has
/// estimated for each body and joint (invweight0). They agree for
///     b = 1/h,   k = erp/h²,   R = cfm/h,  hence  d = A / (A + R).
class Softness {
 public:
  Softness(const robot::Contact& contact, double h)
      : damping_(1.0 / h), stiffness_(contact.erp / (h * h)), regularizer_(contact.cfm_s_per_kg / h) {}

  /// `reference` and `impedance`: MuJoCo's solref and solimp.
  void give(mjtNum* reference, mjtNum* impedance, double diagonal) const {
    const double d = std::clamp(diagonal / (diagonal + regularizer_), mjMINIMP, mjMAXIMP);
    // Negative numbers in solref are (−stiffness, −damping), which MuJoCo divides by d.
    reference[0] = -stiffness_ * d;
    reference[1] = -damping_ * d;
    impedance[0] = impedance[1] = d;  // at any depth
  }

 private:
  double damping_, stiffness_, regularizer_;
};

/// The most contacts that a geom can have with the plane.
int max_plane_contacts(const Geom& geom) {
  switch (geom.shape) {
    case Shape::sphere:
      return 1;
    case Shape::capsule:
      return 2;
    case Shape::cylinder:
    case Shape::box:
    case Shape::mesh:
      return 4;
  }
  return 0;
}

/// Adds the sizes of the contact and constraint arrays (those that the compiler would choose cost time
/// whenever a trial starts), and dry friction of joints: as friction of a tendon along each, because that of
/// the joint itself is its servo (set_joints()).
std::string completed(const morphology::Mjcf& mjcf, const RobotSpec& robot) {
  constexpr int between_legs = 64, limit = 512;
  int contacts = robot.self_collision ? between_legs : 0;
  for (const Geom& geom : robot.geoms) {
    const int on_uneven_ground = static_cast<int>(robot::collision_points(geom).size());
    contacts += geom.collides ? std::max(max_plane_contacts(geom), on_uneven_ground) : 0;
  }
  contacts = std::clamp(contacts, 1, limit);
  std::string tendons;
  for (std::size_t place = 0; place < mjcf.joints.size(); ++place) {
    const double friction_nm = robot.joints[to_index(mjcf.joints[place])].friction_loss_nm;
    if (friction_nm > 0.0)
      tendons += fmt::format(R"(<fixed name="{0}" frictionloss="{1}"><joint joint="{0}" coef="1"/></fixed>)",
                             io::escape_xml(mjcf.joint_names[place]), friction_nm);
  }
  const int rows = 3 * static_cast<int>(robot.joints.size()) + 3 * contacts;
  std::string text = mjcf.text;
  if (!tendons.empty()) text.insert(text.find("</mujoco>"), "  <tendon>" + tendons + "</tendon>\n");
  text.insert(text.find("</mujoco>"), fmt::format("  <size nconmax=\"{}\" njmax=\"{}\"/>\n", contacts, rows));
  return text;
}

void set_options(mjOption& option, double timestep_s) {
  option.timestep = timestep_s;
  option.integrator = mjINT_EULER;
  option.solver = mjSOL_NEWTON;
  option.cone = mjCONE_ELLIPTIC;
  option.impratio = 1.0;
  option.iterations = 20;
  option.tolerance = 1e-10;
  option.disableflags |= mjDSBL_PASSIVE | mjDSBL_ACTUATION | mjDSBL_SENSOR;
}

/// The limit of its servo's torque. A spring has none: a number that MuJoCo can compute with.
double largest_torque_nm(const robot::Joint& joint) {
  constexpr double without_limit_nm = 1e9;
  if (joint.has_motor()) return joint.servo.max_torque_nm;
  return joint.stiffness_nm_per_rad > 0.0 ? without_limit_nm : 0.0;
}

void set_joints(const RobotSpec& robot, const Softness& softness, double timestep_s, Model& model) {
  const mjModel& m = *model.mujoco;
  for (int j = 0; j < static_cast<int>(robot.joints.size()); ++j) {
    const int dof = model.dof_of[to_index(j)], id = m.dof_jntid[dof];
    const robot::Joint& joint = robot.joints[to_index(j)];
    const double diagonal = m.dof_invweight0[dof];
    softness.give(m.jnt_solref + mjNREF * id, m.jnt_solimp + mjNIMP * id, diagonal);
    softness.give(m.dof_solref + mjNREF * dof, m.dof_solimp + mjNIMP * dof, diagonal);
    // A servo is dry friction |τ| ≤ frictionloss, which by itself aims at speed 0; MujocoEngine::drive()
    // moves that to the servo's speed.
    m.dof_frictionloss[dof] = largest_torque_nm(joint);
    // Damping at the speed after the step, in all constraints: (M + h D) q̈ = … − D q̇.
    m.dof_armature[dof] += timestep_s * joint.damping_nm_s_per_rad;
    m.dof_damping[dof] = 0.0;
  }
  for (int t = 0; t < m.ntendon; ++t)
    softness.give(m.tendon_solref_fri + mjNREF * t, m.tendon_solimp_fri + mjNIMP * t, m.tendon_invweight0[t]);
}

void set_geoms(const Softness& softness, const mjModel& m) {
  for (int g = 1; g < m.ngeom; ++g) {
    const double diagonal = m.body_invweight0[2 * m.geom_bodyid[g]];
    softness.give(m.geom_solref + mjNREF * g, m.geom_solimp + mjNIMP * g, diagonal);
    m.geom_priority[g] = 1;  // its parameters, not the ground's
  }
}

}  // namespace

Model make_model(const RobotSpec& robot, double timestep_s) {
  const auto mjcf = morphology::write_mjcf(robot);
  Model model{.mujoco = morphology::compile_mjcf(completed(mjcf, robot), "the mujoco engine"),
              .position_of = std::vector<int>(robot.joints.size()),
              .dof_of = std::vector<int>(robot.joints.size()),
              .joint_of = {},
              .leg_of = {},
              .geom_of = {}};
  mjModel& m = *model.mujoco;
  model.joint_of.assign(to_index(m.nv), -1);
  model.leg_of.assign(to_index(m.ngeom), -1);
  model.geom_of.assign(to_index(m.ngeom), -1);
  for (std::size_t place = 0; place < mjcf.joints.size(); ++place) {
    const int j = mjcf.joints[place];
    model.position_of[to_index(j)] = m.jnt_qposadr[place + 1];
    model.dof_of[to_index(j)] = m.jnt_dofadr[place + 1];
    model.joint_of[to_index(model.dof_of[to_index(j)])] = j;
  }
  for (std::size_t place = 0; place < mjcf.geoms.size(); ++place) {
    model.geom_of[place + 1] = mjcf.geoms[place];
    for (int l = 0; l < static_cast<int>(robot.legs.size()); ++l)
      if (robot.legs[to_index(l)].has_foot_geom(mjcf.geoms[place])) model.leg_of[place + 1] = l;
  }
  set_options(m.opt, timestep_s);
  const Softness softness(robot.contact, timestep_s);
  set_joints(robot, softness, timestep_s, model);
  set_geoms(softness, m);
  return model;
}

}  // namespace amble::physics::mujoco
