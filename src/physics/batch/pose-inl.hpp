// Forward kinematics, contact detection and sensors, from the state of the robots; for each instruction set.
#if defined(AMBLE_BATCH_POSE_INL_HPP) == defined(HWY_TARGET_TOGGLE)
#ifdef AMBLE_BATCH_POSE_INL_HPP
#undef AMBLE_BATCH_POSE_INL_HPP
#else
#define AMBLE_BATCH_POSE_INL_HPP
#endif

#include <algorithm>

#include "amble/core/index.hpp"
#include "amble/ground/height_field.hpp"
#include "amble/physics/batch/step.hpp"
#include "amble/physics/batch/trigonometry-inl.hpp"
#include "amble/physics/batch/vector-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace amble::physics::batch::HWY_NAMESPACE {

/// One pass of a step: as many lanes as a vector holds, from `lane` on. Functions that are not inlined take
/// it by value: what is reached through a pointer the compiler reads again after each store of a vector,
/// which may change anything as far as it knows.
struct Pass {
  Pass(const StepArguments& step, int first_lane)
      : arguments(step),
        lane(first_lane),
        model_(step.model),
        work_(step.workspace),
        rows_(step.rows),
        state_(step.state),
        links_(step.model.links.data()),
        ground_(step.ground),
        geom_has_impulse_(step.workspace.geom_has_impulse.data() +
                          to_index(first_lane / width) * step.model.geoms.size()),
        scratch_(step.workspace.memory()),
        timestep_s_(step.timestep_s) {}

  const StepArguments& arguments;
  int lane;

  const Model& model() const { return model_; }
  const StateRows& rows() const { return rows_; }
  Workspace& work() const { return work_; }
  float timestep_s() const { return timestep_s_; }
  Row* row(int index) const { return state_ + index; }
  V state(int index) const { return load1(state_[index], lane); }
  V3 state3(int index) const { return load3(state_ + index, lane); }
  void set_state(int index, V v) const { store1(v, state_[index], lane); }
  void set_state3(int index, V3 v) const { store3(v, state_ + index, lane); }
  float* scratch(int vector) const { return scratch_ + vector * width; }
  const Link& link(const Chain& chain, int j) const { return links_[chain.first + j]; }
  const JointRow& row_of(const Chain& chain, int r) const {
    return model_.joint_rows[to_index(chain.first_row + r)];
  }
  float* joint_row(const Chain& chain, int r) const {
    return scratch(work_.joint_row + joint_row_size * (chain.first_row + r));
  }
  int pose_row(int link) const { return rows().pose + StateRows::pose_size * link; }
  unsigned char& geom_has_impulse(int geom) const { return geom_has_impulse_[geom]; }
  const UnevenGround* ground() const { return ground_; }
  Mask active() const { return state(StateRows::active) > zero(); }
  /// The world's axes in torso axes, as columns: the rotation matrix from world to torso axes.
  Columns world() const {
    return {state3(StateRows::world_axes), state3(StateRows::world_axes + 3),
            state3(StateRows::world_axes + 6)};
  }

 private:
  const Model& model_;
  Workspace& work_;
  StateRows rows_;
  Row* state_;
  const Link* links_;
  const UnevenGround* ground_;
  unsigned char* geom_has_impulse_;
  float* scratch_;
  float timestep_s_;
};

/// Rotates two of a frame's axes about the third: u ← u cos + w sin, w ← w cos − u sin.
HWY_INLINE void rotate_pair(V3& u, V3& w, SineCosine angle) {
  const V3 before = u;
  u = fma(angle.sine, w, angle.cosine * u);
  w = fnma(angle.sine, before, angle.cosine * w);
}

