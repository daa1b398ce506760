// A champion that walks in this page: the functions of the WebAssembly module of src/browser, typed. What goes wrong
// in the module ends it; then a new one is brought to where it was, and the message is thrown as an Error.

import { inflate } from "./data.js";
import { patched } from "./patch.js";

/**
 * @typedef {object} Description what does not change from step to step
 * @property {string} experiment
 * @property {number} seed
 * @property {number} generation
 * @property {string} engine in which it walks here
 * @property {string} evolved_in
 * @property {string[]} ground_kinds
 * @property {number} timestep_s
 * @property {number} duration_s of a trial in its evolution
 * @property {number} mass_kg
 * @property {number} recorded_steps in its file, with which stepsAsRecorded() compares; 0: of another engine
 * @property {number} distance_m in its file
 * @property {string[]} columns of state()
 * @property {object} robot as in recordings
 * @property {object} controller as in recordings
 * @property {object} ground all settings of [ground]
 * @property {number | "inf"} friction
 * @property {{parts: object[]}} damage all settings of [damage]
 */

const CELLS = 256; // of uneven ground, in x and in y
const MOST_STEPS = 1e9; // in one call
const MOST_LIFT_M = 100; // src/experiment/problem/live_trial.cpp
const NOT_HERE = 52; // what a system answers that has no such function

/** What the module asks of a system: the time. Everything else it does without. */
function systemFor(module, memory) {
  const functions = {};
  for (const { module: from, name } of WebAssembly.Module.imports(module))
    if (from === "wasi_snapshot_preview1") functions[name] = () => NOT_HERE;
  if (functions.clock_time_get)
    functions.clock_time_get = (_clock, _precision, to) => {
      new DataView(memory().buffer).setBigUint64(to, BigInt(Math.round(performance.now() * 1e6)), true);
      return 0;
    };
  if (functions.proc_exit)
    functions.proc_exit = () => {
      throw new Error("the simulation ended itself");
    };
  return functions;
}

/** A running module: its functions, with texts as strings. */
export class Machine {
  /** @param {WebAssembly.Module} module */
  static async start(module) {
    const machine = new Machine();
    const memory = () => machine.exports.memory;
    const { exports } = await WebAssembly.instantiate(module, {
      amble: {
        fail: (text, size) => {
          throw new Error(machine.text(text, size));
        },
      },
      wasi_snapshot_preview1: systemFor(module, memory),
    });
    machine.exports = exports;
    exports._initialize();
    return machine;
  }

  text(at, size) {
    return new TextDecoder().decode(new Uint8Array(this.exports.memory.buffer, at, size));
  }
  /** Calls a function that takes a text, or bytes. */
  give(name, content, ...numbers) {
    const bytes = typeof content === "string" ? new TextEncoder().encode(content) : content;
    const at = this.exports.amble_text(bytes.length);
    new Uint8Array(this.exports.memory.buffer, at, bytes.length).set(bytes);
    this.exports[`amble_${name}`](...numbers);
  }
  /** Calls a function that gives a text. */
  take(name, ...numbers) {
    this.exports[`amble_${name}`](...numbers);
    return this.given();
  }
  /** What the last function that gives a text gave; the same as bytes, copied. */
  given() {
    return this.text(this.exports.amble_result(), this.exports.amble_result_size());
  }
  givenBytes() {
    return new Uint8Array(this.exports.memory.buffer, this.exports.amble_result(), this.exports.amble_result_size()).slice();
  }
  isExact() {
    return this.exports.amble_is_exact() === 1;
  }
}

/**
 * The modules of a page, the fastest first: with relaxed SIMD, whose multiply-add is one instruction, and the one that every browser takes.
 * @param {Document} document filled by src/page
 */
export async function modulesOf(document) {
  const [bytes, patch] = await Promise.all(["amble-module", "amble-relaxed"].map((id) => inflate(document.getElementById(id).textContent)));
  return [{ name: "relaxed", bytes: patched(bytes, patch) }, { name: "amble", bytes }];
}

/**
 * Compiles the first of these modules that this browser takes and that computes the native program's bits.
 * @param {{name: string, bytes: BufferSource}[]} modules the fastest first
 * @returns {Promise<{name: string, module: WebAssembly.Module}>}
 */
export async function chooseModule(modules) {
  for (const { name, bytes } of modules) {
    if (!WebAssembly.validate(bytes)) continue;
    const module = await WebAssembly.compile(bytes);
    if ((await Machine.start(module)).isExact()) return { name, module };
  }
  throw new Error("This browser does not run the simulation: it needs WebAssembly with SIMD (browsers of 2023 or later).");
}

/** Refuses what is no champion's file before the module sees it. */
function checkChampion(text) {
  let file;
  try {
    file = JSON.parse(text);
  } catch (error) {
    throw new Error(`The champion's file is not valid JSON: ${error.message}`);
  }
  if (file?.format !== "amble-champion") throw new Error("This is not a champion's file of amble.");
}

/** So many single-precision numbers. What the module refuses ends it, so that it is asked for nothing that it would. */
function numbers(what, values, count, unit) {
  const all = Array.from(values ?? []);
  if (all.length !== count || !all.every((value) => typeof value === "number" && Number.isFinite(Math.fround(value))))
    throw new Error(`${what}: expected ${count} numbers, ${unit}`);
  return all;
}

