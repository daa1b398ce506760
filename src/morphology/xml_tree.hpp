#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace amble::morphology {

/// An element of an XML document with its place in the file.
struct XmlElement {
  std::string name;
  std::vector<std::pair<std::string, std::string>> attributes = {};  ///< values with entities resolved
  std::vector<XmlElement> children = {};
  std::string file = {};
  int line = 0;
  std::string text = {};  ///< before its first child; only if XmlLimits says so: neither MJCF nor URDF use it

  std::optional<std::string> attribute(std::string_view key) const;
  std::string attribute_or(std::string_view key, std::string_view other) const;
  /// Appends the attribute if there is none of that name.
  void set(std::string_view key, std::string_view value);
  void remove_attribute(std::string_view key);
  /// The first child of that name, or none.
  XmlElement* child(std::string_view child_name);
  const XmlElement* child(std::string_view child_name) const;
  /// This element and all below it, parents first; `parent` is null for this one.
  void visit(const std::function<void(XmlElement& element, XmlElement* parent)>& action);
  void visit(const std::function<void(const XmlElement& element)>& action) const;
  /// Removes all descendants for which `unwanted` holds.
  void prune(const std::function<bool(const XmlElement& element, const XmlElement& parent)>& unwanted);
};

/// What a document may have at most, so that no file takes unbounded memory or time.
struct XmlLimits {
  std::size_t elements = 200'000;
  std::size_t depth = 256;
  std::size_t bodies = 1000;  ///< elements <body> or <link>
  bool keep_text = false;
};

/// An attribute's value with the five entities of XML and numbers of characters resolved.
std::string without_entities(std::string_view value);

/// Reads a document with one root element. A document type is passed over; one with
/// entities of its own is refused. Throws
/// UserError "FILE:LINE: …".
XmlElement parse_xml(std::string_view text, const std::string& file, const XmlLimits& limits = {});

/// A document as text, each element's start on a line of its own; `lines[n − 1]` is the element of line n.
struct XmlText {
  std::string text;
  std::vector<XmlElement*> lines;
};
XmlText write_xml(XmlElement& root);

}  // namespace amble::morphology
