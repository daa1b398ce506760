// The network of a mixed champion at a time: what sensors, neurons and SUPGs say, and what passes through the links between them.
import { choice } from "./controls.js";
import { rangeOf } from "./joints.js";
import { number } from "./plot.js";
import { colour, element } from "./theme.js";

const ROW = 30, HEAD = 22, RADIUS = 8.5, REACH = 18; // px: from node to node, above a leg's, of a node, and where a click finds one
const COLUMNS = { joint: 0.17, hidden: 0.29, sensor: 0.39 }; // of a leg on the left, shares of the width; what belongs to no leg is in the middle
const LEAST = 0.03, MOST_HEADS = 60, PAINTED_EVERY_MS = 90; // weaker links are left out; so many have heads
const within = (value) => Math.min(1, Math.max(-1, value));

/** What a sensor reads, by the last part of its name; a recording has no others. */
const READINGS = {
  command_speed: ({ walk, row }) => walk.commands[0][row],
  command_turn: ({ walk, row }) => walk.commands[1][row],
  command_stop: ({ walk, row }) => Number(walk.commands.every((column) => column[row] === 0)),
  heading_error: ({ done, row }) => done.headingErrors[row],
  yaw_rate: ({ walk, done, row }) => (row ? (done.headings[row] - done.headings[row - 1]) / walk.poses.step_s : 0),
  touch: ({ walk, t }, leg) => Number(walk.touching(leg, t)),
};

/** What a node says at `now`, −1 … 1; null: not known. */
function sayingOf({ name, role, gain, shift }, leg, walk) {
  const last = name.split(".").at(-1), { robot } = walk;
  if (role === "sensor") {
    const reading = READINGS[last];
    return reading && (walk.commands || last === "touch") ? (now) => within(reading(now, leg) * gain - shift) : () => null;
  }
  if (role === "hidden") {
    const column = walk.neurons.find((neuron) => neuron.name === name)?.values;
    return column ? ({ row }) => column[row] : () => null;
  }
  const joint = robot.legs[leg]?.joints[robot.joint_types.indexOf(last)] ?? -1;
  if (joint < 0) return () => null;
  const [lower, upper] = rangeOf(robot.joints[joint]);
  return ({ row }) => within((2 * walk.targets[joint][row] - lower - upper) / (upper - lower || 1));
}

/** The nodes with their legs (−1: none), what they say, and their phases, if they are SUPGs. */
export function nodesOf(walk) {
  const { legs } = walk.robot;
  return walk.controller.nodes.map((node) => {
    const leg = legs.findIndex(({ name }) => node.name.startsWith(`${name}.`));
    const phase = ({ row }) => (walk.timers && leg >= 0 ? walk.timers[leg][row] / walk.controller.period_ticks : -1);
    return { ...node, leg, short: leg < 0 ? node.name : node.name.slice(legs[leg].name.length + 1), say: sayingOf(node, leg, walk), phase };
  });
}

/** What a link adds to its target now: its weight times what its source says; a coupling by how far the two legs are from the difference of their phases. */
export function passing(link, says, phases) {
  if (link.port !== "coupling") return link.weight * (says[link.source] ?? 0);
  const [from, to] = [phases[link.source], phases[link.target]], turned = 2 * Math.PI * (from - to);
  return from < 0 || to < 0 ? 0 : link.in_phase * Math.sin(turned) - link.out_of_phase * Math.cos(turned);
}

/** Where nodes are: as on the robot seen from above, legs to its left and right with the front above; {places, height, heads} in px. */
function arrange(nodes, { robot: { legs }, controller }, width) {
  const side = controller.coordinates.indexOf("side"), beside = [[], []];
  legs.forEach((_, leg) => {
    const own = nodes.find((node) => node.leg === leg);
    beside[side < 0 || !own ? leg % 2 : own.at[side] < 0 ? 1 : 0].push(leg);
  });
  const column = (leg, role) => nodes.filter((node) => node.leg === leg && (leg < 0 || node.role === role)); // of no leg: all
  const most = Math.max(1, ...legs.flatMap((_, leg) => Object.keys(COLUMNS).map((role) => column(leg, role).length)));
  const tall = HEAD + most * ROW, height = Math.max(tall * Math.max(beside[0].length, beside[1].length), column(-1).length * ROW);
  const places = new Map(), heads = [];
  const put = (all, x, top, room) => all.forEach((node, i) => places.set(node, [x, top + ((i + 0.5) * room) / all.length]));
  put(column(-1), width / 2, 0, height);
  beside.forEach((own, right) => own.forEach((leg, i) => {
    heads.push([legs[leg].name, right, i * tall + HEAD / 2]);
    for (const [role, share] of Object.entries(COLUMNS)) {
      const all = column(leg, role), room = all.length * ROW;
      put(all, width * (right ? 1 - share : share), i * tall + HEAD + ((most * ROW) - room) / 2, room);
    }
  }));
  return { places: nodes.map((node) => places.get(node)), height, heads };
}

