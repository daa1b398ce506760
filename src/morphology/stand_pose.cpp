#include "amble/morphology/stand_pose.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <numbers>
#include <optional>
#include <utility>

#include "amble/core/index.hpp"
#include "amble/morphology/start_pose.hpp"
#include "amble/robot/pose.hpp"

namespace amble::morphology {
namespace {

constexpr double pi = std::numbers::pi;
/// Joints keep this share of their range from their stops, at most so much.
constexpr double stop_share = 0.05, most_from_stop_rad = 0.1;
/// Joints of a leg whose anchors are within this share of its length from the first one are its hip.
constexpr double hip_share = 0.25;
/// A foot is a part with a sole if the last joint is within this share of the leg's length from it.
constexpr double ankle_share = 0.35;
/// How far legs that turn about z at the hip stand out, as a share of their length.
constexpr double sprawl_share = 0.4;
constexpr double vertical = 0.8;

class LegSolver {
 public:
  LegSolver(const robot::RobotSpec& robot, const LegGuess& leg, bool sprawls_may, bool knees_forward)
      : robot_(robot),
        leg_(leg),
        angles_(robot.joints.size(), 0.0),
        poses_(robot::start_poses(robot)),
        knee_sign_(knees_forward ? -1.0 : 1.0) {
    for (int body = foot().body; body > 0; body = robot.bodies[to_index(body)].parent) {
      bodies_.insert(bodies_.begin(), body);
      if (body == robot.joints[to_index(leg.joints.front())].body) break;
    }
    // What else hangs from the leg's bodies moves with them.
    for (int b = bodies_.front() + 1; b < static_cast<int>(robot.bodies.size()); ++b)
      if (std::ranges::find(bodies_, robot.bodies[to_index(b)].parent) != bodies_.end() &&
          std::ranges::find(bodies_, b) == bodies_.end())
        bodies_.push_back(b);
    std::ranges::sort(bodies_);
    for (const int j : leg.joints) {
      const robot::Joint& joint = robot.joints[to_index(j)];
      const double most = std::isfinite(joint.upper_rad) ? joint.upper_rad : pi,
                   least = std::isfinite(joint.lower_rad) ? joint.lower_rad : -pi;
      const double inside = std::min(stop_share * (most - least), most_from_stop_rad);
      // A joint that turns round and round has one turn.
      lower_.push_back(std::max(least + inside, std::min(-pi, most - inside - 2.0 * pi)));
      upper_.push_back(std::min(most - inside, lower_.back() + 2.0 * pi));
    }
    measure(sprawls_may);
  }

  double length_m() const { return length_m_; }

  /// How far below the hip the foot's lowest point gets, or the least that it can be below it, m.
  double farthest_m(bool down) {
    aim_ = down ? Aim::down : Aim::up;
    solve();
    aim_ = Aim::ground;
    place(best_);
    return hip_point_m().z - bottom_m();
  }

  /// `ground_m`: where the foot's lowest point is to be; `shift_m`: of the foot against the place below the
  /// hip.
  void solve_for(double ground_m, Vec3 shift_m) {
    ground_m_ = ground_m;
    shift_m_ = shift_m;
    solve();
    place(best_);
  }

  double hip_height_m() {
    place(best_.empty() ? std::vector<double>(lower_.size(), 0.0) : best_);
    return hip_point_m().z;
  }

  const std::vector<double>& angles() const { return best_; }
  double bottom_m() const {
    double lowest_m = std::numeric_limits<double>::infinity();
    for (const int g : sole_geoms_)
      lowest_m = std::min(lowest_m, robot::bottom_m(robot_.geoms[to_index(g)], poses_));
    return lowest_m;
  }
  /// The middle of a foot with a sole, else of the foot's shape.
  Vec3 foot_m() const { return sole_ ? soles_middle_m() : robot::centre_m(foot(), poses_); }
  Vec3 target_m() const {
    Vec3 target = hip_point_m() + shift_m_;
    if (sprawls_) target = target + sprawl_share * length_m_ * outward_;
    return target;
  }
  const std::vector<robot::Pose>& poses() const { return poses_; }
  const std::vector<int>& bodies() const { return bodies_; }
  void set_outward(Vec3 outward) { outward_ = outward; }
  bool sprawls() const { return sprawls_; }

 private:
  enum class Aim { ground, down, up };

  const robot::Geom& foot() const { return robot_.geoms[to_index(leg_.foot_geom)]; }

  Vec3 soles_middle_m() const {
    Vec3 sum;
    for (const int g : sole_geoms_) sum = sum + robot::centre_m(robot_.geoms[to_index(g)], poses_);
    return (1.0 / static_cast<double>(sole_geoms_.size())) * sum;
  }

