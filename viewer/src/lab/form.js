// What can be chosen, as a form.
import { element } from "../theme.js";
import { group, row, slider } from "../widgets.js";

const select = (options) => element("select", {}, ...options.map(([value, text]) => element("option", { value }, text)));
const count = (min, max, step = 1) => element("input", { type: "number", min, max, step, inputmode: "numeric" });

const CONTROLLERS = [["supg", "SUPGs"], ["together", "SUPGs, together"], ["sine", "sine wave"], ["ctrnn", "CTRNN"]];
const SEARCHES = [["objective", "the farthest"], ["novelty", "the newest"], ["map-elites", "the best of each kind"]];
const MUTATIONS = [["all", "weights, nodes, links"], ["weights", "weights only"], ["none", "none"]];
const NOISES = [["none", "none"], ["little", "a little"], ["strong", "a lot"]];
const HINTS = {
  supg: "Single-unit pattern generators: each joint has a pattern, which begins anew when its foot touches the ground.",
  together: "As SUPGs, but all legs begin at the same time.",
  sine: "A network of neurons reads joints, feet and a sine wave, its clock.", ctrnn: "A continuous-time recurrent neural network: neurons that act on each other over time, and make a rhythm by themselves.",
  objective: "Who walks farthest has most children.", novelty: "Who ends where nobody has ended has most children: novelty search.",
  "map-elites": "A map keeps the best robot of each kind, and all of them have children: MAP-Elites.",
  all: "Children get other weights, and now and then a new node or link.", weights: "The network stays as large as it is.", none: "Children are only mixed from two parents.",
  none_noise: "Each walk repeats exactly.", little: "Each generation starts a thousandth of a radian differently.", strong: "Pushes, drops, wrong sensors, late motors.",
};
const GROUNDS = ["plane", "hills", "rough", "stones", "blocks", "stairs", "hurdles"].map((kind) => [kind, kind === "plane" ? "flat" : kind]);
const GRAVITIES = [["1", "Earth"], ["0.38", "Mars (38 %)"], ["0.17", "Moon (17 %)"], ["2.5", "Jupiter (250 %)"]];

// What a change of the world does, by the state of the run.
const WHEN = {
  none: "Into this world the first generation is born.",
  paused: "A change counts from the next generation on: the best so far is that of another world then, and begins anew.",
  ended: "The run is over. Ground, slope and a missing leg count at once for the walker in the picture. All of it, noise and gravity too, counts for more generations.",
  broken: "The run has ended: nothing walks here any more. Begin anew to choose a world.",
};
WHEN.running = WHEN.paused;
const LATER = ["noise", "gravity"];

export class Form {
  /** `changed(key)` is called after the user has chosen. */
  constructor(robots, changed) {
    Object.assign(this, { changed, fields: new Map(), names: new Map(), texts: new Map(), rows: [], hints: [] });
    this.run = group("The run",
      this.field("robot", "Robot", select(robots.map(({ id, name }) => [id, name]))), this.field("controller", "Controller", select(CONTROLLERS)),
      this.hint("controller"), this.field("search", "Who has children", select(SEARCHES)), this.hint("search"), this.field("population", "Population", slider(10, 200, 10, 60), ({ population }) => `${population}`),
      this.field("generations", "Generations", count(1, 5000)), this.field("seconds", "Length of a trial", slider(2, 20, 1, 8), ({ seconds }) => `${seconds} s`),
      this.field("seed", "Seed (which dice)", count(0, 999999)));
    this.more = element("details", {}, element("summary", {}, "More: feet, mutation, a lost leg"),
      this.field("feels", "Feels its feet", element("input", { type: "checkbox" })), this.field("mutation", "Mutation", select(MUTATIONS)), this.hint("mutation"),
      this.field("lost", "It loses a leg", select([["never", "never"], ["first", "its first"]])), this.field("lostAt", "at generation", count(1, 5000)));
    this.run.append(this.more);
    this.saidOfWorld = element("p", { class: "hint world-when" });
    this.world = group("The world", this.saidOfWorld,
      this.field("noise", "Noise", select(NOISES)), this.hint("noise"), this.field("ground", "Ground", select(GROUNDS)),
      this.field("roughness", "Height, of a leg", slider(0.04, 0.4, 0.02, 0.12), ({ roughness }) => `${Math.round(100 * roughness)} %`),
      this.field("slope", "Uphill", slider(-0.3, 0.3, 0.02, 0), ({ slope }) => `${Math.round(100 * slope)} %`.replace("-", "−")),
      this.field("gravity", "Gravity", select(GRAVITIES)), this.field("missing", "Leg that is missing", select([["", "none"]])));
  }

