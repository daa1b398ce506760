// Buttons of the lab, and its numbers.
import { number } from "../plot.js";
import { element } from "../theme.js";
import { button } from "../widgets.js";
import { mapBins } from "./plan.js";

const TRIALS = 16; // of what the best typically does: src/experiment/plan/typical_level.hpp
const PUSH_S = 0.1, PUSH_M_S = 0.25; // a push gives the whole robot this speed

const NUMBERS = ["Generations", "Best so far", "Best, typically", "Median of all", "Species", "Generations/s"];

/** What "typically" stands for, and who falls. */
function typicallyMeans({ typical, typical_fell: fell }) {
  if (!Number.isFinite(typical)) return "";
  const falls = Number.isFinite(fell) ? ` ${Math.round(fell * TRIALS)} of these end in a fall.` : "";
  return `Typically: the middle of ${TRIALS} new trials of the best, each a little different.${falls}`;
}

const byId = (id) => document.getElementById(id);

export class Toolbar {
  constructor(lab) {
    this.lab = lab;
    this.start = button("Start", () => lab.toggle(), { class: "primary" });
    this.again = button("Stop and begin anew", () => this.beginAnew());
    this.bestAgain = button("The best again", () => lab.attempt(() => lab.showBest()), { title: "In place of the walker of a cell" });
    this.saveBest = button("Save the walker", () => lab.files.saveBest(), { title: "A champion’s file, which all commands of amble take" });
    this.saveRun = button("Save the run", () => lab.attempt(() => lab.files.saveRun()), { title: "A folder in one file: the lab opens it again, and amble resume goes on with it" });
    this.file = element("input", { type: "file", id: "file", class: "unseen", accept: ".json,.tar,application/json,application/x-tar", "aria-label": "Open a robot, a champion or a run", tabindex: "-1" });
    this.file.addEventListener("change", () => {
      if (this.file.files[0]) lab.files.open(this.file.files[0]);
      this.file.value = "";
    });
    this.open = button("Open a file", () => this.file.click(), { title: "A robot.json, a champion, or a run that was saved here; or drop it on the page" });
    byId("buttons").append(this.start, this.again, this.bestAgain, this.saveBest, this.saveRun, this.open, this.file);
    this.walk = button("Let it walk", () => this.toggleWalk());
    this.push = button("Push it", () => this.pushIt(), { title: "From its right side; or drag its body" });
    byId("views").append(this.walk, this.push);
    this.numbers = NUMBERS.map((name) => {
      const value = element("dd", {});
      const label = element("dt", {}, name);
      byId("now").append(element("div", {}, label, value));
      return { label, value };
    });
    this.interval = setInterval(() => this.showWalk(), 300);
    this.show();
  }

  beginAnew() {
    if (!this.lab.mayLeave()) return;
    this.lab.anew();
    this.lab.attempt(() => this.lab.preview());
    this.start.focus();
  }

  busy(text) {
    this.start.textContent = text;
    this.start.disabled = true;
  }

  show() {
    const { lab } = this, { evolution, progress } = lab, state = evolution?.state;
    this.start.textContent = !evolution ? "Start" : state === "running" ? "Pause" : state === "ended" ? `${lab.more_generations} more generations` : "Go on";
    this.start.disabled = state === "broken";
    this.again.hidden = !evolution;
    this.bestAgain.hidden = !lab.elite || !lab.newest;
    this.saveBest.hidden = !lab.best;
    this.saveRun.hidden = !evolution || !progress;
    lab.form.sayWorld(state);
    const bar = byId("progress");
    bar.max = evolution?.generations ?? 1;
    bar.value = evolution?.generation ?? 0;
    byId("now").hidden = !progress;
    byId("typically").textContent = progress ? typicallyMeans(progress) : "";
    if (progress) this.showNumbers(progress, evolution);
  }

  showNumbers(progress, evolution) {
    const scored = (value) => [number(value, 2), element("small", {}, progress.unit)];
    const { rate } = evolution ?? {}, { map } = progress, of = (total) => element("small", {}, ` of ${total}`);
    const kinds = map ? [`${map.length}`, of(mapBins ** 2)] : [`${progress.count ?? progress.species.length}`];
    const all = [[`${progress.generation + 1}`, of(evolution?.generations ?? "–")], scored(progress.best_so_far), scored(progress.typical),
                 scored(progress.median), kinds, [rate ? number(rate, rate < 10 ? 1 : 0) : "–"]];
    this.numbers.forEach(({ value }, i) => value.replaceChildren(...all[i]));
    this.numbers[NUMBERS.indexOf("Species")].label.textContent = map ? "Cells filled" : "Species";
  }

  toggleWalk() {
    const { clock } = this.lab.stage;
    if (clock.playing) clock.pause();
    else clock.play();
    this.showWalk();
  }
  showWalk() {
    const text = this.lab.stage.clock.playing ? "Stand still" : "Let it walk";
    if (this.walk.textContent !== text) this.walk.textContent = text;
  }

  pushIt() {
    const { walk, clock } = this.lab.stage;
    if (!walk) return;
    const force = (walk.description.mass_kg * PUSH_M_S) / PUSH_S;
    walk.kick = { force_n: [0, force, 0], until_s: walk.seconds + PUSH_S };
    clock.play();
  }
}
