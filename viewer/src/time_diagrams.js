// The diagrams over time: footfalls, timers, joints, speed and height.
import { Plot, niceStep, number } from "./plot.js";
import { legColour, walkerColour } from "./theme.js";

const TRIGGER_SPAN_S = 40; // in longer windows the triangles would hide each other
const FOOT_ROW = 30, TIMER_ROW = 40, JOINT_ROW = 42, MOTION_ROW = 92;

/** Footfall diagram (Hildebrand 1965): a bar while the foot is on the ground, a triangle at each trigger. */
export function footfallPlot(walk, window, clock) {
  const { legs } = walk.robot;
  return new Plot("Footfalls", legs.length * FOOT_ROW, window, clock, (pen) => {
    legs.forEach(({ name }, leg) => {
      const y = leg * FOOT_ROW + 9;
      pen.rowLabel(name, y + 7);
      pen.rect(pen.left, pen.right, y, 14, "--panel");
      for (const stance of walk.stances[leg]) pen.bar(stance, y, 14, legColour(leg));
      if (walk.triggers) for (const time_s of walk.triggers[leg]) triangle(pen, time_s, y - 1.5);
    });
  });
}

function triangle(pen, time_s, y) {
  if (time_s < pen.from_s || time_s > pen.to_s || pen.to_s - pen.from_s > TRIGGER_SPAN_S) return;
  const { context } = pen, x = pen.x(time_s);
  context.beginPath();
  context.moveTo(x, y);
  context.lineTo(x - 3.5, y - 6);
  context.lineTo(x + 3.5, y - 6);
  pen.fill("--ink");
}

/** The timer of each leg: it climbs through its period, and a trigger sends it back. */
export function timerPlot(walk, window, clock) {
  const { legs } = walk.robot;
  const period = walk.supg.period_ticks;
  return new Plot("Timers of the SUPGs", legs.length * TIMER_ROW, window, clock, (pen) => {
    legs.forEach(({ name }, leg) => {
      const base = leg * TIMER_ROW + TIMER_ROW - 4, height = TIMER_ROW - 15;
      pen.rowLabel(name, base - height / 2);
      pen.rect(pen.left, pen.right, base - height, height, "--panel");
      const y = (ticks) => base - (Math.max(ticks, 0) / period) * height;
      pen.curve(walk.timers[leg], walk.poses, y, legColour(leg), 1.6);
      if (walk.triggers) for (const time_s of walk.triggers[leg]) triangle(pen, time_s, base - height - 0.5);
    });
  });
}

/** Each joint's angle (coloured) and its target (thin), over the joint's range. */
export function jointPlot(walk, window, clock) {
  const { joints, legs } = walk.robot;
  const legOf = (joint) => legs.findIndex((leg) => leg.joints.includes(joint));
  return new Plot("Joint angles and targets", joints.length * JOINT_ROW, window, clock, (pen) => {
    joints.forEach(({ name, lower_rad, upper_rad }, j) => {
      const top = j * JOINT_ROW + 5, height = JOINT_ROW - 10;
      const y = (angle) => top + height * (1 - (angle - lower_rad) / (upper_rad - lower_rad || 1));
      const leg = legOf(j);
      const [first, ...rest] = name.split("_");
      pen.rowLabel(first, top + height / 2 - (rest.length ? 7 : 0), leg < 0 ? "--ink" : legColour(leg));
      if (rest.length) pen.text(rest.join(" "), 0, top + height / 2 + 8, { size: 11.5 });
      pen.rect(pen.left, pen.right, top, height, "--panel");
      pen.curve(walk.angles[j], walk.poses, y, leg < 0 ? "--ink" : legColour(leg), 2.2);
      pen.curve(walk.targets[j], walk.poses, y, "--ink", 1, { steps: true });
    });
  });
}

const extent = (columns) => {
  let lower = Infinity, upper = -Infinity;
  for (const column of columns)
    for (const value of column) {
      lower = Math.min(lower, value);
      upper = Math.max(upper, value);
    }
  return [lower, upper];
};

/** Speed over the ground and height of the centre of mass, of all walkers. */
export function motionPlot(walks, window, clock, selected) {
  const speeds = walks.map((walk) => speedColumn(walk));
  const rows = [
    { title: "Speed", unit: "m/s", columns: speeds, range: [0, Math.max(0.05, extent(speeds)[1])] },
    { title: "Height", unit: "m", columns: walks.map((walk) => walk.com[2]) },
  ];
  for (const row of rows) {
    const [lower, upper] = row.range ?? extent(row.columns);
    const spare = Math.max((upper - lower) * 0.06, 0.005);
    row.range = [row.range ? 0 : lower - spare, upper + spare];
  }
  return new Plot("Speed and height of the centre of mass", rows.length * MOTION_ROW, window, clock, (pen) => {
    rows.forEach(({ title, unit, columns, range: [lower, upper] }, r) => {
      const base = (r + 1) * MOTION_ROW - 6, height = MOTION_ROW - 22;
      const y = (value) => base - ((value - lower) / (upper - lower)) * height;
      pen.text(`${title}, ${unit}`, 0, base - height - 8, { weight: 600, css: "--ink" });
      const step = niceStep(upper - lower, 3), decimals = Math.max(0, -Math.floor(Math.log10(step)));
      for (let i = Math.ceil(lower / step - 1e-9); i * step <= upper; ++i) {
        pen.hair(pen.left, y(i * step), pen.right, y(i * step));
        pen.text(number(i * step, decimals), pen.left - 8, y(i * step), { align: "right", size: 11.5 });
      }
      walks.forEach((walk, i) => {
        const css = walks.length === 1 ? "--ink" : walkerColour(i);
        pen.curve(columns[i], walk.poses, y, css, i === selected() ? 2 : 1.2);
      });
    });
  });
}

function speedColumn(walk) {
  const { count, first_s, step_s } = walk.poses;
  return Float32Array.from({ length: count }, (_, k) => walk.speed(first_s + k * step_s));
}
