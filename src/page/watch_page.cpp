#include "amble/page/watch_page.hpp"

#include <string_view>

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

}  // namespace amble::page
