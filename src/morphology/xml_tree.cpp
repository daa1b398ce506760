#include "amble/morphology/xml_tree.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cstdint>

#include "amble/core/error.hpp"
#include "amble/morphology/model_bytes.hpp"

namespace amble::morphology {
namespace {

constexpr std::string_view blanks = " \t\r\n";

/// Without those at its ends.
std::string_view without_blanks(std::string_view text) {
  const std::size_t first = text.find_first_not_of(blanks);
  return first == std::string_view::npos ? "" : text.substr(first, text.find_last_not_of(blanks) - first + 1);
}

/// An attribute's value as XML means it: a line break is a blank there, unless it is written as a number.
std::string resolved(std::string_view value) {
  std::string text(value);
  for (char& c : text)
    if (c == '\n' || c == '\r') c = ' ';
  return without_entities(text);
}

class Parser {
 public:
  Parser(std::string_view text, const std::string& file, const XmlLimits& limits)
      : text_(text), file_(file), limits_(limits) {}

  XmlElement document() {
    // Neither XML nor MuJoCo, for which it ends a text, has such a character.
    if (const std::size_t zero = text_.find('\0'); zero != std::string_view::npos) {
      at_ = zero;
      bad("there is a zero byte, which no text has");
    }
    if (text_.starts_with("\xef\xbb\xbf")) at_ = 3;
    skip_between();
    if (at_ >= text_.size()) bad("expected an element, but the file ends");
    XmlElement root = element(1);
    skip_between();
    if (at_ < text_.size()) bad("expected the end of the file after </" + root.name + ">");
    return root;
  }

 private:
  [[noreturn]] void bad(const std::string& problem) {
    fail(ExitCode::bad_input, "{}:{}: no XML that can be read: {}", file_, line(), problem);
  }
  [[noreturn]] void too_many(const std::string& what) {
    fail(ExitCode::bad_input, "{}:{}: too large a model: {}", file_, line(), what);
  }

  /// Number of the line at which the parser stands.
  int line() {
    for (; counted_ < std::min(at_, text_.size()); ++counted_) line_ += text_[counted_] == '\n' ? 1 : 0;
    return line_;
  }

  bool at(std::string_view what) const { return text_.substr(at_).starts_with(what); }

  void skip_past(std::string_view end) {
    const std::size_t found = text_.find(end, at_);
    if (found == std::string_view::npos) bad("'" + std::string(end) + "' is missing");
    at_ = found + end.size();
  }

  /// Text, comments and processing instructions between tags.
  void skip_between() {
    for (;;) {
      const std::size_t found = text_.find('<', at_);
      const std::string_view between =
          text_.substr(at_, found == std::string_view::npos ? found : found - at_);
      if (open_ == 0 && between.find_first_not_of(blanks) != std::string_view::npos) bad("expected '<'");
      at_ = found == std::string_view::npos ? text_.size() : found;
      if (at("<!--")) {
        skip_past("-->");
      } else if (at("<![CDATA[")) {
        skip_past("]]>");
      } else if (at("<?")) {
        skip_past("?>");
      } else if (at("<!DOCTYPE") && elements_ == 0) {
        skip_document_type();
      } else if (at("<!")) {
        bad("declarations (<!…>) stand before the first element");
      } else {
        return;
      }
    }
  }

  /// A document type that only names the format, or where its definition is, says nothing of the model.
  void skip_document_type() {
    char quote = '\0';
    for (std::size_t end = at_ + 1; end < text_.size(); ++end) {
      const char c = text_[end];
      if (quote != '\0') {
        if (c == quote) quote = '\0';
      } else if (c == '"' || c == '\'') {
        quote = c;
      } else if (c == '[') {
        fail(ExitCode::bad_input,
             "{}:{}: document types with entities (<!DOCTYPE … [<!ENTITY …>]>) are refused: write what they "
             "stand for in their place",
             file_, line());
      } else if (c == '>') {
        at_ = end + 1;
        return;
      }
    }
    bad("'>' is missing");
  }

