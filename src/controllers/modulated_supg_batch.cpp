#include "amble/controllers/modulated_supg_batch.hpp"

#include <algorithm>
#include <numeric>
#include <utility>

#include "amble/controllers/supg_targets.hpp"
#include "amble/core/check.hpp"
#include "amble/core/index.hpp"

namespace amble::controllers {
namespace {

constexpr std::int32_t stopped = -1;

/// All bits of a condition.
constexpr std::int32_t bits_if(bool condition) {
  return -static_cast<std::int32_t>(condition);
}
}  // namespace

ModulatedSupgBatch::ModulatedSupgBatch(ModulatedSupgs supgs, ModulatedParameters parked, int lanes)
    : supgs_(std::move(supgs)), parked_(std::move(parked)), lanes_(lanes) {
  AMBLE_CHECK(lanes > 0, "a batch has at least one lane");
  const SupgSettings& settings = supgs_.settings;
  period_ = parked_.period_ticks() * parts_per_tick;
  start_ = settings.start_tick * parts_per_tick;
  const CycleRule rule = cycle_rule(settings, parked_.period_ticks());
  rules_ = {.period = period_,
            .end_of_cycle = rule.end < 0 ? stopped : period_,
            .wraps = bits_if(rule.end == 0),  // by as much as the timer is beyond the period
            .airborne_needed = rule.airborne_ticks_needed,
            .by_touch = bits_if(rule.by_touch),
            .phase = bits_if(settings.offset == Offset::phase),
            .refractory = settings.modulation.refractory_ticks};
  reset_share_ = reset_share(settings.modulation);
  shapes_ = settings.modulation.shape > 0.0;
  by_reading_ = settings.modulation.shape_by == ShapeBy::reading;

  const int legs = parked_.legs(), all = legs * lanes, sensors = parked_.modulation().sensors();
  tables_.resize(to_index(all));
  for (auto* const values : {&timer_, &continued_, &airborne_ticks_, &wait_ticks_, &first_timer_, &triggered_,
                             &refractory_left_, &advance_, &no_chance_, &jumped_})
    values->resize(to_index(all));
  fresh_.resize(to_index(lanes));
  std::ranges::fill(advance_, parts_per_tick);
  sensed_ = LaneRows(sensors, all);
  cosines_ = phase_cosines(settings.modulation, parked_.period_ticks());
  if (!cosines_.empty()) load_ = LaneRows(1, all);
  if (by_reading_) weights_ = LaneRows(parked_.modulation().channels(), all);
  rates_ = LaneRows(sensors, all);
  for (auto* const values : {&continued_rad_, &present_rad_})
    values->resize(to_index(parked_.modulation().width() * all));
  for (const int joint : supgs_.joints.of_legs) {
    const JointRange range = joint < 0 ? JointRange{} : supgs_.joints.ranges[to_index(joint)];
    limits_rad_.emplace_back(range.at(0.0), range.at(1.0));
  }
  if (settings.trigger == Trigger::random) random_.emplace(parked_.period_ticks(), legs, lanes);
  if (settings.seam.smooths())
    smoother_.emplace(settings.seam, supgs_.timestep_s, static_cast<int>(supgs_.joints.of_legs.size()),
                      lanes);
  for (int lane = 0; lane < lanes; ++lane) load(lane, parked_);
}

void ModulatedSupgBatch::load(int lane, const Parameters& parameters) {
  AMBLE_CHECK(lane >= 0 && lane < lanes_, "there is no such lane");
  const auto* const supg = dynamic_cast<const ModulatedParameters*>(&parameters);
  AMBLE_CHECK(supg != nullptr && supg->legs() == parked_.legs() && supg->types() == parked_.types() &&
                  supg->period_ticks() == parked_.period_ticks(),
              "the parameters belong to another architecture");
  if (random_) random_->load(lane);
  if (supgs_.contact) supgs_.contact->load(lane);
  const int sensors = supg->modulation().sensors();
  for (int leg = 0; leg < supg->legs(); ++leg) {
    const std::size_t i = index(leg, lane);
    const bool phase = rules_.phase != 0;
    tables_[i] = supg->modulation().entry(leg, stopped);
    timer_[i] = continued_[i] = stopped;
    airborne_ticks_[i] = triggered_[i] = refractory_left_[i] = 0;
    wait_ticks_[i] = phase ? 0 : supg->offset_ticks(leg);
    first_timer_[i] = phase ? supg->offset_ticks(leg) * parts_per_tick : start_;
    for (int s = 0; s < sensors; ++s) rates_.row(s)[i] = supg->modulation().rate(leg, s);
  }
  fresh_[to_index(lane)] = 1;
}

void ModulatedSupgBatch::step(const robot::SensorFrame& sensors, LaneArray& targets_rad) {
  AMBLE_CHECK(sensors.touch.rows() == parked_.legs() && sensors.touch.lanes() == lanes_,
              "touch must be legs × lanes");
  AMBLE_CHECK(targets_rad.lanes() == lanes_, "targets must be joints × lanes");
  if (supgs_.contact) supgs_.contact->update(sensors);
  begin_tick(sensors);
  sense(sensors);
  if (shapes_ && by_reading_)
    run_weights(sensed_.data(), sensed_.stride(), parked_.modulation().sensors(), weights_.data(), count());
  set_rates();
  update_timers(supgs_.contact ? supgs_.contact->row(0) : sensors.touch.row(0));
  write_targets(targets_rad);
  for (const auto& [joint, target_rad] : supgs_.joints.others)
    std::fill_n(targets_rad.row(joint), lanes_, target_rad);
  if (supgs_.contact) supgs_.contact->targets(targets_rad);
  std::ranges::fill(fresh_, 0);
}

void ModulatedSupgBatch::sense(const robot::SensorFrame& sensors) {
  rows_.clear();
  const auto read = [&](const LegSensor& sensor, float* sensed) {
    const float* const reading = sensor.is_there ? substrate::row_of(sensor.sensor, sensors) : nullptr;
    AMBLE_CHECK(!sensor.is_there || reading != nullptr, "the sensors are of another robot");
    rows_.push_back({reading, sensor.gain, sensor.shift, sensed});
  };
  for (int leg = 0; leg < parked_.legs(); ++leg) {
    const auto& all = supgs_.sensors[to_index(leg)];
    for (std::size_t s = 0; s < all.size(); ++s)
      read(all[s], sensed_.row(static_cast<int>(s)) + index(leg, 0));
    if (!cosines_.empty()) read(supgs_.loads[to_index(leg)], load_.row(0) + index(leg, 0));
  }
  if (!rows_.empty()) run_sensed(rows_, lanes_);
}

void ModulatedSupgBatch::set_rates() {
  set_sensed_rates();
  if (!cosines_.empty()) hold_by_load();
}

/// ρ = Σ a s, limited to ± 1.
void ModulatedSupgBatch::set_sensed_rates() {
  const int sensors = parked_.modulation().sensors();
  if (supgs_.settings.modulation.rate <= 0.0 || sensors == 0) {
    if (!cosines_.empty()) std::ranges::fill(advance_, parts_per_tick);
    return;
  }
  run_rates(rates_.data(), sensed_.data(), sensed_.stride(), sensors, advance_.data(), count());
}

/// Takes σ n cos 2πφ ticks off each advance.
void ModulatedSupgBatch::hold_by_load() {
  const auto strength = static_cast<float>(supgs_.settings.modulation.load_feedback);
  const float* const load = load_.row(0);
  for (std::size_t i = 0; i < advance_.size(); ++i)
    advance_[i] = held_advance(advance_[i], strength * load[i],
                               cosines_[to_index(std::max(timer_[i], 0) >> parts_bits)]);
}

void ModulatedSupgBatch::update_timers(const float* contact) {
  const TimerLanes lanes{.contact = contact,
                         .by_chance = random_ ? random_->advance() : no_chance_.data(),
                         .first_timer = first_timer_.data(),
                         .timer = timer_.data(),
                         .airborne = airborne_ticks_.data(),
                         .wait = wait_ticks_.data(),
                         .fired = triggered_.data()};
  if (run_parts(rules_, advance_.data(), lanes, continued_.data(), refractory_left_.data(), count())) pull();
}

/// Moves the timers that were triggered.
void ModulatedSupgBatch::pull() {
  for (std::size_t i = 0; i < timer_.size(); ++i)
    if (triggered_[i] != 0) timer_[i] = reset_timer(timer_[i], start_, period_, reset_share_);
}

/// The targets of those from `first` to `end`, legs and lanes as everywhere.
void ModulatedSupgBatch::interpolate(const std::vector<std::int32_t>& timers, int first, int end,
                                     std::vector<float>& targets_rad) const {
  const Modulation& modulation = parked_.modulation();
  const LaneRows& channels = by_reading_ ? weights_ : sensed_;
  run_targets({.tables = tables_.data(),
               .stride_bits = modulation.stride_bits(),
               .width = modulation.width(),
               .channels = shapes_ ? modulation.channels() : 0,
               .says = channels.data(),
               .says_stride = channels.stride()},
              timers.data(), first, end, count(), targets_rad.data());
}

void ModulatedSupgBatch::write_targets(LaneArray& targets_rad) {
  interpolate(smoother_ ? continued_ : timer_, 0, count(), continued_rad_);
  if (smoother_) {
    present_rad_ = continued_rad_;
    for (std::size_t i = 0; i < jumped_.size(); ++i) jumped_[i] = bits_if(timer_[i] != continued_[i]);
    for (int i = 0; i < count(); ++i)
      if (jumped_[to_index(i)] != 0) interpolate(timer_, i, i + 1, present_rad_);
    reshape(present_rad_.data());
  }
  reshape(continued_rad_.data());
  limit(targets_rad);
  if (smoother_) smooth(targets_rad);
  targets_are_set(targets_rad);
}

/// To the joints' ranges; into what is smoothed, if that is to be.
void ModulatedSupgBatch::limit(LaneArray& targets_rad) {
  limited_.clear();
  for (std::size_t supg = 0; supg < limits_rad_.size(); ++supg) {
    const int joint = supgs_.joints.of_legs[supg];
    if (joint < 0) continue;
    const auto [lower_rad, upper_rad] = limits_rad_[supg];
    const std::size_t at = row(static_cast<int>(supg));
    float* const continued_rad = continued_rad_.data() + at;
    limited_.push_back(
        {continued_rad, lower_rad, upper_rad, smoother_ ? continued_rad : targets_rad.row(joint)});
    if (!smoother_) continue;
    float* const present_rad = present_rad_.data() + at;
    limited_.push_back({present_rad, lower_rad, upper_rad, present_rad});
  }
  run_limits(limited_, lanes_);
}

void ModulatedSupgBatch::smooth(LaneArray& targets_rad) {
  for (int supg = 0; supg < static_cast<int>(limits_rad_.size()); ++supg) {
    const int joint = joint_of(supg);
    if (joint < 0) continue;
    const auto [lower_rad, upper_rad] = limits_rad_[to_index(supg)];
    const float* const present_rad = present_rad_.data() + row(supg);
    start_filters(supg, present_rad);
    smoother_->smooth(supg, continued_rad_.data() + row(supg), present_rad,
                      jumped_.data() + index(supg / parked_.types(), 0), lower_rad, upper_rad,
                      targets_rad.row(joint));
  }
}

/// In a lane's first tick its filters start at rest where the target is.
void ModulatedSupgBatch::start_filters(int supg, const float* present_rad) {
  for (int lane = 0; lane < lanes_; ++lane)
    if (fresh_[to_index(lane)] != 0) smoother_->load(supg, lane, present_rad[lane]);
}

std::vector<std::string> ModulatedSupgBatch::state_names() const {
  std::vector<std::string> names;
  for (const std::string& leg : supgs_.leg_names) names.push_back("timer." + leg);
  for (const std::string& leg : supgs_.leg_names) names.push_back("trigger." + leg);
  return names;
}

std::vector<std::size_t> ModulatedSupgBatch::events() const {
  std::vector<std::size_t> triggers(supgs_.leg_names.size());
  std::iota(triggers.begin(), triggers.end(), supgs_.leg_names.size());
  return triggers;
}

void ModulatedSupgBatch::state(int lane, std::span<float> values) const {
  const auto legs = supgs_.leg_names.size();
  AMBLE_CHECK(lane >= 0 && lane < lanes_, "there is no such lane");
  AMBLE_CHECK(values.size() == 2 * legs, "a SUPG has two state variables per leg");
  for (std::size_t leg = 0; leg < legs; ++leg) {
    const std::size_t i = index(static_cast<int>(leg), lane);
    values[leg] = timer_[i] < 0 ? -1.0f : static_cast<float>(timer_[i]) * (1.0f / parts_per_tick);
    values[legs + leg] = static_cast<float>(triggered_[i]);
  }
}

}  // namespace amble::controllers