  field(key, name, control, text = () => "") {
    const made = row(name, control, () => text(this.values()));
    control.name = key;
    control.addEventListener("input", () => this.show());
    control.addEventListener("change", () => this.changed(key));
    this.fields.set(key, control);
    this.names.set(key, name);
    this.texts.set(key, text);
    this.rows.push({ ...made, control });
    return made.label;
  }

  /** What the choice means. */
  hint(key) {
    const text = element("p", { class: "hint", id: `hint-${key}` }), control = this.fields.get(key);
    control.setAttribute("aria-describedby", text.id);
    this.hints.push(() => (text.textContent = HINTS[`${control.value}_${key}`] ?? HINTS[control.value] ?? ""));
    return text;
  }

  values() {
    const values = {};
    for (const [key, control] of this.fields) values[key] = valueOf(key, control);
    return values;
  }

  /** What `values` have other than `others`, in words; not the seed, and nothing that has no effect. */
  differences(values, others) {
    const idle = { lostAt: values.lost === "never", roughness: values.ground === "plane", seed: true,
                   feels: !["supg", "together"].includes(values.controller), mutation: values.search === "map-elites" };
    return [...this.fields.keys()].filter((key) => !idle[key] && values[key] !== others[key]).map((key) => this.words(key, values));
  }
  words(key, values) {
    const control = this.fields.get(key), value = values[key];
    if (key === "robot") return [...control.options].find((option) => option.value === value)?.textContent ?? value;
    const option = control.tagName === "SELECT" && [...control.options].find((one) => one.value === String(value));
    const text = control.type === "checkbox" ? (value ? "yes" : "no") : option ? option.textContent : this.texts.get(key)(values) || value;
    return `${this.names.get(key).toLowerCase()} ${text}`;
  }

  set(values) {
    for (const [key, value] of Object.entries(values)) {
      const control = this.fields.get(key);
      if (!control) continue;
      if (control.type === "checkbox") control.checked = value;
      else control.value = String(value);
      if (control.tagName === "SELECT" && control.selectedIndex < 0) control.selectedIndex = 0;
    }
    this.show();
  }

  /** A robot of one's own among the others. */
  addRobot(id, name) {
    const robots = this.fields.get("robot");
    [...robots.options].find((option) => option.value === id)?.remove();
    robots.prepend(element("option", { value: id }, name));
  }

  /** The legs and controllers that the robot has. */
  setRobot({ facts, configs }) {
    const missing = this.fields.get("missing"), chosen = missing.value;
    missing.replaceChildren(element("option", { value: "" }, "none"), ...facts.legs.map((leg) => element("option", { value: leg }, leg.replaceAll("_", " "))));
    missing.value = facts.legs.includes(chosen) ? chosen : "";
    const controllers = this.fields.get("controller");
    for (const option of controllers.options) option.disabled = !configs[option.value];
    if (controllers.selectedOptions[0]?.disabled) controllers.value = "supg";
    this.show();
  }

  /** When a change of the world counts: `state` of the run, if there is one. */
  sayWorld(state) {
    const text = WHEN[state] ?? WHEN.none;
    if (this.saidOfWorld.textContent !== text) this.saidOfWorld.textContent = text;
    for (const control of this.world.querySelectorAll("input, select")) control.closest("label").classList.toggle("later", state === "ended" && LATER.includes(control.name));
    this.broken = state === "broken";
    this.show();
  }

  /** While a run goes on only its world can be changed. */
  lock(locked) {
    this.locked = locked;
    this.show();
  }

  show() {
    const now = this.values();
    for (const show of [...this.rows.map((one) => one.show), ...this.hints]) show();
    for (const control of this.run.querySelectorAll("input, select")) control.disabled = Boolean(this.locked);
    const can = (key, possible) => (this.fields.get(key).disabled = !possible);
    for (const control of this.world.querySelectorAll("input, select")) control.disabled = Boolean(this.broken);
    if (!this.broken) can("roughness", now.ground !== "plane");
    if (this.locked) return;
    can("feels", ["supg", "together"].includes(now.controller));
    can("lostAt", now.lost !== "never");
    can("mutation", now.search !== "map-elites");
  }
}

function valueOf(key, control) {
  if (control.type === "checkbox") return control.checked;
  if (control.tagName === "SELECT") return key === "gravity" ? Number(control.value) : control.value;
  const value = Number(control.value), { min, max } = control;
  return Math.min(Math.max(Number.isFinite(value) ? value : Number(min), Number(min)), Number(max));
}
