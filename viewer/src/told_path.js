// What a walker was told, and where that would have led.
import { niceStep, number } from "./plot.js";
import { colour, element } from "./theme.js";

const MEAN_S = 1; // speed and turn are means over this long: within a stride a body sways
const LIVE_PX = 280, ROOM = 0.3, LEAST_ROOM_M = 0.2, MOST_POINTS = 2000; // of a walk that grows, whose picture keeps its height
const MARGIN_PX = 14, LEAST_PX = 160, MOST_PX = 420, SCALE_PX = 22; // the last: below the paths, for the length of a metre or so

/** Heading of row k, rad to the left of the world's x, of the axis that points along x in the robot's own pose; whole turns are those of `before`. */
function headingOf(walk, k, before) {
  const [w0, x0, y0, z0] = walk.robot.bodies[0].rotation, [qw, qx, qy, qz] = walk.rootColumns.slice(3);
  // The rotation since that pose, of which only where it takes x matters.
  const w = qw[k] * w0 + qx[k] * x0 + qy[k] * y0 + qz[k] * z0, x = -qw[k] * x0 + qx[k] * w0 - qy[k] * z0 + qz[k] * y0;
  const y = -qw[k] * y0 + qx[k] * z0 + qy[k] * w0 - qz[k] * x0, z = -qw[k] * z0 - qx[k] * y0 + qy[k] * x0 + qz[k] * w0;
  const heading = Math.atan2(2 * (x * y + w * z), 1 - 2 * (y * y + z * z));
  return heading + 2 * Math.PI * Math.round((before - heading) / (2 * Math.PI));
}

function headings(walk) {
  const found = new Float64Array(walk.poses.count);
  for (let k = 0; k < found.length; ++k) found[k] = headingOf(walk, k, k === 0 ? 0 : found[k - 1]);
  return found;
}

/** The mean speed along its own axis and the mean turn from one row to another, seen at row `k`. */
function ratesBetween(walk, turned, from, to, k) {
  const seconds = (to - from) * walk.poses.step_s || 1, [x, y] = walk.com;
  return [((x[to] - x[from]) * Math.cos(turned[k]) + (y[to] - y[from]) * Math.sin(turned[k])) / seconds, (turned[to] - turned[from]) / seconds];
}

/** Rates of a walk with commands: {headings, speeds (m/s along its own axis), turns (rad/s to the left)}, row by row. */
export function rates(walk) {
  const { step_s, count } = walk.poses, half = Math.max(1, Math.round(MEAN_S / 2 / step_s));
  const turned = headings(walk), speeds = new Float64Array(count), turns = new Float64Array(count);
  for (let k = 0; k < count; ++k)
    [speeds[k], turns[k]] = ratesBetween(walk, turned, Math.max(0, k - half), Math.min(count - 1, k + half), k);
  const headingErrors = new Float64Array(count);
  for (let k = 0; k < count; ++k) headingErrors[k] = headingError(walk, turned, headingErrors, k);
  return { headings: turned, headingErrors, speeds, turns, wantedHeadings: wantedHeadings(walk, turned), wanted: wantedPath(walk, turned) };
}

/** What the sensor heading_error says in row k: how far what the turns led to is to the left, within half a turn and the lead of the walker's settings. */
function headingError(walk, turned, before, k) {
  if (k === 0) return 0;
  const ahead = turned[k - 1] + before[k - 1] + walk.commands[1][k] * walk.poses.step_s - turned[k], most = walk.controller?.heading_lead_rad || Math.PI;
  return Math.min(most, Math.max(-most, ahead - 2 * Math.PI * Math.round(ahead / (2 * Math.PI))));
}

/** What the commanded turns have led to, row by row. */
function wantedHeadings(walk, turned) {
  const { step_s, count } = walk.poses, wanted = new Float64Array(count);
  for (let k = 0; k < count; ++k) wanted[k] = k === 0 ? turned[0] : wanted[k - 1] + walk.commands[1][k] * step_s;
  return wanted;
}

