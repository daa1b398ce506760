// The curves of a run, generation by generation, over its species as stacked bands; runs before it as thin lines.
import { niceAxis, number } from "../plot.js";
import { colour, element } from "../theme.js";
import { AXIS, LEFT, RIGHT, TOP, lineKey, paintGenerations, paintLevels } from "./axes.js";
import { Picture, line, write, writeLines } from "./picture.js";

const BANDS = 64, GAP = 24;
// Runs before, the latest first: colour and dashes.
const OLD = [["--c5", [7, 3]], ["--c3", [2, 3]], ["--c6", [9, 3, 2, 3]]];
const LINES = [["best so far", (row) => row.best_so_far, "--ink", 2.4, []], ["best of the generation", ({ best }) => best, "--c1", 1, []],
               ["median", ({ median }) => median, "--c0", 1.8, []], ["what the best so far typically does", ({ typical }) => typical, "--c4", 2, [1, 4]]];

/** Species, or filled cells of a map, as words. */
export const kindsOf = ({ species, count, cells, map }) =>
  map || cells !== undefined ? `${cells ?? map.length} cells of the map` : `${count ?? species.length} species`;

export class Curve {
  /** `hint`: what stands there before the first generation. `unit`: of what is drawn, with its space. */
  constructor({ hint = "Press Start: each generation adds a point.", unit = " m" } = {}) {
    Object.assign(this, { hint, unit });
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
    this.unit = progress.unit;
    this.history.push(progress);
    this.show();
  }
  mark(generation) {
    this.marks.push(generation);
  }

  show() {
    this.showKeys();
    const now = this.history.at(-1);
    if (now) this.picture.label(`Curves of ${now.generation + 1} generations: the best so far gets ${number(now.best_so_far, 2)}${this.unit}, the median ${number(now.median, 2)}${this.unit}; ${kindsOf(now)}`);
    this.picture.repaint();
  }

  showKeys() {
    const ends = ({ name, history }) => `before: ${name}, ${number(history.at(-1).best_so_far, 1)}${this.unit} (typically ${number(history.at(-1).typical, 1)}${this.unit})`;
    this.keys.replaceChildren(...LINES.map(([text, , ...look]) => lineKey(text, ...look)),
                              ...this.before.map((run, i) => lineKey(ends(run), OLD[i][0], 1.8, OLD[i][1])));
  }

  paint(context, width, height) {
    const { history, before } = this, runs = [history, ...before.map((run) => run.history)];
    const most = Math.max(10, ...runs.map((run) => run.at(-1)?.generation ?? 0)); // of many generations not each has a row
    const bands = history.some(({ species, count }) => species?.length || count > 0) ? BANDS + GAP : 0, base = height - AXIS - bands;
    const x = (generation) => LEFT + (generation / most) * (width - LEFT - RIGHT);
    let highest = 0.1;
    for (const { best_so_far, best } of runs.flat()) highest = Math.max(highest, best_so_far || 0, best || 0);
    const { lower, upper, ticks, text } = niceAxis(0, highest, 5);
    const y = (value) => base - ((value - lower) / (upper - lower)) * (base - TOP);
    const empty = runs.every((run) => run.length === 0);
    if (!empty) paintLevels(context, ticks, { text, unit: this.unit, y, width });
    else paintLevels(context, [lower], { text, unit: "", y, width });
    if (empty) writeLines(context, this.hint, (LEFT + width - RIGHT) / 2, base / 2, width - LEFT - RIGHT, { align: "center", size: 14 });
    const curve = (run, value, css, thick, dash) => line(context, run.map((row) => [x(row.generation), y(value(row))]), css, thick, dash);
    for (const generation of this.marks) this.paintMark(context, x(generation), base, width);
    before.forEach((run, i) => curve(run.history, (row) => row.best_so_far, OLD[i][0], 1.8, OLD[i][1]));
    for (const [, ...look] of [...LINES].reverse()) curve(history, ...look);
    for (const [value, css] of [[(row) => row.best_so_far, "--ink"], [(row) => row.median, "--c0"]]) this.paintEnd(context, x, y, value, css);
    paintGenerations(context, x, base + 12, most, width);
    if (bands) this.paintSpecies(context, x, base + GAP + 8, width);
  }

  /** The world changed. */
  paintMark(context, x, base, end) {
    line(context, [[x, TOP], [x, base]], "--ink", 1.2, [4, 4]);
    const right = x > end - 90;
    write(context, "another world", right ? x - 4 : x + 4, TOP + 4, { align: right ? "right" : "left", size: 11 });
  }
  paintEnd(context, x, y, value, css) {
    const now = this.history.at(-1);
    if (!now) return;
    context.beginPath();
    context.arc(x(now.generation), y(value(now)), 3.2, 0, 2 * Math.PI);
    context.fillStyle = colour(css);
    context.fill();
  }

  /** Stacked: each species as a band, as high as it has members; where only their number is known, equal ones in grey. */
  paintSpecies(context, x, top, width) {
    const high = BANDS - 8;
    this.history.forEach(({ species, count, generation }, i) => {
      const bands = species.length ? species : Array.from({ length: count || 0 }, () => [null, 1]);
      const next = this.history[i + 1]?.generation ?? generation + 1, from = Math.max(x(generation - 0.5), LEFT), wide = Math.min(x(next - 0.5) + 0.5, width - RIGHT) - from;
      const all = bands.reduce((sum, [, size]) => sum + size, 0);
      let at = top;
      for (const [id, size] of bands) {
        const tall = (size / all) * high;
        context.fillStyle = colour(id === null ? "--mid" : `--c${id % 8}`);
        context.globalAlpha = id === null ? 0.4 : 0.45 + 0.4 * (Math.floor(id / 8) % 2);
        context.fillRect(from, at, wide, Math.max(tall - 0.6, 0.4));
        at += tall;
      }
    });
    context.globalAlpha = 1;
    write(context, "species", LEFT - 8, top + high / 2, { align: "right", size: 11 });
  }
}
