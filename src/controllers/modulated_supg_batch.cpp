#include "amble/controllers/modulated_supg_batch.hpp"

#include <algorithm>
#include <numeric>
#include <utility>

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

  const int legs = parked_.legs(), sensors = parked_.modulation().sensors();
  tables_.resize(to_index(lanes));
  for (auto* const values :
       {&timer_, &continued_, &airborne_ticks_, &wait_ticks_, &first_timer_, &triggered_, &refractory_left_})
    values->resize(to_index(legs * lanes));
  for (auto* const values : {&advance_, &no_chance_, &jumped_, &fresh_}) values->resize(to_index(lanes));
  std::ranges::fill(advance_, parts_per_tick);
  sensed_ = LaneRows(sensors, lanes);
  cosines_ = phase_cosines(settings.modulation, parked_.period_ticks());
  if (!cosines_.empty()) load_ = LaneRows(1, lanes);
  if (by_reading_) weights_ = LaneRows(parked_.modulation().channels(), lanes);
  rates_ = LaneRows(legs * sensors, lanes);
  for (auto* const values : {&continued_rad_, &present_rad_})
    values->resize(to_index(parked_.modulation().width() * lanes));
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
  tables_[to_index(lane)] = supg->modulation().entry(0, stopped);
  if (random_) random_->load(lane);
  if (supgs_.contact) supgs_.contact->load(lane);
  const int sensors = supg->modulation().sensors();
  for (int leg = 0; leg < supg->legs(); ++leg) {
    const std::size_t i = index(leg, lane);
    const bool phase = rules_.phase != 0;
    timer_[i] = continued_[i] = stopped;
    airborne_ticks_[i] = triggered_[i] = refractory_left_[i] = 0;
    wait_ticks_[i] = phase ? 0 : supg->offset_ticks(leg);
    first_timer_[i] = phase ? supg->offset_ticks(leg) * parts_per_tick : start_;
    for (int s = 0; s < sensors; ++s) rates_.at(leg * sensors + s, lane) = supg->modulation().rate(leg, s);
  }
  fresh_[to_index(lane)] = 1;
}

void ModulatedSupgBatch::step(const robot::SensorFrame& sensors, LaneArray& targets_rad) {
  AMBLE_CHECK(sensors.touch.rows() == parked_.legs() && sensors.touch.lanes() == lanes_,
              "touch must be legs × lanes");
  AMBLE_CHECK(targets_rad.lanes() == lanes_, "targets must be joints × lanes");
  if (supgs_.contact) supgs_.contact->update(sensors);
  begin_tick(sensors);
  for (int leg = 0; leg < parked_.legs(); ++leg) {
    sense(leg, sensors);
    if (shapes_ && by_reading_) weigh_levels();
    set_rates(leg);
    update_timers(leg, supgs_.contact ? supgs_.contact->row(leg) : sensors.touch.row(leg),
                  random_ ? random_->advance(leg) : no_chance_.data());
    write_targets(leg, targets_rad);
  }
  for (const auto& [joint, target_rad] : supgs_.joints.others)
    std::fill_n(targets_rad.row(joint), lanes_, target_rad);
  if (supgs_.contact) supgs_.contact->targets(targets_rad);
  std::ranges::fill(fresh_, 0);
}

void ModulatedSupgBatch::sense(int leg, const robot::SensorFrame& sensors) {
  rows_.clear();
  const auto read = [&](const LegSensor& sensor, float* sensed) {
    const float* const reading = sensor.is_there ? substrate::row_of(sensor.sensor, sensors) : nullptr;
    AMBLE_CHECK(!sensor.is_there || reading != nullptr, "the sensors are of another robot");
    rows_.push_back({reading, sensor.gain, sensor.shift, sensed});
  };
  const auto& all = supgs_.sensors[to_index(leg)];
  for (std::size_t s = 0; s < all.size(); ++s) read(all[s], sensed_.row(static_cast<int>(s)));
  if (!cosines_.empty()) read(supgs_.loads[to_index(leg)], load_.row(0));
  if (!rows_.empty()) run_sensed(rows_, lanes_);
}

/// How much each level of each sensor says.
void ModulatedSupgBatch::weigh_levels() {
  const int lanes = lanes_, sensors = parked_.modulation().sensors();
  for (int s = 0, channel = 0; s < sensors; ++s)
    for (const float level : reading_levels) {
      const float* const sensed = sensed_.row(s);
      float* const weights = weights_.row(channel++);
      for (int lane = 0; lane < lanes; ++lane) weights[lane] = weight_of_level(sensed[lane], level);
    }
}

void ModulatedSupgBatch::set_rates(int leg) {
  set_sensed_rates(leg);
  if (!cosines_.empty()) hold_by_load(leg);
}

/// ρ = Σ a s, limited to ± 1.
void ModulatedSupgBatch::set_sensed_rates(int leg) {
  const int sensors = parked_.modulation().sensors();
  if (supgs_.settings.modulation.rate <= 0.0 || sensors == 0) {
    if (!cosines_.empty()) std::ranges::fill(advance_, parts_per_tick);
    return;
  }
  run_rates(rates_.row(leg * sensors), sensed_.data(), sensed_.stride(), sensors, advance_.data(), lanes_);
}

