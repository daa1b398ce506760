// One recorded walk: what the robot did at any time.
import { inflateText, unpackFrames } from "./data.js";
import { unpackGround } from "./heights.js";

const ROOT = ["x", "y", "z", "qw", "qx", "qy", "qz"].map((name) => "root." + name);
const COM = ["x", "y", "z"].map((name) => "com." + name);
const SPEED_WINDOW_S = 0.5; // speed is the way of this long

/** Legs that a damage takes away, [{leg, from_s}]. */
export function lostLegs(robot, damage) {
  const parts = (damage?.parts ?? []).filter(({ kind }) => kind === "missing");
  return parts.map(({ leg: name, from_s }) => ({ leg: robot.legs.findIndex((leg) => leg.name === name), from_s }));
}

export class Walk {
  static async unpack(json) {
    const ground = await unpackGround(json.ground), cppn_svg = await inflateText(json.cppn_svg);
    const controller = JSON.parse(await inflateText(json.controller));
    return new Walk({ ...json, ground, cppn_svg, controller }, await unpackFrames(json.poses), await unpackFrames(json.contacts));
  }

  constructor(json, poses, contacts) {
    Object.assign(this, json);
    this.poses = poses;
    this.contacts = contacts;
    this.rootColumns = ROOT.map((name) => poses.get(name));
    this.com = COM.map((name) => poses.get(name));
    this.angles = this.robot.joints.map((joint) => poses.get("angle." + joint.name));
    this.targets = this.robot.joints.map((joint) => poses.get("target." + joint.name));
    this.timers = this.columnsOfLegs(poses, "timer.");
    const commands = ["speed", "turn"].map((name) => poses.get("command." + name));
    this.commands = commands.every(Boolean) ? commands : null;
    this.touches = this.columnsOfLegs(contacts, "touch.");
    this.debounce_s = this.gait?.settings.debounce_s ?? 0;
    this.neurons = (poses.names ?? []).filter((name) => name.startsWith("neuron.")).map((name) => ({ name: name.slice("neuron.".length), values: poses.get(name) }));
    this.triggered = this.columnsOfLegs(contacts, "trigger.");
    this.supg = this.controller.patterns_rad ? this.controller : null;
    this.lost = lostLegs(this.robot, json.damage);
  }

  /** Legs, by number, that it lacks at time t. */
  missingLegs(t) {
    return this.lost.filter(({ from_s }) => from_s <= t).map(({ leg }) => leg);
  }

  /**
   * Stances as the gait figures count them, [from, to] in seconds, when there was chatter in and between them, and when
   * a foot triggered its timer. Looked for when asked for: what is simulated grows with every picture.
   */
  get events() {
    const { count } = this.contacts;
    if (this.found?.count !== count) this.found = { count, ...this.findEvents(count) };
    return this.found;
  }
  get stances() {
    return this.events.stances;
  }
  get chatter() {
    return this.events.chatter;
  }
  get triggers() {
    return this.events.triggers;
  }

  findEvents(count) {
    const { step_s } = this.contacts;
    const known = (column) => column.subarray(0, count);
    const triggers = this.triggered && this.triggered.map((trigger) => onsets(known(trigger), step_s));
    const least = Math.round(this.debounce_s / step_s);
    const span = ([first, end]) => [first === 0 ? 0 : (first + 1) * step_s, Math.min(end + 1, count) * step_s];
    const middles = (rows) => rows.map(span).map(([from, to]) => (from + to) / 2);
    const all = this.touches.map((touch) => footfalls(runs(known(touch)), least));
    return { triggers, stances: all.map(({ stances }) => stances.map(span)),
             chatter: all.map(({ gaps, touches }) => ({ gaps: middles(gaps), touches: middles(touches) })) };
  }

  /** One column per leg, or null if a leg has none. */
  columnsOfLegs(frames, prefix) {
    const columns = this.robot.legs.map((leg) => frames.get(prefix + leg.name));
    return columns.every(Boolean) ? columns : null;
  }

  /** Row and share of the next row at time t; a time that is a row's own has no share of the next. */
  place(t) {
    const { first_s, step_s, count } = this.poses;
    const x = Math.min(Math.max((t - first_s) / step_s, 0), count - 1);
    const nearest = Math.round(x);
    if (Math.abs(x - nearest) < 1e-6) return { row: nearest, share: 0 };
    return { row: Math.floor(x), share: x - Math.floor(x) };
  }

