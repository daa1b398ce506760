#include "amble/page/template_marks.hpp"

#include <fmt/format.h>

#include "amble/core/check.hpp"
#include "amble/io/base64.hpp"
#include "amble/page/html_page.hpp"
#include "amble/robot/deflate.hpp"

namespace amble::page {

std::string script_text(const io::Json& json) {
  std::string text;
  for (const char c : json.dump(-1, ' ', true, io::Json::error_handler_t::replace)) {
    if (c == '<')
      text += "\\u003c";
    else
      text += c;
  }
  return text;
}

std::string packed(const std::string& bytes) {
  return io::base64(robot::deflated(bytes, 9));
}

std::string module_elements() {
  const auto element = [](std::string_view id, std::string_view bytes) {
    return fmt::format("<script type=\"text/plain\" id=\"{}\">{}</script>", id, packed(std::string(bytes)));
  };
  return element("amble-module", browser_module()) + element("amble-relaxed", relaxed_patch());
}

std::string_view fill(std::string_view rest, std::string_view mark, std::string_view content,
                      std::string& page) {
  const auto at = rest.find(mark);
  AMBLE_CHECK(at != std::string_view::npos, "the page's template has all marks, in order");
  page += rest.substr(0, at);
  page += content;
  return rest.substr(at + mark.size());
}

void fill_end(std::string_view rest, std::string& page) {
  constexpr std::string_view begin = "<script id=\"amble-program\">", end = "</script>";
  rest = fill(rest, begin, "<script type=\"text/plain\" id=\"amble-program\">", page);
  const auto length = rest.find(end);
  AMBLE_CHECK(length != std::string_view::npos, "the page's program ends");
  page += packed(std::string(rest.substr(0, length)));
  page += rest.substr(length);
}

}  // namespace amble::page
