#include "amble/gait/meter.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "amble/core/check.hpp"
#include "amble/core/index.hpp"

namespace amble::gait {

// A stance is confirmed at the latest 2 × debounce − 2 frames after its first: when a gap of debounce − 1
// frames began just before it was long enough.
ContactFilter::ContactFilter(int debounce_frames)
    : debounce_frames_(std::max(debounce_frames, 1)), debounced_(to_index(2 * debounce_frames_ - 1)) {}

std::optional<bool> ContactFilter::add(bool touch) {
  const std::int64_t frame = frames_++;
  debounced_[slot(frame)] = 0;
  if (touch) {
    if (!stance_ || frame - last_ > debounce_frames_) {
      first_ = frame;
      confirmed_ = false;
    } else if (confirmed_) {
      for (std::int64_t gap = last_ + 1; gap < frame; ++gap) debounced_[slot(gap)] = 1;
    }
    stance_ = true;
    last_ = frame;
    if (confirmed_) {
      debounced_[slot(frame)] = 1;
    } else if (frame - first_ + 1 >= debounce_frames_) {
      confirmed_ = true;
      for (std::int64_t past = first_; past <= frame; ++past) debounced_[slot(past)] = 1;
    }
  }
  if (frame < lag()) return std::nullopt;
  return debounced_[slot(frame - lag())] != 0;
}

std::vector<bool> ContactFilter::finish() const {
  std::vector<bool> rest;
  for (std::int64_t frame = std::max<std::int64_t>(0, frames_ - lag()); frame < frames_; ++frame)
    rest.push_back(debounced_[slot(frame)] != 0);
  return rest;
}

std::size_t ContactFilter::slot(std::int64_t frame) const {
  return to_index(frame % static_cast<std::int64_t>(debounced_.size()));
}

std::vector<bool> debounced(const std::vector<bool>& touch, int debounce_frames) {
  ContactFilter filter(debounce_frames);
  std::vector<bool> output;
  for (const bool frame : touch)
    if (const auto value = filter.add(frame)) output.push_back(*value);
  for (const bool value : filter.finish()) output.push_back(value);
  return output;
}

namespace {

/// A window whose phases have a smaller resultant than this does not count towards the drift.
constexpr double min_drift_resultant = 0.3;

const Settings& valid(const Settings& settings) {
  settings.validate();
  return settings;
}

std::int64_t frames_in(double seconds, double frame_s) {
  return std::llround(seconds / frame_s);
}

std::vector<float> start_of(const Body& body) {
  return body.angle_start_rad.empty() ? std::vector<float>(body.joints.size()) : body.angle_start_rad;
}

}  // namespace

Meter::Meter(const Body& body, double frame_s, const Settings& settings)
    : body_(body),
      frame_s_(frame_s),
      settings_(valid(settings)),
      transient_frames_(frames_in(settings.transient_s, frame_s)),
      window_frames_(std::max<std::int64_t>(1, frames_in(settings.window_s, frame_s))),
      travel_(body.com_start_m, start_of(body), frame_s),
      raw_touch_(body.legs.size()),
      raw_touchdowns_(body.legs.size()),
      late_raw_touchdowns_(body.legs.size()),
      filters_(body.legs.size(), ContactFilter(static_cast<int>(frames_in(settings.debounce_s, frame_s)))),
      com_m_(body.com_start_m),
      tracker_(body.legs.size(), frames_in(settings.longest_stride_s, frame_s)),
      total_(body.legs.size()),
      open_(stretch_from_here()),
      drifts_(body.legs.size(), std::vector<PhaseDrift>(body.legs.size())) {}

void Meter::add(const Frame& frame) {
  AMBLE_CHECK(frame.touch.size() == body_.legs.size(), "one touch per leg");
  const bool first = travel_.frames() == 0, late = travel_.frames() >= transient_frames_;
  travel_.add(frame.com_m, frame.angle_rad, frame.torque_nm);
  pending_com_m_.push_back(frame.com_m);
  std::vector<bool> settled;
  for (std::size_t leg = 0; leg < filters_.size(); ++leg) {
    const bool touch = frame.touch[leg] > 0.5f;
    const bool lands = touch && !raw_touch_[leg] && !first;
    raw_touchdowns_[leg] += lands;
    late_raw_touchdowns_[leg] += lands && late;
    raw_touch_[leg] = touch;
    if (const auto value = filters_[leg].add(touch)) settled.push_back(*value);
  }
  if (!settled.empty()) add_debounced(settled);
}

Report Meter::finish(record::Outcome outcome) {
  std::vector<std::vector<bool>> rest;
  for (const ContactFilter& filter : filters_) rest.push_back(filter.finish());
  for (std::size_t k = 0; !rest.empty() && k < rest[0].size(); ++k) {
    std::vector<bool> touch(rest.size());
    for (std::size_t leg = 0; leg < rest.size(); ++leg) touch[leg] = rest[leg][k];
    add_debounced(touch);
  }
  // An unfinished window is too short to be classified by itself: it becomes part of the last one.
  if (last_) {
    last_->merge(open_);
    close_window(std::move(*last_));
  } else if (open_.sums.frames > 0) {
    close_window(std::move(open_));
  }

  Report report;
  report.robot = body_.robot;
  report.outcome = outcome;
  report.seconds = static_cast<double>(travel_.frames()) * frame_s_;
  report.settings = settings_;
  report_footfalls(report);
  report_travel(report);
  return report;
}

Stretch Meter::stretch_from_here() const {
  return {.first_frame = frames_,
          .sums = StrideSums(body_.legs.size()),
          .com_begin_m = com_m_,
          .com_end_m = com_m_,
          .tally = {}};
}

/// The next frame whose debounced contacts are known.
void Meter::add_debounced(const std::vector<bool>& touch) {
  com_m_ = pending_com_m_.front();
  pending_com_m_.pop_front();
  if (++frames_ <= transient_frames_) {
    open_ = stretch_from_here();
    return;
  }
  tracker_.add(touch, open_.sums);
  open_.com_end_m = com_m_;
  if (!window_is_full()) return;
  if (last_) close_window(std::move(*last_));
  last_ = std::exchange(open_, stretch_from_here());
}

/// A window is extended until each foot has made the strides that a classification needs; feet at rest do not
/// extend it.
bool Meter::window_is_full() const {
  if (open_.sums.frames < window_frames_) return false;
  if (open_.sums.frames >= longest_window * window_frames_) return true;
  for (std::size_t leg = 0; leg < body_.legs.size(); ++leg)
    if (open_.sums.legs[leg].strides < min_strides && tracker_.in_stride(leg)) return false;
  return true;
}

/// Classifies a window that is complete.
void Meter::close_window(Stretch window) {
  const double middle_s =
      (static_cast<double>(window.first_frame) + 0.5 * static_cast<double>(window.sums.frames)) * frame_s_;
  for (std::size_t i = 0; i < drifts_.size(); ++i) {
    for (std::size_t j = 0; j < drifts_.size(); ++j) {
      const CircularSum& phases = window.sums.phases[i][j];
      if (phases.resultant() >= min_drift_resultant) drifts_[i][j].add(middle_s, phases.mean());
    }
  }
  if (const auto found = classification(window.sums)) window.tally.add(*found, window.sums.frames);
  total_.merge(window.sums);
  windows_.add(std::move(window));
}

}  // namespace amble::gait
