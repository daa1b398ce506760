#include "amble/page/watch_page.hpp"

#include <string_view>

#include "amble/core/check.hpp"
#include "amble/figures/style_sheet.hpp"
#include "amble/page/html_page.hpp"
#include "amble/page/template_marks.hpp"

namespace amble::page {

std::string make_watch_page(const std::string& made_by) {
  std::string html;
  std::string_view rest = watch_template();
  rest = fill(rest, "<!--amble:palette-->", "<style>" + figures::shared_style_sheet() + "</style>", html);
  rest = fill(rest, "<!--amble:data-->",
              "<script type=\"application/json\" id=\"amble-data\">" +
                  script_text(io::Json{{"made_by", made_by}}) + "</script>",
              html);
  fill_end(rest, html);
  return html;
}

std::string_view watch_page_scripts() {
  constexpr std::string_view begin = "script-src ";
  const std::string_view page = watch_template();
  const auto at = page.find(begin), end = page.find(';', at);
  AMBLE_CHECK(at != std::string_view::npos && end != std::string_view::npos,
              "the page says which scripts may run");
  return page.substr(at + begin.size(), end - at - begin.size());
}

}  // namespace amble::page
