#include "amble/page/lab_page.hpp"

#include <string_view>

#include "amble/core/check.hpp"
#include "amble/figures/style_sheet.hpp"
#include "amble/page/html_page.hpp"
#include "amble/page/template_marks.hpp"

namespace amble::page {

std::string make_lab_page(const std::vector<LabRobot>& robots, const std::string& made_by) {
  AMBLE_CHECK(!robots.empty(), "a lab has a robot");
  io::Json list = io::Json::array();
  for (const LabRobot& robot : robots) {
    io::Json configs = io::Json::object();
    for (const auto& [name, config] : robot.configs) configs[name] = config;
    list.push_back(
        {{"id", robot.id}, {"name", robot.name}, {"text", robot.text}, {"configs", std::move(configs)}});
  }
  const io::Json data{{"made_by", made_by}, {"robots", packed(list.dump())}};
  std::string html;
  std::string_view rest = lab_template();
  rest = fill(rest, "<!--amble:palette-->", "<style>" + figures::shared_style_sheet() + "</style>", html);
  rest = fill(rest, "<!--amble:data-->",
              "<script type=\"application/json\" id=\"amble-data\">" + script_text(data) + "</script>", html);
  rest = fill(rest, "<!--amble:module-->", module_elements(), html);
  fill_end(rest, html);
  return html;
}

}  // namespace amble::page
