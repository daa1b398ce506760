#pragma once

#include <functional>
#include <initializer_list>
#include <string>
#include <string_view>
#include <vector>

#include "amble/figures/figure_size.hpp"

namespace amble::report {

/// Parts of a page as well-formed XML. Arguments named `content` are markup, all other texts are plain and
/// escaped here.

/// The text with no-break spaces where a line must not end: within "[1.2, 3.4]" and between a number and its
/// unit. For markup, too.
std::string tied(std::string_view text);

/// A section with an anchor, a title and a paragraph (none if `lead` is empty).
std::string section(std::string_view id, std::string_view title, std::string_view lead,
                    std::string_view content);
std::string paragraph(std::string_view text, std::string_view css_class = {});
std::string subtitle(std::string_view text);
/// Both layouts of a figure; the style sheet shows the one that fits.
std::string figure(const std::function<std::string(figures::FigureSize)>& draw,
                   std::string_view caption = {});
/// A part that the reader opens.
std::string folded(std::string_view title, std::string_view content, bool open = false);

/// A column of a table. Numbers are right-aligned.
struct Column {
  std::string title;
  bool is_number = true;
  std::string css_class = {};
};

class TableWriter {
 public:
  /// `css_class`: "cards", each row of which becomes a card on phones, with every cell behind its column's
  /// title; "dense" for few and narrow columns, which stay a table there; and names for more style.
  explicit TableWriter(std::vector<Column> columns, std::string_view css_class = "cards");
  /// The first cell is the row's head. As many as there are columns.
  void row(const std::vector<std::string>& texts);
  /// The same with markup in place of texts.
  void row_of_markup(const std::vector<std::string>& contents);
  std::string finish();

 private:
  std::vector<Column> columns_;
  std::string out_;
};

}  // namespace amble::report
