// A diagram over time: a canvas that shows a window of the recording, and a cursor at the present.
import { colour, element } from "./theme.js";

const onPaper = () => matchMedia("print").matches;
const LEFT = 72, RIGHT = 10, AXIS = 20;

/** The part of the recording that diagrams show: `span_s` around the present, inside the recording. */
export class TimeWindow {
  constructor(duration_s, span_s) {
    this.duration_s = duration_s;
    this.setSpan(span_s);
  }
  setSpan(span_s) {
    this.span_s = Math.min(span_s, this.duration_s) || 1;
  }
  start(t) {
    return Math.max(0, Math.min(t - this.span_s / 2, this.duration_s - this.span_s));
  }
}

/** 1, 2 or 5 × 10^k such that `length` holds no more than `most` of it. */
export function niceStep(length, most) {
  const power = 10 ** Math.floor(Math.log10(length / most));
  return power * [1, 2, 5, 10].find((factor) => (factor * power * most) / length >= 0.9999);
}

/** The whole nice steps around [lower, upper]: {lower, upper, ticks, text(tick)}, at least two ticks and about `most`. */
export function niceAxis(lower, upper, most) {
  const step = niceStep(upper - lower, most), decimals = Math.max(0, -Math.floor(Math.log10(step)));
  const first = Math.floor(lower / step + 1e-9), last = Math.ceil(upper / step - 1e-9);
  const ticks = Array.from({ length: last - first + 1 }, (_, i) => (first + i) * step);
  return { lower: first * step, upper: last * step, ticks, text: (tick) => number(tick, decimals) };
}

export const number = (value, decimals) => value.toFixed(decimals).replace("-", "−");

export class Plot {
  /**
   * `height_px` of the drawing without its time axis; `draw(pen)` paints it, with pen = {context, x(time_s), left,
   * right, from_s, to_s, text(), hair()}.
   */
  constructor(label, height_px, window, clock, draw) {
    Object.assign(this, { height_px, window, clock, draw });
    this.canvas = element("canvas", { role: "img", "aria-label": label });
    this.cursor = element("div", { class: "cursor" });
    this.element = element("div", { class: "plot" }, this.canvas, this.cursor);
    this.element.style.height = `${height_px + AXIS}px`;
    this.visible = true;
    new IntersectionObserver(([entry]) => {
      this.visible = entry.isIntersecting;
      if (this.visible) this.show();
    }, { rootMargin: "200px" }).observe(this.element);
    new ResizeObserver(() => this.repaint()).observe(this.element);
    this.seekByPointer();
  }

  seekByPointer() {
    const seek = (event) => {
      const at = event.clientX - this.canvas.getBoundingClientRect().left;
      const share = (at - LEFT) / (this.width - LEFT - RIGHT);
      this.clock.seek(this.grabbed_s + Math.min(Math.max(share, 0), 1) * this.window.span_s);
    };
    this.canvas.addEventListener("pointerdown", (event) => {
      if (event.button !== 0) return;
      this.clock.pause();
      this.grabbed_s = this.window.start(this.clock.time_s); // the window must not run away under the pointer
      this.canvas.setPointerCapture(event.pointerId);
      this.held = true;
      seek(event);
    });
    this.canvas.addEventListener("pointermove", (event) => this.held && seek(event));
    for (const end of ["pointerup", "pointercancel"])
      this.canvas.addEventListener(end, () => {
        this.held = false;
        this.show();
      });
  }

  repaint() {
    this.painted_s = undefined;
    this.show();
  }

  /** Paints if the window has moved, and puts the cursor where the time is. */
  show() {
    if (!this.visible && !onPaper()) return;
    const from_s = this.held ? this.grabbed_s : this.window.start(this.clock.time_s);
    if (from_s !== this.painted_s || this.painted_span_s !== this.window.span_s) this.paint(from_s);
    const x = LEFT + ((this.clock.time_s - from_s) / this.window.span_s) * (this.width - LEFT - RIGHT);
    this.cursor.style.transform = `translateX(${x.toFixed(2)}px)`;
  }

  paint(from_s) {
    this.width = this.element.clientWidth;
    if (this.width === 0) return;
    const ratio = onPaper() ? 3 : devicePixelRatio;
    this.canvas.width = Math.round(this.width * ratio);
    this.canvas.height = Math.round((this.height_px + AXIS) * ratio);
    const context = this.canvas.getContext("2d");
    context.scale(ratio, ratio);
    const span_s = this.window.span_s;
    const scale = (this.width - LEFT - RIGHT) / span_s;
    const pen = new Pen(context, {
      from_s, to_s: from_s + span_s, left: LEFT, right: this.width - RIGHT,
      x: (time_s) => LEFT + (time_s - from_s) * scale,
    });
    pen.timeAxis(this.height_px);
    this.draw(pen);
    [this.painted_s, this.painted_span_s] = [from_s, span_s];
  }
}

