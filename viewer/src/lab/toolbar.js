// Buttons of the lab, and its numbers.
import { number } from "../plot.js";
import { element } from "../theme.js";
import { button } from "../widgets.js";

const PUSH_S = 0.1, PUSH_M_S = 0.25; // a push gives the whole robot this speed

const byId = (id) => document.getElementById(id);

export class Toolbar {
  constructor(lab) {
    this.lab = lab;
    this.start = button("Start", () => lab.toggle(), { class: "primary" });
    this.again = button("Stop and begin anew", () => this.beginAnew());
    this.saveBest = button("Save the walker", () => lab.saveBest(), { title: "A champion’s file, which all commands of amble take" });
    this.saveRun = button("Save the run", () => lab.attempt(() => lab.saveRun()), { title: "A folder in one file: the lab opens it again, and amble resume goes on with it" });
    this.file = element("input", { type: "file", id: "file", class: "unseen", accept: ".json,.tar,application/json,application/x-tar", "aria-label": "Open a robot, a champion or a run", tabindex: "-1" });
    this.file.addEventListener("change", () => {
      if (this.file.files[0]) lab.openFile(this.file.files[0]);
      this.file.value = "";
    });
    this.open = button("Open a file", () => this.file.click(), { title: "A robot.json, a champion, or a run that was saved here; or drop it on the page" });
    byId("buttons").append(this.start, this.again, this.saveBest, this.saveRun, this.open, this.file);
    this.walk = button("Let it walk", () => this.toggleWalk());
    this.push = button("Push it", () => this.pushIt(), { title: "From its right side; or drag its body" });
    byId("views").append(this.walk, this.push);
    this.numbers = ["Generation", "Best so far", "Typically", "Median", "Species", "Pace"].map((name) => {
      const value = element("dd", {});
      byId("now").append(element("div", {}, element("dt", {}, name), value));
      return value;
    });
    this.interval = setInterval(() => this.showWalk(), 300);
    this.show();
  }

  beginAnew() {
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
    this.start.textContent = !evolution ? "Start" : state === "running" ? "Pause" : state === "ended" ? "It is over" : "Go on";
    this.start.disabled = ["ended", "broken"].includes(state);
    this.again.hidden = !evolution;
    this.saveBest.hidden = !lab.best;
    this.saveRun.hidden = !evolution || !progress;
    const bar = byId("progress");
    bar.max = evolution?.generations ?? 1;
    bar.value = evolution?.generation ?? 0;
    byId("now").hidden = !progress;
    if (progress) this.showNumbers(progress, evolution);
  }

  showNumbers(progress, evolution) {
    const metres = (value) => [number(value, 2), element("small", {}, " m")];
    const per_s = evolution?.rate ? [number(evolution.rate, evolution.rate < 10 ? 1 : 0), element("small", {}, " per second")] : ["–"];
    const all = [[`${progress.generation + 1}`, element("small", {}, ` of ${evolution?.generations ?? "–"}`)], metres(progress.best_so_far),
                 metres(progress.typical), metres(progress.median), progress.map ? [`${progress.map.length}`, element("small", {}, " cells")] : [`${progress.species.length}`], per_s];
    this.numbers.forEach((cell, i) => cell.replaceChildren(...all[i]));
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
