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
  /// An enabled link into a node.
  struct Link {
    int from_slot;  ///< whose value it carries
    float weight;   ///< within ± 2^32
  };
  /// Sum of links [first_link, first_link + link_count), then the activation function. Computed in passes
  /// first_pass … last_pass: earlier values influence no output, and later ones are the same or influence
  /// none.
  struct Node {
    int slot;                     ///< where its value goes
    int first_link,               ///< index in Program::links
        link_count;               ///< from there on
    neat::Activation activation;  ///< applied to the sum
    int first_pass,               ///< from 1
        last_pass;                ///< at most Program::passes
  };

  int inputs = 0;                    ///< the bias not counted
  int slots = 0;                     ///< values that are kept: bias, inputs, nodes
  int passes = 1;                    ///< 1 if `in_place`
  bool in_place = true;              ///< whether one pass in the order of `nodes` is enough
  bool cyclic = false;               ///< whether links form a cycle that outputs depend on
  Linear linear = Linear::absolute;  ///< what the function "linear" is
  std::vector<Node> nodes;           ///< sources before targets where there is no cycle
  std::vector<Link> links;           ///< node by node; those of one node by rising innovation
  std::vector<int> output_slots;     ///< output by output
};

/// Leaves out disabled links and nodes that no output depends on. AMBLE_CHECK: each link joins nodes of the
/// genome, weights are finite, and without settings.recurrent what is left has no cycle.
Program compile(const neat::Genome& genome, const Settings& settings);

/// Query points of a CPPN, stored input by input (structure of arrays, float32) and padded to whole blocks,
/// so that one SIMD instruction serves many points. The bias is not among the inputs; it is the constant 1.
class Points {
 public:
  /// Points that evaluation treats as one: a few vector registers of any width; the capacity is a multiple of
  /// it.
  static constexpr int block = 64;

  /// All coordinates are 0 at first. Both numbers are at least 0.
  Points(int inputs, int count);
  int inputs() const { return inputs_; }  ///< coordinates of a point
  int count() const { return count_; }    ///< points that were asked for
  /// count() rounded up to whole blocks; coordinates of the points beyond count() stay 0.
  int capacity() const { return capacity_; }
  /// `value` must be within ±2^64, and point and input must exist (AMBLE_CHECK).
  void set(int point, int input, float value);
  /// A coordinate of a point; indices are not checked.
  float get(int point, int input) const { return values_[index(point, input)]; }
  /// One coordinate of all points, capacity() numbers.
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
  /// The genome must be valid (neat::validate), without cycles unless settings.recurrent (AMBLE_CHECK).
  /// Weights are rounded to single precision and clamped to ±2^32.
  Network(const neat::Genome& genome, const Settings& settings);

  /// Inputs of the genome, without the bias.
  int inputs() const { return program_.inputs; }
  /// Outputs of the genome.
  int outputs() const { return static_cast<int>(program_.output_slots.size()); }
  /// Whether the enabled links form a cycle that outputs depend on. If not, evaluation is feed-forward in one
  /// pass (except that a chain of outputs longer than the passes above is cut off just as the passes would).
  bool cyclic() const { return program_.cyclic; }

  /// Values of all outputs at all points: outputs × points.capacity() floats, output by output; those beyond
  /// points.count() are unspecified. Not limited to −1 … 1 where an output's function is linear. AMBLE_CHECK:
  /// `results` has exactly that size, and points.inputs() equals inputs(). Thread safe.
  void evaluate(const Points& points, std::span<float> results) const;

 private:
  Program program_;
};

}  // namespace amble::cppn
