// From the state proper to poses, sensors and touch, for each instruction set.
#if defined(AMBLE_BATCH_POSE_INL_HPP) == defined(HWY_TARGET_TOGGLE)
#ifdef AMBLE_BATCH_POSE_INL_HPP
#undef AMBLE_BATCH_POSE_INL_HPP
#else
#define AMBLE_BATCH_POSE_INL_HPP
#endif

#include <algorithm>

#include "amble/core/index.hpp"
#include "amble/physics/batch/step.hpp"
#include "amble/physics/batch/trigonometry-inl.hpp"
#include "amble/physics/batch/vector-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace amble::physics::batch::HWY_NAMESPACE {

/// As many lanes as a vector holds, from `lane` on.
struct Pass {
  const Batch& batch;
  int lane;

  const Model& model() const { return batch.model; }
  Workspace& work() const { return batch.workspace; }
  Row* row(int index) const { return batch.state + index; }
  V state(int index) const { return load1(batch.state[index], lane); }
  V3 state3(int index) const { return load3(batch.state + index, lane); }
  void set_state(int index, V v) const { store1(v, batch.state[index], lane); }
  void set_state3(int index, V3 v) const { store3(v, batch.state + index, lane); }
  float* scratch(int vector) const { return batch.workspace.memory() + vector * width; }
  const Link& link(const Chain& chain, int j) const { return batch.model.links[to_index(chain.first + j)]; }
  int pose_row(int link) const { return batch.rows.pose + Rows::pose_size * link; }
  unsigned char& geom_felt(int geom) const {
    const std::size_t first = to_index(lane / width) * batch.model.geoms.size();
    return batch.workspace.felt[first + to_index(geom)];
  }
  Mask active() const { return state(Rows::active) > zero(); }
  /// The world's axes in torso axes, as columns: takes world axes to torso axes.
  Columns world() const { return {state3(Rows::axes), state3(Rows::axes + 3), state3(Rows::axes + 6)}; }
};

HWY_INLINE void turn_pair(V3& u, V3& w, SineCosine angle) {
  const V3 before = u;
  u = fma(angle.sine, w, angle.cosine * u);
  w = fnma(angle.sine, before, angle.cosine * w);
}

/// Turns a frame by the angle of its joint; the joint's axis.
HWY_INLINE V3 turn_frame(Columns& axes, const Link& link, V angle) {
  SineCosine turned = sine_cosine(angle);
  if (link.axis == 3) {
    const Columns before = axes;
    const V3 a = set(link.direction), axis = before * a;
    const V versine = set(1.0f) - turned.cosine;
    const V3 s = turned.sine * a, part = versine * a;
    axes.x = fma(s.z, before.y, fnma(s.y, before.z, fma(part.x, axis, turned.cosine * before.x)));
    axes.y = fma(s.x, before.z, fnma(s.z, before.x, fma(part.y, axis, turned.cosine * before.y)));
    axes.z = fma(s.y, before.x, fnma(s.x, before.y, fma(part.z, axis, turned.cosine * before.z)));
    return axis;
  }
  const V sign = set(link.sign);
  turned.sine = sign * turned.sine;
  if (link.axis == 0) {
    turn_pair(axes.y, axes.z, turned);
    return sign * axes.x;
  }
  if (link.axis == 1) {
    turn_pair(axes.z, axes.x, turned);
    return sign * axes.y;
  }
  turn_pair(axes.x, axes.y, turned);
  return sign * axes.z;
}

/// Frames of a chain seen from the torso's frame; adds its first moment of mass to `moment`.
HWY_INLINE void reach_out(const Pass& pass, const Chain& chain, V3& moment) {
  const V one = set(1.0f), none = zero();
  Columns axes{{one, none, none}, {none, one, none}, {none, none, one}};
  V3 origin = zero3();
  for (int j = 0; j < chain.count; ++j) {
    const Link& link = pass.link(chain, j);
    const V3 offset = set(link.from_parent_m);
    origin = origin + (j == 0 ? offset : axes * offset);
    const V3 axis = turn_frame(axes, link, pass.state(pass.batch.rows.angle + chain.first + j));
    const int row = pass.pose_row(chain.first + j);
    pass.set_state3(row, axes.x);
    pass.set_state3(row + 3, axes.y);
    pass.set_state3(row + 6, axes.z);
    pass.set_state3(row + 9, origin);
    pass.set_state3(row + 12, axis);
    if (link.has_mass) moment = fma(set(link.body.mass_kg), origin + axes * set(link.body.com_m), moment);
  }
}