  void place(const std::vector<double>& q) {
    for (std::size_t i = 0; i < q.size(); ++i) angles_[to_index(leg_.joints[i])] = q[i];
    for (const int b : bodies_) {
      const robot::Pose& parent = poses_[to_index(robot_.bodies[to_index(b)].parent)];
      poses_[to_index(b)] = robot::pose_along(robot_, b, parent, angles_, robot_.joints.size());
    }
  }

  Vec3 anchor_m(std::size_t i) const {
    const robot::Joint& joint = robot_.joints[to_index(leg_.joints[i])];
    return poses_[to_index(joint.body)] * joint.anchor_m;
  }
  Vec3 hip_point_m() const { return anchor_m(hip_); }

  void measure(bool sprawls_may) {
    const std::size_t joints = leg_.joints.size();
    std::vector<double> way_m(joints, 0.0);
    for (std::size_t i = 1; i < joints; ++i) way_m[i] = way_m[i - 1] + norm(anchor_m(i) - anchor_m(i - 1));
    length_m_ = way_m.back() + norm(foot_m() - anchor_m(joints - 1));
    if (!(length_m_ > 0.0)) length_m_ = 1.0;
    for (std::size_t i = 0; i < joints; ++i)
      if (way_m[i] <= hip_share * length_m_) hip_ = i;
    const robot::Joint& first = robot_.joints[to_index(leg_.joints.front())];
    const Vec3 axis = rotate(poses_[to_index(first.body)].rotation, first.axis);
    sprawls_ = sprawls_may && std::abs(axis.z) > vertical;
    for (int g = 0; g < static_cast<int>(robot_.geoms.size()); ++g) {
      const robot::Geom& geom = robot_.geoms[to_index(g)];
      if (!geom.collides) continue;
      if (geom.body == foot().body)
        sole_geoms_.push_back(g);
      else if (std::ranges::find(bodies_, geom.body) != bodies_.end())
        other_geoms_.push_back(g);
    }
    const bool ankle = norm(foot_m() - anchor_m(joints - 1)) < ankle_share * length_m_;
    if (ankle && joints > 1) find_sole();
  }

  /// The foot's thinnest direction, in its body's axes, away from the joint above it.
  void find_sole() {
    const robot::Pose& pose = poses_[to_index(foot().body)];
    const bool box = foot().shape == robot::Shape::box;
    const Quat frame = box ? foot().rotation : Quat{};
    std::array<double, 3> extents{};
    const std::array<Vec3, 3> axes{rotate(frame, {1, 0, 0}), rotate(frame, {0, 1, 0}),
                                   rotate(frame, {0, 0, 1})};
    for (std::size_t k = 0; k < 3; ++k) {
      // A turned copy of the poses in which the axis points up measures the extent along it.
      std::array<double, 2> ends{};
      for (const double sign : {1.0, -1.0}) {
        double lowest = std::numeric_limits<double>::infinity();
        std::vector<robot::Pose> turned(poses_.size());
        const Vec3 up{0.0, 0.0, 1.0}, axis = sign * axes[k];
        const Vec3 about = cross(axis, up);
        const double sine = norm(about);
        const Quat turn = sine > 1e-9 ? axis_angle((1.0 / sine) * about, std::atan2(sine, dot(axis, up)))
                                      : axis_angle({1.0, 0.0, 0.0}, dot(axis, up) > 0.0 ? 0.0 : pi);
        turned[to_index(foot().body)] = {{}, turn};
        for (const int g : sole_geoms_)
          lowest = std::min(lowest, robot::bottom_m(robot_.geoms[to_index(g)], turned));
        ends[sign > 0.0 ? 0 : 1] = lowest;
      }
      extents[k] = -ends[0] - ends[1];
    }
    const auto thinnest = to_index(static_cast<int>(std::ranges::min_element(extents) - extents.begin()));
    std::array<double, 3> sorted = extents;
    std::ranges::sort(sorted);
    constexpr double thin = 0.75;
    if (sorted[0] > thin * sorted[1]) return;
    const Vec3 axis = axes[thinnest];
    const robot::Joint& last = robot_.joints[to_index(leg_.joints.back())];
    if (std::abs(dot(axis, last.axis)) > vertical) return;  // a wheel's
    const Vec3 away = rotate(conjugate(pose.rotation), soles_middle_m() - anchor_m(leg_.joints.size() - 1));
    // With the ankle in the sole's middle, the way that points down already.
    const bool tells = std::abs(dot(axis, away)) > 0.1 * extents[thinnest];
    const double way = tells ? dot(axis, away) : -rotate(pose.rotation, axis).z;
    sole_ = way >= 0.0 ? axis : -axis;
  }