  std::string_view name() {
    const std::size_t end = text_.find_first_of(" \t\r\n/>=<\"'", at_);
    const std::string_view found = text_.substr(at_, end == std::string_view::npos ? end : end - at_);
    if (found.empty()) bad("expected a name");
    at_ += found.size();
    return found;
  }

  void skip_blanks() { at_ = std::min(text_.find_first_not_of(blanks, at_), text_.size()); }

  void attribute(XmlElement& element) {
    const std::string key(name());
    skip_blanks();
    if (!at("=")) bad("attribute '" + key + "' has no value");
    ++at_;
    skip_blanks();
    if (!at("\"") && !at("'")) bad("the value of '" + key + "' must stand in quotes");
    const char quote = text_[at_++];
    const std::size_t end = text_.find(quote, at_);
    if (end == std::string_view::npos) bad("the value of '" + key + "' has no end");
    // MuJoCo counts the numbers of a keyframe wrongly if a line break or a blank comes first.
    const std::string_view value = without_blanks(text_.substr(at_, end - at_));
    if (value.find('<') != std::string_view::npos) bad("'<' in the value of '" + key + "'");
    if (element.attribute(key)) bad("attribute '" + key + "' is given twice");
    element.attributes.emplace_back(key, resolved(value));
    at_ = end + 1;
  }

  XmlElement element(std::size_t depth) {
    if (depth > limits_.depth) too_many(fmt::format("elements within each other {} deep", depth));
    if (++elements_ > limits_.elements) too_many(fmt::format("more than {} elements", limits_.elements));
    XmlElement element;
    element.file = file_;
    element.line = line();
    ++at_;  // <
    element.name = name();
    if ((element.name == "body" || element.name == "link") && ++bodies_ > limits_.bodies)
      too_many(fmt::format("more than {} bodies", limits_.bodies));
    for (;;) {
      skip_blanks();
      if (at("/>")) {
        at_ += 2;
        return element;
      }
      if (at(">")) break;
      if (at_ >= text_.size()) bad("<" + element.name + "> has no end");
      attribute(element);
    }
    ++at_;  // >
    ++open_;
    if (limits_.keep_text)
      element.text = text_.substr(at_, std::min(text_.find('<', at_), text_.size()) - at_);
    for (skip_between(); !at("</"); skip_between()) {
      if (at_ >= text_.size()) bad("</" + element.name + "> is missing");
      element.children.push_back(this->element(depth + 1));
    }
    at_ += 2;
    if (name() != element.name) bad("</" + element.name + "> is missing");
    skip_blanks();
    if (!at(">")) bad("expected '>'");
    ++at_;
    --open_;
    return element;
  }