export class Network {
  /** `done`: what rates() or GrowingRates say of the walk, if it is told anything. */
  constructor(walk, done, clock) {
    Object.assign(this, { walk, done, clock, port: "all", how: "now", chosen: -1, nodes: nodesOf(walk), links: walk.controller.links });
    this.ports = [...new Set(this.links.map(({ port }) => port))];
    this.most = Object.fromEntries(this.ports.map((port) => [port, Math.max(...this.links.map((link) => (link.port === port ? Math.abs(link.weight) : 0)))]));
    this.makeElement();
    new ResizeObserver(() => this.repaint()).observe(this.box);
    new IntersectionObserver(([entry]) => {
      this.visible = entry.isIntersecting;
      this.repaint();
    }, { rootMargin: "200px" }).observe(this.box);
  }

  makeElement() {
    const { walk: { controller }, nodes, links } = this, count = (role) => nodes.filter((node) => node.role === role).length;
    const chooser = (label, key, options) => {
      const made = choice(label, options.map((value) => [value, value]), this[key], (value) => {
        made.choose((this[key] = value));
        this.repaint();
      });
      made.element.classList.add("spans");
      return made.element;
    };
    this.list = element("select", { "aria-label": "Node" }, ...["all nodes", ...nodes.map(({ name }) => name)].map((name, i) => element("option", { value: i - 1 }, name)));
    this.list.addEventListener("change", () => this.choose(Number(this.list.value)));
    this.canvas = element("canvas", { role: "img", "aria-label": `The network: ${count("sensor")} sensors, ${count("hidden")} neurons, ${count("joint")} SUPGs, ${links.length} of ${controller.possible_links} links` });
    this.canvas.addEventListener("click", ({ offsetX, offsetY }) => this.choose(this.nodeAt(offsetX, offsetY)));
    this.words = element("p", { class: "note" });
    this.box = element("div", { class: "network" }, this.canvas);
    this.element = element("div", {}, element("div", { class: "network-choices" }, chooser("Links", "port", ["all", ...this.ports]),
      chooser("What links show", "how", ["now", "weights"]), this.list), this.box, this.words);
  }

  choose(node) {
    this.chosen = this.list.value = node;
    this.repaint();
  }

  nodeAt(x, y) {
    return this.places.findIndex((place) => Math.hypot(place[0] - x, place[1] - y) < REACH);
  }

  repaint() {
    this.painted_ms = undefined;
    this.show(this.time_s ?? 0);
  }

  show(t) {
    this.time_s = t;
    const width = this.box.clientWidth, now_ms = performance.now();
    if (!width || !this.visible || (this.clock.playing && now_ms - this.painted_ms < PAINTED_EVERY_MS)) return;
    this.painted_ms = now_ms;
    const now = { walk: this.walk, done: this.done, row: this.walk.place(t).row, t };
    this.says = this.nodes.map((node) => node.say(now));
    this.phases = this.nodes.map((node) => node.phase(now));
    this.passing = this.links.map((link) => passing(link, this.says, this.phases));
    this.paint(width);
    const words = this.wording();
    if (this.words.textContent !== words) this.words.textContent = words;
  }

  /** What a chosen node says, and what acts on it most. */
  wording() {
    const { nodes, links, chosen } = this, signed = (value) => (value < 0 ? "" : "+") + number(value, 2);
    if (chosen < 0) return "Choose a node, here or in the picture, to see its links alone.";
    const says = this.says[chosen], phase = this.phases[chosen];
    const into = links.map((link, i) => ({ ...link, value: this.passing[i] })).filter(({ target, port }) => target === chosen && (this.port === "all" || port === this.port));
    const most = into.sort((a, b) => Math.abs(b.value) - Math.abs(a.value)).slice(0, 3).map(({ source, port, value }) => `${nodes[source].name} ${signed(value)}${this.port === "all" ? ` (${port})` : ""}`);
    return `${nodes[chosen].name}: ${says === null ? "the recording does not have it" : signed(says)}${nodes[chosen].role === "joint" && phase >= 0 ? `, ${number(phase, 2)} of its period` : ""}. ` +
      (into.length ? `Most of ${into.length} links into it: ${most.join(", ")}.` : "No links lead into it.");
  }

  paint(width) {
    const { places, height, heads } = arrange(this.nodes, this.walk, width), ratio = devicePixelRatio, pen = this.canvas.getContext("2d");
    this.places = places;
    Object.assign(this.canvas, { width: Math.round(width * ratio), height: Math.round(height * ratio) });
    Object.assign(this.canvas.style, { width: `${width}px`, height: `${height}px` });
    pen.scale(ratio, ratio);
    this.paintLinks(pen);
    pen.globalAlpha = 1;
    this.nodes.forEach((node, i) => this.paintNode(pen, node, i));
    this.nodes.forEach((node, i) => this.paintName(pen, node, i, width)); // above all nodes: narrow pages have some beside names
    for (const [name, right, y] of heads) write(pen, name, right ? width : 0, y, right ? "right" : "left", 600);
  }

