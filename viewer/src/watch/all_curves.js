// How far the best of every run has got, over the generations: a thin line for each run, a thick one for the median of each condition.
import { niceAxis, number } from "../plot.js";
import { element } from "../theme.js";
import { AXIS, LEFT, RIGHT, TOP, lineKey, paintGenerations, paintLevels } from "../lab/axes.js";
import { Picture, line, writeLines } from "../lab/picture.js";

const AGAIN_MS = 10_000, MEDIAN_OF = 3, POINTS = 120, NEAR_PX = 30;
const LOOKS = Array.from({ length: 8 }, (_, i) => `--c${i}`);

/** The runs of one condition have the same name but for a number at the end: "runs/supg-novelty-007" is of "supg-novelty", "supg/7" of "supg". */
export const conditionOf = (id) => {
  const parts = id.split("/"), name = parts.at(-1).replace(/[-_.]?\d+$/, "");
  return name || (parts.length > 1 ? parts.slice(0, -1).join("/") : id);
};

/** The best so far of a run after a generation; undefined where it has not got there. */
export function bestAfter({ last, steps }, generation) {
  if (generation > last || generation < steps[0][0]) return undefined;
  let low = 0, high = steps.length - 1;
  while (low < high) {
    const middle = (low + high + 1) >> 1;
    if (steps[middle][0] <= generation) low = middle;
    else high = middle - 1;
  }
  return steps[low][1];
}

export function median(values) {
  const sorted = [...values].sort((a, b) => a - b), half = sorted.length >> 1;
  return sorted.length % 2 ? sorted[half] : (sorted[half - 1] + sorted[half]) / 2;
}

export class AllCurves {
  /** `choose(id)` is called for a run whose line is clicked. */
  constructor(choose) {
    Object.assign(this, { choose, runs: new Map(), conditions: [], chosen: null, unit: " m" });
    this.keys = element("p", { class: "keys" });
    this.picture = new Picture("How far the best of each run has got", "lab-curve", (width) => (width < 500 ? 260 : 320), (...all) => this.paint(...all));
    this.picture.element.addEventListener("click", ({ offsetX, offsetY }) => this.hit(offsetX, offsetY));
    this.element = element("div", {}, this.keys, this.picture.element);
  }

  /** Asks for them now and again while the page is in sight. */
  begin() {
    if (this.begun) return;
    this.begun = true;
    const ask = async () => {
      try {
        if (!document.hidden) await this.ask();
      } catch (error) {
        console.info(error.message); // the page says elsewhere that nobody answers
      }
      setTimeout(ask, AGAIN_MS);
    };
    ask();
  }
  async ask() {
    const answer = await fetch("curves", { cache: "no-store" });
    if (answer.ok) this.show((await answer.json()).runs);
  }

  show(runs) {
    this.runs = new Map(Object.entries(runs));
    const names = [...new Set([...this.runs.keys()].map(conditionOf))].sort();
    this.conditions = names.map((name, i) => {
      const all = [...this.runs].filter(([id]) => conditionOf(id) === name).map(([, run]) => run);
      return { name, runs: all, css: LOOKS[i % LOOKS.length], dash: i < LOOKS.length ? [] : [7, 3], median: this.medianOf(all) };
    });
    this.keys.replaceChildren(...this.conditions.map((condition) => this.key(condition)));
    const said = this.conditions.map(({ name, runs: all }) => {
      const ends = all.map(({ steps }) => steps.at(-1)[1]).sort((a, b) => a - b);
      return `${name}: ${ends.length > 1 ? `${ends.length} runs, ${number(ends[0], 2)} to ${number(ends.at(-1), 2)}` : number(ends[0], 2)}${this.unit}`;
    });
    this.picture.label(`How far the best of each run has got. ${said.join("; ")}. The list below has each run.`);
    this.picture.repaint();
  }

  mark(id, unit) {
    if (id === this.chosen && unit === this.unit) return;
    Object.assign(this, { chosen: id, unit });
    this.picture.repaint();
  }

  /** As far as three runs have got; of fewer there is none. */
  medianOf(runs) {
    const last = [...runs.map((run) => run.last)].sort((a, b) => b - a)[MEDIAN_OF - 1];
    if (last === undefined) return [];
    const count = Math.min(POINTS, last);
    return Array.from({ length: count + 1 }, (_, i) => Math.round((i * last) / Math.max(count, 1)))
      .map((at) => [at, runs.map((run) => bestAfter(run, at)).filter((best) => best !== undefined)])
      .filter(([, bests]) => bests.length >= MEDIAN_OF).map(([at, bests]) => [at, median(bests)]);
  }

  scale(width, height) {
    const all = [...this.runs.values()], most = Math.max(10, ...all.map(({ last }) => last)), base = height - AXIS;
    const axis = niceAxis(0, Math.max(0.1, ...all.flatMap(({ steps }) => steps.map(([, best]) => best))), 5);
    return { most, base, axis, x: (generation) => LEFT + (generation / most) * (width - LEFT - RIGHT),
             y: (value) => base - ((value - axis.lower) / (axis.upper - axis.lower)) * (base - TOP) };
  }

  paint(context, width, height) {
    const { most, base, axis, x, y } = this.scale(width, height);
    if (!this.runs.size) return writeLines(context, "No run has a generation yet.", width / 2, base / 2, width - LEFT - RIGHT, { align: "center", size: 14 });
    paintLevels(context, axis.ticks, { text: axis.text, unit: this.unit, y, width });
    paintGenerations(context, x, base + 12, most, width);
    const stairs = ({ last, steps }) => steps.flatMap(([at, best], i) => [[x(at), y(best)], [x(steps[i + 1]?.[0] ?? last), y(best)]]);
    context.globalAlpha = this.conditions.some(({ median: points }) => points.length) ? 0.35 : 0.8;
    for (const { runs, css, dash } of this.conditions) for (const run of runs) line(context, stairs(run), css, 1, dash);
    context.globalAlpha = 1;
    for (const { median: points, css, dash } of this.conditions) if (points.length) line(context, points.map(([at, best]) => [x(at), y(best)]), css, 2.6, dash);
    if (this.runs.has(this.chosen)) line(context, stairs(this.runs.get(this.chosen)), "--ink", 2);
    return undefined;
  }

  /** The run whose line is nearest above or below the pointer. */
  hit(offsetX, offsetY) {
    const { clientWidth, clientHeight } = this.picture.element, { most, x, y } = this.scale(clientWidth, clientHeight);
    const generation = Math.round(((offsetX - LEFT) / (clientWidth - LEFT - RIGHT)) * most);
    let nearest = null, least = NEAR_PX;
    for (const [id, run] of this.runs) {
      const best = bestAfter(run, generation), away = best === undefined ? Infinity : Math.hypot(y(best) - offsetY, x(generation) - offsetX);
      if (away < least) [nearest, least] = [id, away];
    }
    if (nearest !== null) this.choose(nearest);
  }

  key({ name, runs, css, dash }) {
    return lineKey(name + (runs.length >= MEDIAN_OF ? `, median of ${runs.length}` : ""), css, 2.6, dash);
  }
}
