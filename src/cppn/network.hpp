#pragma once

#include <span>
#include <vector>

#include "amble/cppn/settings.hpp"
#include "amble/neat/genome.hpp"

namespace amble::cppn {

/// Query points of a CPPN, stored input by input (structure of arrays, float32) and padded to whole blocks, so that one
/// SIMD instruction serves many points. The bias is not among the inputs; it is the constant 1.
class Points {
 public:
  /// Lanes that evaluation treats as one; the capacity is a multiple of it.
  static constexpr int block = 16;

  Points(int inputs, int count);
  int inputs() const { return inputs_; }
  int count() const { return count_; }
  int capacity() const { return capacity_; }
  void set(int point, int input, float value);
  float get(int point, int input) const;
  const float* input(int i) const { return values_.data() + static_cast<std::ptrdiff_t>(i) * capacity_; }

 private:
  int inputs_, count_, capacity_;
  std::vector<float> values_;
};

/// A genome made ready for many queries: const, shareable between threads. Disabled links and nodes that no output
/// depends on are left out. All arithmetic is IEEE single precision without fused operations in a fixed order, and the
/// activation functions are our own: the same bits on every CPU and for every vector width.
class Network {
 public:
  Network(const neat::Genome& genome, const Settings& settings);

  int inputs() const { return inputs_; }
  int outputs() const { return outputs_; }
  /// Whether the enabled links form a cycle that outputs depend on. If not, evaluation is feed-forward in one pass.
  bool cyclic() const { return cyclic_; }

  /// Values of all outputs at all points: outputs × points.capacity() floats, output by output; those beyond
  /// points.count() mean nothing. `results` must have exactly that size. `points.inputs()` must equal inputs().
  void evaluate(const Points& points, std::span<float> results) const;

 private:
  friend class Evaluator;
  struct Link { int from; float weight; };
  struct Node { int first_link; int link_count; neat::Activation activation; };

  int inputs_ = 0, outputs_ = 0;
  bool cyclic_ = false;
  int passes_ = 1;
  bool linear_is_absolute_ = true;
  std::vector<Node> nodes_;   ///< computed nodes, in order of evaluation
  std::vector<Link> links_;
  std::vector<int> output_slot_;
};

}  // namespace amble::cppn
