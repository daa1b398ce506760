#include "amble/page/replay_page.hpp"

#include <algorithm>
#include <cmath>
#include <string_view>
#include <utility>
#include <vector>

#include "amble/core/check.hpp"
#include "amble/core/index.hpp"
#include "amble/figures/style_sheet.hpp"
#include "amble/ground/recorded.hpp"
#include "amble/io/base64.hpp"
#include "amble/io/quoting.hpp"
#include "amble/page/html_page.hpp"
#include "amble/page/packed_recording.hpp"
#include "amble/page/template_marks.hpp"
#include "amble/record/frame_codec.hpp"

namespace amble::page {
namespace {

io::Json frames_json(const PackedFrames& frames) {
  return {{"columns", frames.columns},
          {"first_s", frames.first_s},
          {"step_s", frames.step_s},
          {"count", frames.count},
          {"data", io::base64(frames.bytes)}};
}

/// The heights of uneven ground in units of 0.1 mm, which compress well: a column for each x, a row for each
/// y.
io::Json ground_json(const std::string& recorded, const std::string& what) {
  if (recorded.empty()) return nullptr;
  const io::Json json = io::parse_json(recorded, what);
  const auto field = ground::field_from_json(io::JsonView(json, what + ": ground"));
  constexpr float unit_m = 1e-4f;
  std::vector<float> heights = field.heights_m();
  for (float& height : heights) height = std::round(height / unit_m);
  std::vector<std::string> columns;
  columns.reserve(to_index(ground::HeightField::cells));
  for (int i = 0; i < ground::HeightField::cells; ++i) columns.push_back(std::to_string(i));
  PackedFrames frames{.columns = std::move(columns),
                      .first_s = 0.0,
                      .step_s = 1.0,
                      .count = to_index(ground::HeightField::cells),
                      .bytes = record::compress_frames(heights, to_index(ground::HeightField::cells))};
  return {{"cell_m", field.cell_m()}, {"unit_m", unit_m}, {"heights", frames_json(frames)}};
}

/// Null for an empty text.
io::Json packed_text(const std::string& text) {
  return text.empty() ? io::Json(nullptr) : io::Json(packed(text));
}

io::Json walker_json(const Walker& walker) {
  const PackedRecording recording =
      walker.cell ? pack_recording(walker.recording, 0.04) : pack_recording(walker.recording);
  const std::string what = walker.recording.string();
  return {{"title", walker.title},
          {"origin", recording.origin},
          {"seconds", recording.seconds},
          {"outcome", record::outcome_names[to_index(recording.outcome)]},
          {"robot", io::parse_json(recording.robot_json, what)},
          {"controller", packed(io::parse_json(recording.controller_json, what).dump())},
          {"ground", ground_json(recording.ground_json, what)},
          {"damage",
           recording.damage_json.empty() ? io::Json(nullptr) : io::parse_json(recording.damage_json, what)},
          {"poses", frames_json(recording.poses)},
          {"contacts", frames_json(recording.contacts)},
          {"cppn_svg", packed_text(walker.cppn_svg)},
          {"gait", walker.gait},
          {"cell", walker.cell ? io::Json(*walker.cell) : io::Json(nullptr)},
          {"champion", packed_text(walker.champion)},
          {"typical", walker.typical},
          {"shown", walker.shown},
          {"as_evolved", walker.as_evolved}};
}

/// The WebAssembly module, where a walker can be simulated.
std::string module_where_needed(const ReplayPage& page) {
  const auto has_champion = [](const Walker& walker) { return !walker.champion.empty(); };
  return std::ranges::any_of(page.walkers, has_champion) ? module_elements() : std::string();
}

}  // namespace

std::string make_page(const ReplayPage& page) {
  AMBLE_CHECK(!page.walkers.empty(), "a page shows at least one walker");
  io::Json data{{"title", page.title}, {"made_by", page.made_by}, {"walkers", io::Json::array()}};
  for (const Walker& walker : page.walkers) data["walkers"].push_back(walker_json(walker));

  if (const auto& map = page.map)
    data["map"] = {{"svg", map->map_svg}, {"curves_svg", map->curves_svg},   {"note", map->note},
                   {"table", map->table}, {"table_title", map->table_title}, {"table_note", map->table_note}};
  const std::string style =
      figures::shared_style_sheet() + (page.map ? figures::map_style_sheet() : std::string());

  std::string html;
  std::string_view rest = page_template();
  rest = fill(rest, "<!--amble:title-->", io::escape_xml(page.title), html);
  rest = fill(rest, "<!--amble:palette-->", "<style>" + style + "</style>", html);
  rest = fill(rest, "<!--amble:data-->",
              "<script type=\"application/json\" id=\"amble-data\">" + script_text(data) + "</script>", html);
  rest = fill(rest, "<!--amble:module-->", module_where_needed(page), html);
  fill_end(rest, html);
  return html;
}

}  // namespace amble::page