/// Takes σ n cos 2πφ ticks off each advance.
void ModulatedSupgBatch::hold_by_load(int leg) {
  const auto strength = static_cast<float>(supgs_.settings.modulation.load_feedback);
  const float* const load = load_.row(0);
  const std::int32_t* const timer = timers(leg);
  for (int lane = 0; lane < lanes_; ++lane) {
    std::int32_t& advance = advance_[to_index(lane)];
    advance = held_advance(advance, strength * load[lane],
                           cosines_[to_index(std::max(timer[lane], 0) >> parts_bits)]);
  }
}

void ModulatedSupgBatch::update_timers(int leg, const float* contact, const std::int32_t* by_chance) {
  const std::size_t first = index(leg, 0);
  const TimerLanes lanes{.contact = contact,
                         .by_chance = by_chance,
                         .first_timer = first_timer_.data() + first,
                         .timer = timer_.data() + first,
                         .airborne = airborne_ticks_.data() + first,
                         .wait = wait_ticks_.data() + first,
                         .fired = triggered_.data() + first};
  const bool fired = run_parts(rules_, advance_.data(), lanes, continued_.data() + first,
                               refractory_left_.data() + first, lanes_);
  if (fired) pull(leg);
}

/// Moves the timers that were triggered.
void ModulatedSupgBatch::pull(int leg) {
  for (int lane = 0; lane < lanes_; ++lane) {
    const std::size_t i = index(leg, lane);
    if (triggered_[i] != 0) timer_[i] = reset_timer(timer_[i], start_, period_, reset_share_);
  }
}

/// The targets of the lanes from `first` to `end`.
void ModulatedSupgBatch::interpolate(int leg, const std::int32_t* timers, int first, int end,
                                     float* targets_rad) const {
  const Modulation& modulation = parked_.modulation();
  const LaneRows& channels = by_reading_ ? weights_ : sensed_;
  run_targets({.tables = tables_.data(),
               .first_entry = leg * modulation.entries(),
               .stride_bits = modulation.stride_bits(),
               .width = modulation.width(),
               .channels = shapes_ ? modulation.channels() : 0,
               .says = channels.data(),
               .says_stride = channels.stride()},
              timers, first, end, lanes_, targets_rad);
}

void ModulatedSupgBatch::write_targets(int leg, LaneArray& targets_rad) {
  const std::size_t first = index(leg, 0);
  float* const continued = continued_rad_.data();
  float* const present = present_rad_.data();
  interpolate(leg, (smoother_ ? continued_ : timer_).data() + first, 0, lanes_, continued);
  if (smoother_) {
    for (int lane = 0; lane < lanes_; ++lane)
      jumped_[to_index(lane)] = bits_if(timer_[first + to_index(lane)] != continued_[first + to_index(lane)]);
    std::copy_n(continued, parked_.types() * lanes_, present);
    for (int lane = 0; lane < lanes_; ++lane)
      if (jumped_[to_index(lane)] != 0) interpolate(leg, timer_.data() + first, lane, lane + 1, present);
  }
  limited_.clear();
  for (int type = 0; type < parked_.types(); ++type)
    limit_joint(leg * parked_.types() + type, continued + type * lanes_, present + type * lanes_,
                targets_rad);
  run_limits(limited_, lanes_);
  for (int type = 0; type < parked_.types(); ++type)
    end_joint(leg * parked_.types() + type, continued + type * lanes_, present + type * lanes_, targets_rad);
}

/// Changes the targets of a joint, and what is to be limited to its range.
void ModulatedSupgBatch::limit_joint(int row, float* continued_rad, float* present_rad,
                                     LaneArray& targets_rad) {
  const int joint = supgs_.joints.of_legs[to_index(row)];
  if (joint < 0) return;
  const auto [lower_rad, upper_rad] = limits_rad_[to_index(row)];
  reshape(row, continued_rad);
  limited_.push_back(
      {continued_rad, lower_rad, upper_rad, smoother_ ? continued_rad : targets_rad.row(joint)});
  if (!smoother_) return;
  reshape(row, present_rad);
  limited_.push_back({present_rad, lower_rad, upper_rad, present_rad});
}

/// Smooths the targets of a joint.
void ModulatedSupgBatch::end_joint(int row, const float* continued_rad, const float* present_rad,
                                   LaneArray& targets_rad) {
  const int joint = supgs_.joints.of_legs[to_index(row)];
  if (joint < 0) return;
  float* const targets = targets_rad.row(joint);
  if (smoother_) {
    const auto [lower_rad, upper_rad] = limits_rad_[to_index(row)];
    start_filters(row, present_rad);
    smoother_->smooth(row, continued_rad, present_rad, jumped_.data(), lower_rad, upper_rad, targets);
  }
  end_target(row, targets);
}

/// In a lane's first tick its filters start at rest where the target is.
void ModulatedSupgBatch::start_filters(int row, const float* present_rad) {
  for (int lane = 0; lane < lanes_; ++lane)
    if (fresh_[to_index(lane)] != 0) smoother_->load(row, lane, present_rad[lane]);
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
