#include "amble/report/html.hpp"

#include <fmt/format.h>

#include "amble/analysis/svg.hpp"
#include "amble/core/check.hpp"

namespace amble::report {

using analysis::escape;
using analysis::Layout;

std::string section(std::string_view id, std::string_view title, std::string_view lead,
                    std::string_view content) {
  return fmt::format("<section id=\"{}\">\n<h2>{}</h2>\n{}{}</section>\n", escape(id), escape(title),
                     lead.empty() ? "" : paragraph(lead), content);
}

std::string paragraph(std::string_view text, std::string_view css_class) {
  if (css_class.empty()) return fmt::format("<p>{}</p>\n", escape(text));
  return fmt::format("<p class=\"{}\">{}</p>\n", css_class, escape(text));
}

std::string subtitle(std::string_view text) {
  return fmt::format("<h3>{}</h3>\n", escape(text));
}

std::string figure(const std::function<std::string(Layout)>& draw, std::string_view caption) {
  const std::string below =
      caption.empty() ? "" : fmt::format("<figcaption>{}</figcaption>", escape(caption));
  return fmt::format("<figure><div class=\"wide\">{}</div><div class=\"narrow\">{}</div>{}</figure>\n",
                     draw(Layout::wide), draw(Layout::narrow), below);
}

std::string folded(std::string_view title, std::string_view content, bool open) {
  return fmt::format("<details{}>\n<summary>{}</summary>\n{}</details>\n", open ? " open=\"open\"" : "",
                     escape(title), content);
}

TableWriter::TableWriter(std::vector<Column> columns, std::string_view css_class)
    : columns_(std::move(columns)) {
  out_ = fmt::format("<table class=\"data{}{}\">\n<thead><tr>", css_class.empty() ? "" : " ", css_class);
  for (const Column& column : columns_)
    out_ += fmt::format("<th scope=\"col\"{}>{}</th>", column.is_number ? " class=\"number\"" : "",
                        escape(column.title));
  out_ += "</tr></thead>\n<tbody>\n";
}

void TableWriter::row(const std::vector<std::string>& texts) {
  std::vector<std::string> contents;
  for (const std::string& text : texts) contents.push_back(escape(text));
  row_of_markup(contents);
}

void TableWriter::row_of_markup(const std::vector<std::string>& contents) {
  AMBLE_CHECK(contents.size() == columns_.size(), "a row has a cell per column");
  out_ += "<tr>";
  for (std::size_t i = 0; i < contents.size(); ++i) {
    const std::string number = columns_[i].is_number ? " class=\"number\"" : "";
    if (i == 0)
      out_ += fmt::format("<th scope=\"row\"{}>{}</th>", number, contents[i]);
    else
      out_ += fmt::format("<td{} data-title=\"{}\">{}</td>", number, escape(columns_[i].title), contents[i]);
  }
  out_ += "</tr>\n";
}

std::string TableWriter::finish() {
  return std::move(out_) + "</tbody>\n</table>\n";
}

}  // namespace amble::report
