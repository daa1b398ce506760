// What is shown of runs that go on elsewhere: the chosen one's curve, species, map and best walker, and a list of all.
import { number } from "../plot.js";
import { element, onThemeChange } from "../theme.js";
import { button } from "../widgets.js";
import { Curve } from "../lab/curve.js";
import { Footfalls } from "../lab/footfalls.js";
import { Inside } from "../lab/inside.js";
import { LabStage } from "../lab/stage.js";
import { AllCurves } from "./all_curves.js";
import { MapPicture } from "./map_picture.js";
import { clockText, rowReader, thinned } from "./rows.js";
import { RunList } from "./run_list.js";
import { Stream } from "./stream.js";

const SAY_EVERY_MS = 20_000; // to screen readers
const byId = (id) => document.getElementById(id);
const askedRun = () => decodeURIComponent(/(?:^#|&)run=([^&]*)/.exec(location.hash)?.[1] ?? "") || null;

export class Watch {
  constructor(module, { still }) {
    Object.assign(this, { still, runs: new Map(), folder: {}, rows: [], chosen: null, elite: null, endText: null, lostText: null });
    this.curve = new Curve({ hint: "Each generation adds a point." });
    this.map = new MapPicture((cell) => this.showElite(cell));
    this.list = new RunList((id) => this.choose(id));
    this.all = new AllCurves((id) => this.choose(id));
    byId("curves").append(this.curve.element);
    byId("cells").append(this.map.element);
    byId("run-list").append(this.list.element);
    byId("all-curves").append(this.all.element);
    this.numbers = ["Generation", "Best so far", "Typically", "Median", "Species", "Left"].map((name) => {
      const term = element("dt", {}, name), value = element("dd", {}, "–");
      byId("now").append(element("div", {}, term, value));
      return { term, value };
    });
    this.stage = new LabStage(module, byId("stage"), {
      now: (walk, time_s) => this.showStory(time_s), shown: (walk) => this.showWalker(walk),
      trouble: (error) => this.complain(error.message),
    });
    this.footfalls = new Footfalls(byId("footfalls"), this.stage.clock);
    this.inside = new Inside(byId("inside"));
    this.walk = button("Let it walk", () => (this.stage.clock.playing ? this.stage.clock.pause() : this.stage.clock.play()), { hidden: "" });
    this.best = button("The best again", () => this.showBest(), { hidden: "" });
    byId("views").append(this.walk, this.best);
    this.stage.clock.listen(() => this.showWalk());
    onThemeChange(() => this.repaint());
    const hear = ["folder", "runs", "begin", "rows", "population", "end"].map((name) => [name, (data) => this[`take_${name}`](data)]);
    this.stream = new Stream({ ...Object.fromEntries(hear), connected: () => this.setLost(null), lost: (text) => this.setLost(text) });
    addEventListener("hashchange", () => this.choose(askedRun()));
  }

  begin() {
    this.stream.open(askedRun() ?? ".");
    this.chosen = askedRun() ?? ".";
    this.refresh();
  }

  /** Shows another run; the curve of the one before stays as a line. */
  choose(id) {
    if (!id || id === this.chosen) return;
    if (this.stream.over) return this.complain("The program that served this page has ended, so no other run can be shown: amble view FOLDER --live shows it.");
    Object.assign(this, { chosen: id, rows: [], sizes: null, shownChampion: undefined });
    this.forgetElite();
    this.forgetWalker();
    location.hash = `run=${encodeURIComponent(id)}`;
    byId("map").hidden = true;
    this.stream.open(id);
    this.refresh();
  }

  // What the server says.

  take_folder(folder) {
    this.folder = folder;
    this.refresh();
  }

  take_runs({ runs }) {
    for (const run of runs) this.runs.set(run.id, run);
    if (!this.runs.has(this.chosen) && this.runs.size) {
      const all = [...this.runs.values()];
      this.choose((all.find(({ stage }) => stage === "running") ?? all[0]).id);
    }
    this.refresh();
    this.showChampion();
  }

  take_begin({ header }) {
    const run = this.runs.get(this.chosen);
    this.read = rowReader(header);
    Object.assign(this, { rows: [], sizes: null });
    this.curve.unit = run?.unit ?? " m";
    this.curve.begin(this.chosen === "." ? (run?.name ?? "") : this.chosen, false);
  }

  take_rows({ lines }) {
    for (const line of lines) {
      const row = this.read(line);
      if (this.sizes && row.generation >= this.sizes.generation) row.species = this.sizes.species;
      this.rows.push(row);
    }
    this.curve.history = thinned(this.rows);
    this.curve.show();
    this.refresh();
  }

  take_population({ generation, species, map }) {
    if (species) this.sizes = { generation, species };
    byId("map").hidden = !map;
    if (map) byId("map-note").textContent = this.map.show(map, this.unit());
  }

  take_end({ text }) {
    this.endText = text;
    this.refresh();
  }

  setLost(text) {
    this.lostText = text;
    this.refresh();
  }

  // What is shown.

  unit() {
    return this.runs.get(this.chosen)?.unit ?? " m";
  }

  /** Lets the latest champion walk, when the one before has walked. */
  async showChampion() {
    const run = this.runs.get(this.chosen);
    if (!run || run.champion === null || run.champion === this.shownChampion || this.elite !== null) return;
    const { id, champion } = run, first = this.shownChampion === undefined;
    this.shownChampion = champion;
    try {
      const answer = await fetch(`champion?run=${encodeURIComponent(id)}&generation=${champion}`);
      if (!answer.ok) throw new Error(await answer.text());
      const text = await answer.text();
      if (id !== this.chosen || champion !== this.shownChampion || this.elite !== null) return;
      await this.stage.show(text, `Best of generation ${champion}`, { soon: first });
      if (id !== this.chosen) return;
      if (first && !this.still) this.stage.clock.play();
      this.walk.hidden = false;
    } catch (error) {
      if (!this.lostText && this.runs.get(id).stage !== "gone") this.complain(`The best walker cannot be shown: ${error.message}`);
    }
  }

  /** Lets the elite of a cell of the map walk, until the best is asked for again. */
  async showElite(cell) {
    const id = this.chosen;
    this.elite = cell;
    this.map.mark(cell);
    byId("trouble").hidden = true;
    try {
      const answer = await fetch(`champion?run=${encodeURIComponent(id)}&cell=${cell}`);
      if (!answer.ok) throw new Error(await answer.text());
      const text = await answer.text();
      if (id !== this.chosen || cell !== this.elite) return;
      await this.stage.show(text, `Cell ${cell} of the map`);
      if (id !== this.chosen || cell !== this.elite) return;
      this.stage.clock.play();
      this.walk.hidden = this.best.hidden = false;
    } catch (error) {
      if (!this.lostText && cell === this.elite) this.complain(`The walker of cell ${cell} cannot be shown: ${error.message}`);
    }
  }
  showBest() {
    this.forgetElite();
    this.shownChampion = undefined;
    this.showChampion();
  }
  forgetElite() {
    this.elite = null;
    this.best.hidden = true;
    this.map.mark(null);
  }

  refresh() {
    const run = this.runs.get(this.chosen), many = this.folder.single === false;
    byId("folder").textContent = `amble · live · ${this.folder.folder ?? ""}`;
    byId("name").textContent = run ? `${run.name || run.id}, seed ${run.seed}` : "Watch runs";
    document.title = run ? `${run.done}/${run.generations} ${run.name} · amble` : "amble: watch runs";
    const text = this.story(run);
    if (byId("stage-text").textContent !== text) byId("stage-text").textContent = text;
    byId("progress").max = Math.max(run?.generations ?? 1, 1);
    byId("progress").value = run?.done ?? 0;
    if (run) this.showNumbers(run);
    byId("runs").hidden = !many;
    if (many) this.showRuns();
  }

  /** What the chosen run does, in a sentence. */
  story(run) {
    if (this.lostText) return `${this.lostText} What is shown is what was known before.`;
    if (this.endText) return this.endText;
    if (this.folder.gone) return `${this.folder.folder} has vanished: moved away or removed. What is shown is what was known before.`;
    if (!run) return this.folder.folder ? "No run is here yet." : "";
    if (run.trouble) return run.trouble;
    const at = `generation ${run.done} of ${run.generations}`;
    return {
      waiting: "The run has not begun yet.",
      running: `It runs: ${at}${run.left_s === null ? "" : `, about ${clockText(run.left_s)} left`}.`,
      stopped: `Stopped at ${at}: amble resume goes on with it.`,
      ended: `The run has ended: all ${run.generations} generations are done.`,
      gone: "Its folder has vanished: moved away or removed. What is shown is what was known before.",
    }[run.stage];
  }

  showNumbers(run) {
    const small = (text) => element("small", {}, text), value = (x) => (x === null ? ["–"] : [number(x, 2), small(run.unit)]);
    const last = this.rows.at(-1), isMap = run.search === "map-elites";
    const kinds = isMap ? last?.elites : last?.count;
    const all = [[`${run.done}`, small(` of ${run.generations || "–"}`)], value(run.best), value(run.typical), value(run.median),
                 [kinds >= 0 ? `${kinds}` : "–"], [run.left_s === null ? "–" : clockText(run.left_s)]];
    this.numbers[4].term.textContent = isMap ? "Cells filled" : "Species";
    this.numbers.forEach((cell, i) => cell.value.replaceChildren(...all[i]));
    const now = performance.now();
    if (now - (this.said_ms ?? -Infinity) < SAY_EVERY_MS) return;
    this.said_ms = now;
    byId("said").textContent = `Generation ${run.done} of ${run.generations}, best ${run.best === null ? "none" : number(run.best, 2) + run.unit}.`;
  }

  showRuns() {
    const all = [...this.runs.values()], count = (stage) => all.filter((run) => run.stage === stage).length;
    const { planned, recorded } = this.folder;
    const study = recorded === null ? "" : ` ${recorded}${planned === null ? "" : ` of ${planned}`} are in the study’s ledger.`;
    const parts = [[count("running"), "going on"], [count("ended"), "ended"], [count("stopped"), "stopped"], [count("gone"), "vanished"]];
    byId("runs-note").textContent = `${all.length} runs: ${parts.filter(([n]) => n).map(([n, what]) => `${n} ${what}`).join(", ") || "none begun"}.${study}${all.length > 1 ? " A run is chosen by its line or its name." : ""}`;
    this.list.show(all, this.chosen);
    this.all.mark(this.chosen, this.unit());
    this.all.begin();
  }

  /** What is in the picture is of another run. */
  forgetWalker() {
    this.stage.forget();
    byId("trouble").hidden = true;
    this.walk.hidden = document.querySelector(".footfalls").hidden = byId("inside").hidden = true;
    byId("story").textContent = "";
    this.curve.begin(this.chosen, true);
  }

  showWalker(walk) {
    document.querySelector(".footfalls").hidden = false;
    this.footfalls.begin(walk);
    this.inside.begin(walk, this.stage.text);
    this.showWalk();
  }
  showStory(time_s) {
    this.footfalls.show();
    this.inside.show(time_s);
    const text = this.stage.story(time_s);
    if (byId("story").textContent !== text) byId("story").textContent = text;
  }
  showWalk() {
    const text = this.stage.clock.playing ? "Stand still" : "Let it walk";
    if (this.walk && this.walk.textContent !== text) this.walk.textContent = text;
  }

  render() {
    this.stage.draw();
  }
  repaint() {
    this.stage.paint();
    this.footfalls.repaint();
    this.curve.picture.repaint();
    this.map.picture.repaint();
    this.all.picture.repaint();
  }
  complain(text) {
    byId("trouble").hidden = false;
    byId("trouble").textContent = text;
  }
}
