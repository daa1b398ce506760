#include "amble/cppn/network.hpp"

#include <cmath>

#include "amble/core/check.hpp"
#include "amble/core/index.hpp"
#include "amble/cppn/activation.hpp"
#include "amble/cppn/kernels.hpp"

namespace amble::cppn {

Points::Points(int inputs, int count)
    : inputs_(inputs), count_(count), capacity_((count + block - 1) / block * block) {
  AMBLE_CHECK(inputs >= 0 && count >= 0, "a CPPN is queried at a natural number of points");
  values_.resize(to_index(inputs_) * to_index(capacity_));
}

void Points::set(int point, int input, float value) {
  AMBLE_CHECK(point >= 0 && point < count_ && input >= 0 && input < inputs_, "there is no such query point");
  AMBLE_CHECK(std::fabs(value) <= largest_linear, "a query coordinate is out of range");
  values_[index(point, input)] = value;
}

Network::Network(const neat::Genome& genome, const Settings& settings)
    : program_(compile(genome, settings)) {}

void Network::evaluate(const Points& points, std::span<float> results) const {
  AMBLE_CHECK(points.inputs() == inputs(), "the query points have another number of inputs than the CPPN");
  AMBLE_CHECK(results.size() == program_.output_slots.size() * to_index(points.capacity()),
              "the results have another size than outputs × capacity");
  // Kept from call to call, because networks are evaluated by the million.
  static thread_local std::vector<Tile> scratch;
  if (scratch.size() < scratch_tiles(program_)) scratch.resize(scratch_tiles(program_));
  run_program(program_, points, results.data(), scratch.data());
}

}  // namespace amble::cppn
