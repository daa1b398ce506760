#pragma once

#include <array>
#include <vector>

#include "amble/gait/body.hpp"
#include "amble/gait/meter.hpp"

namespace amble::tests {

/// Frames of 0.01 s.
inline constexpr double frame_s = 0.01;

/// A body of 5 kg without joints, hips 0.8 m high, gravity 10 m/s². Four legs are FL, FR, BL, BR, as a
/// quadruped has them; other numbers are L0, L1, …, of which two or six are in pairs of a left and a right
/// one from front to back.
inline gait::Body synthetic_body(int legs = 4) {
  gait::Body body;
  body.robot = "synthetic";
  const std::array<const char*, 4> names{"FL", "FR", "BL", "BR"};
  for (int leg = 0; leg < legs; ++leg)
    body.legs.push_back(legs == 4 ? names[static_cast<std::size_t>(leg)] : "L" + std::to_string(leg));
  body.mass_kg = 5.0;
  body.gravity_m_s2 = 10.0;
  body.leg_length_m = 0.8;
  if (legs == 4) body.quadruped = gait::QuadrupedLegs{};
  if (legs == 2 || legs == 6)
    for (int leg = 0; leg < legs; leg += 2) body.pairs.push_back({leg, leg + 1});
  return body;
}

/// Feet that step like clockwork: leg l is on the ground in frame k if (k − offset[l]) mod stride < stance.
struct Clockwork {
  int stride = 100, stance = 60;
  std::vector<int> offset;  ///< frames

  bool touches(std::size_t leg, int frame) const {
    const int in_stride = ((frame - offset[leg]) % stride + stride) % stride;
    return in_stride < stance;
  }
  std::vector<float> touch(int frame) const {
    std::vector<float> row;
    for (std::size_t leg = 0; leg < offset.size(); ++leg) row.push_back(touches(leg, frame) ? 1.0f : 0.0f);
    return row;
  }
};

/// A meter that is fed with touches alone; the centre of mass stays where it is.
class Feeder {
 public:
  explicit Feeder(int legs = 4, const gait::Settings& settings = {})
      : meter_(synthetic_body(legs), frame_s, settings) {}

  /// The next frame.
  void add(const std::vector<float>& touch) {
    meter_.add({.com_m = {}, .touch = touch, .angle_rad = {}, .torque_nm = {}});
    ++frames_;
  }
  void walk(const Clockwork& feet, int frames) {
    for (int k = 0; k < frames; ++k) add(feet.touch(frames_));
  }
  int frames() const { return frames_; }
  gait::Report finish() { return meter_.finish(record::Outcome::completed); }

 private:
  gait::Meter meter_;
  int frames_ = 0;
};

constexpr gait::Classification named(gait::Gait gait) {
  return {gait, gait::Irregular::no};
}

/// 20 s of feet that land at these shares of a stride of 0.8 s, in percent; legs FL, FR, BL, BR.
inline gait::Report walk(const std::vector<int>& percent, int stance_percent = 60) {
  Clockwork feet{.stride = 80, .stance = stance_percent * 80 / 100, .offset = {}};
  for (const int share : percent) feet.offset.push_back(share * 80 / 100);
  Feeder feeder;
  feeder.walk(feet, 2000);
  return feeder.finish();
}

}  // namespace amble::tests