  paintLinks(pen) {
    const shown = this.links.map((link, i) => ({ ...link, value: this.how === "now" ? this.passing[i] : link.weight }))
      .map((link) => ({ ...link, strength: Math.min(1, Math.abs(link.value) / (this.most[link.port] || 1)) }))
      .filter(({ port, source, target, strength }) => (this.port === "all" || port === this.port) && strength > LEAST && (this.chosen < 0 || source === this.chosen || target === this.chosen));
    for (const link of shown.sort((a, b) => a.strength - b.strength)) {
      pen.strokeStyle = pen.fillStyle = colour(link.value < 0 ? "--minus" : "--plus");
      pen.globalAlpha = (shown.length > MOST_HEADS ? 0.75 : 1) * link.strength ** 0.8;
      pen.lineWidth = 0.5 + 2.5 * link.strength;
      line(pen, this.places[link.source], this.places[link.target], shown.length <= MOST_HEADS);
    }
  }

  paintNode(pen, node, i) {
    const [x, y] = this.places[i], says = this.says[i], phase = this.phases[i], r = RADIUS;
    const shape = (size) => {
      pen.beginPath();
      if (node.role === "sensor") pen.rect(x - size * 0.9, y - size * 0.9, size * 1.8, size * 1.8);
      else pen.arc(x, y, size, 0, 2 * Math.PI);
    };
    shape(r);
    pen.fillStyle = colour("--paper");
    pen.fill();
    shape(r * Math.sqrt(Math.abs(says ?? 0)));
    pen.fillStyle = colour(says < 0 ? "--minus" : "--plus");
    pen.fill();
    shape(r);
    pen.strokeStyle = colour("--ink");
    pen.lineWidth = i === this.chosen ? 3 : 1.3;
    pen.setLineDash(says === null ? [2, 2] : []);
    pen.stroke();
    pen.setLineDash([]);
    if (node.role === "joint" && phase >= 0) hand(pen, x, y, r, phase);
  }

  paintName(pen, node, i, width) {
    const [x, y] = this.places[i], outer = node.role === "joint" && node.leg >= 0, right = x > width / 2;
    if (outer) write(pen, node.short, x + (right ? 14 : -14), y, right ? "left" : "right");
    else if (node.role === "sensor") write(pen, node.short.replaceAll("_", " "), x, y + 14.5, "center");
  }
}

/** A clock's hand, from twelve on. */
function hand(pen, x, y, r, phase) {
  const angle = 2 * Math.PI * (phase - 0.25);
  pen.beginPath();
  pen.moveTo(x, y);
  pen.lineTo(x + (r + 3.5) * Math.cos(angle), y + (r + 3.5) * Math.sin(angle));
  pen.lineWidth = 2;
  pen.stroke();
}

function write(pen, text, x, y, align, weight = 450) {
  pen.font = `${weight} ${weight > 500 ? 12 : 11}px ${colour("--sans")}`;
  pen.textAlign = align;
  pen.textBaseline = "middle";
  pen.lineJoin = "round";
  pen.lineWidth = 3;
  pen.strokeStyle = colour("--paper");
  pen.strokeText(text, x, y);
  pen.fillStyle = colour("--ink");
  pen.fillText(text, x, y);
}

/** From the edge of one node to that of another, bent to the right of its way; of a node to itself a loop. */
function line(pen, [x0, y0], [x1, y1], head) {
  const length = Math.hypot(x1 - x0, y1 - y0);
  pen.beginPath();
  if (length === 0) pen.arc(x0, y0 - RADIUS - 4, 5, 0.8 * Math.PI, 2.2 * Math.PI);
  else {
    const [ux, uy] = [(x1 - x0) / length, (y1 - y0) / length], bend = 0.13 * length;
    const middle = [(x0 + x1) / 2 - uy * bend, (y0 + y1) / 2 + ux * bend], end = [x1 - ux * RADIUS, y1 - uy * RADIUS];
    pen.moveTo(x0 + ux * RADIUS, y0 + uy * RADIUS);
    pen.quadraticCurveTo(...middle, ...end);
    if (head) {
      const angle = Math.atan2(end[1] - middle[1], end[0] - middle[0]);
      for (const turn of [2.7, -2.7]) {
        pen.moveTo(...end);
        pen.lineTo(end[0] + 7 * Math.cos(angle + turn), end[1] + 7 * Math.sin(angle + turn));
      }
    }
  }
  pen.stroke();
}
