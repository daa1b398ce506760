#include "amble/motion/neural_network.hpp"

#include <cstdint>
#include <limits>

#include "amble/io/json_file.hpp"

namespace amble::motion {
namespace {

using io::JsonView;

NetworkNode read_node(const JsonView& json, std::size_t coordinates) {
  NetworkNode node;
  node.name = json.at("name").text();
  const JsonView at = json.at("at");
  if (at.size() != coordinates) at.bad("a number for each coordinate");
  for (std::size_t i = 0; i < at.size(); ++i) node.at.push_back(at.at(i).finite_number());
  const std::string role = json.at("role").text();
  if (role != "sensor" && role != "hidden" && role != "joint") json.at("role").bad("sensor, hidden or joint");
  node.role = role == "sensor" ? NodeRole::sensor : role == "joint" ? NodeRole::joint : NodeRole::hidden;
  return node;
}

int read_index(const JsonView& json, std::size_t end) {
  const std::int64_t index = json.integer();
  if (index < 0 || index >= static_cast<std::int64_t>(end)) json.bad("the index of a node");
  return static_cast<int>(index);
}

int read_count(const JsonView& json) {
  const std::int64_t count = json.integer();
  if (count < 0 || count > std::numeric_limits<int>::max()) json.bad("a whole number from 0 to 2147483647");
  return static_cast<int>(count);
}

NetworkLink read_link(const JsonView& json, std::size_t nodes) {
  const double weight = json.at("weight").finite_number();
  return {read_index(json.at("source"), nodes), read_index(json.at("target"), nodes), weight};
}

}  // namespace

NeuralNetwork parse_network(const std::string& controller_json, const std::string& what) {
  const io::Json document = io::parse_json(controller_json, what);
  const JsonView json(document, what);
  NeuralNetwork network;
  const JsonView coordinates = json.at("coordinates");
  for (std::size_t i = 0; i < coordinates.size(); ++i)
    network.coordinates.push_back(coordinates.at(i).text());
  const JsonView nodes = json.at("nodes");
  for (std::size_t i = 0; i < nodes.size(); ++i)
    network.nodes.push_back(read_node(nodes.at(i), coordinates.size()));
  const JsonView links = json.at("links");
  for (std::size_t i = 0; i < links.size(); ++i)
    network.links.push_back(read_link(links.at(i), nodes.size()));
  network.possible_links = read_count(json.at("possible_links"));
  return network;
}

}  // namespace amble::motion
