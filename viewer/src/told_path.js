// What a walker was told, and where that would have led.
import { niceStep, number } from "./plot.js";
import { colour, element } from "./theme.js";

const MEAN_S = 1; // speed and turn are means over this long: within a stride a body sways
const MARGIN_PX = 14, LEAST_PX = 160, MOST_PX = 420, SCALE_PX = 22; // the last: below the paths, for the length of a metre or so

/** Heading of each row, rad to the left of the world's x, whole turns counted: of the axis that points along x in the robot's own pose. */
function headings(walk) {
  const [w0, x0, y0, z0] = walk.robot.bodies[0].rotation;
  const [qw, qx, qy, qz] = walk.rootColumns.slice(3), found = new Float64Array(walk.poses.count);
  for (let k = 0; k < found.length; ++k) {
    // The rotation since that pose, of which only where it takes x matters.
    const w = qw[k] * w0 + qx[k] * x0 + qy[k] * y0 + qz[k] * z0, x = -qw[k] * x0 + qx[k] * w0 - qy[k] * z0 + qz[k] * y0;
    const y = -qw[k] * y0 + qx[k] * z0 + qy[k] * w0 - qz[k] * x0, z = -qw[k] * z0 - qx[k] * y0 + qy[k] * x0 + qz[k] * w0;
    const heading = Math.atan2(2 * (x * y + w * z), 1 - 2 * (y * y + z * z));
    found[k] = k === 0 ? heading : heading + 2 * Math.PI * Math.round((found[k - 1] - heading) / (2 * Math.PI));
  }
  return found;
}

/** Rates of a walk with commands: {headings, speeds (m/s along its own axis), turns (rad/s to the left)}, row by row. */
export function rates(walk) {
  const { step_s, count } = walk.poses, [x, y] = walk.com, half = Math.max(1, Math.round(MEAN_S / 2 / step_s));
  const turned = headings(walk), speeds = new Float64Array(count), turns = new Float64Array(count);
  for (let k = 0; k < count; ++k) {
    const from = Math.max(0, k - half), to = Math.min(count - 1, k + half), seconds = (to - from) * step_s || 1;
    speeds[k] = ((x[to] - x[from]) * Math.cos(turned[k]) + (y[to] - y[from]) * Math.sin(turned[k])) / seconds;
    turns[k] = (turned[to] - turned[from]) / seconds;
  }
  return { headings: turned, speeds, turns };
}

/** Where the commands would have led from the start: [x, y] by row. */
export function wantedPath(walk, turned) {
  const { step_s, count } = walk.poses, [speed, turn] = walk.commands, x = [walk.com[0][0]], y = [walk.com[1][0]];
  for (let k = 1, heading = turned[0]; k < count; ++k) {
    heading += turn[k] * step_s;
    x.push(x[k - 1] + speed[k] * step_s * Math.cos(heading));
    y.push(y[k - 1] + speed[k] * step_s * Math.sin(heading));
  }
  return [x, y];
}

/** Both paths from above, and where the walker is. */
export class PathFromAbove {
  constructor(walk, turned) {
    Object.assign(this, { walk, wanted: wantedPath(walk, turned), done: walk.com });
    const all = [0, 1].map((axis) => [...this.wanted[axis], ...this.done[axis].subarray(0, walk.poses.count)]);
    [this.least, this.most] = [Math.min, Math.max].map((of) => all.map((values) => values.reduce((a, b) => of(a, b))));
    const away = (k) => Math.hypot(this.wanted[0][k] - this.done[0][k], this.wanted[1][k] - this.done[1][k]);
    const label = `The path it was told and the path it walked, from above. At the end they are ${number(away(walk.poses.count - 1), 1)} m apart.`;
    this.canvas = element("canvas", { class: "path-from-above", role: "img", "aria-label": label });
    this.element = element("div", {}, this.canvas);
    new ResizeObserver(() => this.repaint()).observe(this.element);
  }

  /** The paths lie along the width, whichever way they go. */
  repaint() {
    const width = this.element.clientWidth, ratio = devicePixelRatio;
    if (width === 0) return;
    const spans = this.most.map((most, axis) => Math.max(most - this.least[axis], 0.2));
    const across = spans[0] >= spans[1] ? 0 : 1;
    this.scale = Math.min((width - 2 * MARGIN_PX) / spans[across], (MOST_PX - 2 * MARGIN_PX) / spans[1 - across]);
    const height = Math.max(LEAST_PX, spans[1 - across] * this.scale + 2 * MARGIN_PX);
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
    if (!this.at) return;
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
    for (let k = 0; k < count; ++k) paint.lineTo(...this.at(x[k], y[k]));
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
