// The curves of a run, generation by generation, over its species as stacked bands; runs before it as thin lines.
import { niceAxis, number } from "../plot.js";
import { colour, element } from "../theme.js";
import { Picture, line, write } from "./picture.js";

const LEFT = 54, RIGHT = 12, TOP = 12, AXIS = 24, BANDS = 64, GAP = 24;
const OLD = [[6, 4], [2, 4], [9, 3, 2, 3]]; // how runs before are dashed, the latest first

export class Curve {
  constructor() {
    this.history = [];
    this.marks = []; // generations at which the world changed
    this.before = []; // {name, history}, the latest first
    this.keys = element("p", { class: "keys" });
    this.picture = new Picture("Best and median by generation; below, the species", "lab-curve", (width) => (width < 500 ? 290 : 340), (...all) => this.paint(...all));
    this.element = element("div", {}, this.keys, this.picture.element);
    this.showKeys();
  }

  /** A new run; what was shown stays as a line to compare with. */
  begin(name, keep = true) {
    if (keep && this.history.length > 1) this.before = [{ name: this.name, history: this.history }, ...this.before].slice(0, OLD.length);
    Object.assign(this, { name, history: [], marks: [] });
    this.show();
  }
  forget() {
    this.before = [];
    this.show();
  }
  add(progress) {
    this.history.push(progress);
    this.show();
  }
  mark(generation) {
    this.marks.push(generation);
  }

  show() {
    this.showKeys();
    const now = this.history.at(-1);
    if (now) this.picture.label(`Curves of ${this.history.length} generations: the best so far walks ${number(now.best_so_far, 2)} m, the median ${number(now.median, 2)} m; ${now.species.length} species`);
    this.picture.repaint();
  }

  showKeys() {
    const key = (kind, text) => element("span", { class: `line-key key-${kind}` }, text);
    this.keys.replaceChildren(key("best", "best so far"), key("now", "best of the generation"), key("median", "median"), key("typical", "what the best typically does"),
      ...this.before.map(({ name }, i) => key(`old${i}`, name)));
  }

  paint(context, width, height) {
    const { history, before } = this, runs = [history, ...before.map((run) => run.history)];
    const most = Math.max(10, ...runs.map((run) => run.length - 1));
    const bands = history.some(({ species }) => species.length) ? BANDS + GAP : 0, base = height - AXIS - bands;
    const x = (generation) => LEFT + (generation / most) * (width - LEFT - RIGHT);
    const upper_m = Math.max(0.1, ...runs.flat().map(({ best_so_far, best }) => Math.max(best_so_far, best)));
    const { lower, upper, ticks, text } = niceAxis(0, upper_m, 5);
    const y = (value) => base - ((value - lower) / (upper - lower)) * (base - TOP);
    for (const tick of ticks) {
      line(context, [[LEFT, y(tick)], [width - RIGHT, y(tick)]], "--hair", 1);
      write(context, tick === ticks.at(-1) ? `${text(tick)} m` : text(tick), LEFT - 8, y(tick), { align: "right", size: 11.5 });
    }
    if (runs.every((run) => run.length === 0)) write(context, "Press Start: each generation adds a point.", (LEFT + width) / 2, base / 2, { align: "center", size: 14 });
    const curve = (run, value, css, thick, dash) => line(context, run.map((row) => [x(row.generation), y(value(row))]), css, thick, dash);
    for (const generation of this.marks) this.paintMark(context, x(generation), base);
    before.forEach((run, i) => curve(run.history, (row) => row.best_so_far, "--mid", 1.6, OLD[i]));
    curve(history, ({ median }) => median, "--c0", 1.8);
    curve(history, ({ best }) => best, "--c1", 1);
    curve(history, ({ typical }) => typical, "--c4", 1.8, [1, 4]);
    curve(history, (row) => row.best_so_far, "--ink", 2.4);
    for (const [value, css] of [[(row) => row.best_so_far, "--ink"], [(row) => row.median, "--c0"]]) this.paintEnd(context, x, y, value, css);
    write(context, "generation 0", LEFT, base + 12, { size: 11.5 });
    write(context, String(most), width - RIGHT, base + 12, { align: "right", size: 11.5 });
    if (bands) this.paintSpecies(context, x, base + GAP + 8, width);
  }

  paintMark(context, x, base) {
    line(context, [[x, TOP], [x, base]], "--ink", 1.2, [4, 4]);
  }
  paintEnd(context, x, y, value, css) {
    const now = this.history.at(-1);
    if (!now) return;
    context.beginPath();
    context.arc(x(now.generation), y(value(now)), 3.2, 0, 2 * Math.PI);
    context.fillStyle = colour(css);
    context.fill();
  }

  /** Stacked: each species as a band, as high as it has members. */
  paintSpecies(context, x, top, width) {
    const high = BANDS - 8;
    this.history.forEach(({ species, generation }) => {
      const all = species.reduce((sum, [, size]) => sum + size, 0), from = x(generation - 0.5), wide = x(generation + 0.5) - from;
      let at = top;
      for (const [id, size] of species) {
        const tall = (size / all) * high;
        context.fillStyle = colour(`--c${id % 8}`);
        context.globalAlpha = 0.45 + 0.4 * (Math.floor(id / 8) % 2);
        context.fillRect(Math.max(from, LEFT), at, Math.min(wide + 0.5, width - RIGHT - from), Math.max(tall - 0.6, 0.4));
        at += tall;
      }
    });
    context.globalAlpha = 1;
    write(context, "species", LEFT - 8, top + high / 2, { align: "right", size: 11 });
  }
}
