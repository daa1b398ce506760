// Runs of the lab in Node.js, and the robots of its page.
import { execFileSync } from "node:child_process";
import { mkdirSync, readFileSync, writeFileSync } from "node:fs";
import { dirname, join } from "node:path";
import { inflateSync } from "node:zlib";
import { Machine } from "../../viewer/src/amble.js";

/** Of a page that `amble lab` has made: by name {id, name, text, configs, facts}. */
export async function robotsOf(page, module) {
  const html = readFileSync(page, "utf8");
  const { robots } = JSON.parse(/<script type="application\/json" id="amble-data">(.*?)<\/script>/s.exec(html)[1]);
  const machine = await Machine.start(module), all = new Map();
  for (const robot of JSON.parse(inflateSync(Buffer.from(robots, "base64")).toString())) {
    machine.give("robot_facts", robot.text);
    const root_height_m = JSON.parse(robot.text).robot.bodies[0].position_m[2];
    all.set(robot.name, { ...robot, facts: { ...JSON.parse(machine.given()), root_height_m } });
  }
  return all;
}

/** A run whose trials are in so many modules, `together` genomes at a time. */
export class LabRun {
  static async begin(module, plan, { modules = 1, together = 16, files = null } = {}) {
    const run = new LabRun();
    Object.assign(run, { together, generation: 0, search: await Machine.start(module) });
    run.trials = await Promise.all(Array.from({ length: modules }, () => Machine.start(module)));
    for (const machine of [run.search, ...run.trials]) machine.give("run_plan", plan);
    for (const [path, bytes] of files ?? []) run.search.give("run_file", Buffer.concat([Buffer.from(`${path}\0`), bytes]));
    if (files) run.search.exports.amble_run_resume();
    else run.search.exports.amble_run_begin();
    run.generation = JSON.parse(run.search.take("run_describe")).generation;
    return run;
  }

  /** One generation; what is told of it. The genomes that come last are evaluated first. */
  step() {
    const { search, trials, together } = this, all = search.exports.amble_run_candidates();
    const firsts = [];
    for (let first = 0; first < all; first += together) firsts.unshift(first);
    firsts.forEach((first, i) => {
      search.exports.amble_run_candidates_of(first, Math.min(together, all - first));
      const machine = trials[i % trials.length];
      machine.give("trials_begin", search.givenBytes(), this.generation);
      while (!machine.exports.amble_trials_advance(97));
      machine.exports.amble_trials_told();
      search.give("run_take", machine.givenBytes(), first);
    });
    ++this.generation;
    return JSON.parse(search.take("run_tell", 0.25));
  }

  change(plan) {
    for (const machine of this.trials) machine.give("run_plan", plan);
    this.search.give("run_change", plan);
  }

  /** [path, bytes] of the run's folder. */
  files() {
    return JSON.parse(this.search.take("run_files")).map((path) => {
      this.search.give("run_give_file", path);
      return [path, this.search.givenBytes()];
    });
  }
  save(folder) {
    for (const [path, bytes] of this.files()) {
      mkdirSync(dirname(join(folder, path)), { recursive: true });
      writeFileSync(join(folder, path), bytes);
    }
    return folder;
  }
}

/** The table of a run without its times. */
export function table(folder) {
  const lines = readFileSync(join(folder, "generations.csv"), "utf8").trim().split("\n").map((line) => line.split(","));
  const times = lines[0].indexOf("wall_s");
  return lines.map((cells) => cells.slice(0, times).join(","));
}

export const amble = (...words) => execFileSync(process.env.AMBLE_PROGRAM, words, { encoding: "utf8", stdio: ["ignore", "pipe", "pipe"] });
