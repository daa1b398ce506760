// A thread of the lab: the run itself, or trials of genomes. Gets {id, does, with: […]}; gives {id, value} or {id, error}.
import { Machine } from "../amble.js";

const STEPS = 200; // of sixteen robots at a time

let machine, started;

/** Genomes for as many threads, in fours, which the module computes as one, and at most sixteen at a time. */
function chunks(threads) {
  const { exports } = machine, all = exports.amble_run_candidates();
  const size = Math.max(1, Math.min(16, 4 * Math.ceil(all / threads / 4)));
  const made = [];
  for (let first = 0; first < all; first += size) {
    exports.amble_run_candidates_of(first, Math.min(size, all - first));
    made.push({ first, bytes: machine.givenBytes() });
  }
  return made;
}

function files() {
  return JSON.parse(machine.take("run_files")).map((path) => {
    machine.give("run_give_file", path);
    return { path, bytes: machine.givenBytes() };
  });
}

/** A file for the module: path, zero byte, content. */
function giveFile({ path, bytes }) {
  const name = new TextEncoder().encode(path), all = new Uint8Array(name.length + 1 + bytes.length);
  all.set(name);
  all.set(bytes, name.length + 1);
  machine.give("run_file", all);
}

const CAN = {
  start() {},
  plan: (text) => machine.give("run_plan", text),
  // The run.
  begin() {
    machine.exports.amble_run_begin();
    return JSON.parse(machine.take("run_describe"));
  },
  resume(all) {
    all.forEach(giveFile);
    machine.exports.amble_run_resume();
    return JSON.parse(machine.take("run_describe"));
  },
  change: (text) => machine.give("run_change", text),
  chunks,
  take: (first, bytes) => machine.give("run_take", bytes, first),
  tell: (wall_s) => JSON.parse(machine.take("run_tell", wall_s)),
  progress: () => JSON.parse(machine.take("run_progress")),
  first: () => machine.take("run_first"),
  champion: () => machine.take("run_champion"),
  elite: (cell) => machine.take("run_elite", cell),
  files,
  // Trials.
  evaluate(generation, bytes) {
    machine.give("trials_begin", bytes, generation);
    while (!machine.exports.amble_trials_advance(STEPS));
    machine.exports.amble_trials_told();
    return machine.givenBytes();
  },
  facts(text) {
    machine.give("robot_facts", text);
    return JSON.parse(machine.given());
  },
};

// What is asked for while the module starts, which some browsers take longer for, waits for it; if it cannot start, all fails by its message.
onmessage = async ({ data: { id, does, with: values } }) => {
  try {
    if (does === "start") started = Machine.start(...values);
    machine = await started;
    postMessage({ id, value: await CAN[does](...values) });
  } catch (error) {
    postMessage({ id, error: error.message });
  }
};
