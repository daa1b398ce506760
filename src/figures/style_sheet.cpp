#include "amble/figures/style_sheet.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <vector>

#include "amble/core/check.hpp"
#include "amble/figures/figure_size.hpp"
#include "amble/figures/svg.hpp"

namespace amble::figures {
namespace {

/// A colour of the palette: in CSS var(--name).
struct Colour {
  std::string_view name, light, dark;
};
constexpr std::array palette{
    Colour{"paper", "#fcfcfb", "#101317"},  Colour{"panel", "#f3f4f4", "#181c21"},
    Colour{"ground", "#e6e8ea", "#232930"}, Colour{"ink", "#16191d", "#e9ecef"},
    Colour{"soft", "#5d6670", "#98a2ad"},   Colour{"line", "#b9c0c7", "#4a535d"},
    Colour{"mid", "#8e979f", "#727d88"},    Colour{"hair", "#e4e7ea", "#262c33"},
    Colour{"trunk", "#d5dae0", "#39424c"},  Colour{"trunk-line", "#7b8590", "#8b97a3"},
    Colour{"c0", "#00599c", "#3d8fe0"},     Colour{"c1", "#c2410c", "#f0713a"},
    Colour{"c2", "#3b9ee0", "#8ecbff"},     Colour{"c3", "#e8a013", "#ffc75a"},
    Colour{"c4", "#00796b", "#35b3a2"},     Colour{"c5", "#8e4fb0", "#b98ad6"},
    Colour{"c6", "#7d8a1f", "#b3c043"},     Colour{"c7", "#c75c93", "#e58fbb"},
    Colour{"plus", "#00796b", "#35b3a2"},   Colour{"minus", "#c2410c", "#f0713a"}};

constexpr std::string_view sans =
    "system-ui, -apple-system, \"Segoe UI\", Roboto, Inter, \"Noto Sans\", \"Helvetica Neue\", Arial, "
    "sans-serif";
constexpr std::string_view mono =
    "ui-monospace, SFMono-Regular, Menlo, Consolas, \"Liberation Mono\", \"DejaVu Sans Mono\", monospace";

constexpr std::string_view cppn = R"css(
.cppn text { font: 13px var(--sans); fill: var(--ink); }
.cppn .key-text { fill: var(--soft); }
.wire path { fill: none; stroke-linecap: round; opacity: .72; } .wire:hover path { opacity: 1; }
.wire.plus path { stroke: var(--plus); } .wire.minus path { stroke: var(--minus); }
.wire.plus polygon { fill: var(--plus); } .wire.minus polygon { fill: var(--minus); } .wire.off polygon { fill: var(--line); }
.wire.back { opacity: .8; } .wire.back:hover, .wire.back path { opacity: 1; } .wire.back path { stroke-linecap: butt; }
.wire.off path { stroke: var(--line); stroke-dasharray: 3 5; stroke-width: 1.2; }
.neuron circle { fill: var(--paper); stroke: var(--ink); stroke-width: 1.6; }
.terminal circle { fill: var(--ink); }
.glyph { fill: none; stroke: var(--ink); stroke-width: 1.6; stroke-linecap: round; }
)css";

constexpr std::string_view text = R"css(
* { box-sizing: border-box; }
html { -webkit-text-size-adjust: 100%; }
body { margin: 0; background: var(--paper); color: var(--ink); font: 16px/1.55 var(--sans); font-variant-numeric: tabular-nums; }
main { max-width: 1008px; margin: 0 auto; padding: 72px 24px 96px; }
header { max-width: 44rem; }
.kicker { margin: 0 0 10px; color: var(--soft); font-size: 13px; letter-spacing: .08em; text-transform: uppercase; }
h1 { margin: 0; font-size: clamp(30px, 5vw, 46px); line-height: 1.12; letter-spacing: -.022em; font-weight: 680; text-wrap: balance; }
.subtitle { margin: 16px 0 0; color: var(--soft); font-size: 18px; line-height: 1.5; }
h2 { margin: 0 0 6px; font-size: 23px; line-height: 1.25; letter-spacing: -.012em; font-weight: 640; }
section { margin-top: 84px; }
section > p { max-width: 44rem; margin: 0; color: var(--soft); }
figure { margin: 26px 0 0; }
.note { margin-top: 22px; padding: 16px 18px; max-width: none; background: var(--panel); border-radius: 8px; }

.numbers { display: flex; flex-wrap: wrap; gap: 26px 34px; margin: 44px 0 0; }
.numbers div { min-width: 92px; }
.numbers dt { color: var(--soft); font-size: 13.5px; }
.numbers dd { margin: 2px 0 0; font-size: 28px; line-height: 1.2; font-weight: 620; letter-spacing: -.015em; white-space: nowrap; }
.numbers dd small { font-size: 15px; font-weight: 450; letter-spacing: 0; color: var(--soft); }
.numbers .per-leg { display: flex; flex-wrap: wrap; gap: 0 12px; }
.numbers + section { margin-top: 56px; }
.key { display: inline-flex; align-items: baseline; gap: 6px; margin-right: 14px; white-space: nowrap; color: var(--ink); font-size: 14px; }
.key::before { content: ""; width: 10px; height: 10px; border-radius: 3px; background: var(--leg); }
.keys { margin-top: 10px; }
.per-leg .key { margin: 0; font-size: 20px; gap: 5px; line-height: 34px; }
.per-leg .key small { margin-right: -1px; }

table { border-collapse: collapse; width: 100%; margin-top: 22px; font-size: 14.5px; }
th, td { padding: 8px 0; border-top: 1px solid var(--hair); text-align: left; vertical-align: top; overflow-wrap: anywhere; }
th { width: 15rem; padding-right: 20px; font-weight: 450; color: var(--soft); }
tr:last-child > * { border-bottom: 1px solid var(--hair); }
pre { margin: 22px 0 0; padding: 16px 18px; background: var(--panel); border-radius: 8px; font: 13.5px/1.6 var(--mono); white-space: pre-wrap; overflow-wrap: anywhere; }
)css";