  double cost(const std::vector<double>& q) {
    place(q);
    const double bottom = bottom_m();
    const Vec3 off = (1.0 / length_m_) * (foot_m() - target_m());
    double sum = 4.0 * (off.x * off.x + off.y * off.y);
    const double strict = aim_ == Aim::down ? 10.0 : 1.0;
    if (aim_ != Aim::ground) {
      // Down counts more than what it costs a leg that spreads to the side to reach out.
      sum += (aim_ == Aim::down ? strict : -strict) * (bottom - hip_point_m().z) / length_m_;
    } else {
      const double high = (bottom - ground_m_) / length_m_;
      sum += 400.0 * high * high;
    }
    if (sole_) {
      const Vec3 down = rotate(poses_[to_index(foot().body)].rotation, *sole_);
      sum += strict * 4.0 * (1.0 + down.z);
    }
    constexpr double clear = 0.05;
    for (const int g : other_geoms_) {
      const double into = clear - (robot::bottom_m(robot_.geoms[to_index(g)], poses_) - bottom) / length_m_;
      if (into > 0.0) sum += strict * 20.0 * into * into;
    }
    // Among poses that are as good: small turns, and knees on the usual side.
    for (const double angle : q) sum += 2e-4 * angle * angle;
    if (q.size() > hip_ + 1) {
      const Vec3 knee = anchor_m(hip_ + 1) - 0.5 * (hip_point_m() + foot_m());
      sum += 0.05 * std::max(0.0, knee_sign_ * knee.x / length_m_);
    }
    return sum;
  }

  void solve() {
    const std::size_t joints = lower_.size();
    const auto of = [this](const std::vector<double>& q) { return cost(q); };
    constexpr std::array primes{2, 3, 5, 7, 11, 13, 17, 19};
    constexpr int samples_per_joint = 250, tries = 6;
    std::vector<std::pair<double, std::vector<double>>> starts;
    const int samples = samples_per_joint * static_cast<int>(joints);
    for (int n = 0; n < samples; ++n) {
      std::vector<double> q(joints);
      for (std::size_t i = 0; i < joints; ++i)
        q[i] = n == 0 ? std::clamp(0.0, lower_[i], upper_[i])
                      : lower_[i] + evenly(n, primes[i % primes.size()]) * (upper_[i] - lower_[i]);
      starts.emplace_back(cost(q), std::move(q));
    }
    const auto by_cost = [](const auto& a, const auto& b) { return a.first < b.first; };
    std::ranges::stable_sort(starts, by_cost);
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t k = 0; k < std::min<std::size_t>(tries, starts.size()); ++k) {
      double value = 0.0;
      std::vector<double> found = lower_cost(of, starts[k].second, lower_, upper_, value);
      if (value >= least - 1e-9) continue;
      least = value;
      best_ = std::move(found);
    }
  }

  const robot::RobotSpec& robot_;
  const LegGuess& leg_;
  std::vector<double> angles_;
  std::vector<robot::Pose> poses_;
  double knee_sign_;  ///< knees go to −x if positive
  std::vector<int> bodies_, sole_geoms_, other_geoms_;
  std::vector<double> lower_, upper_, best_;
  double length_m_ = 0.0, ground_m_ = 0.0;
  Vec3 shift_m_, outward_;
  std::size_t hip_ = 0;
  bool sprawls_ = false;
  Aim aim_ = Aim::ground;
  std::optional<Vec3> sole_;
};

/// Four digits after the point, which is less than a motor can tell; next to nothing is 0.
double rounded_rad(double value) {
  constexpr double nothing_rad = 2e-3;
  return std::abs(value) < nothing_rad ? 0.0 : std::round(value * 1e4) / 1e4;
}

Vec3 com_m(const robot::RobotSpec& robot, const std::vector<LegSolver>& legs) {
  std::vector<robot::Pose> poses = robot::start_poses(robot);
  for (const LegSolver& leg : legs)
    for (const int b : leg.bodies()) poses[to_index(b)] = leg.poses()[to_index(b)];
  Vec3 moment;
  double mass_kg = 0.0;
  for (std::size_t b = 0; b < poses.size(); ++b) {
    moment = moment + robot.bodies[b].mass_kg * (poses[b] * robot.bodies[b].com_m);
    mass_kg += robot.bodies[b].mass_kg;
  }
  return (1.0 / mass_kg) * moment;
}

Vec3 level_mean(const std::vector<Vec3>& points) {
  Vec3 sum;
  for (const Vec3 point : points) sum = sum + Vec3{point.x, point.y, 0.0};
  return (1.0 / static_cast<double>(points.size())) * sum;
}

/// How far the feet must move so that they are below the centre of mass: on one or two legs their middle; on
/// more it must be between them, and not near the edge.
Vec3 off_feet(Vec3 com, const std::vector<Vec3>& feet) {
  const Vec3 level_com{com.x, com.y, 0.0};
  if (feet.size() <= 2) return level_com - level_mean(feet);
  Vec3 least = feet[0], most = feet[0];
  for (const Vec3 foot : feet) {
    least = {std::min(least.x, foot.x), std::min(least.y, foot.y), 0.0};
    most = {std::max(most.x, foot.x), std::max(most.y, foot.y), 0.0};
  }
  constexpr double edge = 0.3;
  const auto beyond = [&](double at, double low, double high) {
    const double inset = edge * (high - low);
    return at < low + inset ? at - low - inset : at > high - inset ? at - high + inset : 0.0;
  };
  return {beyond(com.x, least.x, most.x), beyond(com.y, least.y, most.y), 0.0};
}

/// The parts as a robot whose joints stop where their motors can be told to go no farther.
robot::RobotSpec held_to(std::span<const std::optional<std::array<double, 2>>> targets_rad,
                         const ModelParts& parts) {
  robot::RobotSpec robot;
  robot.bodies = parts.bodies;
  robot.geoms = parts.geoms;
  robot.joints = parts.joints;
  for (std::size_t j = 0; j < robot.joints.size(); ++j) {
    if (!targets_rad[j]) continue;
    robot::Joint& joint = robot.joints[j];
    const double lower = std::max(joint.lower_rad, (*targets_rad[j])[0] - parts.start_rad[j]),
                 upper = std::min(joint.upper_rad, (*targets_rad[j])[1] - parts.start_rad[j]);
    if (lower < upper) joint.lower_rad = lower, joint.upper_rad = upper;
  }
  return robot;
}

}  // namespace