/// Rotates a frame (`axes`, torso axes) by the angle of its joint, and returns the joint's axis (torso axes).
HWY_INLINE V3 rotate_frame(Columns& axes, const Link& link, V angle) {
  SineCosine joint = sine_cosine(angle);
  if (link.axis == 3) {
    // Rodrigues' rotation formula, R = cos 1 + sin [a]ₓ + (1 − cos) a aᵀ; new axes = before · R.
    const Columns before = axes;
    const V3 a = set(link.direction), axis = before * a;
    const V versine = set(1.0f) - joint.cosine;
    const V3 s = joint.sine * a, part = versine * a;
    axes.x = fma(s.z, before.y, fnma(s.y, before.z, fma(part.x, axis, joint.cosine * before.x)));
    axes.y = fma(s.x, before.z, fnma(s.z, before.x, fma(part.y, axis, joint.cosine * before.y)));
    axes.z = fma(s.y, before.x, fnma(s.x, before.y, fma(part.z, axis, joint.cosine * before.z)));
    return axis;
  }
  const V sign = set(link.sign);
  joint.sine = sign * joint.sine;
  if (link.axis == 0) {
    rotate_pair(axes.y, axes.z, joint);
    return sign * axes.x;
  }
  if (link.axis == 1) {
    rotate_pair(axes.z, axes.x, joint);
    return sign * axes.y;
  }
  rotate_pair(axes.x, axes.y, joint);
  return sign * axes.z;
}

/// Frames of a chain's links relative to the torso's frame, from the torso outwards (Featherstone 2008,
/// sec. 4.2 and 4.4):
///   origin_i = origin_p + R_p offset_i,   R_i = R_p R(q_i).
/// Adds the chain's first moment of mass, Σ m c (kg m), to `moment`.
HWY_INLINE void chain_kinematics(const Pass& pass, const Chain& chain, V3& moment) {
  const V one = set(1.0f), none = zero();
  Columns axes{{one, none, none}, {none, one, none}, {none, none, one}};
  V3 origin = zero3();
  for (int j = 0; j < chain.count; ++j) {
    const Link& link = pass.link(chain, j);
    const V3 offset = set(link.from_parent_m);
    if (link.parent != j - 1) {  // where the chain branches
      const int parent = pass.pose_row(chain.first + link.parent);
      axes = {pass.state3(parent), pass.state3(parent + 3), pass.state3(parent + 6)};
      origin = pass.state3(parent + 9);
    }
    origin = origin + (j == 0 ? offset : axes * offset);
    const V3 axis = rotate_frame(axes, link, pass.state(pass.rows().angle + chain.first + j));
    const int row = pass.pose_row(chain.first + j);
    pass.set_state3(row, axes.x);
    pass.set_state3(row + 3, axes.y);
    pass.set_state3(row + 6, axes.z);
    pass.set_state3(row + 9, origin);
    pass.set_state3(row + 12, axis);
    if (link.has_mass) moment = fma(set(link.body.mass_kg), origin + axes * set(link.body.com_m), moment);
  }
}

/// The rotation matrix of the torso's quaternion (w, q), R = (w² − q·q) 1 + 2 q qᵀ + 2 w [q]ₓ, row by row:
/// the world's axes in torso axes.
HWY_INLINE void find_world_axes(const Pass& pass) {
  const V w = pass.state(StateRows::rotation);
  const V3 q = pass.state3(StateRows::rotation + 1);
  const V one = set(1.0f), two = set(2.0f);
  const V3 d = two * q;
  // As 1 − 2 (y² + z²), … for a unit quaternion.
  const V xx = d.x * q.x, yy = d.y * q.y, zz = d.z * q.z;
  pass.set_state3(StateRows::world_axes,
                  {one - (yy + zz), difference_of_products(d.x, q.y, d.z, w), fma(d.y, w, d.x * q.z)});
  pass.set_state3(StateRows::world_axes + 3,
                  {fma(d.z, w, d.x * q.y), one - (xx + zz), difference_of_products(d.y, q.z, d.x, w)});
  pass.set_state3(StateRows::world_axes + 6,
                  {difference_of_products(d.x, q.z, d.y, w), fma(d.x, w, d.y * q.z), one - (xx + yy)});
}

/// Poses of all links, and the joints' motion subspaces (a, c × a), about the robot's centre of mass.
HWY_NOINLINE void forward_kinematics(const Pass pass) {
  const Model& model = pass.model();
  find_world_axes(pass);
  V3 moment = set(model.torso.mass_kg) * set(model.torso.com_m);
  for (const Chain& chain : model.chains) chain_kinematics(pass, chain, moment);
  // c = (Σ m_i c_i) / m; from here on positions are relative to it.
  const V3 com = set(1.0f / model.mass_kg) * moment;
  pass.set_state3(StateRows::torso_origin, zero3() - com);
  for (int l = 0; l < pass.rows().links; ++l) {
    const int row = pass.pose_row(l);
    const V3 origin = pass.state3(row + 9) - com;
    pass.set_state3(row + 9, origin);
    pass.set_state3(row + 15, cross(origin, pass.state3(row + 12)));
  }
}

