// The best walker, walking in the 3-D picture; when its time is over it begins again, or gives way to a better one.
import { LiveRobot } from "../amble.js";
import { Clock } from "../clock.js";
import { Drag } from "../drag.js";
import { LiveWalk } from "../live_walk.js";
import { number } from "../plot.js";
import { Stage } from "../scene.js";

const PAUSE_S = 0.6; // after a walk, before the next
const LEAST_MS = 2500; // of a walk, before a better one takes its place
const LATE_PICTURES = 20; // in a row are too much for the machine

export class LabStage {
  /** `parent`: where the picture goes; `now(text)`: what it does, for those who look; `shown(walk)`: another walker. */
  constructor(module, parent, hear) {
    Object.assign(this, { module, parent, hear, next: null });
    this.clock = new Clock(0);
    this.clock.listen(() => this.invalidate());
    new ResizeObserver(() => this.invalidate()).observe(parent);
  }

  /** Lets a champion's file walk: at once, or when the walk of now is over. */
  async show(text, title, { soon = true } = {}) {
    this.next = { text, title };
    if (soon || !this.walk || !this.clock.playing) await this.takeNext();
  }

  /** Until another champion comes there is none. */
  forget() {
    this.drag?.remove();
    this.stage?.remove();
    Object.assign(this, { walk: null, next: null, opening: null });
  }

  async takeNext() {
    const { text, title } = this.next, opening = (this.opening = {});
    this.next = null;
    this.over_s = 0;
    const live = await LiveRobot.open(this.module, text);
    if (opening !== this.opening) return; // another, or none, is wanted by now
    const { robot: { name, joints }, columns } = live.describe();
    const same = this.walk && name === this.robotName && columns.join() === this.walk.description.columns.join();
    if (same) this.walk.become(live);
    else this.begin(live, title);
    Object.assign(this, { title, robotName: name, joints: joints.length, text, elsewhere: false });
    this.again();
    this.hear.shown(this.walk);
  }

  begin(live, title) {
    this.walk = new LiveWalk(live, { title, origin: "", cppn_svg: null });
    this.drag?.remove();
    this.stage?.remove();
    this.stage = new Stage(this.parent, [this.walk], () => this.invalidate());
    this.drag = new Drag(this.stage, this);
    this.clock.more = (until_s) => {
      const reached_s = this.walk.advance(Math.min(until_s, this.duration_s));
      return this.walk.outcome === "diverged" ? this.duration_s : reached_s;
    };
  }

  /** What walks begins again on another ground or with another body: {ground, damage}, as in a config. Rejects with a message. */
  async put({ ground, damage }) {
    const { live, description } = this.walk, known = Object.keys(description.ground);
    await live.setGround({ ...description.ground, ...Object.fromEntries(Object.entries(ground).filter(([key]) => known.includes(key))) });
    await live.setDamage(damage);
    this.elsewhere = true;
    this.walk.renew();
    this.again();
    this.clock.play();
  }

  /** From its start, if it may move. */
  again() {
    if (this.walk.seconds > 0 || this.elsewhere) this.walk.restart({ asEvolved: !this.elsewhere });
    this.duration_s = this.walk.description.duration_s;
    this.over_s = 0;
    this.began_ms = performance.now();
    this.clock.duration_s = 0;
    this.clock.seek(0);
    this.stage.renew(0);
    this.stage.resetCamera();
    this.invalidate();
  }

  invalidate() {
    if (this.asked || this.showing || !this.walk) return;
    this.asked = true;
    requestAnimationFrame((now_ms) => this.frame(now_ms));
  }

  frame(now_ms) {
    this.asked = false;
    if (!this.walk) return; // forgotten since
    if (this.clock.playing && this.stage.rests(now_ms)) return this.invalidate();
    this.drag.update();
    const passed_s = this.clock.playing && this.last_ms !== undefined ? Math.min((now_ms - this.last_ms) / 1000, 0.1) : 0;
    this.last_ms = this.clock.playing ? now_ms : undefined;
    this.stage.keepUp(passed_s, LATE_PICTURES);
    if (passed_s > 0) this.move(passed_s);
    this.draw(this.clock.playing || this.stage.slow);
    if (this.clock.playing) this.invalidate();
    else this.stage.afterRest(() => this.clock.playing || this.draw());
  }

  /** Now, without waiting for the browser's next frame; `moves`: other pictures follow. */
  draw(moves = false) {
    if (!this.walk) return; // nothing has walked yet
    const time_s = Math.min(this.clock.time_s, this.walk.seconds);
    this.showing = true; // what moves the camera here asks for no other frame
    this.stage.resize();
    this.stage.show(time_s, moves);
    this.hear.now(this.walk, time_s);
    this.showing = false;
  }

  move(passed_s) {
    if (this.next && performance.now() - this.began_ms > LEAST_MS && !this.drag.held) return this.takeNext().catch((error) => this.hear.trouble(error));
    if (this.walk.seconds < this.duration_s - 1e-9 && this.walk.outcome !== "diverged") return this.clock.advance(passed_s);
    this.over_s += passed_s;
    if (this.next) return this.takeNext().catch((error) => this.hear.trouble(error));
    if (this.over_s < PAUSE_S || this.drag.held) return;
    this.again();
  }

  paint() {
    if (this.walk) this.stage.paint();
    this.invalidate();
  }

  /** Where it is, and how its trial ended once it has. */
  story(time_s) {
    const { walk } = this, { fell_s } = walk, now = `${this.title}: ${number(walk.distance(time_s), 2)} m after ${number(time_s, 1)} s.`;
    if (fell_s !== null && time_s >= fell_s - 1e-9) return `${now} It fell after ${number(fell_s, 1)} s, at ${number(walk.distance(fell_s), 2)} m: its trial was over there.`;
    if (walk.outcome === "diverged" && time_s >= walk.seconds - 1e-9) return `${now} The simulation broke down.`;
    return time_s >= this.duration_s - 1e-9 ? `${now} Its trial is over; it has not fallen.` : now;
  }
}
