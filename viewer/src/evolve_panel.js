// Evolution in the page: what is chosen, the curve of what came out, and its best.
import { niceAxis, number } from "./plot.js";
import { colour, element } from "./theme.js";
import { askBeforeLeaving } from "./unsaved.js";
import { button, group, row, slider } from "./widgets.js";

const HEIGHT = 170, LEFT = 40, RIGHT = 8, BELOW = 22, BANDS = 34;
const MOST_SHOWN = 600; // generations

/** Bundled as text by build.mjs. */
const startWorker = () => new Worker(URL.createObjectURL(new Blob([AMBLE_EVOLVE_WORKER], { type: "text/javascript" })));

export class EvolvePanel {
  /** `live`: {module, champion: a file's text, show(champion's text)}. */
  constructor(live) {
    Object.assign(this, { live, history: [], stride: 1, best: null, worker: null, running: false, frame: null });
    this.population = slider(20, 300, 10, 100);
    this.seconds = slider(2, 20, 1, 8);
    this.nodes = slider(0, 0.3, 0.01, 0.05);
    this.feels = element("input", { type: "checkbox", checked: "" });
    this.seed = element("input", { type: "number", min: 0, max: 999999, step: 1, value: 1 });
    this.rows = [
      row("Population", this.population, () => this.population.value), row("Length of a trial", this.seconds, () => `${this.seconds.value} s`),
      row("Mutations that add a node", this.nodes, () => `${number(100 * this.nodes.value, 0)} %`),
      row("Feels its feet", this.feels, () => ""), row("Seed", this.seed, () => ""),
    ];
    this.start = button("Evolve", () => this.toggle());
    this.again = button("From nothing again", () => (!this.unsaved || confirm("The best of this run is not saved. Begin from nothing?")) && this.stop());
    this.show = button("Show the best", () => this.live.show(this.best.text, this.best.generation));
    this.save = button("Save the best", () => this.saveBest(), { title: "A champion's file, which all commands of amble take" });
    this.status = element("p", { class: "lead", role: "status" });
    this.canvas = element("canvas", { class: "evolve-curve", role: "img", "aria-label": "Best and median by generation, and the sizes of species" });
    this.element = group("Evolve it anew",
      element("p", { class: "lead" }, "From random networks, by NEAT, on the ground of its file: a controller that walks, in this page. The same settings give the same walkers, to the bit."),
      ...this.rows.map(({ label }) => label), element("div", { class: "live-buttons" }, this.start, this.again, this.show, this.save), this.status, this.canvas);
    for (const { label, show } of this.rows) {
      label.addEventListener("input", show);
      show();
    }
    new ResizeObserver(() => this.paint()).observe(this.canvas);
    askBeforeLeaving(() => this.unsaved);
    this.refresh();
  }

  get unsaved() {
    return this.best !== null && this.best !== this.saved;
  }

  settings() {
    return { seed: Math.max(0, Math.round(Number(this.seed.value))) || 0, population: Number(this.population.value), seconds: Number(this.seconds.value),
             add_node_share: Number(this.nodes.value), add_link_share: 0.15, feels_its_feet: this.feels.checked };
  }

  toggle() {
    this.running = !this.running;
    if (this.worker) this.worker.postMessage({ running: this.running });
    else this.begin();
    this.refresh();
  }

  begin() {
    this.worker = startWorker();
    this.worker.onmessage = ({ data }) => this.take(data);
    this.worker.onerror = (event) => this.take({ error: event.message });
    this.began_ms = performance.now();
    this.worker.postMessage({ module: this.live.module, champion: this.live.champion, settings: this.settings() });
  }

  stop() {
    this.worker?.terminate();
    Object.assign(this, { worker: null, running: false, history: [], stride: 1, best: null });
    this.refresh();
  }

  take({ progress, best, error }) {
    if (error) {
      this.stop();
      this.status.textContent = `Evolution ended: ${error}`;
      return;
    }
    // A run has no end, its curve has: of generations every other, every fourth, … stays, and the last.
    const stays = ({ generation }) => generation % this.stride === 0;
    if (this.history.length && !stays(this.history.at(-1))) this.history.pop();
    if (this.history.length >= 2 * MOST_SHOWN) {
      this.stride *= 2;
      this.history = this.history.filter(stays);
    }
    this.history.push(progress);
    if (best) this.best = { text: best, generation: progress.best_generation };
    // Small populations have several generations a frame, and what cannot be seen is not drawn.
    this.frame ??= requestAnimationFrame(() => {
      this.frame = null;
      this.refresh();
    });
  }

