// The temporal patterns of a SUPG: target angle over the timer, and where the timer is now.
import { rangeOf } from "./joints.js";
import { element, legClass, svgElement } from "./theme.js";

const MOST_ABREAST = 6, MOST_ON_A_PHONE = 4; // columns
const WIDTH = 160, HEIGHT = 74, PAD = 5;

/** Legs in one row: all, or rows as equal as can be. */
const abreast = (legs, most) => Math.ceil(legs / Math.ceil(legs / most));

/** A name that may be broken after its underscores. */
const breakable = (name) => name.split(/(?<=_)/).flatMap((part, i) => (i ? [element("wbr", {}), part] : [part]));

export class Patterns {
  constructor(walk) {
    this.walk = walk;
    this.period = walk.supg.period_ticks;
    this.cursors = walk.robot.legs.map(() => []);
    this.states = walk.robot.legs.map(() => element("span", { class: "timer-state" }));
    const { legs } = walk.robot;
    const columns = legs.map(({ name }, leg) =>
      element("div", { class: "pattern-leg" },
              element("div", { class: `pattern-head ${legClass(leg)}` }, element("b", {}, ...breakable(name)), this.states[leg]),
              ...walk.robot.joint_types.map((type, row) => this.panel(leg, row, type.replaceAll("_", " ")))));
    this.element = element("div", { class: "patterns" }, ...columns);
    this.element.style.setProperty("--abreast", abreast(legs.length, MOST_ABREAST));
    this.element.style.setProperty("--abreast-narrow", abreast(legs.length, MOST_ON_A_PHONE));
  }

  x(ticks) {
    return PAD + (ticks / this.period) * (WIDTH - 2 * PAD);
  }

  panel(leg, row, title) {
    const { robot, supg } = this.walk;
    const joint = robot.legs[leg].joints[row];
    if (joint < 0) return element("div", { class: "panel" });
    const [lower_rad, upper_rad] = rangeOf(robot.joints[joint]);
    const y = (angle) => PAD + (HEIGHT - 2 * PAD) * (1 - (angle - lower_rad) / (upper_rad - lower_rad || 1));
    const points = supg.patterns_rad[joint].map((angle, tick) => `${this.x(tick).toFixed(1)},${y(angle).toFixed(1)}`);
    const offset = this.x(supg.offset_ticks[leg]);
    const cursor = svgElement("line", { class: "now-line", y1: 0, y2: HEIGHT });
    const dot = svgElement("circle", { class: "now-dot", r: 4 });
    this.cursors[leg].push({ cursor, dot, angleAt: (tick) => y(supg.patterns_rad[joint][tick]) });
    const picture = svgElement("svg", {
      viewBox: `0 0 ${WIDTH} ${HEIGHT}`, preserveAspectRatio: "none", class: legClass(leg), role: "img",
      "aria-label": `Pattern of ${robot.joints[joint].name}`,
    },
    svgElement("line", { class: "offset", x1: offset, x2: offset, y1: 0, y2: HEIGHT }),
    svgElement("polyline", { class: "pattern", points: points.join(" ") }), cursor, dot);
    return element("div", { class: "panel" }, element("small", {}, title), picture);
  }

  show(t) {
    this.cursors.forEach((list, leg) => {
      const ticks = this.walk.timer(leg, t);
      const running = ticks >= 0;
      const text = running ? `${(ticks * this.walk.supg.timestep_s).toFixed(2)} s` : "at rest";
      if (this.states[leg].textContent !== text) this.states[leg].textContent = text;
      for (const { cursor, dot, angleAt } of list) {
        cursor.style.display = dot.style.display = running ? "" : "none";
        if (!running) continue;
        const x = this.x(ticks);
        cursor.setAttribute("x1", x);
        cursor.setAttribute("x2", x);
        dot.setAttribute("cx", x);
        dot.setAttribute("cy", angleAt(Math.min(Math.round(ticks), this.period)));
      }
    });
  }
}
