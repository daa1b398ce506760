#include "amble/controllers/mixed_batch.hpp"

#include <algorithm>
#include <numbers>
#include <utility>

#include "amble/controllers/neural_kernel.hpp"
#include "amble/core/check.hpp"
#include "amble/core/index.hpp"
#include "amble/cppn/activation.hpp"

namespace amble::controllers {

MixedBatch::MixedBatch(ModulatedSupgs supgs, std::shared_ptr<const MixedNet> net,
                       std::vector<std::string> neuron_names, MixedParameters parked, int lanes)
    : ModulatedSupgBatch(std::move(supgs), parked, lanes),
      net_(std::move(net)),
      neuron_names_(std::move(neuron_names)),
      weights_(static_cast<int>(parked.weights.size()), lanes),
      in_phase_(static_cast<int>(net_->couplings.size()), lanes),
      out_of_phase_(in_phase_),
      minus_out_of_phase_(in_phase_),
      expressed_(parked.weights.size()),
      values_(net_->rows(), lanes),
      bias_(static_cast<int>(net_->neurons.size()), lanes),
      step_(bias_),
      next_(bias_),
      legs_(static_cast<int>(net_->rates.size())),
      supgs_count_(static_cast<int>(net_->amplitudes.size())) {
  sums_ = LaneRows(legs_ + 2 * supgs_count_, lanes);
  phases_ = pulls_ = LaneRows(couples() ? 2 * legs_ : 0, lanes);
}

void MixedBatch::load(int lane, const Parameters& parameters) {
  ModulatedSupgBatch::load(lane, parameters);
  const auto* const mixed = dynamic_cast<const MixedParameters*>(&parameters);
  AMBLE_CHECK(mixed != nullptr && mixed->weights.size() == expressed_.size(),
              "the parameters belong to another architecture");
  for (std::size_t i = 0; i < expressed_.size(); ++i) {
    float& weight = weights_.at(static_cast<int>(i), lane);
    const float next = mixed->weights[i];
    expressed_[i] += (next != 0.0f ? 1 : 0) - (weight != 0.0f ? 1 : 0);
    weight = next;
  }
  for (std::size_t n = 0; n < mixed->biases.size(); ++n) {
    bias_.at(static_cast<int>(n), lane) = mixed->biases[n];
    step_.at(static_cast<int>(n), lane) = mixed->steps[n];
  }
  for (std::size_t k = 0; k < mixed->in_phase.size(); ++k) {
    in_phase_.at(static_cast<int>(k), lane) = mixed->in_phase[k];
    out_of_phase_.at(static_cast<int>(k), lane) = mixed->out_of_phase[k];
    minus_out_of_phase_.at(static_cast<int>(k), lane) = -mixed->out_of_phase[k];
  }
  for (int row = 0; row < net_->rows(); ++row) values_.at(row, lane) = 0.0f;
  tables_known_ = false;
}

/// Links that no lane expresses are left out: their products are zeros, and all sums begin with +0 or a bias
/// of neurons, whose tanh is the same for both zeros.
void MixedBatch::fill(SumTable& table, const std::vector<Row>& rows) {
  std::vector<std::pair<int, std::vector<MixedNet::Link>>> sums;
  for (const auto& [row, links] : rows) {
    std::vector<MixedNet::Link> some;
    for (const MixedNet::Link& link : *links)
      if (expressed_[to_index(link.index)] > 0) some.push_back(link);
    sums.emplace_back(row, std::move(some));
  }
  std::ranges::stable_sort(sums, {}, [](const auto& sum) { return sum.second.size(); });
  const auto offset = [&](int row) {
    return static_cast<std::uint32_t>(static_cast<std::size_t>(row) * values_.stride());
  };
  SumTableBuilder builder(table, static_cast<int>(expressed_.size()), lanes());
  builder.begin_level();
  for (const auto& [row, links] : sums) {
    builder.add_neuron(offset(row), static_cast<int>(links.size()));
    for (const MixedNet::Link& link : links) builder.add_link(offset(link.source), weights_.row(link.index));
  }
}

void MixedBatch::fill_tables() {
  std::vector<Row> neurons, supgs;
  for (std::size_t n = 0; n < net_->hidden.size(); ++n)
    neurons.emplace_back(static_cast<int>(n), &net_->hidden[n].links);
  const auto add = [&](const std::vector<MixedNet::Sum>& sums, int first) {
    for (std::size_t i = 0; i < sums.size(); ++i)
      if (!sums[i].links.empty()) supgs.emplace_back(first + static_cast<int>(i), &sums[i].links);
  };
  add(net_->rates, 0);
  add(net_->amplitudes, legs_);
  add(net_->shifts, legs_ + supgs_count_);
  fill(to_neurons_, neurons);
  fill(to_supgs_, supgs);
  if (couples()) fill_phases();
}

/// Σ c sin(θ' − 2πψ) and Σ c cos(θ' − 2πψ) over the couplings of each leg, from sin θ' and cos θ'.
void MixedBatch::fill_phases() {
  const auto offset = [&](int row) {
    return static_cast<std::uint32_t>(static_cast<std::size_t>(row) * phases_.stride());
  };
  SumTableBuilder builder(to_phases_, 4 * static_cast<int>(net_->couplings.size()), lanes());
  builder.begin_level();
  for (const bool sine : {true, false})
    for (int leg = 0; leg < legs_; ++leg) {
      std::vector<int> its;
      for (std::size_t k = 0; k < net_->couplings.size(); ++k)
        if (net_->couplings[k].leg == leg) its.push_back(static_cast<int>(k));
      builder.add_neuron(offset(sine ? leg : legs_ + leg), 2 * static_cast<int>(its.size()));
      for (const int k : its) {
        const int other = net_->couplings[to_index(k)].other;
        builder.add_link(offset(other), sine ? in_phase_.row(k) : out_of_phase_.row(k));
        builder.add_link(offset(legs_ + other), sine ? minus_out_of_phase_.row(k) : in_phase_.row(k));
      }
    }
}

void MixedBatch::begin_tick(const robot::SensorFrame& sensors) {
  if (!std::exchange(tables_known_, true)) fill_tables();
  read(sensors);
  if (!net_->neurons.empty()) {
    float* const neurons = values_.row(net_->first_neuron());
    run_tanh_euler(to_neurons_, values_.data(), bias_.data(), step_.data(), neurons, next_.data(), lanes());
    std::copy_n(next_.data(), net_->neurons.size() * next_.stride(), neurons);
  }
  run_sums(to_supgs_, values_.data(), sums_.data(), lanes());
  if (couples()) read_phases();
}

void MixedBatch::read(const robot::SensorFrame& sensors) {
  read_.clear();
  for (std::size_t s = 0; s < net_->sensors.size(); ++s) {
    const LegSensor& sensor = net_->sensors[s];
    const float* const reading = substrate::row_of(sensor.sensor, sensors);
    AMBLE_CHECK(reading != nullptr && sensors.touch.lanes() == lanes(), "the sensors are of another robot");
    read_.push_back({reading, sensor.gain, sensor.shift, values_.row(static_cast<int>(s))});
  }
  if (!read_.empty()) run_sensed(read_, lanes());
}

/// Sines and cosines of the legs' phases, 0 of those that stand, and what they pull others by.
void MixedBatch::read_phases() {
  constexpr auto pi = static_cast<float>(std::numbers::pi);
  const int count = lanes();
  const float per_part = 1.0f / static_cast<float>(period_parts());
  const std::size_t stride = phases_.stride();
  for (int leg = 0; leg < legs_; ++leg) {
    const std::int32_t* const timer = timers(leg);
    float* const sine = phases_.row(leg);
    float* const cosine = phases_.row(legs_ + leg);
    for (int lane = 0; lane < count; ++lane) {
      const float turns = static_cast<float>(timer[lane]) * per_part;
      sine[lane] = turns * pi;
      cosine[lane] = (turns + 0.25f) * pi;
    }
  }
  // A CPPN's sine is sin 2x.
  cppn::activate(neat::Activation::sine, cppn::Linear::identity,
                 {phases_.data(), to_index(2 * legs_) * stride});
  for (int leg = 0; leg < legs_; ++leg) {
    const std::int32_t* const timer = timers(leg);
    for (int lane = 0; lane < count; ++lane)
      if (timer[lane] < 0) phases_.at(leg, lane) = phases_.at(legs_ + leg, lane) = 0.0f;
  }
  run_sums(to_phases_, phases_.data(), pulls_.data(), count);
}

void MixedBatch::set_rates() {
  for (int leg = 0; leg < legs_; ++leg) {
    PulledRates rates{
        .sum = sums_.row(leg), .sine = nullptr, .cosine = nullptr, .sines = nullptr, .cosines = nullptr};
    if (couples())
      rates = {.sum = sums_.row(leg),
               .sine = phases_.row(leg),
               .cosine = phases_.row(legs_ + leg),
               .sines = pulls_.row(leg),
               .cosines = pulls_.row(legs_ + leg)};
    run_pulled_rates(rates, advances(leg), lanes());
  }
}

void MixedBatch::reshape(float* targets_rad) {
  for (int supg = 0; supg < supgs_count_; ++supg) {
    if (joint_of(supg) < 0 || !net_->reshapes(to_index(supg))) continue;
    const JointRange& range = range_of(supg);
    const auto middle_rad = static_cast<float>(0.5 * (range.lower_rad + range.upper_rad));
    const auto half_rad = static_cast<float>(0.5 * (range.upper_rad - range.lower_rad));
    run_reshape({.amplitude = sums_.row(legs_ + supg),
                 .shift = sums_.row(legs_ + supgs_count_ + supg),
                 .middle_rad = middle_rad,
                 .half_rad = half_rad},
                targets_rad + row(supg), lanes());
  }
}

void MixedBatch::targets_are_set(const LaneArray& targets_rad) {
  for (std::size_t i = 0; i < net_->listened.size(); ++i) {
    const int supg = net_->listened[i];
    if (joint_of(supg) < 0) continue;
    const float* const target_rad = targets_rad.row(joint_of(supg));
    float* const to = values_.row(net_->first_listened() + static_cast<int>(i));
    const JointRange& range = range_of(supg);
    const auto middle_rad = static_cast<float>(0.5 * (range.lower_rad + range.upper_rad));
    const double width_rad = range.upper_rad - range.lower_rad;
    const auto per_half = static_cast<float>(width_rad > 0.0 ? 2.0 / width_rad : 0.0);
    for (int lane = 0; lane < lanes(); ++lane) to[lane] = (target_rad[lane] - middle_rad) * per_half;
  }
}

std::vector<std::string> MixedBatch::state_names() const {
  std::vector<std::string> names = ModulatedSupgBatch::state_names();
  for (const std::string& name : neuron_names_) names.push_back("neuron." + name);
  return names;
}

void MixedBatch::state(int lane, std::span<float> values) const {
  AMBLE_CHECK(values.size() >= net_->neurons.size(), "one value per state variable");
  ModulatedSupgBatch::state(lane, values.first(values.size() - net_->neurons.size()));
  const auto neurons = values.last(net_->neurons.size());
  for (std::size_t n = 0; n < neurons.size(); ++n)
    neurons[n] = values_.at(net_->first_neuron() + static_cast<int>(n), lane);
}

}  // namespace amble::controllers
