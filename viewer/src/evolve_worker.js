// Evolution in a thread of its own, so that the page goes on moving. Gets {module, champion, settings}, then {running} now and then;
// gives {progress} after each generation, with {best}, a champion's file, where there is a new one, and {error} if it cannot go on.
import { Machine } from "./amble.js";

const SLICE_MS = 60; // then it looks whether it is to pause
const STEPS = 10; // of sixteen robots, between two looks at the clock

let machine, running = true, shown = -1;

function slice() {
  const start_ms = performance.now();
  while (running && performance.now() - start_ms < SLICE_MS) {
    if (!machine.exports.amble_evolution_advance(STEPS)) continue;
    const progress = JSON.parse(machine.take("evolution_progress"));
    const best = progress.best_generation === shown ? null : machine.take("evolution_champion");
    shown = progress.best_generation;
    postMessage({ progress, best });
  }
  if (running) setTimeout(attempt);
}

function attempt() {
  try {
    slice();
  } catch (error) {
    postMessage({ error: error.message });
  }
}

onmessage = async ({ data }) => {
  try {
    if (data.module) {
      machine = await Machine.start(data.module);
      machine.give("evolution_of", data.champion);
      machine.give("evolve", JSON.stringify(data.settings));
      return attempt();
    }
  } catch (error) {
    return postMessage({ error: error.message });
  }
  const was = running;
  running = data.running;
  if (running && !was && machine) attempt();
};
