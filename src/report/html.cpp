#include "amble/report/html.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "amble/core/check.hpp"
#include "amble/io/quoting.hpp"

namespace amble::report {

using figures::FigureSize;
using io::escape_xml;

namespace {

std::string class_of(const Column& column) {
  const std::string_view both = column.is_number && !column.css_class.empty() ? " " : "";
  const std::string names = fmt::format("{}{}{}", column.is_number ? "number" : "", both, column.css_class);
  return names.empty() ? "" : fmt::format(" class=\"{}\"", names);
}

}  // namespace

std::string tied(std::string_view text) {
  constexpr std::array<std::string_view, 7> units{"%", "m", "s", "×", "h", "min", "df"};
  std::string out;
  int depth = 0;
  for (std::size_t i = 0; i < text.size(); ++i) {
    depth += text[i] == '[' ? 1 : text[i] == ']' ? -1 : 0;
    bool tie = depth > 0;
    if (text[i] == ' ' && i > 0 && text[i - 1] >= '0' && text[i - 1] <= '9') {
      const auto end = text.find_first_of(" ,;.)<", i + 1);
      const std::string_view word = text.substr(i + 1, end == text.npos ? end : end - i - 1);
      tie = tie || std::ranges::find(units, word) != units.end();
    }
    if (text[i] == ' ' && tie)
      out += "\u00A0";
    else
      out += text[i];
  }
  return out;
}

std::string section(std::string_view id, std::string_view title, std::string_view lead,
                    std::string_view content) {
  return fmt::format("<section id=\"{}\">\n<h2>{}</h2>\n{}{}</section>\n", escape_xml(id), escape_xml(title),
                     lead.empty() ? "" : paragraph(lead), content);
}

std::string paragraph(std::string_view text, std::string_view css_class) {
  if (css_class.empty()) return fmt::format("<p>{}</p>\n", tied(escape_xml(text)));
  return fmt::format("<p class=\"{}\">{}</p>\n", css_class, tied(escape_xml(text)));
}

std::string subtitle(std::string_view text) {
  return fmt::format("<h3>{}</h3>\n", escape_xml(text));
}

std::string figure(const std::function<std::string(FigureSize)>& draw, std::string_view caption) {
  const std::string below =
      caption.empty() ? "" : fmt::format("<figcaption>{}</figcaption>", escape_xml(caption));
  return fmt::format("<figure><div class=\"wide\">{}</div><div class=\"narrow\">{}</div>{}</figure>\n",
                     draw(FigureSize::wide), draw(FigureSize::narrow), below);
}

std::string folded(std::string_view title, std::string_view content, bool open) {
  return fmt::format("<details{}>\n<summary>{}</summary>\n{}</details>\n", open ? " open=\"open\"" : "",
                     escape_xml(title), content);
}

TableWriter::TableWriter(std::vector<Column> columns, std::string_view css_class)
    : columns_(std::move(columns)) {
  out_ = fmt::format("<div class=\"scroll\"><table class=\"data {}\">\n<thead><tr>", css_class);
  for (const Column& column : columns_)
    out_ += fmt::format("<th scope=\"col\"{}>{}</th>", class_of(column), escape_xml(column.title));
  out_ += "</tr></thead>\n<tbody>\n";
}

void TableWriter::row(const std::vector<std::string>& texts) {
  std::vector<std::string> contents;
  contents.reserve(texts.size());
  for (const std::string& text : texts) contents.push_back(tied(escape_xml(text)));
  row_of_markup(contents);
}

void TableWriter::row_of_markup(const std::vector<std::string>& contents) {
  AMBLE_CHECK(contents.size() == columns_.size(), "a row has a cell per column");
  out_ += "<tr>";
  for (std::size_t i = 0; i < contents.size(); ++i) {
    const std::string css_class = class_of(columns_[i]);
    // The style sheet of phones lays out title and content side by side, so the content is one box.
    if (i == 0)
      out_ += fmt::format("<th scope=\"row\"{}>{}</th>", css_class, contents[i]);
    else
      out_ += fmt::format("<td{} data-title=\"{}\"><div>{}</div></td>", css_class,
                          escape_xml(columns_[i].title), contents[i]);
  }
  out_ += "</tr>\n";
}

std::string TableWriter::finish() {
  return std::move(out_) + "</tbody>\n</table></div>\n";
}

}  // namespace amble::report
