#pragma once

#include <memory>
#include <vector>

#include "amble/core/index.hpp"
#include "amble/physics/batch/model.hpp"
#include "amble/physics/batch/rows.hpp"

namespace amble::physics::batch {

/// A block of up to three constraint rows, as vectors that follow each other: first each row's W = L⁻¹ Jᵀ
/// (numbers of its chain, then the six of the base), then these. Rows are scaled so that a row's impulse
/// changes its own speed by the solver's over-relaxation: what a row lacks is then the change it asks for.
struct BlockShape {
  int numbers;  ///< of one W

  int field(int index) const { return 3 * numbers + index; }
  int size() const { return field(36); }

  static constexpr int softness = 0;  ///< speed given up per impulse
  static constexpr int bias = 3;      ///< speed wanted
  static constexpr int low = 6;       ///< bounds of the impulse; of a friction row with a coefficient, `high`
  static constexpr int high = 9;      ///< is its bound per impulse of the normal row
  static constexpr int gram = 12;     ///< W1 · W0, W2 · W0, W2 · W1
  static constexpr int impulse = 15;
  static constexpr int root = 18;      ///< what scales an impulse
  static constexpr int inverse = 21;   ///< and its inverse
  static constexpr int position = 24;  ///< of a contact: from the centre of mass, along the world's axes
  static constexpr int cross = 27;     ///< of a chain's first contact: W · W of its motors, motor by motor
};

/// The blocks of a chain: joints first, then contacts.
struct ChainBlocks {
  int first = 0, joint_blocks = 0, count = 0;

  /// Of a chain of three joints: its motors and its first contact are visited together.
  bool paired() const { return joint_blocks == 1 && count > 1; }
};

/// Memory for one pass over as many lanes as a vector holds; nothing in it outlives a step but `felt`.
class Workspace {
 public:
  explicit Workspace(const Model& model)
      : shape{model.longest_chain + 6}, chain_blocks(model.chains.size() + 1) {
    const int links = static_cast<int>(model.links.size()), points = static_cast<int>(model.points.size());
    const auto take = [this](int vectors) {
      const int start = vectors_;
      vectors_ += vectors;
      return start;
    };
    heights = take(points);
    places = take(points);
    inertia = take(9 * links);
    columns = take(6 * links);
    servos = take(4 * links);
    free = take(links);
    for (const Chain& chain : model.chains)
      factors.push_back(take(chain.count * (chain.count + 1) / 2 + 7 * chain.count));
    blocks = take((links + points) * shape.size());
    storage_.resize(to_index((vectors_ + 1) * lanes));
    void* start = storage_.data();
    std::size_t space = storage_.size() * sizeof(float);
    memory_ = static_cast<float*>(std::align(sizeof(Row), sizeof(float), start, space));
    block_joint.resize(to_index(links + points));
    near.resize(model.geoms.size());
    felt.resize(lanes * model.geoms.size());
  }

  Workspace(const Workspace&) = delete;
  Workspace& operator=(const Workspace&) = delete;

  /// Aligned as a Row is.
  float* memory() { return memory_; }

  int heights;  ///< by point: of its lowest place over the ground
  int places;  ///< by point that touches in some lane: which of its chain's contact blocks it has, −1: none
  int inertia;  ///< by link: its own second (6) and first (3) moment of mass about the robot's centre
  int columns;  ///< by link: column of the mass matrix for the base, turning and pushing: 6
  int servos;   ///< by link: speed wanted, lowest and highest impulse, torque that is no row: 4
  int free;     ///< by link: Lᵀ ν of the joints
  std::vector<int> factors;  ///< by chain: its L, inverses of L's diagonal, L's six rows for the base (by
                             ///< joint), B, then L_b⁻¹ B
  int blocks;
  BlockShape shape;
  std::vector<ChainBlocks> chain_blocks;  ///< of the torso, then of each chain
  std::vector<int> block_joint;           ///< by block of joints: its first joint
  std::vector<unsigned char> near;  ///< by geom: may touch the ground in some lane; else it has no heights
  std::vector<unsigned char> felt;  ///< by pass and geom: a point of it has an impulse of the step before

 private:
  int vectors_ = 0;
  std::vector<float> storage_;
  float* memory_ = nullptr;
};

}  // namespace amble::physics::batch