constexpr std::string_view in_page = R"css(
svg { display: block; width: 100%; height: auto; overflow: visible; }
.narrow { display: none; }
)css";

constexpr std::string_view plots = R"css(
svg text { font: 13px var(--sans); fill: var(--ink); }
svg text.tick { font-size: 12px; fill: var(--soft); }
svg text.tiny { font-size: 10.5px; fill: var(--soft); }
svg text.title { font-weight: 600; }
svg text.label { font-weight: 600; }
svg text.value { fill: var(--soft); }
svg text.halo { paint-order: stroke; stroke: var(--paper); stroke-width: 4px; stroke-linejoin: round; }
.axis { stroke: var(--line); }
.grid { stroke: var(--hair); }
.curve { fill: none; stroke: currentColor; stroke-width: 2.4; stroke-linejoin: round; stroke-linecap: round; }
.curve.best { stroke: var(--ink); stroke-width: 2.6; }
.dot.best { fill: var(--ink); }
.curve.mean { stroke: var(--soft); stroke-width: 1.6; }
.dot.mean { fill: var(--soft); }
.curve.median { stroke: var(--mid); stroke-width: 1.6; }
.dot.median { fill: var(--mid); }
.curve.small { stroke: var(--ink); stroke-width: 1.6; }
.dot.small { fill: var(--ink); }
svg text.mean { font-weight: 450; fill: var(--soft); }
svg text.median { font-weight: 450; fill: var(--soft); }
.under-best { fill: var(--ink); opacity: .05; }
.curve.typical { stroke: var(--c0); stroke-width: 2; }
.dot.typical { fill: var(--c0); }
.quartiles { fill: var(--c0); opacity: .16; }
svg text.typical { fill: var(--c0); }
)css";

constexpr std::string_view maps = R"css(
svg text.map-axis { font-size: 17px; fill: var(--soft); }
.empty-cell { fill: var(--panel); }
.shade0 { fill: var(--c0); opacity: 0.16; }
.shade1 { fill: var(--c0); opacity: 0.265; }
.shade2 { fill: var(--c0); opacity: 0.37; }
.shade3 { fill: var(--c0); opacity: 0.475; }
.shade4 { fill: var(--c0); opacity: 0.58; }
.shade5 { fill: var(--c0); opacity: 0.685; }
.shade6 { fill: var(--c0); opacity: 0.79; }
.shade7 { fill: var(--c0); opacity: 0.895; }
.shade8 { fill: var(--c0); opacity: 1; }
)css";