  /** Root (x, y, z, qw, qx, qy, qz), centre of mass and joint angles at time t; between rows interpolated. */
  pose(t) {
    const { row, share } = this.place(t);
    const at = (column) => (share === 0 ? column[row] : column[row] + share * (column[row + 1] - column[row]));
    const root = this.rootColumns.map(at);
    if (share !== 0) turnBetween(this.rootColumns, row, share, root);
    return { root, com: this.com.map(at), angles: this.angles.map(at) };
  }

  comAt(t) {
    const { row, share } = this.place(t);
    const next = Math.min(row + 1, this.poses.count - 1);
    return this.com.map((column) => column[row] + share * (column[next] - column[row]));
  }

  /** Index of the recorded frame whose state holds at time t. */
  contactRow(t) {
    const { first_s, step_s, count } = this.contacts;
    return Math.min(Math.max(Math.floor((t - first_s) / step_s + 1e-6), 0), count - 1);
  }
  touching(leg, t) {
    return this.contacts.count > 0 && this.touches[leg][this.contactRow(t)] > 0.5;
  }

  /** The leg's timer in ticks, or −1 while it is stopped. */
  timer(leg, t) {
    return this.timers[leg][this.place(t).row];
  }

  /** Distance over the ground from the start. */
  distance(t) {
    const com = this.comAt(t);
    return Math.hypot(com[0] - this.com[0][0], com[1] - this.com[1][0]);
  }
  speed(t) {
    const from = Math.max(0, Math.min(t, this.seconds) - SPEED_WINDOW_S / 2);
    const to = Math.min(this.seconds, from + SPEED_WINDOW_S);
    if (!(to > from)) return 0;
    const a = this.comAt(from), b = this.comAt(to);
    return Math.hypot(b[0] - a[0], b[1] - a[1]) / (to - from);
  }
  height(t) {
    return this.comAt(t)[2];
  }

  contactShare(leg) {
    if (this.contacts.count === 0) return 0;
    return this.touches[leg].reduce((sum, touch) => sum + (touch > 0.5), 0) / this.contacts.count;
  }
  everTouched() {
    return this.touches.some((touch) => touch.some((value) => value > 0.5));
  }
}

/** Where a column of 0 and 1 is 1: [first row, row after the last]. */
export function runs(column) {
  const found = [];
  for (let k = 0; k < column.length; ++k) {
    if (!(column[k] > 0.5)) continue;
    const first = k;
    while (k < column.length && column[k] > 0.5) ++k;
    found.push([first, k]);
  }
  return found;
}

/**
 * Runs of touches without chatter, as src/gait/meter.hpp takes it out: gaps of fewer than `least` rows are
 * closed, then stances of fewer rows dropped. Gives {stances, gaps, touches}; the last two are what did not count.
 */
export function footfalls(touched, least) {
  const joined = [], gaps = [];
  for (const [first, end] of touched) {
    const stance = joined.at(-1);
    if (stance && first - stance[1] < least) {
      gaps.push([stance[1], first]);
      stance[1] = end;
    } else {
      joined.push([first, end]);
    }
  }
  const counts = ([first, end]) => end - first >= least;
  const stances = joined.filter(counts);
  const within = ([first]) => stances.some((stance) => stance[0] <= first && first < stance[1]);
  return { stances, gaps: gaps.filter(within), touches: joined.filter((stance) => !counts(stance)) };
}

/** When a column of 0 and 1 became 1: the beginning of that step. */
export function onsets(column, step_s) {
  const found = [];
  for (let k = 0; k < column.length; ++k)
    if (column[k] > 0.5 && !(k > 0 && column[k - 1] > 0.5)) found.push(k * step_s);
  return found;
}

/** Puts into root[3 … 6] the rotation between two rows, by the shorter way. */
function turnBetween(columns, row, share, root) {
  const from = columns.slice(3).map((column) => column[row]);
  const to = columns.slice(3).map((column) => column[row + 1]);
  const sign = from.reduce((sum, value, i) => sum + value * to[i], 0) < 0 ? -1 : 1;
  const mixed = from.map((value, i) => value + share * (sign * to[i] - value));
  const length = Math.hypot(...mixed);
  mixed.forEach((value, i) => (root[3 + i] = value / length));
}
