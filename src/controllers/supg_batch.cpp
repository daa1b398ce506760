#include "amble/controllers/supg_batch.hpp"

#include <algorithm>
#include <numeric>
#include <utility>

#include "amble/controllers/supg_kernel.hpp"
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
      masks_(to_index(lanes)) {
  for (int lane = 0; lane < lanes; ++lane) load(lane);
}

void RandomTriggers::load(int lane) {
  for (int leg = 0; leg < legs_; ++leg) {
    const std::size_t i = to_index(leg * lanes_ + lane);
    number_[i] = 0;
    left_ticks_[i] = gap_ticks(leg, 0);
  }
}

const std::int32_t* RandomTriggers::advance(int leg) {
  for (int lane = 0; lane < lanes_; ++lane) {
    const std::size_t i = to_index(leg * lanes_ + lane);
    const bool triggered = --left_ticks_[i] == 0;
    masks_[to_index(lane)] = -static_cast<std::int32_t>(triggered);
    if (triggered) left_ticks_[i] = gap_ticks(leg, ++number_[i]);
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
  no_chance_.resize(static_cast<std::size_t>(lanes));
  if (settings.trigger == Trigger::random) random_.emplace(period_ticks_, parked_.legs(), lanes);
  if (settings.seam.smooths()) {
    smoother_.emplace(settings.seam, timestep_s, static_cast<int>(joints_.of_legs.size()), lanes);
    for (auto* const values : {&continued_, &jumped_}) values->resize(to_index(lanes));
    for (auto* const values : {&continued_rad_, &present_rad_}) values->resize(to_index(lanes));
    continued_tables_.resize(to_index(lanes));
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
    if (!smoother_) continue;
    const std::int32_t first = offset_ == Offset::phase ? first_timer_[index(leg, lane)] : stopped;
    const float* const first_rad = supg->targets_rad(leg, first);
    for (int type = 0; type < supg->types(); ++type)
      smoother_->load(leg * supg->types() + type, lane, first_rad[type]);
  }
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
  for (int leg = 0; leg < parked_.legs(); ++leg) {
    const std::int32_t* const by_chance = random_ ? random_->advance(leg) : no_chance_.data();
    if (smoother_) continue_timers(leg);
    update_timers(leg, contact_ ? contact_->row(leg) : sensors.touch.row(leg), by_chance);
    timers_are_set(leg);
    if (smoother_)
      write_smoothed(leg, targets_rad);
    else
      write_targets(leg, targets_rad);
  }
  for (const auto& [joint, target_rad] : joints_.others)
    std::fill_n(targets_rad.row(joint), lanes_, target_rad);
  if (contact_) contact_->targets(targets_rad);
}

void SupgBatch::update_timers(int leg, const float* touch, const std::int32_t* by_chance) {
  const std::size_t first = index(leg, 0);
  const TimerRules rules{.period = period_ticks_,
                         .end_of_cycle = end_of_cycle_,
                         .airborne_needed = airborne_ticks_needed_,
                         .by_touch = by_touch_};
  run_ticks(rules, start_tick_,
            {.contact = touch,
             .by_chance = by_chance,
             .first_timer = first_timer_.data() + first,
             .timer = timer_.data() + first,
             .airborne = airborne_ticks_.data() + first,
             .wait = wait_ticks_.data() + first,
             .fired = triggered_.data() + first},
            lanes_);
}

void SupgBatch::write_targets(int leg, LaneArray& targets_rad) const {
  const std::ptrdiff_t types = parked_.types(), lanes = lanes_;
  const std::ptrdiff_t from = parked_.targets_rad(leg, 0) - parked_.targets_rad(0, 0);
  const std::int32_t* const timer = timer_.data() + index(leg, 0);
  const float* const* const tables = tables_.data() + index(leg, 0);
  for (std::ptrdiff_t type = 0; type < types; ++type) {
    const int joint = joints_.of_legs[to_index(leg * types + type)];
    if (joint < 0) continue;
    float* const row = targets_rad.row(joint);
    for (std::ptrdiff_t lane = 0; lane < lanes; ++lane)
      row[lane] = tables[lane][from + timer[lane] * types + type];
  }
}

void SupgBatch::continue_timers(int leg) {
  const std::size_t first = index(leg, 0);
  const std::int32_t* const timer = timer_.data() + first;
  const std::int32_t* const wait = wait_ticks_.data() + first;
  const std::int32_t* const first_timer = first_timer_.data() + first;
  std::int32_t* const continued = continued_.data();
  const std::int32_t period = period_ticks_, phase = mask(offset_ == Offset::phase);
  std::copy_n(tables_.data() + first, lanes_, continued_tables_.data());
  for (int lane = 0; lane < lanes_; ++lane) {
    const std::int32_t next =
        select(mask(timer[lane] == stopped), stopped, std::min(timer[lane] + 1, period));
    continued[lane] = select(mask(wait[lane] == 0) & phase, first_timer[lane], next);
  }
}

void SupgBatch::write_smoothed(int leg, LaneArray& targets_rad) {
  const std::ptrdiff_t types = parked_.types(), lanes = lanes_;
  const std::ptrdiff_t from = parked_.targets_rad(leg, 0) - parked_.targets_rad(0, 0);
  const std::int32_t* const timer = timer_.data() + index(leg, 0);
  const std::int32_t* const continued = continued_.data();
  std::int32_t* const jumped = jumped_.data();
  const float* const* const tables = tables_.data() + index(leg, 0);
  const float* const* const tables_before = continued_tables_.data();
  std::int32_t any = 0;
  for (std::ptrdiff_t lane = 0; lane < lanes; ++lane) {
    jumped[lane] = mask(timer[lane] != continued[lane]) | mask(tables[lane] != tables_before[lane]);
    any |= jumped[lane];
  }
  for (std::ptrdiff_t type = 0; type < types; ++type) {
    const std::ptrdiff_t row = leg * types + type;
    const int joint = joints_.of_legs[to_index(row)];
    if (joint < 0) continue;
    float* const continued_rad = continued_rad_.data();
    float* const present_rad = present_rad_.data();
    for (std::ptrdiff_t lane = 0; lane < lanes; ++lane)
      continued_rad[lane] = tables_before[lane][from + continued[lane] * types + type];
    if (any != 0)
      for (std::ptrdiff_t lane = 0; lane < lanes; ++lane)
        present_rad[lane] = tables[lane][from + timer[lane] * types + type];
    const JointRange& range = joints_.ranges[to_index(joint)];
    smoother_->smooth(static_cast<int>(row), continued_rad, any != 0 ? present_rad : continued_rad, jumped,
                      range.at(0.0), range.at(1.0), targets_rad.row(joint));
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
