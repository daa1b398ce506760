// The diagrams of one walker, as sections beside the stage.
import { GaitTable } from "./gait.js";
import { Network } from "./network.js";
import { Patterns } from "./patterns.js";
import { element, legClass } from "./theme.js";
import { PathFromAbove, rates } from "./told_path.js";
import { commandPlot, footfallPlot, jointPlots, motionPlot, neuronPlot, timerPlot } from "./time_diagrams.js";

const section = (title, text, ...content) =>
  element("section", {}, element("h2", {}, title), ...(text ? [element("p", { class: "lead" }, text)] : []), ...content);
/** A picture that came with the page. */
function drawing(svg) {
  const box = element("div", { class: "scroll cppn-box", tabindex: "0", role: "group", "aria-label": "The network, which may be wider than the page" });
  box.innerHTML = svg;
  const picture = box.firstElementChild;
  picture.style.minWidth = `${0.65 * picture.width.baseVal.value}px`; // for legibility on a phone
  return box;
}
const note = (text) => element("p", { class: "note" }, text);

const CONTACTS = { torque: "a motor’s torque", tracking: "how far a joint is from its target", shock: "a shock that the body feels" };

/** What a trigger is, and what it does. */
function triggerText({ kind, trigger, contact, modulation }) {
  if (kind === "oscillators") return "the foot came down and its leg’s oscillators began anew";
  const when = trigger === "random" ? "a moment drawn by chance, whatever the foot does"
    : contact && contact.source !== "touch" ? `a contact guessed from ${CONTACTS[contact.source]}`
    : trigger === "level" ? "the foot is down" : "the foot came down";
  const pull = modulation?.reset ?? 1;
  return `${when}${pull === 1 ? ", and the timer of its leg is set back" : `, and the timer of its leg moves ${Math.round(100 * pull)} % of the way back`}`;
}

/** What else moves targets than the pattern that is drawn. */
function changesText({ kind, modulation }) {
  if (kind === "mixed") return " The targets are these patterns, stretched and shifted by the links of neurons and sensors, whose values stand below.";
  if (!modulation?.sensors?.length) return "";
  return ` Drawn is the pattern alone; ${modulation.sensors.join(", ")} change${modulation.sensors.length === 1 ? "s" : ""} ` +
    `${[modulation.rate ? "how fast timers climb" : "", modulation.shape ? "the targets" : ""].filter(Boolean).join(" and ") || "nothing, as its gains are 0"}.`;
}

const neuronText = ({ controller: { kind } }) => kind === "mixed"
  ? "What each neuron beside the SUPGs says, from −1 to 1: it listens to sensors, commands and others, and acts on rates, amplitudes and shifts."
  : `The controller is of kind “${kind}”. What each neuron says, from 0 to 1; those that bear a joint’s name are its target, over the joint’s range.`;

/** The numbers that oscillators are. */
function oscillators(walk) {
  const { timestep_s, joints, amplitude_rad, phase_turns, offset_rad, swing_turns_per_tick, stance_turns_per_tick, reset } = walk.controller;
  const hz = (turns) => `${(turns / timestep_s).toFixed(2)} /s`;
  const cells = (tag, ...texts) => texts.map((text, i) => element(i ? tag : "th", { scope: i || tag === "th" ? "col" : "row" }, text));
  const rows = joints.map((name, i) => element("tr", {}, ...cells("td", name, offset_rad[i].toFixed(2), amplitude_rad[i].toFixed(2), phase_turns[i].toFixed(2))));
  return section("Oscillators", `Each joint’s target is its offset and a sine of its own, which turns ${hz(swing_turns_per_tick)} where it is positive and ` +
    `${hz(stance_turns_per_tick)} where it is not. ${reset === "touch" ? "A foot that comes down begins those of its leg anew." : "Nothing is sensed."}`,
    element("div", { class: "scroll", tabindex: "0", role: "group", "aria-label": "Oscillators, which may be wider than the page" },
      element("table", { class: "trials" }, element("tr", {}, ...cells("th", "joint", "offset, rad", "amplitude, rad", "phase, turns")), ...rows)));
}

export class Analysis {
  constructor(parent, walks, window, clock) {
    Object.assign(this, { parent, walks, window, clock, shown: [], plots: [], selected: 0 });
  }

