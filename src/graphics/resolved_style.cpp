#include "amble/graphics/resolved_style.hpp"

#include <algorithm>
#include <cctype>
#include <set>
#include <vector>

#include "amble/core/check.hpp"

namespace amble::graphics {
namespace {

struct Declaration {
  std::string property, value;
};

struct Rule {
  std::vector<std::string> selectors;
  std::vector<Declaration> declarations;
};

std::string trimmed(std::string_view text) {
  constexpr std::string_view space = " \n\t";
  const std::size_t first = text.find_first_not_of(space);
  if (first == std::string_view::npos) return {};
  return std::string(text.substr(first, text.find_last_not_of(space) - first + 1));
}

/// The parts between separators, trimmed, without empty ones.
std::vector<std::string> split(std::string_view text, char separator) {
  std::vector<std::string> parts;
  while (!text.empty()) {
    const std::size_t end = std::min(text.find(separator), text.size());
    if (std::string part = trimmed(text.substr(0, end)); !part.empty()) parts.push_back(std::move(part));
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  return parts;
}

std::vector<Declaration> parse_declarations(std::string_view text) {
  std::vector<Declaration> declarations;
  for (const std::string& one : split(text, ';')) {
    const std::size_t colon = one.find(':');
    AMBLE_CHECK(colon != std::string::npos, "a declaration has a colon");
    declarations.push_back({trimmed(one.substr(0, colon)), trimmed(one.substr(colon + 1))});
  }
  return declarations;
}

std::vector<Rule> parse_rules(std::string_view text) {
  AMBLE_CHECK(text.find('@') == std::string_view::npos, "rules without at-rules");
  std::vector<Rule> rules;
  for (const std::string& one : split(text, '}')) {
    const std::size_t brace = one.find('{');
    AMBLE_CHECK(brace != std::string::npos, "a rule has a brace");
    rules.push_back({split(one.substr(0, brace), ','), parse_declarations(one.substr(brace + 1))});
  }
  return rules;
}

bool is_name(char c) {
  return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '-' || c == '_';
}

std::set<std::string> classes_of_selector(std::string_view selector) {
  std::set<std::string> classes;
  for (std::size_t i = 0; i < selector.size(); ++i) {
    if (selector[i] != '.') continue;
    const auto end =
        std::find_if_not(selector.begin() + static_cast<std::ptrdiff_t>(i) + 1, selector.end(), is_name);
    classes.emplace(selector.begin() + static_cast<std::ptrdiff_t>(i) + 1, end);
  }
  return classes;
}

std::set<std::string> classes_of_element(std::string_view element) {
  constexpr std::string_view attribute = "class=\"";
  std::set<std::string> classes;
  for (std::size_t at = element.find(attribute); at != std::string_view::npos;
       at = element.find(attribute, at)) {
    at += attribute.size();
    for (std::string& name : split(element.substr(at, element.find('"', at) - at), ' '))
      classes.insert(std::move(name));
  }
  return classes;
}

/// `value` with each var(--name) replaced.
std::string resolved(std::string value, const CustomProperties& properties) {
  for (std::size_t at = value.find("var("); at != std::string::npos; at = value.find("var(", at)) {
    const std::size_t end = value.find(')', at);
    const auto property = properties.find(value.substr(at + 4, end - at - 4));
    AMBLE_CHECK(property != properties.end(), "a custom property that is known");
    value.replace(at, end - at + 1, property->second);
  }
  return value;
}

/// The selector inside, at, or around an element of the class: the class before the first compound, and at
/// and after each.
std::vector<std::string> within_class(const std::string& selector, const std::string& name) {
  const std::vector<std::string> compounds = split(selector, ' ');
  const auto joined = [&](std::size_t at, const std::string& before, const std::string& after) {
    std::string text;
    for (std::size_t i = 0; i < compounds.size(); ++i) {
      if (i > 0) text += ' ';
      if (i == at) text += before;
      text += compounds[i];
      if (i == at) text += after;
    }
    return text;
  };
  std::vector<std::string> selectors;
  for (std::size_t i = 0; i < compounds.size(); ++i) {
    selectors.push_back(joined(i, "." + name + " ", ""));
    const bool pseudo = compounds[i].find(':') != std::string::npos;
    if (!pseudo) selectors.push_back(joined(i, "", "." + name));
  }
  return selectors;
}

/// What is written of a rule for one scheme.
class Writer {
 public:
  Writer(const CustomProperties& properties, std::set<std::string> classes, bool colours_only)
      : properties_(properties), classes_(std::move(classes)), colours_only_(colours_only) {}

  void write(const Rule& rule) {
    std::vector<std::string> selectors;
    for (const std::string& selector : rule.selectors)
      if (std::ranges::includes(classes_, classes_of_selector(selector))) selectors.push_back(selector);
    std::vector<Declaration> own, of_legs;
    for (const Declaration& declaration : rule.declarations) {
      if (colours_only_ && !is_colour(declaration.property)) continue;
      const bool of_leg = declaration.value.find("var(--leg)") != std::string::npos;
      (of_leg ? of_legs : own).push_back(declaration);
    }
    write(selectors, own, properties_);
    for (const auto& [name, value] : properties_) {
      const std::string leg = "leg" + name.substr(std::min<std::size_t>(name.size(), 3));
      if (!name.starts_with("--c") || !classes_.contains(leg)) continue;
      CustomProperties with_leg = properties_;
      with_leg["--leg"] = value;
      std::vector<std::string> within;
      for (const std::string& selector : selectors)
        for (std::string& one : within_class(selector, leg)) within.push_back(std::move(one));
      write(within, of_legs, with_leg);
    }
  }

  const std::string& text() const { return text_; }

 private:
  static bool is_colour(std::string_view property) {
    return property == "fill" || property == "stroke" || property == "background";
  }

  void write(const std::vector<std::string>& selectors, const std::vector<Declaration>& declarations,
             const CustomProperties& properties) {
    if (selectors.empty() || declarations.empty()) return;
    for (std::size_t i = 0; i < selectors.size(); ++i) text_ += (i == 0 ? "" : ", ") + selectors[i];
    text_ += " {";
    for (const auto& [property, value] : declarations)
      text_ += " " + property + ": " + resolved(value, properties) + ";";
    text_ += " }\n";
  }

  const CustomProperties& properties_;
  std::set<std::string> classes_;
  bool colours_only_;
  std::string text_;
};

}  // namespace

CustomProperties custom_properties(std::string_view declarations) {
  CustomProperties properties;
  for (auto& [property, value] : parse_declarations(declarations))
    if (property.starts_with("--")) properties.emplace(std::move(property), std::move(value));
  return properties;
}

std::string resolved_style(std::string_view rules, const CustomProperties& light,
                           const CustomProperties& dark, std::string_view element) {
  const std::set<std::string> classes = classes_of_element(element);
  Writer all(light, classes, false), dark_colours(dark, classes, true);
  for (const Rule& rule : parse_rules(rules)) {
    all.write(rule);
    dark_colours.write(rule);
  }
  return all.text() + "@media screen and (prefers-color-scheme: dark) {\n" + dark_colours.text() + "}\n";
}

}  // namespace amble::graphics
