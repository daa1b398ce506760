#pragma once

#include <cstddef>
#include <vector>

#include "amble/core/index.hpp"
#include "amble/physics/batch/model.hpp"
#include "amble/physics/batch/state_rows.hpp"

namespace amble::physics::batch {

/// Layout of a block of up to three constraint rows, counted in vectors: first each row's W = L⁻¹ Jᵀ / s (the
/// entries of its chain, then the six of the base), then the fields below. A row is scaled by
/// s = √((|L⁻¹ Jᵀ|² + cfm/h) / ω), so that its diagonal is the over-relaxation ω: a sweep then adds a row's
/// residual to its scaled impulse as it is.
struct BlockLayout {
  int entries;  ///< of one W

  int field(int index) const { return 3 * entries + index; }
  int size() const { return field(36); }

  // Each is the first of three, row by row, unless it says otherwise.
  static constexpr int softness = 0;  ///< (cfm/h) / s²
  static constexpr int target = 3;    ///< velocity that the row aims at, / s
  static constexpr int low = 6;       ///< bounds of the impulse, × s; of a friction row with a finite
  static constexpr int high = 9;      ///< coefficient, `high` is the bound per scaled normal impulse
  static constexpr int gram = 12;     ///< W1 · W0, W2 · W0, W2 · W1
  static constexpr int impulse = 15;  ///< N s or N m s, × s
  static constexpr int scale = 18;    ///< s
  static constexpr int inverse_scale = 21;
  static constexpr int arm = 24;  ///< of a contact: from the centre of mass, world axes, m
  static constexpr int cross_gram =
      27;  ///< of a chain's first contact: W · W of its motors, motor by motor: 9
};

/// The blocks of a chain: joints first, then contacts.
struct ChainBlocks {
  int first = 0, joint_blocks = 0, count = 0;
  int joint_rows = 0;  ///< of the chain; a block has three of them, the last perhaps fewer

  /// Whether it is a chain of three joints, whose motors and first contact are relaxed together.
  bool paired() const { return joint_blocks == 1 && count > 1; }
};

constexpr int joint_row_size = 5;

/// At least so many floats, aligned as a Row is, which all engines of this thread share: a few hundred kB
/// that stay in the processor's cache however many engines there are. Valid until a call asks for more.
float* thread_scratch(std::size_t floats);

/// Scratch memory of one pass over as many lanes as a vector holds. Only geom_has_impulse outlives a step.
class Workspace {
 public:
  explicit Workspace(const Model& model)
      : block_layout{model.longest_chain + 6}, chain_blocks(model.chains.size() + 1) {
    const int links = static_cast<int>(model.links.size()), points = static_cast<int>(model.points.size()),
              rows = static_cast<int>(model.joint_rows.size());
    const auto take = [this](int vectors) {
      const int start = vectors_;
      vectors_ += vectors;
      return start;
    };
    point_height = take(points);
    point_slot = take(points);
    link_inertia = take(9 * links);
    base_column = take(6 * links);
    joint_row = take(joint_row_size * rows);
    u_joints = take(links);
    for (const Chain& chain : model.chains)
      factors.push_back(take(chain.count * (chain.count + 1) / 2 + 7 * chain.count));
    blocks = take((rows + points) * block_layout.size());
    point_normal = take(3 * points);
    block_normal = take(3 * (rows + points));
    block_joint.resize(to_index(rows + points));
    geom_may_touch.resize(model.geoms.size());
    geom_has_impulse.resize(lanes * model.geoms.size());
  }

  Workspace(const Workspace&) = delete;
  Workspace& operator=(const Workspace&) = delete;

  /// To be called before each step: what memory() holds is lost between two.
  void attach() { memory_ = thread_scratch(to_index(vectors_ * lanes)); }
  /// Aligned as a Row is.
  float* memory() { return memory_; }

  // Offsets into memory(), counted in vectors.
  int point_height;  ///< by point: of its lowest place above the ground, m; on uneven ground along the normal
  int point_slot;    ///< by point: index among its chain's contact blocks, by lane; −1: does not touch
  int link_inertia;  ///< by link: inertia (6) and first moment of mass (3) about the robot's centre of mass
  int base_column;   ///< by link: its column of M_bq, angular and linear: 6
  int joint_row;     ///< by joint row: target velocity, lowest and highest impulse, explicit torque,
                     ///< softness (velocity per impulse): joint_row_size
  int u_joints;      ///< by link: the joint's entry of u = Lᵀ ν; before, its bias force
  std::vector<int> factors;  ///< by chain: L_c, inverses of its diagonal, B_c (six by joint), later L_b⁻¹ B_c
  int blocks;                ///< of constraint rows, block by block
  int point_normal;          ///< by point: of uneven ground below it, world axes: 3
  int block_normal;          ///< by block of a contact: the same
  BlockLayout block_layout;

  std::vector<ChainBlocks> chain_blocks;  ///< of the torso, then of each chain
  std::vector<int> block_joint;           ///< by block of joints: its first row, counted in its chain
  /// By geom: whether it may touch the ground in some lane; else its point_height is not computed.
  std::vector<unsigned char> geom_may_touch;
  /// By pass and geom: whether one of its points has an impulse of the last step.
  std::vector<unsigned char> geom_has_impulse;

 private:
  int vectors_ = 0;
  float* memory_ = nullptr;
};

}  // namespace amble::physics::batch
