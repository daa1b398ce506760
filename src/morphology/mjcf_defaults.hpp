#pragma once

#include <deque>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>

#include "amble/morphology/xml_tree.hpp"

namespace amble::morphology {

/// Attributes of MJCF elements with those of their default classes. All sections <default> are one class at
/// the top, whatever they call it: a later one changes it for all that comes after, and the last is that of
/// elements without a class. The tree's sections <default> must outlive it.
class MjcfDefaults {
 public:
  explicit MjcfDefaults(const XmlElement& root);

  /// `childclass`: of elements that name no class; empty: that at the top.
  std::optional<std::string> attribute(const XmlElement& element, std::string_view key,
                                       const std::string& childclass) const;

 private:
  struct Class {
    const XmlElement* settings;
    const Class* parent;
  };

  const Class* find(const std::string& name) const;
  void add_within(const XmlElement& element, const Class& parent);

  std::deque<Class> tops_;
  std::set<std::string> top_names_;
  std::map<std::string, Class> classes_;
};

}  // namespace amble::morphology