/// Position of a point in its link's frame, where `up` points upwards: of a rim about the centre c and the
/// axis a, c + R d, d = −(up − (up · a) a) / |…| being the direction down along the rim, turned about a.
HWY_INLINE V3 point_position(const Point& point, V3 up) {
  const V3 centre = set(point.position_m);
  if (point.rim_radius_m == 0.0f) return centre;
  const V3 axis = set(point.rim_axis);
  const V along = dot(up, axis);
  const V3 down = fma(along, axis, zero3() - up);
  const V square = dot(down, down);
  // Where a cylinder is upright but for rounding, every point of its rim is as low.
  const Mask upright = square < set(1e-8f);
  const V scale = set(1.0f) / hn::Sqrt(hn::IfThenElse(upright, set(1.0f), square));
  const V3 start = set(point.rim_start);
  const V3 lowest{hn::IfThenElse(upright, start.x, scale * down.x),
                  hn::IfThenElse(upright, start.y, scale * down.y),
                  hn::IfThenElse(upright, start.z, scale * down.z)};
  const V3 direction = fma(set(point.rim_cosine), lowest, set(point.rim_sine) * cross(axis, lowest));
  return fma(set(point.rim_radius_m), direction, centre);
}

/// Height and slopes of a field at (x, y), bilinear in its cell (ground::HeightField::at).
struct FieldSample {
  V height, slope_x, slope_y;
};

HWY_INLINE FieldSample sample_field(const UnevenGround& ground, const float* field, V x, V y) {
  const Ints integers;
  const V scale = set(ground.cells_per_m), u = x * scale, v = y * scale;
  const V left = hn::Floor(u), front = hn::Floor(v), s = u - left, t = v - front;
  const auto mask = hn::Set(integers, ground::HeightField::cells - 1), one = hn::Set(integers, 1);
  const auto i = hn::And(hn::ConvertTo(integers, left), mask), next_i = hn::And(i + one, mask);
  const auto j = hn::And(hn::ConvertTo(integers, front), mask), next_j = hn::And(j + one, mask);
  static_assert(ground::HeightField::cells == 256);
  const auto row = hn::ShiftLeft<8>(j), next_row = hn::ShiftLeft<8>(next_j);
  const V a = hn::GatherIndex(Floats(), field, hn::Or(row, i));
  const V b = hn::GatherIndex(Floats(), field, hn::Or(row, next_i));
  const V c = hn::GatherIndex(Floats(), field, hn::Or(next_row, i));
  const V d = hn::GatherIndex(Floats(), field, hn::Or(next_row, next_i));
  const V near = fma(s, b - a, a), far = fma(s, d - c, c);
  return {.height = fma(t, far - near, near),
          .slope_x = fma(t, (d - c) - (b - a), b - a) * scale,
          .slope_y = (far - near) * scale};
}

/// Distance of point `p`, at `position` in its link's frame, from uneven ground along the ground's normal,
/// which it stores (ground::Ground::touch).
HWY_INLINE V gap_on_uneven_ground(const Pass& pass, int p, V3 position) {
  const Point& point = pass.model().points[to_index(p)];
  V3 place = pass.state3(StateRows::torso_origin) + position;
  if (point.chain >= 0) {
    const int row = pass.pose_row(pass.model().chains[to_index(point.chain)].first + point.link);
    place = pass.state3(row + 9) +
            Columns{pass.state3(row), pass.state3(row + 3), pass.state3(row + 6)} * position;
  }
  const V3 world = pass.state3(StateRows::com) + transposed(pass.world(), place);
  const UnevenGround& ground = *pass.ground();
  const FieldSample at = sample_field(ground, ground.fields[to_index(point.field)], world.x, world.y);
  const V one = set(1.0f);
  const V up = one / hn::Sqrt(fma(at.slope_y, at.slope_y, fma(at.slope_x, at.slope_x, one)));
  const V3 normal{hn::Neg(up * at.slope_x), hn::Neg(up * at.slope_y), up};
  float* const stored = pass.scratch(pass.work().point_normal + 3 * p);
  store(normal.x, stored);
  store(normal.y, stored + width);
  store(normal.z, stored + 2 * width);
  return up * (world.z - at.height);
}

