#include "amble/robot/check.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <string_view>
#include <utility>

#include "amble/core/check.hpp"
#include "amble/core/index.hpp"

namespace amble::robot {
namespace {

bool finite(Vec3 v) {
  return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

bool unit(Quat q) {
  return std::abs(q.w * q.w + q.x * q.x + q.y * q.y + q.z * q.z - 1.0) < 1e-6;
}

class Checker {
 public:
  Checker(const RobotSpec& robot, const std::function<void(const std::string&)>& report)
      : robot_(robot), report_(report) {}

  void check() const {
    if (robot_.bodies.empty()) bad("the robot has no body");
    for (const Joint& joint : robot_.joints) check_joint(joint);
    for (int b = 0; b < count(robot_.bodies); ++b) check_body(b);
    for (const Geom& geom : robot_.geoms) check_geom(geom);
    check_legs();
    check_contact();
    if (!finite(robot_.gravity_m_s2)) bad("gravity must be finite");
    if (!std::isfinite(robot_.fall_height_m)) bad("fall_height_m must be finite");
    if (!(robot_.fall_above_m > robot_.fall_height_m)) bad("fall_above_m must be above fall_height_m");
    if (!(robot_.fall_tilt_rad > 0.0)) bad("fall_tilt_rad must be positive");
  }

 private:
  template <typename T>
  static int count(const std::vector<T>& items) {
    return static_cast<int>(items.size());
  }

  template <typename... Args>
  void bad(fmt::format_string<Args...> text, Args&&... args) const {
    report_(fmt::format(text, std::forward<Args>(args)...));
    AMBLE_CHECK(false, "report must throw");
  }

  void need(bool good, std::string_view kind, const std::string& name, std::string_view problem) const {
    if (!good) bad("{} '{}' {}", kind, name, problem);
  }

  void check_body(int b) const {
    const Body& body = robot_.bodies[to_index(b)];
    const Vec3 moments = body.inertia_kg_m2;
    const auto must = [&](bool good, std::string_view problem) { need(good, "body", body.name, problem); };
    must(b == 0 ? body.parent == -1 : body.parent >= 0 && body.parent < b, "must come after its parent");
    must(finite(body.position_m) && unit(body.rotation), "must have a finite position and a unit rotation");
    must(std::isfinite(body.mass_kg) && body.mass_kg > 0.0, "must have a positive mass");
    must(finite(body.com_m) && unit(body.inertia_rotation),
         "must have a finite centre of mass and unit principal axes");
    must(finite(moments) && moments.x > 0.0 && moments.y > 0.0 && moments.z > 0.0,
         "must have positive moments of inertia");
    must(b == 0 || !robot_.joints_of_body(b).empty(), "is not moved by any joint");
  }

  void check_geom(const Geom& geom) const {
    const auto must = [&](bool good, std::string_view problem) { need(good, "geom", geom.name, problem); };
    const Vec3 size = geom.size_m;
    must(geom.body >= 0 && geom.body < count(robot_.bodies), "names a body that is not there");
    must(finite(geom.position_m) && unit(geom.rotation), "must have a finite position and a unit rotation");
    must(finite(size) && size.x > 0.0, "must have a positive size");
    const bool round = geom.shape == Shape::sphere || geom.shape == Shape::mesh;
    must(round || size.y > 0.0, "must have a positive length");
    must(geom.shape != Shape::box || size.z > 0.0, "must have a positive height");
    if (geom.shape == Shape::mesh) check_mesh(geom);
  }

  void check_mesh(const Geom& geom) const {
    const auto must = [&](bool good, std::string_view problem) { need(good, "geom", geom.name, problem); };
    must(geom.vertices_m.size() >= 4 && geom.triangles.size() >= 4, "must have at least four corners");
    for (const Vec3 vertex : geom.vertices_m)
      must(finite(vertex) && norm(vertex) <= geom.size_m.x, "must have its vertices within its radius");
    for (const auto& triangle : geom.triangles)
      for (const int corner : triangle)
        must(corner >= 0 && corner < count(geom.vertices_m),
             "has a triangle with a corner that is not there");
  }

  void check_joint(const Joint& joint) const {
    const auto must = [&](bool good, std::string_view problem) { need(good, "joint", joint.name, problem); };
    must(joint.body > 0 && joint.body < count(robot_.bodies), "names a body that is not there, or the root");
    must(finite(joint.anchor_m), "must have a finite anchor");
    must(finite(joint.axis) && std::abs(norm(joint.axis) - 1.0) < 1e-6, "must have an axis of length 1");
    must(joint.lower_rad < joint.upper_rad, "must have a lower stop below its upper stop");
    const AngleRange command = joint.command_range();
    must(std::isfinite(command.lower_rad) && std::isfinite(command.upper_rad),
         "has no stops, so it needs a range of command");
    must(command.lower_rad <= command.upper_rad &&
             (joint.servo.hold_torque ||
              (joint.lower_rad <= command.lower_rad && command.upper_rad <= joint.upper_rad)),
         "must have a range of command within its stops");
    if (!(joint.lower_rad <= 0.0 && joint.upper_rad >= 0.0)) {
      bad("joint '{}': the start pose, angle 0, lies outside its range {} … {} rad", joint.name,
          joint.lower_rad, joint.upper_rad);
    }
    const Servo& servo = joint.servo;
    for (const double number :
         {servo.gain_per_s, servo.max_torque_nm, servo.kp_nm_per_rad, servo.kd_nm_s_per_rad}) {
      must(std::isfinite(number) && number >= 0.0,
           "must have servo numbers that are finite and not negative");
      must(joint.has_motor() || number == 0.0, "has no motor, so the numbers of its servo must be 0");
    }
    must(std::isfinite(joint.stiffness_nm_per_rad) && joint.stiffness_nm_per_rad >= 0.0 &&
             std::isfinite(joint.rest_rad),
         "must have a spring with a finite stiffness, not negative, and a finite angle at rest");
    must(!joint.has_motor() || (joint.stiffness_nm_per_rad == 0.0 && joint.rest_rad == 0.0),
         "has a motor, so it cannot have a spring");
    for (const double number : {joint.armature_kg_m2, joint.damping_nm_s_per_rad, joint.friction_loss_nm})
      must(std::isfinite(number) && number >= 0.0,
           "must have armature, damping and friction loss that are finite and not negative");
  }

  void check_legs() const {
    int next = 0;  // joint in control order
    for (const Leg& leg : robot_.legs) check_leg(leg, next);
    for (; next < count(robot_.joints); ++next) {
      const Joint& joint = robot_.joints[to_index(next)];
      need(!joint.driven(), "joint", joint.name, "belongs to no leg, so it cannot be driven");
    }
  }

  void check_leg(const Leg& leg, int& next) const {
    const auto must = [&](bool good, std::string_view problem) { need(good, "leg", leg.name, problem); };
    must(!leg.foot_geoms.empty(), "has a foot without shapes");
    for (const int geom : leg.foot_geoms) {
      must(geom >= 0 && geom < count(robot_.geoms), "names a foot that is not there");
      must(robot_.geoms[to_index(geom)].collides, "has a foot that cannot collide");
      must(std::ranges::count(leg.foot_geoms, geom) == 1, "names a shape of its foot twice");
    }
    must(leg.joints.size() == robot_.joint_types.size(), "must have a joint, or none, for each joint type");
    for (const int joint : leg.joints) {
      if (joint == -1) continue;
      must(joint == next && next < count(robot_.joints), "has joints out of control order");
      must(robot_.joints[to_index(next)].has_motor(), "has a joint without a motor among those it commands");
      ++next;
    }
    for (const int geom : leg.foot_geoms) {
      const Geom& foot = robot_.geoms[to_index(geom)];
      if (!leg.joints.empty() && !moves(leg, foot.body))
        bad("leg '{}': its foot '{}' is on body '{}', which none of its joints moves", leg.name, foot.name,
            robot_.bodies[to_index(foot.body)].name);
    }
  }

  /// Whether a joint of the leg is the last before this body that is driven; held and passive joints of no
  /// leg may follow it.
  bool moves(const Leg& leg, int body) const {
    for (; body > 0; body = robot_.bodies[to_index(body)].parent) {
      bool driven = false;
      for (const int joint : robot_.joints_of_body(body)) {
        if (std::ranges::find(leg.joints, joint) != leg.joints.end()) return true;
        driven = driven || robot_.joints[to_index(joint)].driven();
      }
      if (driven) return false;
    }
    return false;
  }

  void check_contact() const {
    const Contact& contact = robot_.contact;
    if (!(contact.friction >= 0.0)) bad("contact.friction must not be negative");
    if (!(contact.erp > 0.0 && contact.erp <= 1.0)) bad("contact.erp must be in (0, 1], not {}", contact.erp);
    if (!(std::isfinite(contact.cfm_s_per_kg) && contact.cfm_s_per_kg >= 0.0)) {
      bad("contact.cfm_s_per_kg must be finite and not negative");
    }
    if (contact.sweeps < 0 || contact.sweeps > most_sweeps)
      bad("contact.sweeps must be in [0, {}], not {}", most_sweeps, contact.sweeps);
  }

  const RobotSpec& robot_;
  const std::function<void(const std::string&)>& report_;
};

}  // namespace

void check_robot(const RobotSpec& robot, const std::function<void(const std::string&)>& report) {
  Checker(robot, report).check();
}

std::string gravity_fault(Vec3 gravity_m_s2) {
  const double size = norm(gravity_m_s2);
  const std::string is = fmt::format("gravity is ({:.4g}, {:.4g}, {:.4g}) m/s2", gravity_m_s2.x + 0.0,
                                     gravity_m_s2.y + 0.0, gravity_m_s2.z + 0.0);
  constexpr const char* down = "(MJCF: <option gravity=\"0 0 -9.81\"/>)";
  if (!(size > 0.0)) return fmt::format("{}: nothing walks without; expected it along -z {}", is, down);
  constexpr double cosine_of_30_degrees = 0.8660254037844386;
  if (gravity_m_s2.z <= -cosine_of_30_degrees * size) return {};
  if (gravity_m_s2.z >= cosine_of_30_degrees * size)
    return fmt::format("{}: it points up; expected it along -z {}", is, down);
  const bool y_up = std::abs(gravity_m_s2.y) > std::abs(gravity_m_s2.x);
  const double up = y_up ? -gravity_m_s2.y : -gravity_m_s2.x;
  // By which +90 or −90 degrees the model's up becomes z: about x from y, about y from x.
  return fmt::format(
      "{}: the model has {}{} up, while the ground here is z = 0; expected gravity along -z {}, and the root "
      "body "
      "turned by {} degrees about {}, which is added to its euler if that has no other part",
      is, up > 0.0 ? "+" : "-", y_up ? 'y' : 'x', down, (up > 0.0) == y_up ? "90" : "-90", y_up ? 'x' : 'y');
}

}  // namespace amble::robot