export class LiveRobot {
  /**
   * @param {WebAssembly.Module} module of chooseModule()
   * @param {string} champion the text of its file
   * @returns {Promise<LiveRobot>} in its start pose
   */
  static async open(module, champion) {
    checkChampion(champion);
    const robot = new LiveRobot();
    Object.assign(robot, { module, champion, calls: [] });
    robot.machine = await Machine.start(module);
    robot.machine.give("open", champion);
    robot.hears = robot.describe().commands !== null;
    return robot;
  }

  /** Does it, and remembers it for a module that may have to take over. */
  async call(action) {
    try {
      action(this.machine);
    } catch (error) {
      await this.recover();
      throw new Error(error.message);
    }
    this.calls.push(action);
  }

  async recover() {
    this.machine = await Machine.start(this.module);
    this.machine.give("open", this.champion);
    for (const action of this.calls) action(this.machine);
  }

  /**
   * Advances by so many steps; fewer only if the simulation breaks down.
   * @param {number} count 0 or more
   * @returns {number} steps made
   */
  step(count) {
    if (!(Number.isInteger(count) && count >= 0 && count <= MOST_STEPS)) throw new Error(`step: expected a whole number from 0 to ${MOST_STEPS}, not ${count}`);
    const done = this.machine.exports.amble_step(count);
    const last = this.calls.at(-1);
    if (last?.steps) last.steps += done;
    else this.calls.push(stepsOf(done));
    return done;
  }

  /** An impulse on the root's centre of mass in the next step, N s, world frame. */
  push(impulse) {
    const [x, y, z] = numbers("push", impulse, 3, "N s");
    const action = ({ exports }) => exports.amble_push(x, y, z);
    action(this.machine);
    this.calls.push(action);
  }

  /** Lifts it, as it is, by up to 100 m before the next step, and lets it fall. */
  lift(height_m) {
    if (!(height_m > 0 && height_m <= MOST_LIFT_M)) throw new Error(`lift: expected more than 0 and at most ${MOST_LIFT_M} m, not ${height_m}`);
    const action = ({ exports }) => exports.amble_lift(height_m);
    action(this.machine);
    this.calls.push(action);
  }

  /** What it is told from the next step on: speed along its own axis, m/s, and turning to the left, rad/s. Description.commands is there. */
  command(told) {
    if (!this.hears) throw new Error("command: this champion senses no commands; configs/steer evolves one that does");
    const [speed_m_s, turn_rad_s] = numbers("command", told, 2, "m/s and rad/s");
    const action = ({ exports }) => exports.amble_command(speed_m_s, turn_rad_s);
    action(this.machine);
    this.told = action;
    this.calls.push(action);
  }

  /** The start pose again, on the ground and with the damage of now, or as evolved; the record begins anew. */
  restart({ asEvolved = false } = {}) {
    const { ground, damage } = this.describe();
    this.machine.exports.amble_restart(asEvolved ? 1 : 0);
    this.calls = [];
    if (asEvolved) {
      this.told = null;
      return;
    }
    if (this.told) this.calls.push(this.told);
    // A module that takes over has these before its first step, too.
    this.calls.push((machine) => machine.give("set_ground", JSON.stringify(ground)),
                    (machine) => machine.give("set_damage", JSON.stringify(damage)),
                    (machine) => machine.exports.amble_restart(0));
  }

  /** All settings of [ground], as description().ground has them. Rejects with a message if they do not fit. */
  setGround(settings) {
    const text = JSON.stringify(settings);
    return this.call((machine) => machine.give("set_ground", text));
  }
  /** All that is wrong with the robot from now on: {parts: […]}. Rejects with a message if it has no such parts. */
  setDamage(settings) {
    const text = JSON.stringify(settings);
    return this.call((machine) => machine.give("set_damage", text));
  }

  /** @returns {Description} */
  describe() {
    return JSON.parse(this.machine.take("describe"));
  }
  /** @returns {Float64Array} the values of Description.columns; valid until the next call */
  state(count) {
    const { memory, amble_state } = this.machine.exports;
    const at = amble_state();
    return new Float64Array(memory.buffer, at, count);
  }
  /** @returns {Float32Array | null} heights of uneven ground, 256 × 256, x faster than y; null for the plane */
  heights() {
    const { memory, amble_heights } = this.machine.exports;
    const at = amble_heights();
    return at === 0 ? null : new Float32Array(memory.buffer, at, CELLS * CELLS).slice();
  }
  /** What was done so far, for `amble trial --inputs`. */
  inputs() {
    return this.machine.take("inputs");
  }
  /** A hash of the states after all steps so far. */
  hash() {
    return this.machine.take("hash");
  }
  /** In how many steps, from the first on, its own trial is that of its file, to the bit. */
  stepsAsRecorded() {
    return this.machine.exports.amble_steps_as_recorded();
  }
}

/** An action of so many steps, which more can be added to. */
function stepsOf(count) {
  const action = ({ exports }) => exports.amble_step(action.steps);
  action.steps = count;
  return action;
}
