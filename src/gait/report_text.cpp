#include "amble/gait/report_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>

#include "amble/core/index.hpp"

namespace amble::gait {
namespace {

constexpr std::size_t most_segment_lines = 12;

using Text = std::back_insert_iterator<std::string>;

std::string words(const Classification& classification) {
  std::string name(gait_names[to_index(classification.gait)]);
  if (classification.reason == Irregular::no) return name;
  return fmt::format("{} ({})", name, irregular_names[to_index(classification.reason)]);
}

/// "0.57", or "–" without a value.
std::string number(const std::optional<double>& value, int decimals) {
  return value ? fmt::format("{:.{}f}", *value, decimals) : "–";
}

/// "walking", "running" or, where two decimals cannot tell them apart, neither; with the duty factor and
/// stride.
std::string footwork(const Report& report) {
  if (!report.duty_factor) return "no strides";
  const double stride_s = report.stride_s.value_or(0.0);
  if (std::abs(*report.duty_factor - 0.5) < 0.0051)
    return fmt::format("between walking and running (duty factor {:.3f}), stride {:.2f} s",
                       *report.duty_factor, stride_s);
  return fmt::format("{} (duty factor {:.2f}), stride {:.2f} s",
                     *report.duty_factor > 0.5 ? "walking" : "running", *report.duty_factor, stride_s);
}

/// The gait's name, if gaits of such legs have names, and how the feet go.
std::string headline(const Report& report) {
  if (!report.classification) return footwork(report);
  return fmt::format("{}; {}", words(*report.classification), footwork(report));
}

/// "0.52 (R 0.97)", or "–" for feet that have not both landed.
std::string pair_text(const PairPhase& pair) {
  return pair.count == 0 ? "–" : fmt::format("{:.2f} (R {:.2f})", pair.phase, pair.resultant);
}

std::string froude(const Report& report) {
  return report.froude ? fmt::format("{:.2g}", *report.froude) : "–";
}

std::string cost(const Report& report) {
  if (!report.work) return "not known (no motor torques)";
  if (!report.cost_of_transport_positive) return "not known (went nowhere)";
  return fmt::format("{:.2f} (motors' positive work), {:.2f} (braking counted too)",
                     *report.cost_of_transport_positive, *report.cost_of_transport_absolute);
}

void print_legs(const Report& report, Text text) {
  // Why a foot makes no strides. Where all counts, the first landing is that of the robot that was put down.
  const bool nothing_counts = report.seconds <= report.settings.transient_s;
  const std::int64_t first_landing = report.settings.transient_s > 0.0 ? 0 : 1;
  const auto note = [&](const LegGait& leg) {
    if (leg.touchdowns > 0) return "";
    if (nothing_counts || !leg.contact_share) return "  all of it is --transient";
    const bool chatters = leg.late_raw_touchdowns > first_landing;
    if (*leg.contact_share == 1.0) return chatters ? "  lifts for less than --debounce" : "  never lifts";
    if (*leg.contact_share == 0.0) return chatters ? "  touches for less than --debounce" : "  never lands";
    return "  lifts, and does not land again";
  };
  fmt::format_to(text,
                 "\nleg    lands (sensor)  strides  stride s     sd  duty  ground  phase     R  drift/min\n");
  for (const LegGait& leg : report.legs) {
    const auto phase = leg.phase ? std::optional(leg.phase->phase) : std::nullopt,
               resultant = leg.phase ? std::optional(leg.phase->resultant) : std::nullopt;
    fmt::format_to(text, "{:<5} {:>6} {:>8}  {:>7}  {:>8}  {:>5}  {:>4}  {:>6}  {:>5}  {:>4}  {:>9}{}\n",
                   leg.name, leg.touchdowns, fmt::format("({})", leg.raw_touchdowns), leg.strides,
                   number(leg.stride_s, 2), number(leg.stride_sd_s, 2), number(leg.duty_factor, 2),
                   leg.contact_share ? fmt::format("{:.0f}%", 100.0 * *leg.contact_share) : "–",
                   number(phase, 2), number(resultant, 2), number(leg.drift_per_min, 3), note(leg));
  }
  if (report.reference_leg >= 0)
    fmt::format_to(text, "phase: touch-downs after those of {}, in its strides\n",
                   report.legs[to_index(report.reference_leg)].name);
}

/// The phases that the name comes from.
void print_pairs(const Report& report, Text text) {
  if (report.quadruped) {
    const QuadrupedPhases& q = *report.quadruped;
    fmt::format_to(text, "pairs: hind {}, fore {}; fore after hind, left {}, right {}\n", pair_text(q.hind),
                   pair_text(q.fore), pair_text(q.left), pair_text(q.right));
  }
  if (report.hexapod) {
    const auto& [pairs, lags, lag, strides] = *report.hexapod;
    fmt::format_to(text, "pairs: fore {}, middle {}, hind {}\n", pair_text(pairs[0]), pair_text(pairs[1]),
                   pair_text(pairs[2]));
    fmt::format_to(text,
                   "lags after the leg behind: left middle {}, left fore {}, right middle {}, right fore {}; "
                   "mean {:.2f}\n",
                   pair_text(lags[0]), pair_text(lags[1]), pair_text(lags[2]), pair_text(lags[3]), lag);
  }
  if (report.biped) fmt::format_to(text, "pair: right after left {}\n", pair_text(report.biped->pair));
}

/// When the gait changed, if it did. Within merged windows only the total times are known.
void print_segments(const Report& report, Text text) {
  const auto segments = segments_of(report);
  if (segments.size() >= 2) {
    fmt::format_to(text, "\ngait by windows\n");
    for (std::size_t i = 0; i < std::min(segments.size(), most_segment_lines); ++i)
      fmt::format_to(text, "{:>9.1f} … {:.1f} s  {}\n", segments[i].start_s, segments[i].end_s,
                     words(segments[i].classification));
    if (segments.size() > most_segment_lines)
      fmt::format_to(text, "          … and {} more (--json has them)\n",
                     segments.size() - most_segment_lines);
  }
  if (std::ranges::count_if(report.gait_seconds, [](double seconds) { return seconds > 0.0; }) < 2) return;
  fmt::format_to(text, "\nwindows  ");
  for (std::size_t gait = 0; gait < report.gait_seconds.size(); ++gait)
    if (report.gait_seconds[gait] > 0.0)
      fmt::format_to(text, " {} {:.0f} s", gait_names[gait], report.gait_seconds[gait]);
  fmt::format_to(text, "\n");
}

}  // namespace

std::string report_summary(const Report& report) {
  std::string summary;
  Text text(summary);
  fmt::format_to(text, "gait      {}\n", headline(report));
  if (report.reference_leg >= 0) {
    fmt::format_to(text, "phases   ");
    for (const LegGait& leg : report.legs)
      if (leg.phase)
        fmt::format_to(text, " {} {:.2f} (R {:.2f})", leg.name, leg.phase->phase, leg.phase->resultant);
    fmt::format_to(text, "\n");
  }
  fmt::format_to(text, "Froude    {}\ntransport {}\n", froude(report), cost(report));
  return summary;
}

std::string report_table(const Report& report) {
  std::string table;
  Text text(table);
  fmt::format_to(text, "robot      {}, {:.2f} s, {}\n", report.robot, report.seconds,
                 record::outcome_names[to_index(report.outcome)]);
  fmt::format_to(text, "gait       {}\n", headline(report));
  print_legs(report, text);
  if (report.duty_factor) print_pairs(report, text);
  if (!report.classification)
    fmt::format_to(text, "gaits have names for four legs, two behind two, and for two or six in pairs\n");
  print_segments(report, text);
  fmt::format_to(text,
                 "\nspeed      {:.3f} m/s ({:.3f} m in a straight line)\npath speed {:.3f} m/s ({:.3f} m, "
                 "straightness {})\n",
                 report.speed_m_s, report.distance_m, report.path_speed_m_s, report.path_m,
                 number(report.straightness, 2));
  fmt::format_to(text, "Froude     {} (path speed, leg length {:.3f} m)\ncost of transport {}\n",
                 froude(report), report.leg_length_m, cost(report));
  if (report.seam && report.seam->jumps > 0) {
    const SeamReport& seam = *report.seam;
    fmt::format_to(text, "seam       {} jumps of targets, {:.3f} rad on average, {:.3f} rad at most{}\n",
                   seam.jumps, seam.mean_rad, seam.largest_rad,
                   seam.power_after_w ? fmt::format("; {:.3g} W in 0.1 s after", *seam.power_after_w) : "");
  }
  return table;
}

}  // namespace amble::gait
