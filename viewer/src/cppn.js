// The CPPN as a graph: a node shows its function, a link its weight by width and its sign by colour.
import { layOut } from "./cppn_layout.js";
import { element, svgElement } from "./theme.js";

const RADIUS = 15, ROW = 46, MARGIN_TOP = 24;
const GLYPHS = {
  bipolar_sigmoid: "M-8 6 C-1 6 -3 -6 8 -6",
  gaussian: "M-8 6 C-3 6 -3 -6 0 -6 C3 -6 3 6 8 6",
  sine: "M-8 0 C-5 -9 -3 -9 0 0 C3 9 5 9 8 0",
  linear: "M-7 6 L7 -6",
};
const FUNCTIONS = { bipolar_sigmoid: "sigmoid", gaussian: "Gaussian", sine: "sine", linear: "linear" };

export function cppnGraph(cppn) {
  const graph = layOut(cppn);
  const most = Math.max(...graph.layers.map((layer) => layer.length));
  const width = Math.max(320, 190 + 74 * (graph.layers.length - 1)), height = most * ROW + 2 * MARGIN_TOP;
  const labels = 78; // room for names at both sides
  const x = ({ layer }) => labels + (layer / Math.max(1, graph.layers.length - 1)) * (width - 2 * labels);
  const y = ({ place }) => MARGIN_TOP + place * (height - 2 * MARGIN_TOP);
  const heaviest = Math.max(1e-9, ...graph.links.map(({ weight }) => Math.abs(weight)));
  const links = [...graph.links]
    .sort((a, b) => Math.abs(b.weight) - Math.abs(a.weight))
    .map((link) => drawLink(link, x, y, heaviest));
  const nodes = graph.nodes.map((node) => drawNode(node, x(node), y(node)));
  const svg = svgElement("svg", { viewBox: `0 0 ${width} ${height}`, class: "cppn", role: "img", "aria-label": "CPPN" },
                         ...links, ...nodes);
  svg.style.maxWidth = `${1.35 * width}px`;
  return element("div", { class: "cppn-box" }, svg, legend(graph));
}

function drawLink({ from, to, weight, enabled, back }, x, y, heaviest) {
  const x0 = x(from) + RADIUS, x1 = x(to) - RADIUS, y0 = y(from), y1 = y(to);
  const bend = Math.max(20, (x1 - x0) / 2);
  const path = back
    ? `M${x(from)} ${y0 - RADIUS} C${x(from) + 30} ${y0 - 46} ${x(to) - 30} ${y1 - 46} ${x(to)} ${y1 - RADIUS}`
    : `M${x0} ${y0} C${x0 + bend} ${y0} ${x1 - bend} ${y1} ${x1} ${y1}`;
  const kind = [weight < 0 ? "minus" : "plus", back && "back", !enabled && "disabled"].filter(Boolean).join(" ");
  const name = (node) => node.label || `node ${node.id}`;
  return svgElement("path", {
    d: path, class: `link ${kind}`, "stroke-width": (0.8 + 5.2 * Math.abs(weight) / heaviest).toFixed(2),
  }, svgElement("title", {}, `${name(from)} → ${name(to)}: ${weight.toFixed(3)}${enabled ? "" : ", disabled"}`));
}

function drawNode({ id, kind, activation, label }, x, y) {
  const isInput = kind === "bias" || kind === "input";
  const node = svgElement("g", { class: `node ${kind}`, transform: `translate(${x} ${y})` });
  node.append(svgElement("title", {}, `${label || `node ${id}`}${isInput ? "" : `: ${FUNCTIONS[activation]}`}`),
              svgElement("circle", { r: isInput ? 6 : RADIUS }));
  if (!isInput) node.append(svgElement("path", { class: "glyph", d: GLYPHS[activation] }));
  if (label) {
    const text = svgElement("text", { x: isInput ? -12 : RADIUS + 6, "text-anchor": isInput ? "end" : "start", dy: "0.35em" });
    text.textContent = label.replaceAll("_", " ");
    node.append(text);
  }
  return node;
}

function legend(graph) {
  const used = new Set(graph.nodes.filter(({ kind }) => kind === "hidden" || kind === "output").map((node) => node.activation));
  const functions = Object.keys(GLYPHS).filter((name) => used.has(name)).map((name) =>
    element("span", {}, svgElement("svg", { viewBox: "-10 -10 20 20", class: "key-glyph" },
                                   svgElement("path", { class: "glyph", d: GLYPHS[name] })), FUNCTIONS[name]));
  const lines = [["plus", "weight above 0"], ["minus", "below 0"]].map(([kind, text]) =>
    element("span", {}, element("i", { class: `swatch ${kind}` }), text));
  if (graph.links.some(({ enabled }) => !enabled))
    lines.push(element("span", {}, element("i", { class: "swatch off" }), "disabled"));
  return element("p", { class: "legend" }, ...functions, ...lines);
}