constexpr std::string_view figures = R"css(
.stance { fill: currentColor; }
.track { fill: var(--panel); }
.trigger { fill: var(--ink); }
.zoomed { fill: none; stroke: var(--line); }
.zoom-beam { fill: var(--panel); opacity: .8; }
.range { fill: var(--panel); }
.ghost { fill: none; stroke: var(--line); opacity: .55; }
.offset { stroke: var(--ink); stroke-dasharray: 2 3; }
.path { fill: none; stroke: var(--ink); stroke-width: 2; stroke-linejoin: round; stroke-linecap: round; }
.told { fill: none; stroke: var(--c1); stroke-width: 1.8; stroke-dasharray: 6 4; }
.told-dot { fill: var(--c1); }
.beeline { stroke: var(--soft); stroke-dasharray: 2 5; }
.footprint { fill: currentColor; }
.trunk-outline { fill: none; stroke: var(--line); stroke-width: 1.2; }
.start { fill: var(--paper); stroke: var(--ink); stroke-width: 2; }
.end { fill: var(--ink); }
.scale-bar { stroke: var(--ink); stroke-width: 1.2; }
.cell { fill: var(--panel); }
.ground { fill: var(--ground); }
.ground-line { stroke: var(--line); }
.trunk { fill: var(--trunk); stroke: var(--trunk-line); stroke-width: 1.2; stroke-linejoin: round; }
.limb { fill: currentColor; stroke: var(--panel); stroke-width: 1.2; stroke-linejoin: round; }
.foot { fill: var(--panel); stroke: currentColor; stroke-width: 2; }
.foot-down { fill: currentColor; stroke: currentColor; stroke-width: 2; }
.far { opacity: .42; }
.plane { fill: var(--panel); stroke: var(--hair); }
.link { stroke: currentColor; stroke-width: 1.1; opacity: .7; } .link.strong { stroke-width: 1.8; } .link.weak { stroke-width: .6; }
.dashed { stroke-dasharray: 4 3; }
.many .link { opacity: .2; stroke-width: .7; } .many .link.strong { stroke-width: 1.1; }
.loop { fill: none; stroke: currentColor; stroke-width: 1.1; }
.arrow { fill: currentColor; }
.node-sensor { fill: var(--paper); stroke: var(--ink); stroke-width: 1.6; }
.node-hidden { fill: var(--paper); stroke: var(--ink); stroke-width: 1.6; }
.node-joint { fill: var(--ink); stroke: var(--ink); stroke-width: 1.6; }
)css";

constexpr std::string_view phone_and_paper = R"css(
@media screen and (max-width: 700px) {
  main { padding: 40px 19px 64px; }
  section { margin-top: 60px; }
  .wide { display: none; } .narrow { display: block; max-width: 420px; margin: 0 auto; }
  .subtitle { font-size: 16.5px; }
  .numbers { display: grid; grid-template-columns: 1fr 1fr; gap: 22px 20px; margin-top: 34px; }
  .numbers dd { font-size: 25px; } .per-leg .key { font-size: 22px; }
  .numbers .span { grid-column: 1 / -1; }
  th { width: 8.5rem; padding-right: 14px; }
  pre { font-size: 12.5px; }
}
@media print {
  @page { margin: 16mm; }
  html { print-color-adjust: exact; -webkit-print-color-adjust: exact; }
  body { background: none; font-size: 11pt; }
  main { padding: 0; max-width: none; }
  section { margin-top: 28pt; break-inside: avoid; }
  .numbers { margin-top: 20pt; gap: 12pt 30pt; } .numbers dd { font-size: 18pt; }
}
)css";

void replace_all(std::string& rules, std::string_view what, std::string_view with) {
  for (std::size_t at = rules.find(what); at != std::string::npos; at = rules.find(what, at + with.size()))
    rules.replace(at, what.size(), with);
}

