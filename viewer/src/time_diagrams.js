// The diagrams over time: footfalls, timers, joints, speed and height.
import { rangeOf } from "./joints.js";
import { Plot, niceAxis, number } from "./plot.js";
import { legColour, walkerLineColour } from "./theme.js";

const TRIGGER_SPAN_S = 40; // in longer windows the triangles would hide each other
const FOOT_ROW = 30, TIMER_ROW = 40, NEURON_ROW = 26, JOINT_ROW = 46, MOTION_ROW = 112;

/**
 * Footfall diagram (Hildebrand 1965): a bar while the foot is on the ground, a triangle at each trigger. Chatter is a
 * hairline: a gap in its stance, a touch outside of one.
 */
export function footfallPlot(walk, window, clock) {
  const { legs } = walk.robot;
  return new Plot("Footfalls", legs.length * FOOT_ROW, window, clock, (pen) => {
    legs.forEach(({ name }, leg) => {
      const y = leg * FOOT_ROW + 9;
      pen.rowLabel(name, y + 7);
      pen.rect(pen.left, pen.right, y, 14, "--panel");
      for (const stance of walk.stances[leg]) pen.bar(stance, y, 14, legColour(leg));
      for (const time_s of walk.chatter[leg].gaps) pen.mark(time_s, y, 14, "--paper");
      for (const time_s of walk.chatter[leg].touches) pen.mark(time_s, y, 14, legColour(leg));
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

/** What each neuron says: from −1 to 1 beside SUPGs, else from 0 to 1. */
export function neuronPlot(walk, window, clock) {
  const least = walk.controller.kind === "mixed" ? -1 : 0;
  return new Plot("Neurons", walk.neurons.length * NEURON_ROW, window, clock, (pen) => {
    walk.neurons.forEach(({ name, values }, row) => {
      const base = row * NEURON_ROW + NEURON_ROW - 3, height = NEURON_ROW - 6;
      const leg = walk.robot.legs.findIndex((one) => name.startsWith(one.name));
      const [first, ...rest] = name.split(".");
      pen.text(first, 0, base - height / 2 - (rest.length ? 9 : 6), { size: 10, css: "--ink" });
      if (rest.length) pen.text(rest.join("."), 0, base - height / 2 + 2, { size: 10 });
      pen.rect(pen.left, pen.right, base - height, height, "--panel");
      pen.curve(values, walk.poses, (value) => base - height * (value - least) / (1 - least), leg < 0 ? "--ink" : legColour(leg), 1.4);
    });
  });
}

/** "−0.8 … 0", in rad. */
const rangeText = (range) => range.map((angle) => number(angle, 2).replace(/\.?0+$/, "")).join(" … ");

/** A plot for each leg, and one for the joints of none, if there are any. */
export function jointPlots(walk, window, clock) {
  const { joints, legs } = walk.robot;
  const others = joints.map((_, j) => j).filter((j) => !legs.some((leg) => leg.joints.includes(j)));
  const groups = [...legs.map((leg, i) => [leg.joints.filter((j) => j >= 0), () => legColour(i)]), [others, () => "--ink"]];
  return groups.filter(([members]) => members.length > 0).map(([members, css]) => jointPlot(walk, members, css, window, clock));
}

/** Each joint's angle (coloured) and its target (thin), over the joint's range. */
function jointPlot(walk, members, css, window, clock) {
  return new Plot("Joint angles and targets", members.length * JOINT_ROW, window, clock, (pen) => {
    members.forEach((j, row) => {
      const joint = walk.robot.joints[j], { name } = joint, range = rangeOf(joint), [lower_rad, upper_rad] = range;
      const top = row * JOINT_ROW + 4, height = JOINT_ROW - 8;
      const y = (angle) => top + height * (1 - (angle - lower_rad) / (upper_rad - lower_rad || 1));
      const [first, ...rest] = name.split("_");
      const lines = top + height / 2 - (rest.length ? 13 : 7);
      pen.rowLabel(first, lines, css());
      if (rest.length) pen.text(rest.join(" "), 0, lines + 14, { size: 11.5 });
      pen.text(rangeText(range), 0, lines + (rest.length ? 27 : 14), { size: 10.5 });
      pen.rect(pen.left, pen.right, top, height, "--panel");
      pen.curve(walk.angles[j], walk.poses, y, css(), 2.2);
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
  const speeds = walks.map((walk) => walk.speeds ?? speedColumn(walk));
  const heights = walks.map((walk) => walk.com[2]);
  const known = walks.every((walk) => !walk.extremes) && { speed: extent(speeds), height: extent(heights) };
  const rows = () => {
    const { speed, height } = known || walks[0].extremes;
    return [
      { title: "Speed, m/s", columns: speeds, axis: niceAxis(0, Math.max(0.05, speed[1]), 4) },
      { title: "Height, m", columns: heights, axis: niceAxis(height[0] - 0.002, height[1] + 0.002, 4) },
    ];
  };
  return new Plot("Speed and height of the centre of mass", 2 * MOTION_ROW, window, clock, (pen) => {
    rows().forEach(({ title, columns, axis }, r) => {
      const y = band(pen, r, title, axis);
      walks.forEach((walk, i) => {
        const css = walks.length === 1 ? "--ink" : walkerLineColour(i);
        pen.curve(columns[i], walk.poses, y, css, i === selected() ? 2.4 : 1.6);
      });
    });
  });
}

/** Title and axis of one quantity of several, one below the other; gives value → px. */
function band(pen, row, title, { lower, upper, ticks, text }) {
  const base = (row + 1) * MOTION_ROW - 8, height = MOTION_ROW - 40;
  const y = (value) => base - ((value - lower) / (upper - lower)) * height;
  pen.text(title, 0, base - height - 18, { weight: 600, css: "--ink" });
  for (const tick of ticks) {
    pen.hair(pen.left, y(tick), pen.right, y(tick));
    pen.text(text(tick), pen.left - 8, y(tick), { align: "right", size: 11.5 });
  }
  return y;
}

/** What a walker was told, thin, and what it did. */
export function commandPlot(walk, rates, window, clock) {
  const [told, turned] = walk.commands, { speeds, turns } = rates;
  const rows = [["Speed along its own axis, m/s", told, speeds], ["Turn to the left, rad/s", turned, turns]].map(([title, ...columns], r) =>
    ({ title, columns, known: rates.extents ? null : extent(columns), now: () => rates.extents[r] }));
  return new Plot("What it was told, and what it did", 2 * MOTION_ROW, window, clock, (pen) => {
    rows.forEach(({ title, columns: [wanted, done], known, now }, r) => {
      const y = band(pen, r, title, niceAxis(...around(known ?? now()), 4));
      pen.curve(done, walk.poses, y, "--ink", 2.4);
      pen.curve(wanted, walk.poses, y, "--told", 1.6, { dash: [6, 3] });
    });
  });
}

/** Not nothing, and 0 in it. */
const around = ([lower, upper]) => [Math.min(lower, -0.02), Math.max(upper, 0.02)];

function speedColumn(walk) {
  const { count, first_s, step_s } = walk.poses;
  return Float32Array.from({ length: count }, (_, k) => walk.speed(first_s + k * step_s));
}
