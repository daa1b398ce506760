// The page as a whole: one clock, the stage, the diagrams, and what the user chooses.
import { Analysis } from "./analysis.js";
import { Clock } from "./clock.js";
import { choice, connectKeys, connectTransport, keyTable } from "./controls.js";
import { Overview } from "./overview.js";
import { TimeWindow, number } from "./plot.js";
import { CAMERAS, Stage } from "./scene.js";
import { element, onThemeChange } from "./theme.js";

const SPANS_S = [2, 5, 15, 60];
const LATE_PICTURES = 40; // in a row are too much for the machine
const FEW = 4; // walkers whose names stand in the picture, and whose stories fit above it
const FOLDED = 12; // more than so many are in a list that is closed at first
const TOLD_EVERY_MS = 100; // numbers and strips while it plays, and diagrams of what is simulated: who reads them needs no more
const FRAMES_KEPT = 2000; // of their times, for amble.frames()
const byId = (id) => document.getElementById(id);

export class Page {
  constructor(data, walks) {
    this.walks = walks;
    this.clock = new Clock(Math.max(...walks.map(({ seconds }) => seconds)));
    const narrow = innerWidth < 700;
    const span_s = narrow ? 2 : 5;
    this.window = new TimeWindow(walks[0].live ? span_s : this.clock.duration_s, span_s);
    this.selected = 0;
    this.layout = "side";
    this.camera = "follow";
    this.frames = [];
    this.head(data);
    byId("app").hidden = false;
    this.makeStage();
    this.analysis = new Analysis(byId("analysis"), walks, this.window, this.clock);
    this.overview = new Overview(byId("overview"), this.window, this.clock);
    this.showTransport = connectTransport(this.clock);
    this.makeViews();
    this.makeNow();
    connectKeys(this);
    this.clock.listen(() => this.invalidate());
    onThemeChange(() => this.repaint());
    new ResizeObserver(() => this.invalidate()).observe(byId("stage"));
    this.select(0);
    this.foot(data);
  }

  head({ title, walkers }) {
    const [{ live, title: name }] = this.walks;
    byId("title").textContent = live && walkers.length > 1 ? name : title;
    if (live) byId("kicker").textContent = "amble · live";
    if (this.walks.length <= FEW && !this.walks[0].live)
      byId("subtitle").textContent = this.walks.map((walk) => story(walk, this.walks.length > 1)).join(" ");
  }

  /** For many walkers a list above the picture, which folds; for few their names in it. */
  placeWalkers(choiceElement) {
    if (this.walks.length <= FEW) return byId("who").append(choiceElement);
    const list = element("details", { class: "walker-list" }, element("summary", {}, `${this.walks.length} walkers`), choiceElement);
    list.open = this.walks.length <= FOLDED;
    byId("stage").before(list);
  }

  foot({ made_by }) {
    const origins = [...new Set(this.walks.map(({ origin }) => origin))].join(", ");
    document.body.append(element("footer", {},
      keyTable(this.walks), element("p", {}, `${this.walks[0].live ? "Simulated in this page, after" : "Recorded from"} ${origins}. Made by ${made_by}.`)));
  }

  makeStage() {
    this.stage = new Stage(byId("stage"), this.walks, () => this.invalidate());
  }

  makeViews() {
    const many = this.walks.length > 1;
    this.cameraChoice = choice("Camera", CAMERAS.map((mode) => [mode, mode]), this.camera, (mode) => this.setCamera(mode));
    byId("views").append(this.cameraChoice.element);
    if (many) {
      this.layoutChoice = choice("Arrangement", [["side", "side by side"], ["ghosts", "ghosts"]], this.layout,
                                 (layout) => this.setLayout(layout));
      byId("views").append(this.layoutChoice.element);
      this.walkerChoice = choice("Walker of the diagrams", this.walks.map(({ title }, i) => [i, title]), 0,
                                 (i) => this.select(Number(i)));
      this.walkerChoice.element.classList.add("walkers");
      [...this.walkerChoice.element.children].forEach((button, i) => button.classList.add(`walker${i % 4}`));
      this.placeWalkers(this.walkerChoice.element);
    }
    const live = Boolean(this.walks[0].live);
    const spans = SPANS_S.filter((span) => live || span < this.clock.duration_s).map((span) => [span, `${span} s`]);
    if (spans.length) {
      if (!live) spans.push([this.clock.duration_s, "all"]);
      this.spanChoice = choice("Time shown in the diagrams", spans, this.window.span_s, (span) => this.setSpan(span));
      this.spanChoice.element.classList.add("spans");
    }
  }