class Pen {
  constructor(context, geometry) {
    Object.assign(this, { context }, geometry);
    context.lineJoin = context.lineCap = "round";
  }

  text(text, x, y, { align = "left", weight = 450, size = 12, css = "--soft", most } = {}) {
    const { context } = this;
    context.font = `${weight} ${size}px ${colour("--sans")}`;
    context.fillStyle = css.startsWith("--") ? colour(css) : css;
    context.textAlign = align;
    context.textBaseline = "middle";
    context.fillText(text, x, y, most);
  }
  /** Beside a row: a long name is broken at the underscore nearest to its middle, and narrowed if that is not enough. */
  rowLabel(text, y, css = "--ink") {
    const { context } = this, room = this.left - 5, style = { weight: 600, css };
    context.font = `600 12px ${colour("--sans")}`;
    const breaks = [...text.matchAll(/_./g)].map(({ index }) => index + 1), middle = text.length / 2;
    if (breaks.length === 0 || context.measureText(text).width <= room) return this.text(text, 0, y, { ...style, most: room });
    const at = breaks.reduce((a, b) => (Math.abs(b - middle) < Math.abs(a - middle) ? b : a));
    [text.slice(0, at), text.slice(at)].forEach((part, i) => this.text(part, 0, y + (i - 0.5) * 13, { ...style, most: room }));
  }

  rect(x0, x1, y, height, css) {
    this.context.fillStyle = css.startsWith("--") ? colour(css) : css;
    this.context.fillRect(x0, y, x1 - x0, height);
  }
  /** Fills the present path. */
  fill(css) {
    this.context.fillStyle = colour(css);
    this.context.fill();
  }
  hair(x0, y0, x1, y1, css = "--hair") {
    const { context } = this;
    context.strokeStyle = colour(css);
    context.lineWidth = 1;
    context.beginPath();
    context.moveTo(Math.round(x0) + 0.5, Math.round(y0) + 0.5);
    context.lineTo(Math.round(x1) + 0.5, Math.round(y1) + 0.5);
    context.stroke();
  }

  /** A bar of time, cut to the window. */
  bar([start_s, end_s], y, height, css) {
    if (end_s < this.from_s || start_s > this.to_s) return;
    const x0 = Math.max(this.x(start_s), this.left), x1 = Math.min(this.x(end_s), this.right);
    this.rect(x0, Math.max(x1, x0 + 0.75), y, height, css);
  }

  /** A hairline at a time. */
  mark(time_s, y, height, css) {
    if (time_s < this.from_s || time_s > this.to_s) return;
    const x = this.x(time_s);
    this.rect(x - 0.6, x + 0.6, y, height, css);
  }

  /** A curve through the rows of `column` inside the window; value → px by y. */
  curve(column, frames, y, css, width, { steps = false, dash = [] } = {}) {
    const { context } = this;
    const first = Math.max(0, Math.floor((this.from_s - frames.first_s) / frames.step_s));
    const last = Math.min(frames.count - 1, Math.ceil((this.to_s - frames.first_s) / frames.step_s));
    // Where more than two rows fall on a px, their least and greatest represent all.
    const stride = Math.max(1, Math.floor((last - first) / (2 * (this.right - this.left))));
    context.save();
    context.beginPath();
    context.rect(this.left, 0, this.right - this.left, 1e4);
    context.clip();
    context.beginPath();
    for (let k = first; k <= last; k += stride) {
      const x = this.x(frames.first_s + k * frames.step_s);
      if (stride === 1) {
        if (steps && k > first) context.lineTo(x, y(column[k - 1]));
        context.lineTo(x, y(column[k]));
      } else {
        for (const value of extremes(column, k, Math.min(k + stride, frames.count))) context.lineTo(x, y(value));
      }
    }
    context.strokeStyle = css.startsWith("--") ? colour(css) : css;
    context.lineWidth = width;
    context.setLineDash(dash);
    context.stroke();
    context.restore();
  }

  timeAxis(base_y) {
    const step = niceStep(this.to_s - this.from_s, (this.right - this.left) / 56);
    const decimals = Math.max(0, -Math.floor(Math.log10(step)));
    for (let i = Math.ceil(this.from_s / step - 1e-9); i * step <= this.to_s + 1e-9; ++i) {
      const x = this.x(i * step);
      this.hair(x, 0, x, base_y + 3);
      const align = x > this.right - 16 ? "right" : "center"; // the last would be cut off
      this.text(`${number(i * step, decimals)} s`, align === "right" ? this.right + RIGHT : x, base_y + 12, { align, size: 11.5 });
    }
  }
}

function extremes(column, from, to) {
  let lower = column[from], upper = lower;
  for (let k = from + 1; k < to; ++k) {
    lower = Math.min(lower, column[k]);
    upper = Math.max(upper, column[k]);
  }
  return [lower, upper];
}
