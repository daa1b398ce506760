// A walk that is simulated while it is looked at: the same as a recorded one, but growing at its end.
import { drawCppn } from "./cppn.js";
import { GrowingRates } from "./told_path.js";
import { lostLegs, Walk } from "./walk.js";

const LONGEST_S = 600;
const SPEED_WINDOW_S = 0.5; // before the present; what comes after is not known
const CELLS = 256;

/** A table with a row for each step from 0 on, filled one after the other; arrays keep their places. */
class Table {
  constructor(names, rows, step_s) {
    this.columns = names.map(() => new Float32Array(rows));
    this.byName = new Map(names.map((name, c) => [name, this.columns[c]]));
    Object.assign(this, { names, rows, first_s: 0, step_s, count: 0 });
  }
  get(name) {
    return this.byName.get(name);
  }
  add(values) {
    values.forEach((value, c) => (this.columns[c][this.count] = value));
    ++this.count;
  }
}

/** What happens in a step, without the row of the start. */
class Events {
  constructor(table) {
    Object.assign(this, { table, first_s: table.step_s, step_s: table.step_s });
  }
  get count() {
    return Math.max(this.table.count - 1, 0);
  }
  get(name) {
    return this.table.get(name)?.subarray(1);
  }
}

export class LiveWalk extends Walk {
  /** `live`: a LiveRobot in its start pose; `json`: the recorded walk of the same champion. */
  constructor(live, json) {
    const description = live.describe();
    const names = [...description.columns, "speed", ...(description.commands ? GrowingRates.columns : [])];
    const table = new Table(names, Math.round(LONGEST_S / description.timestep_s) + 1, description.timestep_s);
    const { robot, controller } = description;
    super({ title: json.title, origin: json.origin, cppn_svg: json.cppn_svg, cell: null, gait: null, seconds: 0,
            outcome: "completed", robot, controller, ground: null }, table, new Events(table));
    Object.assign(this, { live, description, table });
    this.force_n = [0, 0, 0]; // pushes as long as it is not zero
    this.kick = { force_n: [0, 0, 0], until_s: 0 }; // the same for a while
    this.command = null; // to be told before the next step
    this.fallen = false;
    this.fell_s = null; // when first
    this.extremes = { speed: [0, 0], height: [Infinity, -Infinity] };
    this.eras = []; // what it walked on and what it was, each from a time on
    this.told = description.commands ? new GrowingRates(this) : null;
    this.readGround();
    this.beginEra();
    this.note();
  }

  get speeds() {
    return this.table.get("speed");
  }
  get full() {
    return this.table.count === this.table.rows;
  }

  /** Begins again at time 0. */
  restart(options) {
    this.live.restart(options);
    this.begin();
  }

  begin() {
    this.kick.until_s = 0;
    this.table.count = 0;
    this.seconds = 0;
    this.outcome = "completed";
    this.fell_s = null;
    this.extremes = { speed: [0, 0], height: [Infinity, -Infinity] };
    this.told?.begin();
    this.renew();
    this.note();
    this.found = null;
  }

  /** The walk of another champion of the same robot, from time 0; `genome`: its network, where the page draws it. */
  become(live, genome = null) {
    this.live = live;
    const description = live.describe(), { controller } = description;
    const cppn_svg = genome && drawCppn(genome, description).outerHTML;
    Object.assign(this, { controller, supg: controller.patterns_rad ? controller : null, cppn_svg });
    this.begin();
  }

  /** Takes over what has changed but the state. */
  renew() {
    this.description = this.live.describe();
    this.robot.gravity_m_s2 = this.description.robot.gravity_m_s2;
    this.readGround();
    this.beginEra();
  }

  /** As its body was then. */
  missingLegs(t) {
    return this.eraAt(t).lost.filter(({ from_s }) => from_s <= t).map(({ leg }) => leg);
  }

  beginEra() {
    this.eras = this.eras.filter(({ from_s }) => from_s < this.seconds);
    this.eras.push({ from_s: this.seconds, ground: this.ground, gravity_m_s2: this.robot.gravity_m_s2, lost: lostLegs(this.robot, this.description.damage) });
  }
  eraAt(time_s) {
    return this.eras.findLast(({ from_s }) => from_s <= time_s) ?? this.eras[0];
  }
  /** What is shown is that of an era. */
  showEra(era) {
    this.ground = era.ground;
    this.robot.gravity_m_s2 = era.gravity_m_s2;
  }

  readGround() {
    const heights = this.live.heights();
    if (!heights) {
      this.ground = null;
      return;
    }
    const wrap = (i) => ((i % CELLS) + CELLS) % CELLS;
    let lowest_m = Infinity, highest_m = -Infinity;
    for (const height of heights) [lowest_m, highest_m] = [Math.min(lowest_m, height), Math.max(highest_m, height)];
    this.ground = { cell_m: this.description.ground.cell_m, height: (i, j) => heights[wrap(j) * CELLS + wrap(i)], lowest_m, highest_m };
  }

  /** Simulates until a time; gives the time that was reached. */
  advance(until_s) {
    const { step_s } = this.table;
    const steps = Math.min(Math.floor((until_s - this.seconds) / step_s + 1e-6), this.table.rows - this.table.count);
    let broken = false;
    for (let i = 0; i < steps && !broken; ++i) {
      const kicked = this.seconds < this.kick.until_s - 1e-9;
      const impulse_n_s = this.force_n.map((part, axis) => (part + (kicked ? this.kick.force_n[axis] : 0)) * step_s);
      if (impulse_n_s.some((part) => part !== 0)) this.live.push(impulse_n_s);
      if (this.command) this.live.command(this.command);
      this.command = null;
      broken = this.live.step(1) === 0;
      if (!broken) this.note();
    }
    if (broken) this.outcome = "diverged";
    return this.seconds;
  }

  /** Adds the state of now as a row. */
  note() {
    const { table } = this, state = this.live.state(this.description.columns.length);
    const row = table.count;
    table.add(state); // the other columns are filled here
    this.seconds = row * table.step_s;
    this.fallen = state[1] > 0;
    if (this.fallen) this.fell_s ??= this.seconds;
    const before = Math.max(0, row - Math.round(SPEED_WINDOW_S / table.step_s)), [x, y, z] = this.com;
    const speed = row > before ? Math.hypot(x[row] - x[before], y[row] - y[before]) / ((row - before) * table.step_s) : 0;
    this.speeds[row] = speed;
    this.told?.add(row);
    const { speed: fast, height } = this.extremes;
    fast[1] = Math.max(fast[1], speed);
    [height[0], height[1]] = [Math.min(height[0], z[row]), Math.max(height[1], z[row])];
  }

  speed(t) {
    return this.speeds[this.place(t).row];
  }
}