/// Heights above the ground of all points whose geom's bounding sphere reaches it, and which feet touch.
template <bool uneven>
HWY_NOINLINE void detect_contacts_on(const Pass pass) {
  const Model& model = pass.model();
  const Mask active = pass.active();
  const V3 up = pass.state3(StateRows::world_axes + 6);
  const V com_height = pass.state(StateRows::com + 2);
  const V highest = set(uneven ? pass.ground()->highest_m : 0.0f);
  const Point* const points = model.points.data();
  const std::size_t geoms = model.geoms.size();
  unsigned char* const may_touch = pass.work().geom_may_touch.data();
  V contacts = zero();
  for (std::size_t g = 0; g < geoms; ++g) {
    const PointGroup& geom = model.geoms[g];
    const Point& first = points[geom.first];
    V3 origin = pass.state3(StateRows::torso_origin), local_up = up;
    if (first.chain >= 0) {
      const int row = pass.pose_row(model.chains[to_index(first.chain)].first + first.link);
      origin = pass.state3(row + 9);
      local_up = transposed({pass.state3(row), pass.state3(row + 3), pass.state3(row + 6)}, up);
    }
    // z = z_com + up · origin + (Rᵀ up) · p − radius, p in the axes of the link's frame.
    const V height = dot(up, origin, com_height);
    const V lowest = dot(local_up, set(geom.centre_m), height) - set(geom.bounding_radius_m);
    may_touch[g] = !hn::AllFalse(Floats(), hn::And(active, lowest <= highest));
    Mask touches = no_lanes();
    for (int p = geom.first; may_touch[g] && p < geom.first + geom.count; ++p) {
      const Point& point = points[p];
      const V3 position = point_position(point, local_up);
      const V h = uneven ? gap_on_uneven_ground(pass, p, position)
                         : dot(local_up, position, height) - set(point.radius_m);
      store(h, pass.scratch(pass.work().point_height + p));
      touches = hn::Or(touches, h <= zero());
      contacts = contacts + hn::IfThenElseZero(h <= zero(), set(1.0f));
    }
    if (geom.leg < 0) continue;
    const int row = pass.rows().touch + geom.leg;
    const V touch = hn::IfThenElseZero(touches, set(1.0f));
    pass.set_state(row, geom.first_of_foot ? touch : max(touch, pass.state(row)));
  }
  pass.set_state(StateRows::contacts, contacts);
}

HWY_INLINE void detect_contacts(const Pass& pass) {
  pass.ground() ? detect_contacts_on<true>(pass) : detect_contacts_on<false>(pass);
}

/// Copies joint angles and touch to the sensors, and computes roll, pitch and yaw.
HWY_NOINLINE void read_sensors(const Pass pass) {
  const auto put = [&](V v, LaneArray& rows, int row)
                       HWY_ATTR { hn::StoreU(v, Floats(), rows.row(row) + pass.lane); };
  robot::SensorFrame& sensors = pass.arguments.sensors;
  for (int l = 0; l < pass.rows().links; ++l)
    put(pass.state(pass.rows().angle + l), sensors.joint_angle_rad, pass.model().links[to_index(l)].joint);
  for (int leg = 0; leg < pass.model().legs; ++leg)
    put(pass.state(pass.rows().touch + leg), sensors.touch, leg);
  // From the entries of R = R_z(yaw) R_y(pitch) R_x(roll): R31 = −sin pitch, R32 / R33 = tan roll,
  // R21 / R11 = tan yaw.
  Columns world = pass.world();
  const Model& model = pass.model();
  if (model.turned) {
    const Columns start = {set(model.start[0]), set(model.start[1]), set(model.start[2])};
    world = {transposed(start, world.x), transposed(start, world.y), transposed(start, world.z)};
  }
  if (model.tilted)
    world = {world * set(model.level[0]), world * set(model.level[1]), world * set(model.level[2])};
  const V one = set(1.0f), sine = min(max(hn::Neg(world.z.x), hn::Neg(one)), one);
  put(arc_tangent(world.z.y, world.z.z), sensors.attitude_rad, 0);
  put(arc_tangent(sine, hn::Sqrt((one - sine) * (one + sine))), sensors.attitude_rad, 1);
  put(arc_tangent(world.y.x, world.x.x), sensors.attitude_rad, 2);
}

}  // namespace amble::physics::batch::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // toggled by HWY_TARGET_TOGGLE
