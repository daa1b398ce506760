// Meter: from sums to the report.
#include <algorithm>
#include <cmath>

#include "amble/core/index.hpp"
#include "amble/gait/meter.hpp"

namespace amble::gait {
namespace {

/// With two windows the regression line would always fit exactly.
constexpr std::int64_t min_drift_windows = 3;

std::optional<double> duty_factor(const LegSums& leg) {
  if (leg.strides == 0) return std::nullopt;
  return static_cast<double>(leg.stance_frames) / static_cast<double>(leg.stride_frames);
}

PairPhase pair_phase(const CircularSum& sum) {
  return {sum.count() == 0 ? 0.0 : sum.mean(), sum.resultant(), sum.count()};
}

std::optional<PairPhase> known_phase(const StrideSums& sums, int reference, std::size_t leg) {
  if (reference < 0 || sums.phases[to_index(reference)][leg].count() == 0) return std::nullopt;
  return pair_phase(sums.phases[to_index(reference)][leg]);
}

/// Mean over the legs that have a value; none if no leg has.
template <typename Get>
std::optional<double> mean(const std::vector<LegGait>& legs, Get get) {
  double sum = 0.0;
  int count = 0;
  for (const LegGait& leg : legs) {
    const std::optional<double> value = get(leg);
    if (!value) continue;
    sum += *value;
    ++count;
  }
  if (count == 0) return std::nullopt;
  return sum / count;
}

}  // namespace

std::optional<QuadrupedPhases> Meter::quadruped_phases(const StrideSums& sums) const {
  if (!body_.quadruped) return std::nullopt;
  const auto [fore_left, fore_right, hind_left, hind_right] = *body_.quadruped;
  const auto sum = [&](int leg, int other) { return sums.phases[to_index(leg)][to_index(other)]; };
  CircularSum lateral = sum(hind_left, fore_left);
  lateral.merge(sum(hind_right, fore_right));
  QuadrupedPhases phases{.hind = pair_phase(sum(hind_left, hind_right)),
                         .fore = pair_phase(sum(fore_left, fore_right)),
                         .left = pair_phase(sum(hind_left, fore_left)),
                         .right = pair_phase(sum(hind_right, fore_right)),
                         .lateral = lateral.count() == 0 ? 0.0 : lateral.mean()};
  for (std::size_t leg = 0; leg < 4; ++leg) phases.strides[leg] = sums.legs[leg].strides;
  return phases;
}

std::optional<HexapodPhases> Meter::hexapod_phases(const StrideSums& sums) const {
  if (body_.pairs.size() != 3) return std::nullopt;
  HexapodPhases phases;
  CircularSum lags;
  std::size_t lag = 0, leg = 0;
  for (std::size_t i = 0; i < 3; ++i)
    phases.pairs[i] = pair_phase(sums.phases[to_index(body_.pairs[i].left)][to_index(body_.pairs[i].right)]);
  for (const auto side : {&robot::LegPair::left, &robot::LegPair::right}) {
    for (std::size_t hind = 2; hind > 0; --hind) {
      const CircularSum& sum =
          sums.phases[to_index(body_.pairs[hind].*side)][to_index(body_.pairs[hind - 1].*side)];
      phases.lags[lag++] = pair_phase(sum);
      lags.merge(sum);
    }
  }
  phases.lag = lags.count() == 0 ? 0.0 : lags.mean();
  for (const LegSums& each : sums.legs) phases.strides[leg++] = each.strides;
  return phases;
}

std::optional<BipedPhases> Meter::biped_phases(const StrideSums& sums) const {
  if (body_.pairs.size() != 1) return std::nullopt;
  const auto left = to_index(body_.pairs[0].left), right = to_index(body_.pairs[0].right);
  return BipedPhases{.pair = pair_phase(sums.phases[left][right]),
                     .duty_factor = 0.5 * (duty_factor(sums.legs[left]).value_or(0.0) +
                                           duty_factor(sums.legs[right]).value_or(0.0)),
                     .strides = {sums.legs[left].strides, sums.legs[right].strides}};
}

std::optional<Classification> Meter::classification(const StrideSums& sums) const {
  if (const auto phases = quadruped_phases(sums)) return classify(*phases);
  if (const auto phases = hexapod_phases(sums)) return classify(*phases);
  if (const auto phases = biped_phases(sums)) return classify(*phases);
  return std::nullopt;
}

/// The left hind foot, as in Hildebrand 1965, or the first foot that strides enough; −1 if none does.
int Meter::reference_leg() const {
  std::vector<int> order;
  if (body_.quadruped)
    order = {body_.quadruped->hind_left, body_.quadruped->hind_right, body_.quadruped->fore_left,
             body_.quadruped->fore_right};
  for (auto pair = body_.pairs.rbegin(); pair != body_.pairs.rend(); ++pair)
    order.insert(order.end(), {pair->left, pair->right});
  if (order.empty())
    for (std::size_t leg = 0; leg < body_.legs.size(); ++leg) order.push_back(static_cast<int>(leg));
  for (const std::int64_t enough : {min_strides, std::int64_t{1}})
    for (const int leg : order)
      if (total_.legs[to_index(leg)].strides >= enough) return leg;
  return -1;
}

LegGait Meter::leg_gait(std::size_t leg, int reference) const {
  const LegSums& sums = total_.legs[leg];
  LegGait gait;
  gait.name = body_.legs[leg];
  if (total_.frames > 0)
    gait.contact_share = static_cast<double>(sums.contact_frames) / static_cast<double>(total_.frames);
  gait.raw_touchdowns = raw_touchdowns_[leg];
  gait.late_raw_touchdowns = late_raw_touchdowns_[leg];
  gait.touchdowns = sums.touchdowns;
  gait.strides = sums.strides;
  if (sums.strides > 0) {
    const auto n = static_cast<double>(sums.strides);
    const double mean_frames = static_cast<double>(sums.stride_frames) / n;
    const double variance = std::max(0.0, sums.squared_stride_frames / n - mean_frames * mean_frames);
    gait.stride_s = mean_frames * frame_s_;
    gait.stride_sd_s = std::sqrt(variance) * frame_s_;
    gait.duty_factor = duty_factor(sums);
  }
  gait.phase = known_phase(total_, reference, leg);
  if (reference >= 0) {
    const PhaseDrift& drift = drifts_[to_index(reference)][leg];
    if (drift.count() >= min_drift_windows) {
      gait.drift_strides = drift.turns();
      gait.drift_per_min = 60.0 * drift.turns_per_s();
    }
  }
  return gait;
}

Window Meter::window(const Stretch& stretch, int reference) const {
  const Vec3 moved = stretch.com_end_m - stretch.com_begin_m;
  const double seconds = static_cast<double>(stretch.sums.frames) * frame_s_;
  Window window;
  window.start_s = static_cast<double>(stretch.first_frame) * frame_s_;
  window.end_s = static_cast<double>(stretch.first_frame + stretch.sums.frames) * frame_s_;
  window.classification = stretch.tally.longest();
  window.speed_m_s = std::hypot(moved.x, moved.y) / seconds;
  for (std::size_t leg = 0; leg < body_.legs.size(); ++leg) {
    window.duty_factors.push_back(duty_factor(stretch.sums.legs[leg]));
    window.phases.push_back(known_phase(stretch.sums, reference, leg));
  }
  return window;
}

void Meter::report_footfalls(Report& report) const {
  report.classification = classification(total_);
  report.quadruped = quadruped_phases(total_);
  report.hexapod = hexapod_phases(total_);
  report.biped = biped_phases(total_);
  report.reference_leg = reference_leg();
  for (std::size_t leg = 0; leg < body_.legs.size(); ++leg)
    report.legs.push_back(leg_gait(leg, report.reference_leg));
  report.duty_factor = mean(report.legs, [](const LegGait& leg) { return leg.duty_factor; });
  report.stride_s = mean(report.legs, [](const LegGait& leg) { return leg.stride_s; });

  ClassificationTally tally;
  for (const Stretch& stretch : windows_.list()) {
    report.windows.push_back(window(stretch, report.reference_leg));
    tally.merge(stretch.tally);
  }
  if (!report.classification) return;
  for (std::size_t gait = 0; gait < gait_names.size(); ++gait)
    report.gait_seconds.push_back(static_cast<double>(tally.frames(static_cast<Gait>(gait))) * frame_s_);
}

void Meter::report_travel(Report& report) const {
  report.distance_m = travel_.distance_m();
  report.path_m = travel_.path_m();
  if (report.seconds > 0.0) {
    report.speed_m_s = report.distance_m / report.seconds;
    report.path_speed_m_s = report.path_m / report.seconds;
  }
  report.leg_length_m = body_.leg_length_m;
  report.mass_kg = body_.mass_kg;
  const double gl = body_.gravity_m_s2 * body_.leg_length_m;
  if (gl > 0.0) report.froude = report.path_speed_m_s * report.path_speed_m_s / gl;
  report.work = travel_.work();
  if (report.path_m <= 0.0) return;
  report.straightness = std::min(1.0, report.distance_m / report.path_m);
  const double lifted_j = body_.mass_kg * body_.gravity_m_s2 * report.path_m;
  if (report.work && lifted_j > 0.0) {
    report.cost_of_transport_positive = report.work->positive_j / lifted_j;
    report.cost_of_transport_absolute = report.work->absolute_j / lifted_j;
  }
}

}  // namespace amble::gait