HWY_INLINE void world_axes(const Pass& pass) {
  const V w = pass.state(Rows::rotation);
  const V3 q = pass.state3(Rows::rotation + 1);
  const V one = set(1.0f), two = set(2.0f);
  const V3 d = two * q;
  const V xx = d.x * q.x, yy = d.y * q.y, zz = d.z * q.z;
  pass.set_state3(Rows::axes,
                  {one - (yy + zz), difference_of_products(d.x, q.y, d.z, w), fma(d.y, w, d.x * q.z)});
  pass.set_state3(Rows::axes + 3,
                  {fma(d.z, w, d.x * q.y), one - (xx + zz), difference_of_products(d.y, q.z, d.x, w)});
  pass.set_state3(Rows::axes + 6,
                  {difference_of_products(d.x, q.z, d.y, w), fma(d.x, w, d.y * q.z), one - (xx + yy)});
}

/// Poses of everything, from the centre of mass of the whole robot.
HWY_NOINLINE void find_pose(const Pass& pass) {
  const Model& model = pass.model();
  world_axes(pass);
  V3 moment = set(model.torso.mass_kg) * set(model.torso.com_m);
  for (const Chain& chain : model.chains) reach_out(pass, chain, moment);
  const V3 com = set(1.0f / model.mass_kg) * moment;
  pass.set_state3(Rows::origin, zero3() - com);
  for (int l = 0; l < pass.batch.rows.links; ++l) {
    const int row = pass.pose_row(l);
    const V3 origin = pass.state3(row + 9) - com;
    pass.set_state3(row + 9, origin);
    pass.set_state3(row + 15, cross(origin, pass.state3(row + 12)));
  }
}

/// The heights of all points that may touch the ground; where a foot touches.
HWY_NOINLINE void find_touch(const Pass& pass) {
  const Model& model = pass.model();
  const Mask active = pass.active();
  const V3 up = pass.state3(Rows::axes + 6);
  const V com_height = pass.state(Rows::com + 2);
  V contacts = zero();
  for (std::size_t g = 0; g < model.geoms.size(); ++g) {
    const PointGroup& geom = model.geoms[g];
    const Point& any = model.points[to_index(geom.first)];
    V3 origin = pass.state3(Rows::origin), tilt = up;
    if (any.chain >= 0) {
      const int row = pass.pose_row(model.chains[to_index(any.chain)].first + any.link);
      origin = pass.state3(row + 9);
      tilt = transposed({pass.state3(row), pass.state3(row + 3), pass.state3(row + 6)}, up);
    }
    const V height = dot(up, origin, com_height);
    const V lowest = dot(tilt, set(geom.centre_m), height) - set(geom.reach_m);
    pass.work().near[g] = !hn::AllFalse(Floats(), hn::And(active, lowest <= zero()));
    Mask touches = nowhere();
    for (int p = geom.first; pass.work().near[g] && p < geom.first + geom.count; ++p) {
      const Point& point = model.points[to_index(p)];
      const V h = dot(tilt, set(point.position_m), height) - set(point.radius_m);
      store(h, pass.scratch(pass.work().heights + p));
      touches = hn::Or(touches, h <= zero());
      contacts = contacts + hn::IfThenElseZero(h <= zero(), set(1.0f));
    }
    if (geom.leg >= 0)
      pass.set_state(pass.batch.rows.touch + geom.leg, hn::IfThenElseZero(touches, set(1.0f)));
  }
  pass.set_state(Rows::contacts, contacts);
}

/// Copies angles, attitude and touch to where controllers look for them.
HWY_NOINLINE void read_sensors(const Pass& pass) {
  const auto put = [&](V v, LaneArray& rows, int row)
                       HWY_ATTR { hn::StoreU(v, Floats(), rows.row(row) + pass.lane); };
  robot::SensorFrame& sensors = pass.batch.sensors;
  for (int l = 0; l < pass.batch.rows.links; ++l)
    put(pass.state(pass.batch.rows.angle + l), sensors.joint_angle_rad,
        pass.model().links[to_index(l)].joint);
  for (int leg = 0; leg < pass.model().legs; ++leg)
    put(pass.state(pass.batch.rows.touch + leg), sensors.touch, leg);
  // Entries of the rotation R_z(yaw) R_y(pitch) R_x(roll).
  const Columns world = pass.world();
  const V one = set(1.0f), sine = hn::Min(hn::Max(hn::Neg(world.z.x), hn::Neg(one)), one);
  put(arc_tangent(world.z.y, world.z.z), sensors.attitude_rad, 0);
  put(arc_tangent(sine, hn::Sqrt((one - sine) * (one + sine))), sensors.attitude_rad, 1);
  put(arc_tangent(world.y.x, world.x.x), sensors.attitude_rad, 2);
}

}  // namespace amble::physics::batch::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // toggled by HWY_TARGET_TOGGLE
