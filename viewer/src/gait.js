// What `amble gait` found: the name, and duty factor, phase and stride of each leg, of all and around the present.
import { number } from "./plot.js";
import { element, legClass } from "./theme.js";

const percent = (share) => (share == null ? "–" : `${(100 * share).toFixed(0)} %`);
const seconds = (time_s) => number(time_s, Number.isInteger(time_s) ? 0 : 1);
const decimals = (count) => (value) => (value == null ? "–" : number(value, count));

const MOST_COLUMNS = 6; // legs

/** Null for robots of which gaits have no names. */
const nameOf = ({ gait, irregular_reason: reason }) => gait && gait + (reason ? ` (${reason})` : "");

/** The duty factor parts walking from running; a value at the limit is named as such. */
function footwork({ duty_factor: duty, stride_s }) {
  if (duty == null) return "no strides";
  const border = Math.abs(duty - 0.5) < 0.005;
  const word = border ? "between walking and running" : duty > 0.5 ? "walking" : "running";
  return `${word}, duty factor ${number(duty, border ? 3 : 2)}, stride ${number(stride_s, 2)} s`;
}

export class GaitTable {
  constructor(walk) {
    Object.assign(this, { walk, gait: walk.gait });
    this.element = element("div", { class: "gait-box" });
    if (this.gait) this.element.append(this.headline());
    this.element.append(element("div", { class: "scroll", tabindex: "0", role: "group", "aria-label": "Footfall of each leg, which may be wider than the page" }, this.table()));
    if (this.now && walk.robot.legs.length > MOST_COLUMNS)
      this.element.append(element("p", { class: "gait-now-line" }, "Now: ", this.title));
    if (this.gait) this.element.append(this.key(), this.figures());
  }

  headline() {
    const name = nameOf(this.gait), feet = footwork(this.gait);
    const [head, ...rest] = name ? [name, feet] : feet.split(", ");
    return element("p", { class: "gait-head" }, element("b", { class: "gait-name" }, head), ` ${rest.join(", ")}`);
  }

  /** A column for each leg; of many legs a row for each, so that the table is no wider than the page. */
  table() {
    const { legs } = this.walk.robot;
    const head = legs.map(({ name }, leg) => element("th", {}, element("span", { class: `key ${legClass(leg)}` }, name)));
    const measures = this.measures();
    const row = (first, cells, attributes = {}) =>
      element("tr", attributes, first, ...cells.map((cell) => element("td", {}, cell)));
    const th = (title) => element("th", {}, title);
    if (legs.length > MOST_COLUMNS) {
      const titles = element("tr", {}, element("td", {}), ...measures.map(({ title, now }) => th(now ? `${title} now` : title)));
      const rows = head.map((name, leg) => row(name, measures.map(({ cells }) => cells[leg])));
      return element("table", { class: "gait by-leg" }, titles, ...rows);
    }
    const rows = measures.map(({ title, cells }) => row(th(title), cells));
    const first = measures.findIndex(({ now }) => now);
    if (first >= 0) {
      const title = element("td", { colspan: legs.length }, this.title);
      rows.splice(first, 0, element("tr", { class: "gait-now" }, th("Now"), title));
    }
    return element("table", { class: "gait" }, element("tr", {}, element("td", {}), ...head), ...rows);
  }

  /** {title, cells: one per leg, now: whether they follow the time}. */
  measures() {
    const { legs } = this.walk.robot;
    const known = this.gait?.legs;
    if (!known) return [{ title: "On the ground", cells: legs.map((_, leg) => percent(this.walk.contactShare(leg))) }];
    const of = (title, value, text) => ({ title, cells: known.map((leg) => text(value(leg))) });
    const list = [of("Duty factor", (leg) => leg.duty_factor, percent), of("Phase", ({ phase }) => phase?.phase, decimals(2)),
                  of("R", ({ phase }) => phase?.resultant, decimals(2)),
                  of("Drift / min", ({ drift_per_min }) => drift_per_min, decimals(3)),
                  of("Stride, s", ({ stride_s }) => stride_s, decimals(2))];
    if (this.gait.windows.length <= 1) return list;
    this.title = element("span");
    const cells = () => legs.map(() => document.createTextNode(""));
    this.now = { duty_factors: cells(), phases: cells() };
    return [...list, { title: "Duty factor", cells: this.now.duty_factors, now: true },
            { title: "Phase", cells: this.now.phases, now: true }];
  }

  key() {
    const { reference_leg: leg } = this.gait;
    const text = leg ? `Phase: when a foot lands within the stride of ${leg}, 0 to 1. R: how steadily, 1 at most. Drift: how ` +
      "the phase moves, strides a minute; known from three parts of the trial on. " : "";
    const known = this.gait.work_positive_j != null;
    return element("p", { class: "lead" }, `${text}Cost of transport: the motors’ positive work / (weight × way)` +
                   (known ? "; in brackets, with braking counted too." : "; not known where an engine tells no torques."));
  }

  figures() {
    const { speed_m_s, straightness, froude, cost_of_transport_positive: cost, cost_of_transport_absolute: braking } = this.gait;
    const fields = [["Speed", speed_m_s, 3, "m/s"], ["Straightness", straightness, 2, ""], ["Froude number", froude, 4, ""],
                    ["Cost of transport", cost, 2, braking == null ? "" : `(${number(braking, 2)})`]];
    return element("dl", { class: "now" }, ...fields.map(([title, value, count, unit]) =>
      element("div", {}, element("dt", {}, title),
              element("dd", {}, decimals(count)(value), ...(unit ? [element("small", {}, ` ${unit}`)] : [])))));
  }

  show(t) {
    if (!this.now) return;
    const { windows } = this.gait;
    const { start_s } = windows[0];
    const window = t < start_s ? null : windows.find(({ end_s }) => t < end_s) ?? windows.at(-1);
    if (window === this.window) return;
    this.window = window;
    const time = (name) => `${seconds(window.start_s)} … ${seconds(window.end_s)} s${name ? `: ${name}` : ""}`;
    this.title.textContent = window ? time(nameOf(window)) : `the first ${seconds(start_s)} s do not count`;
    this.now.duty_factors.forEach((cell, leg) => (cell.data = percent(window?.duty_factors[leg])));
    this.now.phases.forEach((cell, leg) => (cell.data = decimals(2)(window?.phases[leg]?.phase)));
  }
}
