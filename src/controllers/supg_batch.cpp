#include "amble/controllers/supg_batch.hpp"

#include <algorithm>
#include <numeric>
#include <utility>

#include "amble/controllers/supg_kernel.hpp"
#include "amble/controllers/supg_targets.hpp"
#include "amble/core/check.hpp"
#include "amble/core/index.hpp"
#include "amble/core/random.hpp"

namespace amble::controllers {

RandomTriggers::RandomTriggers(int period_ticks, int legs, int lanes)
    : period_ticks_(period_ticks),
      legs_(legs),
      lanes_(lanes),
      left_ticks_(to_index(legs * lanes)),
      number_(to_index(legs * lanes)),
      masks_(to_index(legs * lanes)) {
  for (int lane = 0; lane < lanes; ++lane) load(lane);
}

void RandomTriggers::load(int lane) {
  for (int leg = 0; leg < legs_; ++leg) {
    const std::size_t i = to_index(leg * lanes_ + lane);
    number_[i] = 0;
    left_ticks_[i] = gap_ticks(leg, 0);
  }
}

const std::int32_t* RandomTriggers::advance() {
  for (std::size_t i = 0; i < masks_.size(); ++i) {
    const bool triggered = --left_ticks_[i] == 0;
    masks_[i] = -static_cast<std::int32_t>(triggered);
    if (triggered) left_ticks_[i] = gap_ticks(static_cast<int>(i) / lanes_, ++number_[i]);
  }
  return masks_.data();
}

std::int32_t RandomTriggers::gap_ticks(int leg, std::uint32_t number) const {
  constexpr std::uint64_t seed = 1;
  const auto half = static_cast<std::uint32_t>(period_ticks_ / 2);
  Stream stream(seed, Purpose::random_triggers, number, static_cast<std::uint32_t>(leg));
  return period_ticks_ - static_cast<std::int32_t>(half) +
         static_cast<std::int32_t>(stream.below(2 * half + 1));
}

namespace {

constexpr std::int32_t stopped = SupgParameters::stopped;

/// All bits of a condition, and by them one of two numbers.
constexpr std::int32_t mask(bool condition) {
  return -static_cast<std::int32_t>(condition);
}
constexpr std::int32_t select(std::int32_t mask, std::int32_t yes, std::int32_t no) {
  return (mask & yes) | (~mask & no);
}

}  // namespace

SupgBatch::SupgBatch(const SupgSettings& settings, double timestep_s, std::vector<std::string> leg_names,
                     SupgJoints joints, SupgParameters parked, int lanes,
                     std::optional<ContactEstimate> contact)
    : offset_(settings.offset),
      start_tick_(settings.start_tick),
      period_ticks_(parked.period_ticks()),
      leg_names_(std::move(leg_names)),
      joints_(std::move(joints)),
      parked_(std::move(parked)),
      lanes_(lanes),
      contact_(std::move(contact)) {
  AMBLE_CHECK(lanes > 0, "a batch has at least one lane");
  const CycleRule rule = cycle_rule(settings, period_ticks_);
  airborne_ticks_needed_ = rule.airborne_ticks_needed;
  by_touch_ = mask(rule.by_touch);
  end_of_cycle_ = rule.end;
  const auto size = static_cast<std::size_t>(parked_.legs() * lanes);
  tables_.resize(size);
  for (auto* const values : {&timer_, &airborne_ticks_, &wait_ticks_, &first_timer_, &triggered_})
    values->resize(size);
  no_chance_.resize(size);
  if (settings.trigger == Trigger::random) random_.emplace(period_ticks_, parked_.legs(), lanes);
  if (settings.seam.smooths()) {
    smoother_.emplace(settings.seam, timestep_s, static_cast<int>(joints_.of_legs.size()), lanes);
    for (auto* const values : {&continued_, &jumped_}) values->resize(size);
    continued_rad_ = present_rad_ = LaneRows(static_cast<int>(joints_.of_legs.size()), lanes);
    for (const int joint : joints_.of_legs) {
      const JointRange range = joint < 0 ? JointRange{} : joints_.ranges[to_index(joint)];
      limits_rad_.emplace_back(range.at(0.0), range.at(1.0));
    }
    continued_tables_.resize(size);
  }
  for (int lane = 0; lane < lanes; ++lane) load(lane, parked_);
}

void SupgBatch::load(int lane, const Parameters& parameters) {
  AMBLE_CHECK(lane >= 0 && lane < lanes_, "there is no such lane");
  const auto* const supg = dynamic_cast<const SupgParameters*>(&parameters);
  AMBLE_CHECK(supg != nullptr && supg->legs() == parked_.legs() && supg->types() == parked_.types() &&
                  supg->period_ticks() == period_ticks_,
              "the parameters belong to another architecture");
  if (random_) random_->load(lane);
  if (contact_) contact_->load(lane);
  for (int leg = 0; leg < supg->legs(); ++leg) {
    begin(leg, lane, *supg);
    smooth_from_start(leg, lane, *supg);
  }
}

void SupgBatch::smooth_from_start(int leg, int lane, const SupgParameters& supg) {
  if (!smoother_) return;
  const std::int32_t first = offset_ == Offset::phase ? first_timer_[index(leg, lane)] : stopped;
  const float* const first_rad = supg.targets_rad(leg, first);
  for (int type = 0; type < supg.types(); ++type)
    smoother_->load(leg * supg.types() + type, lane, first_rad[type]);
}

void SupgBatch::begin(int leg, int lane, const SupgParameters& supg) {
  const std::size_t i = index(leg, lane);
  const bool phase = offset_ == Offset::phase;
  play(leg, lane, supg);
  timer_[i] = stopped;
  airborne_ticks_[i] = 0;
  wait_ticks_[i] = phase ? 0 : supg.offset_ticks(leg);
  first_timer_[i] = phase ? after(supg.offset_ticks(leg)) : start_tick_;
  triggered_[i] = 0;
}

void SupgBatch::step(const robot::SensorFrame& sensors, LaneArray& targets_rad) {
  AMBLE_CHECK(sensors.touch.rows() == parked_.legs() && sensors.touch.lanes() == lanes_,
              "touch must be legs × lanes");
  AMBLE_CHECK(targets_rad.lanes() == lanes_, "targets must be joints × lanes");
  if (contact_) contact_->update(sensors);
  if (smoother_) continue_timers();
  update_timers(contact_ ? contact_->row(0) : sensors.touch.row(0));
  for (int leg = 0; leg < parked_.legs(); ++leg) timers_are_set(leg);
  if (smoother_)
    write_smoothed(targets_rad);
  else
    write_targets(targets_rad);
  for (const auto& [joint, target_rad] : joints_.others)
    std::fill_n(targets_rad.row(joint), lanes_, target_rad);
  if (contact_) contact_->targets(targets_rad);
}

void SupgBatch::update_timers(const float* touch) {
  const TimerRules rules{.period = period_ticks_,
                         .end_of_cycle = end_of_cycle_,
                         .airborne_needed = airborne_ticks_needed_,
                         .by_touch = by_touch_};
  run_ticks(rules, start_tick_,
            {.contact = touch,
             .by_chance = random_ ? random_->advance() : no_chance_.data(),
             .first_timer = first_timer_.data(),
             .timer = timer_.data(),
             .airborne = airborne_ticks_.data(),
             .wait = wait_ticks_.data(),
             .fired = triggered_.data()},
            parked_.legs() * lanes_);
}

void SupgBatch::write_targets(LaneArray& targets_rad) {
  rows_.clear();
  for (const int joint : joints_.of_legs) rows_.push_back(joint < 0 ? nullptr : targets_rad.row(joint));
  run_entries({.tables = tables_.data(), .timers = timer_.data(), .to = rows_}, parked_.types(), lanes_);
}

void SupgBatch::continue_timers() {
  const std::int32_t period = period_ticks_, phase = mask(offset_ == Offset::phase);
  if (std::exchange(plays_others_, false)) continued_tables_ = tables_;
  for (std::size_t i = 0; i < timer_.size(); ++i) {
    const std::int32_t next = select(mask(timer_[i] == stopped), stopped, std::min(timer_[i] + 1, period));
    continued_[i] = select(mask(wait_ticks_[i] == 0) & phase, first_timer_[i], next);
  }
}

void SupgBatch::find_jumps() {
  for (std::size_t i = 0; i < jumped_.size(); ++i) jumped_[i] = mask(timer_[i] != continued_[i]);
  if (!plays_others_) return;
  for (std::size_t i = 0; i < jumped_.size(); ++i) jumped_[i] |= mask(tables_[i] != continued_tables_[i]);
}

void SupgBatch::look_up_both() {
  const int types = parked_.types();
  rows_.clear();
  for (int supg = 0; supg < parked_.legs() * types; ++supg) rows_.push_back(continued_rad_.row(supg));
  run_entries({.tables = continued_tables_.data(), .timers = continued_.data(), .to = rows_}, types, lanes_);
  present_rad_ = continued_rad_;
  for (int leg = 0; leg < parked_.legs(); ++leg)
    for (int lane = 0; lane < lanes_; ++lane) {
      const std::size_t i = index(leg, lane);
      if (jumped_[i] == 0) continue;
      const float* const entry = tables_[i] + static_cast<std::ptrdiff_t>(timer_[i]) * types;
      for (int type = 0; type < types; ++type) present_rad_.at(leg * types + type, lane) = entry[type];
    }
}

void SupgBatch::write_smoothed(LaneArray& targets_rad) {
  find_jumps();
  // All rows before any is smoothed: what has just been stored in pieces cannot be loaded as a whole.
  look_up_both();
  for (int leg = 0, supg = 0; leg < parked_.legs(); ++leg)
    for (int type = 0; type < parked_.types(); ++type, ++supg) {
      const int joint = joints_.of_legs[to_index(supg)];
      if (joint < 0) continue;
      const auto [lower_rad, upper_rad] = limits_rad_[to_index(supg)];
      smoother_->smooth(supg, continued_rad_.row(supg), present_rad_.row(supg),
                        jumped_.data() + index(leg, 0), lower_rad, upper_rad, targets_rad.row(joint));
    }
}

std::vector<std::string> SupgBatch::state_names() const {
  std::vector<std::string> names;
  for (const std::string& leg : leg_names_) names.push_back("timer." + leg);
  for (const std::string& leg : leg_names_) names.push_back("trigger." + leg);
  return names;
}

std::vector<std::size_t> SupgBatch::events() const {
  std::vector<std::size_t> triggers(leg_names_.size());
  std::iota(triggers.begin(), triggers.end(), leg_names_.size());
  return triggers;
}

void SupgBatch::state(int lane, std::span<float> values) const {
  const auto legs = leg_names_.size();
  AMBLE_CHECK(lane >= 0 && lane < lanes_, "there is no such lane");
  AMBLE_CHECK(values.size() == 2 * legs, "a SUPG has two state variables per leg");
  for (std::size_t leg = 0; leg < legs; ++leg) {
    const std::size_t i = index(static_cast<int>(leg), lane);
    values[leg] = static_cast<float>(timer_[i]);
    values[legs + leg] = static_cast<float>(triggered_[i]);
  }
}

}  // namespace amble::controllers
