#pragma once

#include <cstdint>
#include <map>
#include <utility>
#include <vector>

#include "amble/io/binary.hpp"
#include "amble/neat/genome.hpp"

namespace amble::neat {

/// The historical markings of a whole run (Stanley & Miikkulainen 2002, sec. 3.2): whichever genome makes a
/// structural mutation, and in whichever generation, the same mutation gets the same number.
///
/// - A link is the same if it joins the same ordered pair of nodes.
/// - A new node is the same if it splits the same link and has the same activation function; so equal ids
/// mean equal functions
///   throughout a run. A genome that already has that node (its split link came back and is split again) gets
///   the next node in line for that split, which is registered in turn.
class Innovations {
 public:
  /// Ids below 1 + inputs + outputs belong to bias, inputs and outputs. No link is known yet.
  Innovations(int inputs, int outputs);

  /// The innovation number of the link from → to.
  std::uint32_t link(std::uint32_t from, std::uint32_t to);
  /// The id of the node that splits link `innovation` of `genome`; the genome has no node of that id.
  std::uint32_t node(std::uint32_t innovation, Activation activation, const Genome& genome);

  /// Whether every node and link of the genome bears the number given here.
  bool knows(const Genome& genome) const;

  void save(io::BinaryWriter& writer) const;
  /// Replaces the content by what save() wrote; throws UserError(ExitCode::bad_file).
  void load(io::BinaryReader& reader);

 private:
  struct Split {
    std::uint32_t innovation;
    Activation activation;
    friend auto operator<=>(const Split&, const Split&) = default;
  };
  using Ends = std::pair<std::uint32_t, std::uint32_t>;

  bool is_node(std::uint32_t id) const { return id < first_hidden_ + splits_.size(); }

  std::uint32_t first_hidden_;
  std::vector<Ends> links_;    ///< by innovation number
  std::vector<Split> splits_;  ///< by node id − first_hidden_
  std::map<Ends, std::uint32_t> innovation_of_;
  std::map<Split, std::vector<std::uint32_t>> nodes_of_;  ///< ids in the order of registration
};

}  // namespace amble::neat
