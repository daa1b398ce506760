#include "amble/analysis/gait_meter.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "amble/core/check.hpp"
#include "amble/core/error.hpp"

namespace amble::analysis {
namespace {

/// Phases of a window that are more scattered than this have no mean worth following.
constexpr double min_drift_resultant = 0.3;

const GaitSettings& valid(const GaitSettings& settings) {
  settings.validate();
  return settings;
}

std::int64_t frames_in(double seconds, double frame_s) {
  return std::llround(seconds / frame_s);
}

}  // namespace

void GaitSettings::validate() const {
  const auto demand = [](bool fits, const char* name, double value, const char* range) {
    if (!fits) fail(ExitCode::bad_input, "gait: {} = {} s: expected {}", name, value, range);
  };
  demand(debounce_s >= 0.0 && debounce_s <= 1.0, "debounce", debounce_s, "0 to 1 s");
  demand(transient_s >= 0.0 && transient_s <= 1e6, "transient", transient_s, "0 to 1e6 s");
  demand(window_s >= 0.1 && window_s <= 3600.0, "window", window_s, "0.1 to 3600 s");
  demand(longest_stride_s > 0.0 && longest_stride_s <= 3600.0, "longest stride", longest_stride_s,
         "more than 0, at most 3600 s");
}

GaitMeter::GaitMeter(const GaitBody& body, double frame_s, const GaitSettings& settings)
    : body_(body),
      frame_s_(frame_s),
      settings_(valid(settings)),
      transient_frames_(frames_in(settings.transient_s, frame_s)),
      window_frames_(std::max<std::int64_t>(1, frames_in(settings.window_s, frame_s))),
      travel_(body.com_start_m, body.joints.size(), frame_s),
      raw_touch_(body.legs.size()),
      raw_touchdowns_(body.legs.size()),
      filters_(body.legs.size(), ContactFilter(static_cast<int>(frames_in(settings.debounce_s, frame_s)))),
      com_m_(body.com_start_m),
      tracker_(body.legs.size(), frames_in(settings.longest_stride_s, frame_s)),
      total_(body.legs.size()),
      open_(stretch_from_here()),
      drifts_(body.legs.size(), std::vector<PhaseDrift>(body.legs.size())) {}

void GaitMeter::add(const GaitFrame& frame) {
  AMBLE_CHECK(frame.touch.size() == body_.legs.size(), "one touch per leg");
  const bool first = travel_.frames() == 0;
  travel_.add(frame.com_m, frame.angle_rad, frame.torque_nm);
  unsettled_com_m_.push_back(frame.com_m);
  std::vector<bool> settled;
  for (std::size_t leg = 0; leg < filters_.size(); ++leg) {
    const bool touch = frame.touch[leg] > 0.5f;
    raw_touchdowns_[leg] += touch && !raw_touch_[leg] && !first;
    raw_touch_[leg] = touch;
    if (const auto value = filters_[leg].add(touch)) settled.push_back(*value);
  }
  if (!settled.empty()) settle(settled);
}

GaitReport GaitMeter::finish(record::Outcome outcome) {
  std::vector<std::vector<bool>> rest;
  for (const ContactFilter& filter : filters_) rest.push_back(filter.finish());
  for (std::size_t k = 0; !rest.empty() && k < rest[0].size(); ++k) {
    std::vector<bool> touch(rest.size());
    for (std::size_t leg = 0; leg < rest.size(); ++leg) touch[leg] = rest[leg][k];
    settle(touch);
  }
  // What is left over is too short to be judged alone: the last window takes it.
  if (last_) {
    last_->merge(open_);
    book(std::move(*last_));
  } else if (open_.sums.frames > 0) {
    book(std::move(open_));
  }

  GaitReport report;
  report.robot = body_.robot;
  report.outcome = outcome;
  report.seconds = static_cast<double>(travel_.frames()) * frame_s_;
  report.settings = settings_;
  report_footfalls(report);
  report_travel(report);
  return report;
}

Stretch GaitMeter::stretch_from_here() const {
  return {.first_frame = frames_,
          .sums = StrideSums(body_.legs.size()),
          .com_begin_m = com_m_,
          .com_end_m = com_m_,
          .tally = {}};
}

/// The next frame whose touches are certain.
void GaitMeter::settle(const std::vector<bool>& touch) {
  com_m_ = unsettled_com_m_.front();
  unsettled_com_m_.pop_front();
  if (++frames_ <= transient_frames_) {
    open_ = stretch_from_here();
    return;
  }
  tracker_.add(touch, open_.sums);
  open_.com_end_m = com_m_;
  if (!window_is_full()) return;
  if (last_) book(std::move(*last_));
  last_ = std::exchange(open_, stretch_from_here());
}

/// Slow feet get the time for the strides that a name needs, feet at rest are not waited for.
bool GaitMeter::window_is_full() const {
  if (open_.sums.frames < window_frames_) return false;
  if (open_.sums.frames >= longest_window * window_frames_) return true;
  for (std::size_t leg = 0; leg < body_.legs.size(); ++leg)
    if (open_.sums.legs[leg].strides < min_strides && tracker_.in_stride(leg)) return false;
  return true;
}

/// Judges a window that will not grow any more.
void GaitMeter::book(Stretch window) {
  const double middle_s =
      (static_cast<double>(window.first_frame) + 0.5 * static_cast<double>(window.sums.frames)) * frame_s_;
  for (std::size_t i = 0; i < drifts_.size(); ++i) {
    for (std::size_t j = 0; j < drifts_.size(); ++j) {
      const CircularSum& phases = window.sums.phases[i][j];
      if (phases.resultant() >= min_drift_resultant) drifts_[i][j].add(middle_s, phases.mean());
    }
  }
  if (const auto name = verdict(window.sums)) window.tally.add(*name, window.sums.frames);
  total_.merge(window.sums);
  windows_.add(std::move(window));
}

}  // namespace amble::analysis