std::string declared(std::string_view Colour::*scheme) {
  std::string declarations;
  for (const Colour& colour : palette) declarations += fmt::format(" --{}: {};", colour.name, colour.*scheme);
  return declarations;
}

/// Classes of legs: --leg for what is around figures, the current colour in them.
std::string legs(bool whole_page) {
  std::string rules;
  for (int leg = 0; leg < leg_colours; ++leg) {
    if (whole_page) rules += fmt::format(".leg{0} {{ --leg: var(--c{0}); }}\n", leg);
    rules += fmt::format("svg .leg{0} {{ color: var(--c{0}); }}\n", leg);
  }
  return rules;
}

/// The palette of both schemes as custom properties, fonts, and the classes of legs.
std::string colours() {
  return fmt::format(
             "\n:root {{ color-scheme: light dark;{} --sans: {}; --mono: {}; }}\n"
             "@media screen and (prefers-color-scheme: dark) {{ :root {{{} }} }}\n",
             declared(&Colour::light), sans, mono, declared(&Colour::dark)) +
         legs(true);
}

/// The lines of `rules` whose first class occurs in the element, and those that name none.
std::vector<std::string_view> lines_for(std::string_view rules, std::string_view element) {
  constexpr std::string_view name = "abcdefghijklmnopqrstuvwxyz0123456789-_";
  std::vector<std::string_view> kept;
  while (!rules.empty()) {
    const std::size_t end = std::min(rules.find('\n'), rules.size());
    const std::string_view line = rules.substr(0, end);
    rules.remove_prefix(std::min(end + 1, rules.size()));
    const std::size_t dot = std::min(line.find('.'), line.find('{'));
    const bool has_class = dot != std::string_view::npos && line[dot] == '.';
    const std::string_view first =
        has_class ? line.substr(dot + 1, line.find_first_not_of(name, dot + 1) - dot - 1) : "";
    if (!line.empty() && element.find(first) != std::string_view::npos) kept.push_back(line);
  }
  return kept;
}

/// Those lines with the palette's values for its names; only those with colours, if asked.
std::string resolved(const std::vector<std::string_view>& lines, std::string_view Colour::*scheme,
                     bool colours_only) {
  std::string style;
  for (const std::string_view line : lines)
    if (!colours_only || line.find("var(--") != std::string_view::npos) style.append(line) += '\n';
  for (const Colour& colour : palette)
    replace_all(style, fmt::format("var(--{})", colour.name), colour.*scheme);
  replace_all(style, "var(--sans)", sans);
  return style;
}

}  // namespace

std::string style_sheet() {
  std::string sheet = colours();
  for (const std::string_view part : {text, in_page, plots, maps, figures, phone_and_paper}) sheet += part;
  return sheet;
}

std::string shared_style_sheet() {
  return colours() + std::string(cppn);
}

std::string map_style_sheet() {
  return std::string(plots) + std::string(maps);
}

std::string standalone_svg(std::string element, std::string_view more_rules) {
  element = with_margin(std::move(element), 16.0);
  const std::size_t head_end = element.find('>');
  AMBLE_CHECK(head_end != std::string::npos, "an SVG element begins with its tag");
  std::string rules =
      "svg { color-scheme: light dark; background: var(--paper); overflow: visible; }\n" + legs(false);
  for (const std::string_view part : {plots, maps, figures, cppn, more_rules}) rules.append(part) += '\n';
  const std::vector<std::string_view> lines = lines_for(rules, element);
  const std::string style =
      fmt::format("\n<style>\n{}@media screen and (prefers-color-scheme: dark) {{\n{}}}\n</style>",
                  resolved(lines, &Colour::light, false), resolved(lines, &Colour::dark, true));
  return element.insert(head_end + 1, style);
}

std::string with_rules(std::string svg, std::string_view rules) {
  const std::size_t end = svg.find("</style>");
  AMBLE_CHECK(end != std::string::npos, "a file by standalone_svg() has a style");
  return svg.insert(end, rules);
}

}  // namespace amble::figures
