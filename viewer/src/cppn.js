// A champion's network, the CPPN: inputs on the left, outputs on the right, and hidden nodes as far right as they are from the inputs.
import { svgElement } from "./theme.js";

const ROW = 34, LAYER = 84, PAD = 16, LETTER = 7.6, BESIDE = 24; // px; a letter's width on average, and what a name needs beside its letters
// The curves of the functions, within −8 … 8 px.
const GLYPHS = {
  bipolar_sigmoid: "M-8 6C-3 6-2 3 0 0C2-3 3-6 8-6", gaussian: "M-8 6C-3 6-3-6 0-6C3-6 3 6 8 6", sine: "M-8 0C-5-9-3-9 0 0C3 9 5 9 8 0",
  identity: "M-7 6L7-6", absolute: "M-7-6L0 6L7-6",
};
const NAMES = { bipolar_sigmoid: "sigmoid", gaussian: "Gaussian", sine: "sine", identity: "x", absolute: "|x|" };

/** How far each node is from the inputs by links that lead on; what only cycles reach is in the middle. */
function layersOf({ nodes, links }) {
  const layer = new Map(nodes.map(({ id, kind }) => [id, kind === "bias" || kind === "input" ? 0 : kind === "hidden" ? 1 : 2]));
  const hidden = new Set(nodes.filter(({ kind }) => kind === "hidden").map(({ id }) => id));
  for (let round = 0; round < hidden.size; ++round)
    for (const { from, to, enabled } of links)
      if (enabled && from !== to && hidden.has(from) && hidden.has(to) && layer.get(to) <= layer.get(from) && layer.get(from) < hidden.size && from < to)
        layer.set(to, layer.get(from) + 1);
  const last = Math.max(1, ...[...hidden].map((id) => layer.get(id))) + 1;
  for (const { id, kind } of nodes) if (kind === "output") layer.set(id, last);
  return { layer, last };
}

const textWidth = (names) => BESIDE + LETTER * Math.max(4, ...names.map((name) => name.length));

/** @returns {SVGElement} Its names, and what the function "linear" is, as Live.describe() has them. */
export function drawCppn(genome, { cppn_inputs: inputs, cppn_outputs: outputs, cppn_linear: linear }) {
  const { nodes, links } = genome, { layer, last } = layersOf(genome);
  const columns = Array.from({ length: last + 1 }, (_, l) => nodes.filter(({ id }) => layer.get(id) === l));
  const tall = Math.max(...columns.map((column) => column.length)) * ROW + 2 * PAD, left = textWidth(["bias", ...inputs]);
  const wide = left + last * LAYER + textWidth(outputs);
  const place = new Map();
  columns.forEach((column, l) => column.forEach(({ id }, i) => place.set(id, [left + l * LAYER, tall / 2 + (i - (column.length - 1) / 2) * ROW])));
  const enabled = links.filter((link) => link.enabled), hidden = nodes.filter(({ kind }) => kind === "hidden").length;
  const picture = svgElement("svg", { class: "cppn", viewBox: `0 0 ${wide} ${tall}`, width: wide, height: tall, role: "img",
    "aria-label": `The network: ${inputs.length} inputs, ${hidden} hidden nodes, ${outputs.length} outputs, ${enabled.length} links` });
  for (const link of enabled) picture.append(drawLink(link, place));
  let input = 0, output = 0;
  for (const node of nodes) {
    const name = node.kind === "bias" ? "bias" : node.kind === "input" ? inputs[input++] : node.kind === "output" ? outputs[output++] : "";
    const activation = node.activation === "linear" ? linear : node.activation;
    picture.append(drawNode({ ...node, activation }, place.get(node.id), (name ?? "").replaceAll("_", " ")));
  }
  return picture;
}

function drawLink({ from, to, weight }, place) {
  const [x0, y0] = place.get(from), [x1, y1] = place.get(to);
  const bend = Math.max(30, Math.abs(x1 - x0) / 2);
  const path = from === to ? `M${x0 - 6} ${y0 - 10}C${x0 - 26} ${y0 - 36} ${x0 + 26} ${y0 - 36} ${x0 + 6} ${y0 - 10}`
    : x1 > x0 ? `M${x0} ${y0}C${x0 + bend} ${y0} ${x1 - bend} ${y1} ${x1} ${y1}`
    : `M${x0} ${y0}C${x0 + bend} ${y0 + 44} ${x1 - bend} ${y1 + 44} ${x1} ${y1}`;
  const thick = Math.min(6, 0.6 + 2.6 * Math.abs(weight));
  return svgElement("g", { class: `wire ${weight < 0 ? "minus" : "plus"}` }, svgElement("path", { d: path, "stroke-width": thick.toFixed(1) }));
}

function drawNode({ kind, activation }, [x, y], name) {
  const ends = kind === "bias" || kind === "input";
  const group = svgElement("g", { class: ends ? "terminal" : "neuron", transform: `translate(${x} ${y})` },
    svgElement("circle", { r: ends ? 5 : 12.5 }));
  if (!ends) group.append(svgElement("path", { class: "glyph", d: GLYPHS[activation] ?? "" }), svgElement("title", {}, `${name} ${NAMES[activation] ?? activation}`.trim()));
  if (name) group.append(svgElement("text", { x: ends ? -12 : 20, y: 4, "text-anchor": ends ? "end" : "start" }, name));
  return group;
}