  saveBest() {
    const link = element("a", { href: URL.createObjectURL(new Blob([this.best.text], { type: "application/json" })), download: "champion.json" });
    link.click();
    setTimeout(() => URL.revokeObjectURL(link.href), 1000);
    this.saved = this.best;
  }

  refresh() {
    this.start.textContent = this.running ? "Pause" : this.worker ? "Go on" : "Evolve";
    for (const { label } of this.rows) label.querySelector("input").disabled = this.worker !== null;
    this.again.hidden = this.worker === null;
    this.show.hidden = this.save.hidden = this.best === null;
    const now = this.history.at(-1), scored = (value) => number(value, 2) + now.unit;
    this.canvas.hidden = !now;
    this.status.textContent = now
      ? `Generation ${now.generation}: best ${scored(now.best)}, median ${scored(now.median)}; ${now.fell} fell; ${now.species.length} species. ` +
        `Best so far ${scored(now.best_so_far)}, of generation ${now.best_generation}.`
      : this.running ? "The first generation walks." : "";
    this.paint();
  }

  paint() {
    const { history, canvas } = this, width = canvas.clientWidth;
    if (!history.length || width === 0) return;
    canvas.width = Math.round(width * devicePixelRatio);
    canvas.height = Math.round(HEIGHT * devicePixelRatio);
    const paint = canvas.getContext("2d");
    paint.scale(devicePixelRatio, devicePixelRatio);
    const most = Math.max(10, history.at(-1).generation), base = HEIGHT - BELOW - BANDS - 6;
    const x = (generation) => LEFT + (generation / most) * (width - LEFT - RIGHT);
    const { lower, upper, ticks, text } = niceAxis(Math.min(0, ...history.map(({ median }) => median)), Math.max(0.1, history.at(-1).best_so_far), 4);
    const y = (value) => base - ((value - lower) / (upper - lower)) * (base - 10);
    paint.font = `11.5px ${colour("--sans")}`;
    paint.textBaseline = "middle";
    for (const tick of ticks) {
      paint.fillStyle = colour("--hair");
      paint.fillRect(LEFT, y(tick), width - LEFT - RIGHT, 1);
      paint.fillStyle = colour("--soft");
      paint.textAlign = "right";
      paint.fillText(text(tick), LEFT - 6, y(tick));
    }
    const curve = (value, css, thick) => {
      paint.beginPath();
      for (const row of history) paint.lineTo(x(row.generation), y(value(row)));
      paint.strokeStyle = colour(css);
      paint.lineWidth = thick;
      paint.stroke();
    };
    curve(({ median }) => median, "--soft", 1.2);
    curve(({ best }) => best, "--c1", 1.2);
    curve(({ best_so_far }) => best_so_far, "--ink", 2.2);
    this.paintSpecies(paint, x, base + 8);
    paint.fillStyle = colour("--soft");
    paint.textAlign = "left";
    paint.fillText("generation 0", LEFT, HEIGHT - 8);
    paint.textAlign = "right";
    paint.fillText(String(most), width - RIGHT, HEIGHT - 8);
  }

  /** Stacked: each species as a band, as high as it has members. */
  paintSpecies(paint, x, top) {
    const colours = Array.from({ length: 8 }, (_, i) => colour(`--c${i}`));
    this.history.forEach(({ species, generation }, i) => {
      const all = species.reduce((sum, [, size]) => sum + size, 0);
      const from = x(this.history[i - 1]?.generation ?? generation);
      let at = top;
      for (const [id, size] of species) {
        const high = (size / all) * BANDS;
        paint.fillStyle = colours[id % 8];
        paint.globalAlpha = 0.75;
        paint.fillRect(from, at, Math.max(1, x(generation) - from + 0.5), high);
        at += high;
      }
    });
    paint.globalAlpha = 1;
  }
}
