#include "amble/controllers/modulated_supg_batch.hpp"

#include <algorithm>
#include <cstring>
#include <numeric>
#include <utility>

#include "amble/core/check.hpp"
#include "amble/core/index.hpp"

namespace amble::controllers {
namespace {

/// Four numbers that lie together, in a register: a type that GCC and Clang have for every processor.
using Four = float __attribute__((vector_size(16)));

inline Four four_at(const float* from) {
  Four four;
  std::memcpy(&four, from, sizeof four);
  return four;
}

/// The numbers at `from`, `share` of the way to those at `next`.
inline Four between(const float* from, const float* next, float share) {
  const Four here = four_at(from);
  return here + share * (four_at(next) - here);
}

constexpr std::int32_t stopped = -1;

/// All bits of a condition, and by them one of two numbers.
constexpr std::int32_t bits_if(bool condition) {
  return -static_cast<std::int32_t>(condition);
}
constexpr std::int32_t either(std::int32_t bits, std::int32_t yes, std::int32_t no) {
  return (bits & yes) | (~bits & no);
}

/// `to` may be `from`.
void limit(const float* from, float lower, float upper, int lanes, float* to) {
  for (int lane = 0; lane < lanes; ++lane) {
    const float above = from[lane] > lower ? from[lane] : lower;
    to[lane] = above < upper ? above : upper;
  }
}

/// What is the same for all lanes. Masks have all bits or none.
struct TimerRules {
  std::int32_t period, end_of_cycle, wraps, airborne_needed, by_touch, phase, refractory;
  int lanes;
};

/// The timers of a leg in the next tick, but for where triggers take them. Without branches that depend on a
/// lane, as in SupgBatch; of so many arrays GCC would not find out by itself that none overlaps another.
void advance_timers(const TimerRules& rules, const float* __restrict contact,
                    const std::int32_t* __restrict by_chance, const std::int32_t* __restrict advance,
                    const std::int32_t* __restrict first_timer, std::int32_t* __restrict timer,
                    std::int32_t* __restrict continued, std::int32_t* __restrict airborne,
                    std::int32_t* __restrict wait, std::int32_t* __restrict fired,
                    std::int32_t* __restrict left) {
  const auto [period, end, wraps, needed, by_touch, phase, refractory, lanes] = rules;
  for (int lane = 0; lane < lanes; ++lane) {
    const std::int32_t waiting = wait[lane], off_ground = airborne[lane], resting = left[lane];
    const std::int32_t touching = bits_if(contact[lane] > 0.5f);
    const std::int32_t triggered = bits_if(waiting < 0) & bits_if(resting == 0) &
                                   ((touching & by_touch & bits_if(off_ground >= needed)) | by_chance[lane]);
    const std::int32_t begins = bits_if(waiting == 0), begins_in_cycle = begins & phase;
    const std::int32_t before = either(begins_in_cycle, first_timer[lane], timer[lane]);
    const std::int32_t runs = bits_if(before >= 0), sum = before + advance[lane];
    const std::int32_t over = bits_if(sum >= period);
    const std::int32_t next = either(runs, either(over, either(wraps, sum - period, end), sum), stopped);
    const std::int32_t on = either(runs, std::min(sum, period), stopped);
    continued[lane] = either(begins_in_cycle, next, on);
    timer[lane] = either(begins & ~phase, first_timer[lane], next);
    fired[lane] = -triggered;
    wait[lane] = std::max(waiting - 1, -1);
    left[lane] = either(triggered, refractory, std::max(resting - 1, 0));
    airborne[lane] = ~touching & std::min(off_ground + 1, needed);
  }
}

}  // namespace

ModulatedSupgBatch::ModulatedSupgBatch(ModulatedSupgs supgs, ModulatedParameters parked, int lanes)
    : supgs_(std::move(supgs)), parked_(std::move(parked)), lanes_(lanes) {
  AMBLE_CHECK(lanes > 0, "a batch has at least one lane");
  const SupgSettings& settings = supgs_.settings;
  period_ = parked_.period_ticks() * parts_per_tick;
  start_ = settings.start_tick * parts_per_tick;
  const CycleRule rule = cycle_rule(settings, parked_.period_ticks());
  wraps_ = rule.end == 0;  // by as much as the timer is beyond the period
  end_of_cycle_ = rule.end < 0 ? stopped : period_;
  airborne_ticks_needed_ = rule.airborne_ticks_needed;
  by_touch_ = bits_if(rule.by_touch);
  phase_ = bits_if(settings.offset == Offset::phase);
  reset_share_ = reset_share(settings.modulation);
  refractory_ticks_ = settings.modulation.refractory_ticks;
  shapes_ = settings.modulation.shape > 0.0;
  by_reading_ = settings.modulation.shape_by == ShapeBy::reading;

  const int legs = parked_.legs(), sensors = parked_.modulation().sensors();
  tables_.resize(to_index(lanes));
  entry_.resize(to_index(lanes));
  share_.resize(to_index(lanes));
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
    const bool phase = phase_ != 0;
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
  const auto read = [&](const LegSensor& sensor, float* sensed) {
    if (!sensor.is_there) {
      std::fill_n(sensed, lanes_, 0.0f);
      return;
    }
    const float* const reading = substrate::row_of(sensor.sensor, sensors);
    AMBLE_CHECK(reading != nullptr, "the sensors are of another robot");
    for (int lane = 0; lane < lanes_; ++lane) sensed[lane] = sensor.sensed(reading[lane]);
  };
  const auto& all = supgs_.sensors[to_index(leg)];
  for (std::size_t s = 0; s < all.size(); ++s) read(all[s], sensed_.row(static_cast<int>(s)));
  if (!cosines_.empty()) read(supgs_.loads[to_index(leg)], load_.row(0));
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
  const int sensors = parked_.modulation().sensors(), lanes = lanes_;
  if (supgs_.settings.modulation.rate <= 0.0 || sensors == 0) {
    if (!cosines_.empty()) std::ranges::fill(advance_, parts_per_tick);
    return;
  }
  float* const rho = present_rad_.data();  // scratch
  std::fill_n(rho, lanes, 0.0f);
  for (int s = 0; s < sensors; ++s) {
    const float* const rate = rates_.row(leg * sensors + s);
    const float* const sensed = sensed_.row(s);
    for (int lane = 0; lane < lanes; ++lane) rho[lane] = rho[lane] + rate[lane] * sensed[lane];
  }
  std::int32_t* const advance = advance_.data();
  limit(rho, -1.0f, 1.0f, lanes, rho);
  for (int lane = 0; lane < lanes; ++lane) advance[lane] = advance_parts(rho[lane]);
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
  advance_timers({period_, end_of_cycle_, bits_if(wraps_), airborne_ticks_needed_, by_touch_, phase_,
                  refractory_ticks_, lanes_},
                 contact, by_chance, advance_.data(), first_timer_.data() + first, timer_.data() + first,
                 continued_.data() + first, airborne_ticks_.data() + first, wait_ticks_.data() + first,
                 triggered_.data() + first, refractory_left_.data() + first);
  pull(leg);
}

/// Moves the timers that were triggered.
void ModulatedSupgBatch::pull(int leg) {
  for (int lane = 0; lane < lanes_; ++lane) {
    const std::size_t i = index(leg, lane);
    if (triggered_[i] != 0) timer_[i] = reset_timer(timer_[i], start_, period_, reset_share_);
  }
}

/// Where the lanes' timers are in their tables, and how far on the way to the next entry.
void ModulatedSupgBatch::find_entries(int leg, const std::int32_t* timers) {
  const int stride_bits = parked_.modulation().stride_bits(), lanes = lanes_;
  const std::int32_t first = leg * parked_.modulation().entries();
  std::int32_t* const at = entry_.data();
  float* const share = share_.data();
  for (int lane = 0; lane < lanes; ++lane) {
    const std::int32_t timer = timers[lane], runs = bits_if(timer >= 0);
    at[lane] = (first + (runs & ((timer >> parts_bits) + 1))) << stride_bits;
    share[lane] = static_cast<float>(runs & (timer & (parts_per_tick - 1))) * (1.0f / parts_per_tick);
  }
}

/// The targets of the lanes from `first` to `end`: four joints at a time, whose numbers lie together.
void ModulatedSupgBatch::interpolate(int first, int end, float* targets_rad) const {
  const std::ptrdiff_t lanes = lanes_, width = parked_.modulation().width();
  const auto stride = static_cast<std::ptrdiff_t>(parked_.modulation().stride());
  const LaneRows& channels = by_reading_ ? weights_ : sensed_;
  const auto row = static_cast<std::ptrdiff_t>(channels.stride());
  const int count = shapes_ ? parked_.modulation().channels() : 0;
  const float* const* const tables = tables_.data();
  const std::int32_t* const at = entry_.data();
  const float* const shares = share_.data();
  for (std::ptrdiff_t block = 0; block < width; block += 4) {
    float* const to = targets_rad + block * lanes;
    for (int lane = first; lane < end; ++lane) {
      const float* entry = tables[lane] + at[lane] + block;
      const float* says = count > 0 ? channels.data() + lane : nullptr;
      const float share = shares[lane];
      Four y = between(entry, entry + stride, share);
      for (int channel = 0; channel < count; ++channel, says += row) {
        entry += width;
        y += between(entry, entry + stride, share) * *says;
      }
      for (std::ptrdiff_t i = 0; i < 4; ++i) to[i * lanes + lane] = y[i];
    }
  }
}

void ModulatedSupgBatch::write_targets(int leg, LaneArray& targets_rad) {
  const std::size_t first = index(leg, 0);
  float* const continued = continued_rad_.data();
  float* const present = present_rad_.data();
  find_entries(leg, (smoother_ ? continued_ : timer_).data() + first);
  interpolate(0, lanes_, continued);
  if (smoother_) {
    for (int lane = 0; lane < lanes_; ++lane)
      jumped_[to_index(lane)] = bits_if(timer_[first + to_index(lane)] != continued_[first + to_index(lane)]);
    std::copy_n(continued, parked_.types() * lanes_, present);
    find_entries(leg, timer_.data() + first);
    for (int lane = 0; lane < lanes_; ++lane)
      if (jumped_[to_index(lane)] != 0) interpolate(lane, lane + 1, present);
  }
  for (int type = 0; type < parked_.types(); ++type)
    write_joint(leg * parked_.types() + type, continued + type * lanes_, present + type * lanes_,
                targets_rad);
}

/// Limits the targets of a joint to its range, and smooths them.
void ModulatedSupgBatch::write_joint(int row, float* continued_rad, float* present_rad,
                                     LaneArray& targets_rad) {
  const int joint = supgs_.joints.of_legs[to_index(row)];
  if (joint < 0) return;
  const JointRange& range = supgs_.joints.ranges[to_index(joint)];
  const float lower = range.at(0.0), upper = range.at(1.0);
  float* const targets = targets_rad.row(joint);
  reshape(row, continued_rad);
  if (!smoother_) {
    limit(continued_rad, lower, upper, lanes_, targets);
    end_target(row, targets);
    return;
  }
  reshape(row, present_rad);
  limit(continued_rad, lower, upper, lanes_, continued_rad);
  limit(present_rad, lower, upper, lanes_, present_rad);
  start_filters(row, present_rad);
  smoother_->smooth(row, continued_rad, present_rad, jumped_.data(), lower, upper, targets);
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
