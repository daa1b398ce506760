#include "amble/score/score.hpp"

#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>

#include "amble/core/check.hpp"
#include "amble/core/error.hpp"
#include "amble/core/index.hpp"
#include "amble/core/registry.hpp"
#include "amble/io/settings_text.hpp"
#include "amble/score/tracking.hpp"

namespace amble::score {
namespace {

/// In a straight line over the ground, in any direction.
double distance(const record::Trajectory& trajectory, const Context&) {
  return distance_m(trajectory);
}

double displacement_m(const record::Trajectory& trajectory, double angle_deg) {
  const Vec3 moved = trajectory.com_end_m - trajectory.com_start_m;
  return along(turned(trajectory, angle_deg), moved.x, moved.y);
}

/// Displacement along the robot's own forward axis at the start; backwards counts negative.
double forward(const record::Trajectory& trajectory, const Context&) {
  return displacement_m(trajectory, 0.0);
}

/// The same of the root's frame instead of the centre of mass.
double root_forward(const record::Trajectory& trajectory, const Context&) {
  const Vec3 moved = trajectory.root_end_m - trajectory.root_start_m;
  return along(turned(trajectory, 0.0), moved.x, moved.y);
}

/// Displacement along the heading of the settings.
double heading(const record::Trajectory& trajectory, const Context& context) {
  return displacement_m(trajectory, context.settings.heading_deg);
}

/// 1 at the speed wanted, falling linearly to 0 at none and at twice that speed.
double closeness(double speed_m_s, double wanted_m_s) {
  return std::max(0.0, 1.0 - std::abs(speed_m_s - wanted_m_s) / wanted_m_s);
}

/// Mean over the whole seconds of a trial that completes of how close to the one wanted the speed along the
/// heading is; a second that the trial does not complete adds 0. A trial of less than a second is one window.
double speed_kept(const record::Trajectory& trajectory, const Context& context) {
  const double wanted_m_s = context.settings.speed_m_s;
  const int seconds = record::second_count(context.duration_s);
  if (seconds == 0) return closeness(heading(trajectory, context) / context.duration_s, wanted_m_s);
  const Direction direction = turned(trajectory, context.settings.heading_deg);
  double sum = 0.0, before_m = 0.0;
  for (std::size_t i = 0; i + 1 < trajectory.com_by_second_m.size(); i += 2) {
    const double now_m = along(direction, trajectory.com_by_second_m[i], trajectory.com_by_second_m[i + 1]);
    sum += closeness(now_m - before_m, wanted_m_s);
    before_m = now_m;
  }
  return sum / seconds;
}

/// Inverse of the cost of transport: weight × distance / energy. 0 for a robot that spent nothing.
double economy(const record::Trajectory& trajectory, const Context& context) {
  if (trajectory.energy_j <= 0.0) return 0.0;
  return context.weight_n * distance_m(trajectory) / trajectory.energy_j;
}

/// Mean cosine of the angle between the root's z axis and the vertical, over the steps until the trial ended.
double uprightness(const record::Trajectory& trajectory, const Context&) {
  return trajectory.steps > 0 ? trajectory.upright_steps / trajectory.steps : 0.0;
}

/// Share of the trial's length before a fall.
double upright_time(const record::Trajectory& trajectory, const Context& context) {
  return trajectory.seconds() / context.duration_s;
}

/// Displacement to the left of the robot's own forward axis at the start.
double sideways(const record::Trajectory& trajectory, const Context&) {
  return displacement_m(trajectory, 90.0);
}

/// How far the robot has turned to the left from the start to the end.
double turn(const record::Trajectory& trajectory, const Context&) {
  const Direction before{trajectory.forward_x, trajectory.forward_y};
  const Direction after{trajectory.forward_end_x, trajectory.forward_end_y};
  return angle_deg({before.x * after.x + before.y * after.y, before.x * after.y - before.y * after.x});
}

/// Share of the steps in which a foot touched something.
double duty_factor(const record::Trajectory& trajectory, const Context& context) {
  const std::vector<int>& steps = trajectory.contact_steps;
  if (trajectory.steps == 0 || steps.empty()) return 0.0;
  if (context.leg >= 0) return 1.0 * steps[to_index(context.leg)] / trajectory.steps;
  double sum = 0.0;
  for (const int of_leg : steps) sum += of_leg;
  return sum / static_cast<double>(steps.size()) / trajectory.steps;
}

/// The share of the first leg's stride that has passed when a leg's foot comes down, its circular mean over
/// footfalls in whole strides, 0 … 1; 0 without any.
double phase_of(const std::vector<int>& first, const std::vector<int>& leg) {
  Direction sum{0.0, 0.0};
  std::size_t next = 0;
  for (std::size_t stride = 0; stride + 1 < first.size(); ++stride) {
    const int start = first[stride], end = first[stride + 1];
    while (next < leg.size() && leg[next] < start) ++next;
    for (; next < leg.size() && leg[next] < end; ++next) {
      const Direction at = unit_direction(360.0 * (leg[next] - start) / (end - start));
      sum = {sum.x + at.x, sum.y + at.y};
    }
  }
  const double phase = angle_deg(sum) / 360.0;
  return phase < 0.0 ? phase + 1.0 : phase;
}

double phase(const record::Trajectory& trajectory, const Context& context) {
  const auto& steps = trajectory.footfall_steps;
  if (steps.empty()) return 0.0;
  if (context.leg >= 0) return phase_of(steps.front(), steps[to_index(context.leg)]);
  double sum = 0.0;
  for (const auto& of_leg : steps) sum += phase_of(steps.front(), of_leg);
  return sum / static_cast<double>(steps.size());
}

/// Mean height of the root's centre of mass over the ground below it.
double height(const record::Trajectory& trajectory, const Context&) {
  return trajectory.steps > 0 ? trajectory.height_steps_m / trajectory.steps : 0.0;
}

double energy(const record::Trajectory& trajectory, const Context&) {
  return trajectory.energy_j;
}

double effort(const record::Trajectory& trajectory, const Context&) {
  return trajectory.effort_steps;
}

/// The same for each trial: shifts a score that would fall below 0 and stay there.
double constant(const record::Trajectory&, const Context&) {
  return 1.0;
}

constexpr double infinite = std::numeric_limits<double>::infinity();
constexpr io::Range signed_range{-infinite, infinite}, positive_range{0.0, infinite}, share_range{0.0, 1.0};

// amble's own quantities. A new one is a row here; if trials must measure something for it, also a member of
// record::Measures and record::Trajectory.
Registry<Quantity>& all_quantities() {
  static Registry<Quantity> all("quantity",
                                {{"distance", "m", positive_range, {}, distance},
                                 {"forward", "m", signed_range, {}, forward},
                                 {"heading", "m", signed_range, {}, heading},
                                 {"sideways", "m", signed_range, {}, sideways},
                                 {"turn", "deg", {-180.0, 180.0}, {}, turn, false, true},
                                 {"speed_kept", "", share_range, {.seconds = true}, speed_kept},
                                 {"energy", "J", positive_range, {.energy = true}, energy},
                                 {"economy", "", positive_range, {.energy = true}, economy},
                                 {"uprightness", "", {-1.0, 1.0}, {.uprightness = true}, uprightness},
                                 {"upright_time", "", share_range, {}, upright_time},
                                 {"duty_factor", "", share_range, {.contacts = true}, duty_factor, true},
                                 {"phase", "", share_range, {.footfalls = true}, phase, true, true},
                                 {"height", "m", signed_range, {.height = true}, height},
                                 {"root_forward", "m", signed_range, {.root = true}, root_forward},
                                 {"effort", "", positive_range, {.effort = true}, effort},
                                 {"constant", "", {1.0, 1.0}, {}, constant},
                                 {"yaw_rate", "rad/s", signed_range, {.headings = true}, yaw_rate},
                                 {"own_speed", "m/s", signed_range, own_speed_measures, own_speed},
                                 {"speed_error", "m/s", positive_range, tracking_measures, speed_error},
                                 {"turn_error", "rad/s", positive_range, tracking_measures, turn_error},
                                 {"heading_error", "rad", positive_range, tracking_measures, heading_error},
                                 {"tracking", "", share_range, tracking_measures, tracking}});
  return all;
}

const Quantity* find(std::string_view name) {
  return all_quantities().find(name);
}

std::string names() {
  std::vector<std::string_view> all;
  for (const Quantity& quantity : quantities()) all.push_back(quantity.name);
  return fmt::format("{}", fmt::join(all, ", "));
}

constexpr double unbounded = 1e9;

}  // namespace

void Term::describe(io::SettingsVisitor& visitor) {
  static const std::string what = "one of " + names() + " (docs/SCORES.md)";
  visitor.text("quantity", quantity, {what});
  visitor.number("weight", weight, {-1e6, 1e6}, {"value of one unit of it"});
}

void Limit::describe(io::SettingsVisitor& visitor) {
  visitor.text("quantity", quantity, {"as in score.terms"});
  visitor.number("least", least, {-unbounded, unbounded}, {"not below this"});
  visitor.number("most", most, {-unbounded, unbounded}, {"not above this"});
}

void TrackingSettings::describe(io::SettingsVisitor& visitor) {
  visitor.number("speed_m_s", speed_m_s, {1e-6, 1e3},
                 {"an error of speed as large as this counts 0 where a slower speed is commanded, m/s"});
  visitor.number("turn_rad_s", turn_rad_s, {1e-6, 1e3},
                 {"an error of turning as large as this counts 0 where a slower turn is commanded, rad/s"});
}

void Settings::describe(io::SettingsVisitor& visitor) {
  visitor.tables("terms", terms,
                 {"the score is the sum of these, at least 0", "Morse et al. 2013, sec. 4: distance"});
  visitor.tables("limits", limits, {"what a trial must keep to"});
  visitor.number("breach_factor", breach_factor, {0.0, 1.0},
                 {"share of the score kept by a trial that breaks a limit"});
  visitor.number(
      "heading_deg", heading_deg, {-360.0, 360.0},
      {"which way heading and speed_kept go, degrees to the left of the robot's forward axis at the "
       "start"});
  visitor.number("speed_m_s", speed_m_s, {1e-6, 1e3}, {"speed wanted by speed_kept, m/s"});
  visitor.table("tracking", tracking,
                {.what = "how strictly the quantity tracking judges", .defaults_are_implied = true});
}

void Settings::validate() const {
  if (terms.empty()) fail_setting({"score.terms"}, "score.terms: expected at least one term");
  for (const Term& term : terms) quantity(term.quantity, "score.terms");
  for (const Limit& limit : limits) {
    quantity(limit.quantity, "score.limits");
    if (!(limit.least <= limit.most))
      fail_setting({"score.limits"}, "score.limits: {}: least = {} is above most = {}", limit.quantity,
                   limit.least, limit.most);
  }
}

bool Settings::is_distance() const {
  return limits.empty() && terms.size() == 1 && terms[0].quantity == "distance" && terms[0].weight == 1.0;
}

void register_quantity(Quantity quantity) {
  AMBLE_CHECK(quantity.of, "a quantity needs a function of trials");
  quantity.of = [of = std::move(quantity.of), range = quantity.range](const record::Trajectory& trajectory,
                                                                      const Context& context) {
    const double value = of(trajectory, context);
    AMBLE_CHECK(std::isfinite(value) && io::in_range(range, value), "a quantity is in its range");
    return value;
  };
  all_quantities().add(std::move(quantity));
}

const std::deque<Quantity>& quantities() {
  return all_quantities().rows();
}

const Quantity& quantity(const std::string& name, const std::string& key) {
  const Quantity* const found = find(name);
  if (!found) fail_setting({key}, "{}: quantity \"{}\": expected {}", key, name, names());
  return *found;
}

record::Objective objective_of(const Settings& settings) {
  if (settings.is_distance()) return {};
  const auto is_length = [](const Term& term) {
    return find(term.quantity) && find(term.quantity)->unit == "m";
  };
  return {.is_distance = false,
          .unit = std::ranges::all_of(settings.terms, is_length) ? " m" : "",
          .title = "Score"};
}

std::string described(const Settings& settings) {
  std::string text;
  for (const Term& term : settings.terms) {
    const double weight = std::abs(term.weight);
    const std::string factor = weight == 1.0 ? "" : fmt::format("{:g} × ", weight);
    const char* const sign = term.weight < 0.0 ? (text.empty() ? "−" : " − ") : (text.empty() ? "" : " + ");
    text += fmt::format("{}{}{}", sign, factor, term.quantity);
  }
  return text;
}

std::string with_unit(std::string_view number, const Settings& settings) {
  return fmt::format("{}{}", number, objective_of(settings).unit);
}

double distance_m(const record::Trajectory& trajectory) {
  if (trajectory.outcome == record::Outcome::diverged) return 0.0;
  const Vec3 moved = trajectory.com_end_m - trajectory.com_start_m;
  return std::sqrt(moved.x * moved.x + moved.y * moved.y);
}

double credited(double value, record::Outcome outcome, double fall_factor) {
  return outcome == record::Outcome::fell ? fall_factor * value : value;
}

Score::Score(const Settings& settings, double duration_s, double weight_n)
    : settings_(settings), duration_s_(duration_s), weight_n_(weight_n) {
  settings_.validate();
}

double Score::of(const record::Trajectory& trajectory) const {
  if (trajectory.outcome == record::Outcome::diverged) return 0.0;
  if (settings_.is_distance()) return distance_m(trajectory);
  const Context context{.settings = settings_, .duration_s = duration_s_, .weight_n = weight_n_};
  double sum = 0.0;
  for (const Term& term : settings_.terms) sum += term.weight * find(term.quantity)->of(trajectory, context);
  for (const Limit& limit : settings_.limits) {
    const double value = find(limit.quantity)->of(trajectory, context);
    if (value < limit.least || value > limit.most) sum *= settings_.breach_factor;
  }
  return std::max(0.0, sum);
}

record::Measures Score::measures() const {
  record::Measures all;
  const auto add = [&all](const std::string& quantity) { all |= find(quantity)->measures; };
  for (const Term& term : settings_.terms) add(term.quantity);
  for (const Limit& limit : settings_.limits) add(limit.quantity);
  return all;
}

}  // namespace amble::score