/** Where the commands would have led from the start: [x, y] by row. */
export function wantedPath(walk, turned) {
  const { step_s, count } = walk.poses, [speed] = walk.commands, x = [walk.com[0][0]], y = [walk.com[1][0]], heading = wantedHeadings(walk, turned);
  for (let k = 1; k < count; ++k) {
    x.push(x[k - 1] + speed[k] * step_s * Math.cos(heading[k]));
    y.push(y[k - 1] + speed[k] * step_s * Math.sin(heading[k]));
  }
  return [x, y];
}

/** The columns of rates() of a walk that grows, by the names of its table's; means are over the second before. */
const COLUMNS = ["heading", "heading.error", "done.speed", "done.turn", "wanted.heading", "wanted.x", "wanted.y"];
export class GrowingRates {
  static columns = COLUMNS;

  constructor(walk) {
    this.walk = walk;
    const [headings, headingErrors, speeds, turns, wantedHeadings, ...wanted] = COLUMNS.map((name) => walk.poses.get(name));
    Object.assign(this, { headings, headingErrors, speeds, turns, wantedHeadings, wanted });
    this.begin();
  }

  begin() {
    this.begun = (this.begun ?? 0) + 1;
    this.extents = [[0, 0], [0, 0]]; // of speeds and of turns, wanted and done
  }

  /** Row k is there. */
  add(k) {
    const { walk, headings, speeds, turns, wantedHeadings, wanted: [x, y] } = this, { step_s } = walk.poses, [speed, turn] = walk.commands;
    headings[k] = headingOf(walk, k, k === 0 ? 0 : headings[k - 1]);
    this.headingErrors[k] = headingError(walk, headings, this.headingErrors, k);
    wantedHeadings[k] = k === 0 ? headings[0] : wantedHeadings[k - 1] + turn[k] * step_s;
    x[k] = k === 0 ? walk.com[0][0] : x[k - 1] + speed[k] * step_s * Math.cos(wantedHeadings[k]);
    y[k] = k === 0 ? walk.com[1][0] : y[k - 1] + speed[k] * step_s * Math.sin(wantedHeadings[k]);
    const from = Math.max(0, k - Math.round(MEAN_S / step_s));
    [speeds[k], turns[k]] = ratesBetween(walk, headings, from, k, Math.round((from + k) / 2));
    [[speed[k], speeds[k]], [turn[k], turns[k]]].forEach((values, i) => {
      this.extents[i] = [Math.min(this.extents[i][0], ...values), Math.max(this.extents[i][1], ...values)];
    });
  }
}

/** Both paths from above, and where the walker is. */
export class PathFromAbove {
  constructor(walk, rates) {
    Object.assign(this, { walk, rates, wanted: rates.wanted, done: walk.com, rows: 0, visible: true });
    this.fit();
    this.canvas = element("canvas", { class: "path-from-above", role: "img", "aria-label": this.label() });
    this.element = element("div", {}, this.canvas);
    new ResizeObserver(() => this.repaint()).observe(this.element);
    new IntersectionObserver(([entry]) => {
      this.visible = entry.isIntersecting;
      if (this.visible) this.show(this.time_s ?? 0);
    }, { rootMargin: "200px" }).observe(this.element);
  }

  label() {
    const what = "The path it was told and the path it walked, from above.";
    if (this.walk.live) return what;
    const k = this.walk.poses.count - 1, away_m = Math.hypot(...[0, 1].map((axis) => this.wanted[axis][k] - this.done[axis][k]));
    return `${what} At the end they are ${number(away_m, 1)} m apart.`;
  }

  /** What is shown holds all rows that there are; of a walk that grows, with room for more. Whether it changed. */
  fit() {
    const { count } = this.walk.poses, { begun } = this.rates, anew = this.rows === 0 || begun !== this.begun;
    this.begun = begun;
    const least = anew ? [Infinity, Infinity] : [...this.least], most = anew ? [-Infinity, -Infinity] : [...this.most];
    for (const path of [this.wanted, this.done])
      for (let axis = 0; axis < 2; ++axis)
        for (let k = anew ? 0 : this.rows; k < count; ++k)
          [least[axis], most[axis]] = [Math.min(least[axis], path[axis][k]), Math.max(most[axis], path[axis][k])];
    this.rows = count;
    if (!anew && least.every((value, axis) => value === this.least[axis]) && most.every((value, axis) => value === this.most[axis])) return false;
    const room_m = this.walk.live ? Math.max(LEAST_ROOM_M, ROOM * Math.max(...most.map((value, axis) => value - least[axis]))) : 0;
    const moved = (value, before, by_m) => (anew || value !== before ? value + by_m : value);
    [this.least, this.most] = [least.map((value, axis) => moved(value, this.least?.[axis], -room_m)), most.map((value, axis) => moved(value, this.most?.[axis], room_m))];
    return true;
  }

