#include "tests/figures/xml.hpp"

#include <cctype>
#include <sstream>
#include <stdexcept>

namespace amble::tests {
namespace {

class Parser {
 public:
  explicit Parser(std::string_view text) : rest_(text) {}

  std::vector<XmlElement> parse() {
    if (rest_.starts_with("<!DOCTYPE html>")) rest_.remove_prefix(15);
    while (!rest_.empty()) {
      if (rest_[0] != '<') {
        read_text();
      } else if (rest_.starts_with("</")) {
        read_end();
      } else {
        read_start();
      }
    }
    if (!open_.empty()) bad("element '" + elements_[open_.back()].name + "' is not closed");
    if (roots_ != 1) bad("there must be one root");
    return std::move(elements_);
  }

 private:
  [[noreturn]] void bad(const std::string& why) const {
    throw std::runtime_error(why + " before: " + std::string(rest_.substr(0, 60)));
  }

  void expect(std::string_view token) {
    if (!rest_.starts_with(token)) bad("expected '" + std::string(token) + "'");
    rest_.remove_prefix(token.size());
  }

  void skip_space() {
    while (!rest_.empty() && std::isspace(static_cast<unsigned char>(rest_[0]))) rest_.remove_prefix(1);
  }

  std::string name() {
    std::size_t size = 0;
    while (size < rest_.size() && (std::isalnum(static_cast<unsigned char>(rest_[size])) ||
                                   rest_[size] == '-' || rest_[size] == ':' || rest_[size] == '_'))
      ++size;
    if (size == 0) bad("expected a name");
    std::string found(rest_.substr(0, size));
    rest_.remove_prefix(size);
    return found;
  }

  /// Resolves entities up to `end`, which stays.
  std::string characters(char end) {
    static const std::map<std::string, std::string> entities{
        {"lt", "<"}, {"gt", ">"}, {"amp", "&"}, {"quot", "\""}, {"#39", "'"}};
    std::string found;
    while (!rest_.empty() && rest_[0] != end) {
      const char c = rest_[0];
      if (c == '<') bad("bare <");
      if (static_cast<unsigned char>(c) < 0x20 && c != '\n' && c != '\t') bad("control character");
      rest_.remove_prefix(1);
      if (c != '&') {
        found += c;
        continue;
      }
      const std::size_t semicolon = rest_.find(';');
      const auto entity = entities.find(std::string(rest_.substr(0, semicolon)));
      if (semicolon == std::string_view::npos || entity == entities.end()) bad("bare & or unknown entity");
      found += entity->second;
      rest_.remove_prefix(semicolon + 1);
    }
    return found;
  }

  void read_text() {
    const std::string found = characters('<');
    if (!open_.empty() && open_.back() + 1 == elements_.size()) elements_.back().text += found;
    if (open_.empty() && found.find_first_not_of(" \n\t") != std::string::npos) bad("text outside the root");
  }

  void read_start() {
    expect("<");
    XmlElement element;
    element.name = name();
    for (skip_space(); !rest_.empty() && rest_[0] != '>' && rest_[0] != '/'; skip_space()) {
      const std::string attribute = name();
      expect("=");
      expect("\"");
      if (!element.attributes.emplace(attribute, characters('"')).second) bad("attribute twice");
      expect("\"");
    }
    if (!open_.empty()) element.path = elements_[open_.back()].path;
    element.path.push_back(element.attributes["class"]);
    if (open_.empty()) ++roots_;
    elements_.push_back(element);
    if (rest_.starts_with("/>")) {
      expect("/>");
    } else {
      expect(">");
      open_.push_back(elements_.size() - 1);
    }
  }

  void read_end() {
    expect("</");
    const std::string closed = name();
    expect(">");
    if (open_.empty() || elements_[open_.back()].name != closed) bad("'" + closed + "' closes nothing");
    open_.pop_back();
  }

  std::string_view rest_;
  std::vector<XmlElement> elements_;
  std::vector<std::size_t> open_;
  int roots_ = 0;
};

bool has_word(const std::string& words, const std::string& word) {
  std::istringstream stream(words);
  for (std::string each; stream >> each;)
    if (each == word) return true;
  return false;
}

}  // namespace

double XmlElement::number(const std::string& attribute) const {
  return std::stod(attributes.at(attribute));
}

std::vector<XmlElement> parse_xml(std::string_view text) {
  return Parser(text).parse();
}

std::vector<XmlElement> with_class(const std::vector<XmlElement>& elements, const std::string& css_class) {
  std::vector<XmlElement> found;
  for (const XmlElement& element : elements)
    if (has_word(element.path.back(), css_class)) found.push_back(element);
  return found;
}

std::vector<std::string> texts(const std::vector<XmlElement>& elements) {
  std::vector<std::string> found;
  for (const XmlElement& element : elements)
    if (element.name == "text") found.push_back(element.text);
  return found;
}

std::vector<std::pair<double, double>> points(const XmlElement& element) {
  std::vector<std::pair<double, double>> found;
  std::istringstream stream(element.attributes.at("points"));
  char comma = 0;
  for (double x = 0, y = 0; stream >> x >> comma >> y;) found.emplace_back(x, y);
  return found;
}

}  // namespace amble::tests