  /** Shows the diagrams of another walker. */
  select(selected) {
    this.selected = selected;
    const walk = this.walks[selected];
    this.plots = [];
    this.shown = [];
    const plot = (made) => {
      this.plots.push(made);
      this.shown.push(made);
      return made.element;
    };
    const { window, clock } = this, done = walk.commands && (walk.told ?? rates(walk));
    this.parent.replaceChildren(
      ...this.told(walk, done, plot),
      this.footfalls(walk, plot(footfallPlot(walk, window, clock))),
      ...this.supg(walk, plot),
      ...(walk.neurons.length ? [section("Neurons", neuronText(walk), plot(neuronPlot(walk, window, clock)))] : []),
      ...this.network(walk, done),
      section("Joints", "Each joint’s angle, in the colour of its leg, and the target that its servo follows, thin. " +
              "The height of a row is the joint’s range, which stands beside it in rad.",
              ...jointPlots(walk, window, clock).map(plot)),
      section("Speed and height", "Of the centre of mass over the ground; speed over half a second.",
              plot(motionPlot(this.walks, window, clock, () => this.selected))),
      ...(walk.cppn_svg ? [section("CPPN", "The evolved network that makes the controller, a compositional pattern producing " +
                                   "network, from its inputs (left) to its " +
                                   "outputs: the function of each node, and each link’s weight as its width.",
                                   drawing(walk.cppn_svg))] : []),
    );
    this.show();
  }

  footfalls(walk, plot) {
    const keys = element("p", { class: "keys" }, ...walk.robot.legs.map(({ name }, leg) =>
      element("span", { class: `key ${legClass(leg)}` }, name)));
    const chatters = walk.chatter.some(({ gaps, touches }) => gaps.length + touches.length > 0);
    const text = "A bar means that the foot is on the ground." +
      (chatters ? ` A hairline is chatter of its sensor: a gap or a touch under ${walk.debounce_s} s, which does not count.` : "") +
      (walk.triggers ? ` A triangle marks a trigger: ${triggerText(walk.controller)}.` : "");
    if (walk.live) return section("Footfalls", text, keys, plot);
    const gait = new GaitTable(walk);
    this.shown.push(gait);
    const made = section("Footfalls and gait", text, keys, plot, gait.element);
    if (!walk.everTouched()) made.append(note("No foot touched the ground."));
    return made;
  }

  /** Folded, as it is as tall as all diagrams before it, and costs nothing so. */
  network(walk, done) {
    if (walk.controller.kind !== "mixed") return [];
    const network = new Network(walk, done, this.clock), key = (css, text) => element("span", { class: "key", style: `--leg: var(${css})` }, text);
    this.shown.push(network);
    return [section("Network", "", element("details", { class: "help" }, element("summary", {}, "What sensors, neurons and SUPGs say to each other"),
      element("p", { class: "lead" }, "As on the robot seen from above. A square is a sensor, a circle a neuron, one with a hand a SUPG: the hand is the " +
        "phase of its leg’s timer. What is filled grows with what the node says; a SUPG says its target, within the joint’s range. A link’s width is its weight times " +
        "what its source says now, or its weight alone. Readings are as without noise and delay."),
      element("p", { class: "keys" }, key("--plus", "plus"), key("--minus", "minus")), network.element))];
  }

  told(walk, done, plot) {
    if (!done) return [];
    const path = new PathFromAbove(walk, done);
    this.shown.push(path);
    return [section("Told and done", "Dashed: the speed and the turn that it was told, and the way that they lead to from its start. " +
                    `Black: what it did, means over ${walk.live ? "the second before" : "a second"}.`, path.element, plot(commandPlot(walk, done, this.window, this.clock)))];
  }

  supg(walk, plot) {
    if (walk.controller.kind === "oscillators") return [oscillators(walk)];
    if ((!walk.supg || !walk.timers) && walk.neurons.length) return [];
    if (!walk.supg || !walk.timers)
      return [section("Controller", "", note(`The controller is of kind “${walk.controller.kind}”: it has no timers and no ` +
                                             "temporal patterns to show."))];
    const patterns = new Patterns(walk);
    this.shown.push(patterns);
    return [section("Timers and patterns",
      `Each leg’s timer climbs through its ${walk.supg.period_ticks * walk.supg.timestep_s} s and a trigger sends it back; ` +
      "below, the target angle of each joint over its leg’s timer, over the joint’s range, with the place of the timer now. " +
      `Dotted: ${walk.supg.offset === "phase" ? "where the leg’s timer starts" : "how long the leg waits before its timer starts"}.` +
      changesText(walk.controller) +
      (walk.supg.gaits ? ` The patterns are those of the first of ${walk.supg.gaits} gaits, between which legs switch as they are told.` : ""),
      plot(timerPlot(walk, this.window, this.clock)), patterns.element)];
  }

  show() {
    for (const diagram of this.shown) diagram.show(this.clock.time_s);
  }
  repaint() {
    for (const plot of this.plots) plot.repaint();
  }
}
