// A page whose walker is simulated in it. It is the page of the address that ends in #live, or #live=1 for the second.
import { LiveRobot, chooseModule, modulesOf } from "./amble.js";
import { inflateText } from "./data.js";
import { EvolvePanel } from "./evolve_panel.js";
import { LivePanel } from "./live_panel.js";
import { LiveWalk } from "./live_walk.js";
import { Drag } from "./drag.js";
import { Steer } from "./steer.js";
import { element } from "./theme.js";

/** Which walker the address asks for; null: the recordings. */
function askedLive(hash) {
  const match = /(?:^#|&)live(?:=(\d+))?/.exec(hash);
  return match ? Number(match[1] ?? 0) : null;
}

/** Whether a walker is told where to go: alone in its page it is there to be driven. */
const obeys = ({ champion, as_evolved, poses }) => Boolean(champion) && as_evolved && poses.columns.includes("command.speed");

/** Which walker a page opens with, simulated; null: with the recordings. */
export function openedLive(walkers, hash) {
  return hash === "" && walkers.length === 1 && obeys(walkers[0]) ? 0 : askedLive(hash);
}

/** The walk of a walker's champion, in its start pose. */
export async function liveWalk(json) {
  const { module } = await chooseModule(await modulesOf(document));
  const [champion, cppn_svg] = await Promise.all([json.champion, json.cppn_svg].map(inflateText));
  return new LiveWalk(await LiveRobot.open(module, champion), { ...json, cppn_svg });
}

/** What can be chosen where a champion came with the page: its recording, or itself. */
export function liveChoice(walkers, live) {
  const many = walkers.length > 1;
  const links = walkers.map(({ champion, title }, i) => ({ champion, title, i })).filter(({ champion }) => champion).map(({ title, i }) => {
    const link = element("a", { class: "live-link", href: `#live=${i}` }, live === i ? "Simulated live" : many ? `Drive ${title}` : "Drive it live");
    if (live === i) link.setAttribute("aria-current", "page");
    return link;
  });
  if (!links.length) return null;
  const back = element("a", { class: "live-link", href: "#recorded" }, "Recorded");
  if (live === null) back.setAttribute("aria-current", "page");
  return element("nav", { class: "live-choice", "aria-label": "Recorded or live" }, back, ...links);
}

/** Connects a page to its one walk that is simulated. */
export class Live {
  constructor(page, walk) {
    Object.assign(this, { page, walk, clock: page.clock });
    this.clock.more = (until_s) => {
      const reached_s = walk.advance(until_s);
      this.fitWindow(reached_s);
      if (walk.outcome === "diverged" || walk.full) this.clock.pause();
      return reached_s;
    };
    const { module, champion } = walk.live;
    this.evolve = new EvolvePanel({ module, champion, show: (text, generation) => this.showBest(text, generation) });
    this.told = element("p", { class: "unseen", role: "status" });
    document.getElementById("subtitle").after(this.told);
    if (walk.description.commands) this.steer = new Steer(this);
    this.panel = new LivePanel(document.getElementById("live"), this, "");
    this.drag = new Drag(page.stage, this);
    page.live = this;
    this.changed();
    setTimeout(() => this.compare(), 300);
  }

  /** Another champion of the robot, evolved here, walks from now on. */
  async showBest(text, generation) {
    this.walk.become(await LiveRobot.open(this.walk.live.module, text), JSON.parse(text).genome);
    this.steer?.forget();
    document.getElementById("title").textContent = `Evolved in this page, generation ${generation}`;
    this.clock.duration_s = 0;
    this.clock.seek(0);
    this.page.select(0);
    this.panel.read();
    this.changed();
    this.compare();
    this.clock.play();
  }

  /** Ground, gravity or body are others. */
  changed() {
    this.shownEra = null;
    this.showEra();
    this.page.invalidate();
  }

  /** The ground and the body that were at the time which is shown. */
  showEra() {
    const era = this.walk.eraAt(this.clock.time_s);
    if (era === this.shownEra) return;
    this.shownEra = era;
    this.walk.showEra(era);
    this.page.stage.renew(0);
  }

  /** Whether these are the native program's bits, by the trial in the champion's file. */
  compare() {
    const { recorded_steps: steps, evolved_in, engine } = this.walk.description;
    if (steps === 0) {
      this.panel.bits.textContent = evolved_in === engine
        ? "Arithmetic: exact, each product added with one rounding as in the native program. Its file has no trial to compare with."
        : `Evolved in the engine ${evolved_in}; here it walks in the engine ${engine}, with the native program’s bits.`;
      return;
    }
    const same = this.walk.live.stepsAsRecorded();
    this.panel.bits.textContent = same === steps
      ? `Exact: the champion’s own trial came out here with the native program’s bits in all ${steps} steps.`
      : `Other bits than the native program’s: its own trial is the same for ${same} of ${steps} steps.`;
  }

  /** Before each frame. */
  update() {
    this.drag?.update();
    this.steer?.update();
    this.fitWindow(this.clock.duration_s);
    this.showEra();
    this.panel.showLegs();
  }

  /** What diagrams can show reaches up to a time. */
  fitWindow(until_s) {
    const { window } = this.page;
    window.duration_s = Math.max(until_s, window.span_s);
  }

  /** Whether there is more to show than when last asked. */
  grew() {
    const before_s = this.shown_s;
    this.shown_s = this.clock.duration_s;
    return this.shown_s !== before_s;
  }

  /** Says how it is, to those who look and to those who listen, when that has changed. */
  tell() {
    const story = this.story(), shown = document.getElementById("subtitle");
    if (shown.textContent === story) return;
    shown.textContent = this.told.textContent = story;
  }

  story() {
    const { walk } = this;
    if (walk.outcome === "diverged") return "The simulation broke down: start again.";
    if (walk.full) return "Ten minutes are over: start again.";
    return walk.fallen ? "It has fallen." : "It is upright.";
  }
}
