#include "amble/page/template_marks.hpp"

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

std::string module_element() {
  return "<script type=\"text/plain\" id=\"amble-module\">" + packed(std::string(browser_module())) +
         "</script>";
}

std::string_view fill(std::string_view rest, std::string_view mark, std::string_view content,
                      std::string& page) {
  const auto at = rest.find(mark);
  AMBLE_CHECK(at != std::string_view::npos, "the page's template has all marks, in order");
  page += rest.substr(0, at);
  page += content;
  return rest.substr(at + mark.size());
}

}  // namespace amble::page