StandPose find_stand_pose(const ModelParts& parts, const std::vector<LegGuess>& guesses,
                          std::span<const std::optional<std::array<double, 2>>> targets_rad, double reach) {
  const robot::RobotSpec robot = held_to(targets_rad, parts);
  const bool biped = guesses.size() <= 2;
  std::vector<LegSolver> legs;
  legs.reserve(guesses.size());
  for (const LegGuess& guess : guesses) legs.emplace_back(robot, guess, guesses.size() >= 4, biped);

  std::vector<Vec3> hips;
  for (LegSolver& leg : legs) {
    const double height_m = leg.hip_height_m();
    hips.push_back({leg.target_m().x, leg.target_m().y, height_m});
  }
  const Vec3 middle = level_mean(hips);
  constexpr double infinity = std::numeric_limits<double>::infinity();
  double ground_m = -infinity, lowest_m = -infinity, highest_m = infinity;
  for (std::size_t l = 0; l < legs.size(); ++l) {
    const Vec3 out = Vec3{hips[l].x, hips[l].y, 0.0} - middle;
    if (norm(out) > 1e-6) legs[l].set_outward((1.0 / norm(out)) * out);
    const double shallow_m = legs[l].farthest_m(false);
    highest_m = std::min(highest_m, legs[l].hip_height_m() - shallow_m);
    const double deep_m = legs[l].farthest_m(true), hip_m = legs[l].hip_height_m();
    lowest_m = std::max(lowest_m, hip_m - deep_m);
    ground_m = std::max(ground_m, hip_m - reach * deep_m);
  }
  ground_m = std::max(std::min(ground_m, highest_m), lowest_m);
  Vec3 shift;
  for (int round = 0; round < 4; ++round) {
    std::vector<Vec3> feet;
    double longest_m = 0.0;
    for (LegSolver& leg : legs) {
      leg.solve_for(ground_m, shift);
      feet.push_back(leg.foot_m());
      longest_m = std::max(longest_m, leg.length_m());
    }
    const Vec3 off = off_feet(com_m(robot, legs), feet);
    constexpr double near = 0.01, most = 0.4;
    if (norm(off) < near * longest_m) break;
    shift = shift + off;
    if (norm(shift) > most * longest_m) shift = (most * longest_m / norm(shift)) * shift;
  }

  StandPose pose;
  for (std::size_t l = 0; l < legs.size(); ++l) {
    for (std::size_t i = 0; i < guesses[l].joints.size(); ++i) {
      const auto j = to_index(guesses[l].joints[i]);
      const robot::Joint& joint = parts.joints[j];
      const double exact = parts.start_rad[j] + legs[l].angles()[i], angle = rounded_rad(exact);
      const double by = angle - parts.start_rad[j];
      pose.angles_rad[joint.name] = by >= joint.lower_rad && by <= joint.upper_rad ? angle : exact;
    }
    const Vec3 off = legs[l].foot_m() - legs[l].target_m();
    pose.uneven_share =
        std::max(pose.uneven_share, std::abs(legs[l].bottom_m() - ground_m) / legs[l].length_m());
    pose.off_share = std::max(pose.off_share, std::hypot(off.x, off.y) / legs[l].length_m());
  }
  return pose;
}

}  // namespace amble::morphology
