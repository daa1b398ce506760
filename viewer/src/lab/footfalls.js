// The footfalls of the walker on a stage, as it walks.
import { TimeWindow } from "../plot.js";
import { footfallPlot } from "../time_diagrams.js";

const SPAN_S = 4, EVERY_MS = 80;

export class Footfalls {
  constructor(parent, clock) {
    Object.assign(this, { parent, clock, shown_s: null, shown_ms: 0 });
  }

  /** Another walker, or the same one anew. */
  begin(walk) {
    this.window = new TimeWindow(SPAN_S, SPAN_S);
    this.plot = footfallPlot(walk, this.window, this.clock);
    this.parent.replaceChildren(this.plot.element);
    this.shown_s = null;
  }

  /** With each frame; bars are painted anew a dozen times a second. */
  show() {
    if (!this.plot) return;
    const { duration_s } = this.clock, now_ms = performance.now();
    this.window.duration_s = Math.max(duration_s, SPAN_S);
    if (duration_s === this.shown_s || (this.clock.playing && now_ms - this.shown_ms < EVERY_MS)) return this.plot.show();
    [this.shown_s, this.shown_ms] = [duration_s, now_ms];
    return this.plot.repaint();
  }
  repaint() {
    this.plot?.repaint();
  }
}