  std::string_view text_;
  const std::string& file_;
  const XmlLimits& limits_;
  std::size_t at_ = 0, counted_ = 0, elements_ = 0, bodies_ = 0, open_ = 0;
  int line_ = 1;
};

/// A character of an attribute's value. Line breaks as numbers: one line for one element.
std::string escaped(char c, char quote) {
  if (c == '&') return "&amp;";
  if (c == '<') return "&lt;";
  if (c == quote) return c == '"' ? "&quot;" : "&apos;";
  const auto byte = static_cast<unsigned char>(c);
  return byte < 0x20 && c != '\t' ? fmt::format("&#{};", byte) : std::string(1, c);
}

void write(XmlElement& element, XmlText& out) {
  out.lines.push_back(&element);
  out.text += "<" + element.name;
  for (const auto& [key, value] : element.attributes) {
    const char quote = value.find('"') == std::string::npos ? '"' : '\'';
    out.text += " " + key + "=" + quote;
    for (const char c : value) out.text += escaped(c, quote);
    out.text += quote;
  }
  out.text += element.children.empty() ? "/>" : ">";
  if (element.children.empty()) return;
  for (XmlElement& child : element.children) {
    out.text += "\n";
    write(child, out);
  }
  out.text += "</" + element.name + ">";
}

/// The character that "&#65" or "&#x41" stands for; 0 and what is beyond Unicode are no characters.
std::optional<char32_t> character_number(std::string_view entity) {
  if (!entity.starts_with("&#") || entity.size() > 10) return std::nullopt;
  const bool hexadecimal = entity.substr(2).starts_with('x');
  entity.remove_prefix(hexadecimal ? 3 : 2);
  std::uint32_t number = 0;
  const auto [end, error] =
      std::from_chars(entity.data(), entity.data() + entity.size(), number, hexadecimal ? 16 : 10);
  if (entity.empty() || error != std::errc() || end != entity.data() + entity.size()) return std::nullopt;
  return number == 0 ? U'\xFFFD' : static_cast<char32_t>(number);
}

}  // namespace

std::optional<std::string> XmlElement::attribute(std::string_view key) const {
  for (const auto& [own, value] : attributes)
    if (own == key) return value;
  return std::nullopt;
}

std::string XmlElement::attribute_or(std::string_view key, std::string_view other) const {
  return attribute(key).value_or(std::string(other));
}

void XmlElement::set(std::string_view key, std::string_view value) {
  for (auto& [own, old] : attributes) {
    if (own == key) {
      old = value;
      return;
    }
  }
  attributes.emplace_back(key, value);
}

void XmlElement::remove_attribute(std::string_view key) {
  std::erase_if(attributes, [&](const auto& attribute) { return attribute.first == key; });
}

XmlElement* XmlElement::child(std::string_view child_name) {
  const auto found = std::ranges::find(children, child_name, &XmlElement::name);
  return found == children.end() ? nullptr : &*found;
}

const XmlElement* XmlElement::child(std::string_view child_name) const {
  const auto found = std::ranges::find(children, child_name, &XmlElement::name);
  return found == children.end() ? nullptr : &*found;
}

void XmlElement::visit(const std::function<void(XmlElement&, XmlElement*)>& action) {
  const auto descend = [&action](const auto& self, XmlElement& element, XmlElement* parent) -> void {
    action(element, parent);
    for (XmlElement& child : element.children) self(self, child, &element);
  };
  descend(descend, *this, nullptr);
}

void XmlElement::visit(const std::function<void(const XmlElement&)>& action) const {
  action(*this);
  for (const XmlElement& child : children) child.visit(action);
}

void XmlElement::prune(const std::function<bool(const XmlElement&, const XmlElement&)>& unwanted) {
  std::erase_if(children, [&](const XmlElement& child) { return unwanted(child, *this); });
  for (XmlElement& child : children) child.prune(unwanted);
}

std::string without_entities(std::string_view value) {
  static constexpr std::array<std::pair<std::string_view, char>, 5> named{
      {{"&amp;", '&'}, {"&lt;", '<'}, {"&gt;", '>'}, {"&quot;", '"'}, {"&apos;", '\''}}};
  constexpr std::size_t longest = 12;  // &#x0010FFFF;
  std::string text;
  for (;;) {
    const std::size_t plain = std::min(value.find('&'), value.size());
    text += value.substr(0, plain);
    value.remove_prefix(plain);
    if (value.empty()) return text;
    const auto found =
        std::ranges::find_if(named, [&](const auto& entity) { return value.starts_with(entity.first); });
    const std::size_t end = value.substr(0, longest).find(';');
    if (found != named.end()) {
      text += found->second;
      value.remove_prefix(found->first.size());
    } else if (const auto number =
                   end == std::string_view::npos ? std::nullopt : character_number(value.substr(0, end))) {
      append_utf8(text, *number);
      value.remove_prefix(end + 1);
    } else {
      text += value.front();
      value.remove_prefix(1);
    }
  }
}

XmlElement parse_xml(std::string_view text, const std::string& file, const XmlLimits& limits) {
  return Parser(text, file, limits).document();
}

XmlText write_xml(XmlElement& root) {
  XmlText out;
  write(root, out);
  out.text += "\n";
  return out;
}

}  // namespace amble::morphology
