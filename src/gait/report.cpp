#include "amble/gait/report.hpp"

#include <algorithm>
#include <array>

#include "amble/core/error.hpp"
#include "amble/core/index.hpp"
#include "amble/gait/report_text.hpp"
#include "amble/io/json_file.hpp"

namespace amble::gait {

void Settings::validate() const {
  const auto demand = [](bool fits, const char* name, double value, const char* range) {
    if (!fits) fail(ExitCode::bad_input, "gait: {} = {} s: expected {}", name, value, range);
  };
  demand(debounce_s >= 0.0 && debounce_s <= 1.0, "debounce", debounce_s, "0 to 1 s");
  demand(transient_s >= 0.0 && transient_s <= 1e6, "transient", transient_s, "0 to 1e6 s");
  demand(window_s >= 0.1 && window_s <= 3600.0, "window", window_s, "0.1 to 3600 s");
  demand(longest_stride_s > 0.0 && longest_stride_s <= 3600.0, "longest stride", longest_stride_s,
         "more than 0, at most 3600 s");
}

std::vector<Segment> segments_of(const Report& report) {
  std::vector<Segment> segments;
  for (const Window& window : report.windows) {
    if (!window.classification) continue;
    if (!segments.empty() && segments.back().classification == *window.classification) {
      segments.back().end_s = window.end_s;
    } else {
      segments.push_back({window.start_s, window.end_s, *window.classification});
    }
  }
  return segments;
}

namespace {

using io::Json;

Json json_of(const std::optional<double>& value) {
  return value ? Json(*value) : Json(nullptr);
}

Json json_of(const std::optional<PairPhase>& pair) {
  if (!pair) return nullptr;
  if (pair->count == 0) return {{"phase", nullptr}, {"resultant", nullptr}, {"count", 0}};
  return {{"phase", pair->phase}, {"resultant", pair->resultant}, {"count", pair->count}};
}

Json name_of(const std::optional<Classification>& classification) {
  return classification ? Json(gait_names[to_index(classification->gait)]) : Json(nullptr);
}

Json reason_of(const std::optional<Classification>& classification) {
  if (!classification || classification->reason == Irregular::no) return nullptr;
  return irregular_names[to_index(classification->reason)];
}

Json json_of(const LegGait& leg) {
  return {{"name", leg.name},
          {"contact_share", json_of(leg.contact_share)},
          {"raw_touchdowns", leg.raw_touchdowns},
          {"touchdowns", leg.touchdowns},
          {"strides", leg.strides},
          {"stride_s", json_of(leg.stride_s)},
          {"stride_sd_s", json_of(leg.stride_sd_s)},
          {"duty_factor", json_of(leg.duty_factor)},
          {"phase", json_of(leg.phase)},
          {"drift_strides", json_of(leg.drift_strides)},
          {"drift_per_min", json_of(leg.drift_per_min)}};
}

template <typename T>
Json list_of(const std::vector<T>& items, Json (*one)(const T&)) {
  Json list = Json::array();
  for (const T& item : items) list.push_back(one(item));
  return list;
}

Json json_of(const Window& window) {
  return {{"start_s", window.start_s},
          {"end_s", window.end_s},
          {"gait", name_of(window.classification)},
          {"irregular_reason", reason_of(window.classification)},
          {"speed_m_s", window.speed_m_s},
          {"duty_factors", list_of(window.duty_factors, json_of)},
          {"phases", list_of(window.phases, json_of)}};
}

Json json_of(const Segment& segment) {
  return {{"start_s", segment.start_s},
          {"end_s", segment.end_s},
          {"gait", name_of(segment.classification)},
          {"irregular_reason", reason_of(segment.classification)}};
}

Json pairs_of(const QuadrupedPhases& phases) {
  return {{"hind", json_of(std::optional(phases.hind))},
          {"fore", json_of(std::optional(phases.fore))},
          {"left", json_of(std::optional(phases.left))},
          {"right", json_of(std::optional(phases.right))},
          {"lateral", phases.left.count + phases.right.count > 0 ? Json(phases.lateral) : Json(nullptr)}};
}

Json pairs_of(const HexapodPhases& phases) {
  Json pairs = Json::object();
  constexpr std::array names{"fore",      "middle",       "hind",      "left_middle",
                             "left_fore", "right_middle", "right_fore"};
  for (std::size_t i = 0; i < 3; ++i) pairs[names[i]] = json_of(std::optional(phases.pairs[i]));
  for (std::size_t i = 0; i < 4; ++i) pairs[names[3 + i]] = json_of(std::optional(phases.lags[i]));
  const bool known = std::ranges::any_of(phases.lags, [](const PairPhase& lag) { return lag.count > 0; });
  pairs["lag"] = known ? Json(phases.lag) : Json(nullptr);
  return pairs;
}

Json pairs_of(const Report& report) {
  if (report.quadruped) return pairs_of(*report.quadruped);
  if (report.hexapod) return pairs_of(*report.hexapod);
  if (report.biped) return {{"feet", json_of(std::optional(report.biped->pair))}};
  return nullptr;
}

/// Those of the gaits that a robot with so many legs may have.
Json seconds_of(const Report& report) {
  if (report.gait_seconds.empty()) return nullptr;
  Json seconds = Json::object();
  for (std::size_t gait = 0; gait < report.gait_seconds.size(); ++gait)
    if (gait_legs[gait] == 0 || gait_legs[gait] == report.legs.size())
      seconds[std::string(gait_names[gait])] = report.gait_seconds[gait];
  return seconds;
}

Json json_of(const Settings& settings) {
  return {{"debounce_s", settings.debounce_s},
          {"transient_s", settings.transient_s},
          {"window_s", settings.window_s},
          {"longest_stride_s", settings.longest_stride_s}};
}

Json json_of(const SeamReport& seam) {
  return {{"jumps", seam.jumps},
          {"mean_rad", seam.mean_rad},
          {"largest_rad", seam.largest_rad},
          {"power_after_w", json_of(seam.power_after_w)}};
}

}  // namespace

std::string report_json(const Report& report) {
  Json json{{"format", "amble-gait"}, {"version", 1}};
  json["robot"] = report.robot;
  json["outcome"] = record::outcome_names[to_index(report.outcome)];
  json["seconds"] = report.seconds;
  json["settings"] = json_of(report.settings);

  json["gait"] = name_of(report.classification);
  json["irregular_reason"] = reason_of(report.classification);
  json["gait_seconds"] = seconds_of(report);
  json["pairs"] = pairs_of(report);
  json["duty_factor"] = json_of(report.duty_factor);
  json["stride_s"] = json_of(report.stride_s);
  json["reference_leg"] =
      report.reference_leg < 0 ? Json(nullptr) : Json(report.legs[to_index(report.reference_leg)].name);
  json["legs"] = list_of(report.legs, json_of);
  json["segments"] = list_of(segments_of(report), json_of);
  json["windows"] = list_of(report.windows, json_of);

  json["distance_m"] = report.distance_m;
  json["path_m"] = report.path_m;
  json["speed_m_s"] = report.speed_m_s;
  json["path_speed_m_s"] = report.path_speed_m_s;
  json["straightness"] = json_of(report.straightness);
  json["leg_length_m"] = report.leg_length_m;
  json["froude"] = json_of(report.froude);
  json["mass_kg"] = report.mass_kg;
  json["work_positive_j"] = report.work ? Json(report.work->positive_j) : Json(nullptr);
  json["work_absolute_j"] = report.work ? Json(report.work->absolute_j) : Json(nullptr);
  json["cost_of_transport_positive"] = json_of(report.cost_of_transport_positive);
  json["cost_of_transport_absolute"] = json_of(report.cost_of_transport_absolute);
  if (report.seam) json["seam"] = json_of(*report.seam);
  return io::json_text(json);
}

}  // namespace amble::gait
