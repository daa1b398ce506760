#pragma once

#include <cstdint>
#include <random>
#include <string>
#include <vector>

#include "amble/morphology/xml_tree.hpp"

namespace amble::tests {

/// Edits a model at random, as people and exporters do: numbers are scaled or lost, attributes and elements
/// are removed, doubled, moved or renamed, and parts are added that models of robots have (equalities,
/// tendons, frames, sensors, meshes that are missing). The same seed gives the same edits.
class ModelEditor {
 public:
  explicit ModelEditor(std::uint64_t seed) : random_(seed) {}

  /// Makes one to three edits.
  void edit(morphology::XmlElement& root);

  /// What was done, for messages.
  const std::string& account() const { return account_; }

 private:
  using Element = morphology::XmlElement;

  std::size_t below(std::size_t count) {
    return count == 0 ? 0 : static_cast<std::size_t>(random_() % count);
  }
  template <typename T>
  const T& any_of(const std::vector<T>& all) {
    return all[below(all.size())];
  }
  void edit_once(Element& root);
  void change_number(Element& root);
  void change_word(Element& root);
  void remove_attribute(Element& root);
  void remove_element(Element& root);
  void double_element(Element& root);
  void move_body(Element& root);
  void add_to_body(Element& root);
  void add_section(Element& root);
  void add_to_urdf(Element& root);
  void wrap_in_frame(Element& root);

  /// All elements of that name, of any if it is empty; the root is not among them.
  static std::vector<Element*> elements(Element& root, const std::string& name = {});
  /// The names of the elements of that name.
  static std::vector<std::string> names(Element& root, const std::string& element);
  void did(const std::string& what) { account_ += (account_.empty() ? "" : "; ") + what; }

  std::mt19937_64 random_;
  std::string account_;
};

}  // namespace amble::tests
