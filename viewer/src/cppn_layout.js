// Places the nodes of a CPPN: layers by the longest way from an input, outputs last, few crossings.

/**
 * {nodes: [{id, kind, activation, label, layer, place}], links: [{from, to, weight, enabled, back}], layers: [[node]]},
 * place in 0 … 1 within the layer. A link is `back` if it does not lead to a later layer.
 */
export function layOut(cppn) {
  const names = { bias: ["bias"], input: [...cppn.inputs], output: [...cppn.outputs], hidden: [] };
  const nodes = cppn.nodes.map((node) => ({ ...node, label: names[node.kind].shift() ?? "", out: [], in: [] }));
  const byId = new Map(nodes.map((node) => [node.id, node]));
  const links = cppn.links.map((link) => ({ ...link, from: byId.get(link.from), to: byId.get(link.to) }));
  for (const link of links) {
    link.from.out.push(link);
    link.to.in.push(link);
  }
  markCycles(nodes);
  setLayers(nodes);
  const layers = [];
  for (const node of nodes) (layers[node.layer] ??= []).push(node);
  const filled = layers.filter(Boolean);
  filled.forEach((layer, i) => layer.forEach((node) => (node.layer = i)));
  for (const link of links) link.back = link.from.layer >= link.to.layer;
  order(filled);
  return { nodes, links, layers: filled };
}

/** A link that closes a circle gets `closes`, found depth first. */
function markCycles(nodes) {
  const state = new Map();
  const visit = (node) => {
    state.set(node, "open");
    for (const link of node.out) {
      if (state.get(link.to) === "open") link.closes = true;
      else if (!state.has(link.to)) visit(link.to);
    }
    state.set(node, "done");
  };
  for (const node of nodes) if (!state.has(node)) visit(node);
}

function setLayers(nodes) {
  const depth = (node) =>
    (node.layer ??= node.in.reduce((most, link) => (link.closes ? most : Math.max(most, depth(link.from) + 1)),
                                   node.kind === "bias" || node.kind === "input" ? 0 : 1));
  const deepest = Math.max(...nodes.map(depth));
  for (const node of nodes) if (node.kind === "output") node.layer = deepest + (deepestHidden(nodes) === deepest);
}
const deepestHidden = (nodes) =>
  Math.max(0, ...nodes.filter(({ kind }) => kind === "hidden").map(({ layer }) => layer));

/** Sorts each layer by the mean place of its neighbours, there and back a few times. */
function order(layers) {
  const settle = (layer) => layer.forEach((node, i) => (node.place = (i + 0.5) / layer.length));
  layers.forEach(settle);
  const mean = (node, links, end) =>
    links.length ? links.reduce((sum, link) => sum + link[end].place, 0) / links.length : node.place;
  for (let round = 0; round < 8; ++round) {
    const [way, side, end] = round % 2 ? [[...layers].reverse(), "out", "to"] : [layers, "in", "from"];
    for (const layer of way.slice(1)) {
      // Inputs and outputs keep their order: it is the one of their names.
      if (layer.some(({ kind }) => kind !== "hidden")) continue;
      const wish = new Map(layer.map((node) => [node, mean(node, node[side], end)]));
      layer.sort((a, b) => wish.get(a) - wish.get(b));
      settle(layer);
    }
  }
}
