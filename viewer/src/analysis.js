// The diagrams of one walker, as sections beside the stage.
import { GaitTable } from "./gait.js";
import { Patterns } from "./patterns.js";
import { element, legClass } from "./theme.js";
import { PathFromAbove, rates } from "./told_path.js";
import { commandPlot, footfallPlot, jointPlots, motionPlot, timerPlot } from "./time_diagrams.js";

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
    const { window, clock } = this;
    this.parent.replaceChildren(
      ...this.told(walk, plot),
      this.footfalls(walk, plot(footfallPlot(walk, window, clock))),
      ...this.supg(walk, plot),
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
      (walk.triggers ? " A triangle marks a trigger: the foot came down and reset the timer of its leg." : "");
    if (walk.live) return section("Footfalls", text, keys, plot);
    const gait = new GaitTable(walk);
    this.shown.push(gait);
    const made = section("Footfalls and gait", text, keys, plot, gait.element);
    if (!walk.everTouched()) made.append(note("No foot touched the ground."));
    return made;
  }

  told(walk, plot) {
    if (!walk.commands) return [];
    const done = rates(walk), path = new PathFromAbove(walk, done.headings);
    this.shown.push(path);
    return [section("Told and done", "Dashed: the speed and the turn that it was told, and the way that they lead to from its start. " +
                    "Black: what it did, means over a second.", path.element, plot(commandPlot(walk, done, this.window, this.clock)))];
  }

  supg(walk, plot) {
    if (!walk.supg || !walk.timers)
      return [section("Controller", "", note(`The controller is of kind “${walk.controller.kind}”: it has no timers and no ` +
                                             "temporal patterns to show."))];
    const patterns = new Patterns(walk);
    this.shown.push(patterns);
    return [section("Timers and patterns",
      `Each leg’s timer climbs through its ${walk.supg.period_ticks * walk.supg.timestep_s} s and a trigger sends it back; ` +
      "below, the target angle of each joint over its leg’s timer, over the joint’s range, with the place of the timer now. " +
      `Dotted: ${walk.supg.offset === "phase" ? "where the leg’s timer starts" : "how long the leg waits before its timer starts"}.` +
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
