#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "amble/core/index.hpp"
#include "amble/cppn/settings.hpp"
#include "amble/neat/genome.hpp"

namespace amble::cppn {

/// A genome compiled for evaluation by cppn::Network.
///
/// Values live in slots: slot 0 is the bias, 1 … inputs are the inputs, and each computed node has one. Each
/// pass computes nodes from the values of the pass before, v_i(t) = f_i(Σ_j w_ij v_j(t − 1)). A feed-forward
/// program needs one pass only, in place, because its nodes are in topological order.
struct Program {
  struct Link {
    int from_slot;
    float weight;
  };
  /// Sum of links [first_link, first_link + link_count), then the activation function. Computed in passes
  /// first_pass … last_pass: earlier values influence no output, and later ones are the same or influence
  /// none.
  struct Node {
    int slot;
    int first_link, link_count;
    neat::Activation activation;
    int first_pass, last_pass;
  };

  int inputs = 0;
  int slots = 0;
  int passes = 1;
  bool in_place = true;
  bool cyclic = false;
  Linear linear = Linear::absolute;
  std::vector<Node> nodes;
  std::vector<Link> links;        ///< of one node: by rising innovation
  std::vector<int> output_slots;  ///< output by output
};

/// Leaves out disabled links and nodes that no output depends on. A genome whose links form a cycle needs
/// settings.recurrent (checked).
Program compile(const neat::Genome& genome, const Settings& settings);

/// Query points of a CPPN, stored input by input (structure of arrays, float32) and padded to whole blocks,
/// so that one SIMD instruction serves many points. The bias is not among the inputs; it is the constant 1.
class Points {
 public:
  /// Points that evaluation treats as one: a few vector registers of any width; the capacity is a multiple of
  /// it.
  static constexpr int block = 64;

  /// All coordinates are 0 at first.
  Points(int inputs, int count);
  int inputs() const { return inputs_; }
  int count() const { return count_; }
  int capacity() const { return capacity_; }
  /// `value` must be within ±2^64 (checked; activation.hpp).
  void set(int point, int input, float value);
  float get(int point, int input) const { return values_[index(point, input)]; }
  const float* input(int i) const { return values_.data() + static_cast<std::ptrdiff_t>(i) * capacity_; }

 private:
  std::size_t index(int point, int input) const {
    return to_index(input) * to_index(capacity_) + to_index(point);
  }

  int inputs_, count_, capacity_;
  std::vector<float> values_;
};

/// A genome compiled for many queries: const, shareable between threads. Disabled links and nodes that no
/// output depends on are left out. All arithmetic is IEEE single precision without fused operations in a
/// fixed order, and the activation functions are our own (activation.hpp): the same bits on every CPU and for
/// every vector width. Values are never NaN.
///
/// A node's value is its activation function of the sum, from zero and in order of innovation, of weight ×
/// source. With Settings::recurrent all nodes start from 0 and are updated together for the number of passes
/// of Settings::passes (with the hidden nodes of the whole genome); where the links form no cycle, one pass
/// in topological order gives the same bits.
class Network {
 public:
  /// The genome must be valid (neat::validate). Weights are rounded to single precision and clamped to ±2^32.
  Network(const neat::Genome& genome, const Settings& settings);

  int inputs() const { return program_.inputs; }
  int outputs() const { return static_cast<int>(program_.output_slots.size()); }
  /// Whether the enabled links form a cycle that outputs depend on. If not, evaluation is feed-forward in one
  /// pass (except that a chain of outputs longer than the passes above is cut off just as the passes would).
  bool cyclic() const { return program_.cyclic; }

  /// Values of all outputs at all points: outputs × points.capacity() floats, output by output; those beyond
  /// points.count() are unspecified. `results` must have exactly that size. `points.inputs()` must equal
  /// inputs().
  void evaluate(const Points& points, std::span<float> results) const;

 private:
  Program program_;
};

}  // namespace amble::cppn
