#pragma once

#include <map>
#include <string>
#include <tuple>
#include <vector>

#include "amble/core/index.hpp"
#include "amble/substrate/layout.hpp"

namespace amble::substrate {

/// Fills a Layout and refuses what does not fit; used by Layout's constructor only.
class LayoutBuilder {
 public:
  LayoutBuilder(Layout& layout, const Settings& settings, const Needs& needs, const robot::RobotSpec& robot)
      : layout_(layout), settings_(settings), needs_(needs), robot_(robot) {}
  void build();

 private:
  void set_names();
  void add_nodes();
  void check_groups() const;
  void check_node(std::size_t index) const;
  void assign_joints();
  void add_links();
  void add_link(std::size_t item, int source, int target, int output);
  void check_port(std::size_t item, int source, int target) const;
  void add_properties();
  void add_property(std::size_t item, int node);
  void check_properties() const;
  void check_outputs() const;

  /// The nodes with this name or of this group.
  std::vector<int> nodes_of(const std::string& name, const std::string& key) const;
  bool is_node(const std::string& name) const;
  /// The properties that a node must have.
  const std::vector<std::string>& needed(int node) const;
  bool has_ports() const { return !needs_.neuron_properties.empty(); }
  int output_of(const std::string& name, const std::string& key);
  std::vector<std::size_t> coordinates_of(const std::vector<std::string>& names,
                                          const std::string& key) const;
  std::vector<float> coordinates(int node) const;
  std::vector<float> link_inputs(int source, int target) const;
  std::vector<float> node_inputs(int node, const std::vector<std::size_t>& zero, int tick) const;
  const std::string& name_of(int node) const { return layout_.nodes_[to_index(node)].name; }

  Layout& layout_;
  const Settings& settings_;
  const Needs& needs_;
  const robot::RobotSpec& robot_;
  bool has_time_ = false;
  std::size_t time_inputs_ = 0, first_time_input_ = 0;
  std::vector<bool> read_;                                    ///< output by output
  std::map<std::tuple<int, int, Port>, std::size_t> linked_;  ///< by which item
  QueryPoints points_;
};

}  // namespace amble::substrate
