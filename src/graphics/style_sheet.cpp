#include "amble/graphics/style_sheet.hpp"

#include "amble/core/check.hpp"
#include "amble/graphics/resolved_style.hpp"
#include "amble/graphics/svg.hpp"

namespace amble::graphics {
namespace {

constexpr std::string_view light_colours = R"css(
  --paper: #fcfcfb; --panel: #f3f4f4; --ground: #e6e8ea; --ink: #16191d; --soft: #5d6670; --line: #b9c0c7;
  --mid: #8e979f; --hair: #e4e7ea; --trunk: #d5dae0; --trunk-line: #7b8590;
  --c0: #00599c; --c1: #c2410c; --c2: #3b9ee0; --c3: #e8a013; --c4: #00796b; --c5: #8e4fb0; --c6: #7d8a1f; --c7: #c75c93;
  --plus: #00796b; --minus: #c2410c;)css";

constexpr std::string_view fonts = R"css(
  --sans: system-ui, -apple-system, "Segoe UI", Roboto, Inter, "Noto Sans", "Helvetica Neue", Arial, sans-serif;
  --mono: ui-monospace, SFMono-Regular, Menlo, Consolas, "Liberation Mono", "DejaVu Sans Mono", monospace;
)css";

constexpr std::string_view dark_colours = R"css(
    --paper: #101317; --panel: #181c21; --ground: #232930; --ink: #e9ecef; --soft: #98a2ad; --line: #4a535d;
    --mid: #727d88; --hair: #262c33; --trunk: #39424c; --trunk-line: #8b97a3;
    --c0: #3d8fe0; --c1: #f0713a; --c2: #8ecbff; --c3: #ffc75a; --c4: #35b3a2; --c5: #b98ad6; --c6: #b3c043; --c7: #e58fbb;
    --plus: #35b3a2; --minus: #f0713a;
)css";

constexpr std::string_view legs =
    R"css(.leg0 { --leg: var(--c0); } .leg1 { --leg: var(--c1); } .leg2 { --leg: var(--c2); } .leg3 { --leg: var(--c3); }
.leg4 { --leg: var(--c4); } .leg5 { --leg: var(--c5); } .leg6 { --leg: var(--c6); } .leg7 { --leg: var(--c7); }
)css";

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
.curve { fill: none; stroke: var(--leg); stroke-width: 2.4; stroke-linejoin: round; stroke-linecap: round; }
.curve.best { stroke: var(--ink); stroke-width: 2.6; } .dot.best { fill: var(--ink); }
.curve.mean { stroke: var(--soft); stroke-width: 1.6; } .dot.mean { fill: var(--soft); }
.curve.median { stroke: var(--mid); stroke-width: 1.6; } .dot.median { fill: var(--mid); }
.curve.small { stroke: var(--ink); stroke-width: 1.6; } .dot.small { fill: var(--ink); }
svg text.mean, svg text.median { font-weight: 450; fill: var(--soft); }
.under-best { fill: var(--ink); opacity: .05; }
.curve.typical { stroke: var(--c0); stroke-width: 2; } .dot.typical { fill: var(--c0); }
.quartiles { fill: var(--c0); opacity: .16; } svg text.typical { fill: var(--c0); }
)css";

constexpr std::string_view maps = R"css(
svg text.map-axis { font-size: 17px; fill: var(--soft); }
.nobody { fill: var(--panel); }
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
.stance { fill: var(--leg); }
.track { fill: var(--panel); }
.trigger { fill: var(--ink); }
.zoomed { fill: none; stroke: var(--line); }
.zoom-beam { fill: var(--panel); opacity: .8; }
.range { fill: var(--panel); }
.ghost { fill: none; stroke: var(--line); opacity: .55; }
.offset { stroke: var(--ink); stroke-dasharray: 2 3; }
.path { fill: none; stroke: var(--ink); stroke-width: 2; stroke-linejoin: round; stroke-linecap: round; }
.beeline { stroke: var(--soft); stroke-dasharray: 2 5; }
.footprint { fill: var(--leg); }
.trunk-outline { fill: none; stroke: var(--line); stroke-width: 1.2; }
.start { fill: var(--paper); stroke: var(--ink); stroke-width: 2; } .end { fill: var(--ink); }
.scale-bar { stroke: var(--ink); stroke-width: 1.2; }
.cell { fill: var(--panel); }
.ground { fill: var(--ground); }
.ground-line { stroke: var(--line); }
.trunk { fill: var(--trunk); stroke: var(--trunk-line); stroke-width: 1.2; stroke-linejoin: round; }
.limb { fill: var(--leg); stroke: var(--panel); stroke-width: 1.2; stroke-linejoin: round; }
.foot { fill: var(--panel); stroke: var(--leg); stroke-width: 2; }
.foot-down { fill: var(--leg); stroke: var(--leg); stroke-width: 2; }
.far { opacity: .42; }
.plane { fill: var(--panel); stroke: var(--hair); }
.link { stroke: var(--leg); stroke-width: 1.1; opacity: .7; } .link.strong { stroke-width: 1.8; } .link.weak { stroke-width: .6; }
.many .link { opacity: .2; stroke-width: .7; } .many .link.strong { stroke-width: 1.1; }
.loop { fill: none; stroke: var(--leg); stroke-width: 1.1; }
.arrow { fill: var(--leg); }
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

/// The custom properties of both schemes, and the classes of legs.
std::string colours() {
  std::string sheet = "\n:root {\n  color-scheme: light dark;";
  sheet += light_colours;
  sheet += fonts;
  sheet += "}\n@media screen and (prefers-color-scheme: dark) {\n  :root {";
  sheet += dark_colours;
  sheet += "  }\n}\n";
  sheet += legs;
  return sheet;
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
  std::string rules = "svg { color-scheme: light dark; background: var(--paper); overflow: visible; }";
  for (const std::string_view part : {plots, maps, figures, cppn, more_rules}) rules += part;
  const CustomProperties shared = custom_properties(fonts);
  CustomProperties light = custom_properties(light_colours), dark = custom_properties(dark_colours);
  light.insert(shared.begin(), shared.end());
  dark.insert(shared.begin(), shared.end());
  const std::string style = "\n<style>\n" + resolved_style(rules, light, dark, element) + "</style>";
  return element.insert(head_end + 1, style);
}

std::string with_rules(std::string svg, std::string_view rules) {
  const std::size_t end = svg.find("</style>");
  AMBLE_CHECK(end != std::string::npos, "a file by standalone_svg() has a style");
  return svg.insert(end, rules);
}

}  // namespace amble::graphics
