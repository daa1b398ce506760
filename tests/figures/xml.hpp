#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace amble::tests {

struct XmlElement {
  std::string name;
  std::map<std::string, std::string> attributes;
  std::string text;               ///< up to the first child
  std::vector<std::string> path;  ///< classes of the elements around it, outermost first, then its own
  double number(const std::string& attribute) const;
};

/// All elements in the order in which they begin. Throws std::runtime_error for what is not well-formed: tags
/// that do not nest, attributes without quotes or twice, bare < or &, unknown entities, more than one root.
std::vector<XmlElement> parse_xml(std::string_view text);

/// Those whose class attribute has the word `css_class`.
std::vector<XmlElement> with_class(const std::vector<XmlElement>& elements, const std::string& css_class);

/// Texts of all <text> elements.
std::vector<std::string> texts(const std::vector<XmlElement>& elements);

/// "x,y x,y …" as numbers.
std::vector<std::pair<double, double>> points(const XmlElement& element);

}  // namespace amble::tests
