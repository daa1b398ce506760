#include "amble/search/elites.hpp"

#include <algorithm>
#include <utility>

#include "amble/core/check.hpp"

namespace amble::search {

Elites::Elites(std::uint32_t cells, std::size_t dimensions)
    : dimensions_(dimensions), number_in_(cells, none) {}

void Elites::put(Elite elite, std::span<const float> descriptor) {
  AMBLE_CHECK(elite.cell < cells() && descriptor.size() == dimensions_, "a cell of this map");
  std::uint32_t number = in(elite.cell);
  if (number == none) {
    number = number_in_[elite.cell] = size();
    elites_.push_back(std::move(elite));
    descriptors_.insert(descriptors_.end(), descriptor.begin(), descriptor.end());
    evaluated_.push_back(0);
  } else {
    forget_evaluated(number);
    elites_[number] = std::move(elite);
    std::ranges::copy(descriptor, descriptors_.begin() + static_cast<std::ptrdiff_t>(number * dimensions_));
  }
  note_evaluated(number);
}

void Elites::update(const Elite& elite, std::span<const float> descriptor) {
  const std::uint32_t number = in(elite.cell);
  AMBLE_CHECK(number != none && descriptor.size() == dimensions_, "an elite to be updated");
  forget_evaluated(number);
  elites_[number].evaluations = elite.evaluations;
  elites_[number].objective = elite.objective;
  elites_[number].spread = elite.spread;
  std::ranges::copy(descriptor, descriptors_.begin() + static_cast<std::ptrdiff_t>(number * dimensions_));
  note_evaluated(number);
}

void Elites::remove(std::uint32_t cell) {
  const std::uint32_t number = in(cell), last = size() - 1;
  AMBLE_CHECK(number != none, "an elite to be removed");
  forget_evaluated(number);
  number_in_[cell] = none;
  if (number != last) {
    elites_[number] = std::move(elites_[last]);
    evaluated_[number] = evaluated_[last];
    std::copy_n(descriptors_.begin() + static_cast<std::ptrdiff_t>(last * dimensions_), dimensions_,
                descriptors_.begin() + static_cast<std::ptrdiff_t>(number * dimensions_));
    number_in_[elites_[number].cell] = number;
  }
  elites_.pop_back();
  evaluated_.pop_back();
  descriptors_.resize(elites_.size() * dimensions_);
}

std::vector<std::uint32_t> Elites::least_evaluated(std::size_t count) const {
  std::vector<std::uint32_t> first;
  first.reserve(std::min<std::size_t>(count, size()));
  for (const auto& [evaluations, when, cell] : queue_) {
    if (first.size() == count) break;
    first.push_back(cell);
  }
  return first;
}

double Elites::objective_sum() const {
  double sum = 0.0;
  for (const Elite& elite : elites_) sum += elite.objective;
  return sum;
}

double Elites::best_objective() const {
  double best = 0.0;
  for (const Elite& elite : elites_) best = std::max(best, elite.objective);
  return best;
}

void Elites::note_evaluated(std::uint32_t number) {
  evaluated_[number] = ++clock_;
  queue_.emplace(elites_[number].evaluations, evaluated_[number], elites_[number].cell);
}

void Elites::forget_evaluated(std::uint32_t number) {
  queue_.erase({elites_[number].evaluations, evaluated_[number], elites_[number].cell});
}

}  // namespace amble::search