  /** The paths lie along the width, whichever way they go. */
  repaint() {
    const width = this.element.clientWidth, ratio = devicePixelRatio;
    if (width === 0) return;
    const spans = this.most.map((most, axis) => Math.max(most - this.least[axis], 0.2));
    const across = spans[0] >= spans[1] ? 0 : 1;
    this.scale = Math.min((width - 2 * MARGIN_PX) / spans[across], (MOST_PX - 2 * MARGIN_PX) / spans[1 - across]);
    if (this.walk.live) this.scale = Math.min(this.scale, (LIVE_PX - 2 * MARGIN_PX) / spans[1 - across]);
    const height = this.walk.live ? LIVE_PX : Math.max(LEAST_PX, spans[1 - across] * this.scale + 2 * MARGIN_PX);
    Object.assign(this.canvas, { width: Math.round(width * ratio), height: Math.round((height + SCALE_PX) * ratio) });
    Object.assign(this.canvas.style, { width: `${width}px`, height: `${height + SCALE_PX}px` });
    const middle = this.most.map((most, axis) => (most + this.least[axis]) / 2);
    // From above x goes right and y up, or, turned by a quarter, y goes left and x up.
    this.at = (x, y) => {
      const [a, b] = [x - middle[0], y - middle[1]];
      return across === 0 ? [width / 2 + a * this.scale, height / 2 - b * this.scale] : [width / 2 - b * this.scale, height / 2 - a * this.scale];
    };
    this.show(this.time_s ?? 0);
  }

  show(t) {
    this.time_s = t;
    if (!this.at || (!this.visible && !matchMedia("print").matches)) return;
    if (this.walk.live && (this.walk.poses.count !== this.rows || this.rates.begun !== this.begun) && this.fit()) return this.repaint();
    const paint = this.canvas.getContext("2d"), { width, height } = this.canvas, row = this.walk.place(t).row;
    paint.setTransform(1, 0, 0, 1, 0, 0);
    paint.clearRect(0, 0, width, height);
    paint.scale(devicePixelRatio, devicePixelRatio);
    paint.lineJoin = "round";
    this.line(paint, this.wanted, this.walk.poses.count, "--told", 1.6, [6, 3]);
    paint.globalAlpha = 0.3;
    this.line(paint, this.done, this.walk.poses.count, "--ink", 2.4);
    paint.globalAlpha = 1;
    this.line(paint, this.done, row + 1, "--ink", 2.4);
    this.dot(paint, this.wanted, row, "--told");
    this.dot(paint, this.done, row, "--ink");
    this.drawScale(paint);
  }

  line(paint, [x, y], count, css, width, dash = []) {
    paint.strokeStyle = colour(css);
    paint.lineWidth = width;
    paint.setLineDash(dash);
    paint.beginPath();
    const step = Math.ceil(count / MOST_POINTS);
    for (let k = 0; k < count - 1; k += step) paint.lineTo(...this.at(x[k], y[k]));
    if (count > 0) paint.lineTo(...this.at(x[count - 1], y[count - 1]));
    paint.stroke();
    paint.setLineDash([]);
  }

  dot(paint, [x, y], row, css) {
    paint.fillStyle = colour(css);
    paint.beginPath();
    paint.arc(...this.at(x[row], y[row]), 4.5, 0, 2 * Math.PI);
    paint.fill();
  }

  drawScale(paint) {
    const step = niceStep(90 / this.scale, 1), y = this.canvas.height / devicePixelRatio - 6;
    paint.fillStyle = colour("--soft");
    paint.fillRect(0, y, step * this.scale, 1.5);
    paint.font = `450 11.5px ${colour("--sans")}`;
    paint.fillText(`${number(step, step < 1 ? 1 : 0)} m`, 0, y - 5);
  }
}