  makeNow() {
    const fields = [["Time", "s", 2, (_, t) => t], ["Distance", "m", 2, (walk, t) => walk.distance(t)],
                    ["Speed", "m/s", 2, (walk, t) => walk.speed(t)], ["Height", "m", 2, (walk, t) => walk.height(t)]];
    this.now = fields.map(([label, unit, decimals, value]) => {
      const text = document.createTextNode("");
      byId("now").append(element("div", {}, element("dt", {}, label),
                                 element("dd", {}, text, element("small", {}, ` ${unit}`))));
      return () => (text.data = number(value(this.walks[this.selected], this.clock.time_s), decimals));
    });
  }

  select(i) {
    if (i >= this.walks.length) return;
    this.selected = i;
    this.stage.arrange(this.layout === "side", i);
    this.walkerChoice?.choose(i);
    if (this.walks.length > FEW) byId("subtitle").textContent = story(this.walks[i], true);
    this.analysis.select(i);
    if (this.spanChoice) byId("analysis").prepend(element("div", { class: "span-row" }, "Show ", this.spanChoice.element));
    this.overview.setWalk(this.walks[i]);
    this.invalidate();
  }
  setSpan(span_s) {
    if (this.live) this.window.duration_s = Math.max(this.clock.duration_s, span_s);
    this.window.setSpan(Number(span_s));
    this.spanChoice.choose(span_s);
    this.invalidate();
  }
  setCamera(mode) {
    this.camera = mode;
    this.stage.setMode(mode);
    this.cameraChoice.choose(mode);
  }
  setLayout(layout) {
    if (this.walks.length === 1) return;
    this.layout = layout;
    this.layoutChoice.choose(layout);
    this.stage.arrange(layout === "side", this.selected);
    this.resetCamera();
  }
  resetCamera() {
    this.stage.resetCamera();
    this.invalidate();
  }

  repaint() {
    this.stage.paint();
    this.overview.repaint();
    this.analysis.repaint();
    this.live?.evolve.paint();
    this.show();
    if (matchMedia("print").matches) this.stage.copyToPaper();
  }

  /** Asks for a frame; many changes before it make one. */
  invalidate() {
    if (this.showing || this.asked) return;
    this.asked = true;
    requestAnimationFrame((now_ms) => this.frame(now_ms));
  }

  frame(now_ms) {
    this.asked = false;
    if (this.clock.playing && this.stage.rests(now_ms)) return this.invalidate();
    this.live?.update();
    if (this.clock.playing && this.last_ms !== undefined) {
      const passed_s = (now_ms - this.last_ms) / 1000;
      this.clock.advance(Math.min(passed_s, 0.25));
      this.stage.keepUp(passed_s, LATE_PICTURES);
    }
    this.last_ms = this.clock.playing ? now_ms : undefined;
    this.show(this.clock.playing || this.stage.slow);
    if (this.clock.playing) this.invalidate();
    else this.stage.afterRest(() => this.clock.playing || this.show());
  }

  /** Brings everything to the clock's time, at once; `moves`: others follow. */
  show(moves = false) {
    this.showing = true; // what moves the camera here asks for no other frame
    const start_ms = performance.now();
    this.stage.resize();
    this.stage.show(this.clock.time_s, moves);
    if (!moves || !this.clock.playing || !(start_ms - this.told_ms < TOLD_EVERY_MS)) this.tell(start_ms);
    else if (!this.live && !this.stage.slow) this.analysis.show(); // cursors glide
    this.frames.push(performance.now() - start_ms);
    if (this.frames.length > FRAMES_KEPT) this.frames.shift();
    this.showing = false;
  }

  /** All but the picture. */
  tell(now_ms) {
    this.told_ms = now_ms;
    if (this.live?.grew()) {
      this.analysis.repaint();
      this.overview.repaint();
    }
    this.analysis.show();
    this.overview.show();
    this.showTransport();
    for (const update of this.now) update();
    this.live?.tell();
  }
}

const sentence = (text) => text.charAt(0).toUpperCase() + text.slice(1);

/** What a walker typically does, where that is known, and what became of the walk that is shown. */
function story(walk, named) {
  const distance = `${number(walk.distance(walk.seconds), 2)} m`, time = `${number(walk.seconds, 2)} s`;
  const who = (named ? `${walk.title}: ` : "") + (walk.typical ? `${named ? walk.typical : sentence(walk.typical)}. Shown is ${walk.shown}: ` : "");
  if (walk.seconds === 0) return `${who}no step was recorded; this is the start pose.`;
  if (walk.outcome === "fell") return `${who}${distance}, then it fell after ${time}.`;
  if (walk.outcome === "diverged") return `${who}${distance}; the simulation broke down after ${time}.`;
  return `${who}${distance} in ${time}.`;
}
