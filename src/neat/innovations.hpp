#pragma once

#include <cstdint>
#include <map>
#include <utility>
#include <vector>

#include "amble/io/binary.hpp"
#include "amble/neat/genome.hpp"
#include "amble/neat/settings.hpp"

namespace amble::neat {

/// Historical markings (Stanley & Miikkulainen 2002, sec. 3.2): equal structural mutations of any genomes
/// get the same number, in one generation or in a whole run (InnovationSettings::scope).
///
/// - A link is the same if it joins the same ordered pair of nodes.
/// - A new node is the same if it splits the same link and, with InnovationKey::link_and_function, has the
///   same activation function: equal ids then mean equal functions. With InnovationKey::link they do not. A
///   genome that already has that node (its split link came back and is split again) gets the next node in
///   line for that split, which is registered in turn.
class Innovations {
 public:
  /// Ids below 1 + inputs + outputs are those of bias, inputs and outputs. No link is known yet.
  Innovations(int inputs, int outputs, const InnovationSettings& settings = {});
  /// For mutations of one genome apart from its population: whatever it has is known, and what is new gets
  /// numbers above all of its own.
  static Innovations beyond(const Genome& genome, InnovationKey key);

  /// To be called before a generation is bred: with InnovationScope::generation the list is cleared, so that
  /// no earlier number is used again.
  void begin_generation();

  /// The innovation number of the link from → to, given now if it is new. AMBLE_CHECK: both nodes have ids
  /// that were given before.
  std::uint32_t link(std::uint32_t from, std::uint32_t to);
  /// The id of the node that splits link `innovation` of `genome`, given now if it is new; the genome has no
  /// node of that id. AMBLE_CHECK: the link's number was given before.
  std::uint32_t node(std::uint32_t innovation, Activation activation, const Genome& genome);

  /// Whether every node and link of the genome has a number given here that agrees with the list, as far as
  /// the list goes back.
  bool knows(const Genome& genome) const;

  /// The whole list, for checkpoints.
  void save(io::BinaryWriter& writer) const;
  /// Replaces the content by what save() wrote under the same settings and numbers of inputs and outputs.
  /// Throws UserError(ExitCode::bad_file), and then is good for nothing but another load().
  void load(io::BinaryReader& reader);

 private:
  struct Split {
    std::uint32_t innovation;
    Activation activation;  ///< with InnovationKey::link always the same
    friend auto operator<=>(const Split&, const Split&) = default;
  };
  using Ends = std::pair<std::uint32_t, std::uint32_t>;

  void check_loaded(io::BinaryReader& reader) const;
  Split split_of(std::uint32_t innovation, Activation activation) const;
  std::size_t next_link() const { return first_link_ + links_.size(); }
  std::size_t next_node() const { return first_node_ + splits_.size(); }

  InnovationSettings settings_;
  std::uint32_t first_hidden_;
  std::uint32_t first_link_ = 0, first_node_;  ///< the first numbers of the list; those before are forgotten
  std::vector<Ends> links_;                    ///< by innovation number − first_link_
  std::vector<Split> splits_;                  ///< by node id − first_node_
  std::map<Ends, std::uint32_t> innovation_of_;
  std::map<Split, std::vector<std::uint32_t>> nodes_of_;  ///< ids in the order of registration
};

}  // namespace amble::neat
