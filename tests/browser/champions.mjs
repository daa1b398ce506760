// Eleven champions whose sessions (sessions.mjs) are to come out alike natively, in Node.js and in browsers. `node champions.mjs` evolves those
// that are not in robots/.
import { execFileSync, spawnSync } from "node:child_process";
import { copyFileSync, mkdirSync, readdirSync, rmSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { fileURLToPath } from "node:url";

const { AMBLE_PROGRAM, AMBLE_WORK, AMBLE_CHAMPIONS } = process.env;
export const source = (name) => fileURLToPath(new URL(`../../${name}`, import.meta.url));

// All kinds of controllers, robots with two to eight legs, and one that obeys.
const GALLERY = ["servo/champion", "hexapod/champion", "biped/champion", "octopod/champion", "hexapod/steered"];
const EVOLVED = [["quick/quadruped", 3], ["quick/oscillators", 3], ["quick/sine", 3], ["quick/ctrnn", 3], ["quick/quadruped", 4], ["repertoire/hexapod", 2]];

const slug = (config, seed) => `${config.replace("/", "-")}-${seed}`;

/** [name, the path of its file]. */
export const champions = [...GALLERY.map((name) => [name, source(`robots/${name}.json`)]),
                          ...EVOLVED.map(([config, seed]) => [`${config}, seed ${seed}`, join(AMBLE_CHAMPIONS, `${slug(config, seed)}.json`)])];

/** Makes the file of a champion after three generations. */
function evolve([config, seed]) {
  const name = slug(config, seed), run = join(AMBLE_CHAMPIONS, name);
  const options = ["--seed", String(seed), "--generations", "3", "--jobs", "1", "--out", run];
  execFileSync(AMBLE_PROGRAM, ["evolve", source(`configs/${config}.toml`), ...options], { stdio: "ignore" });
  copyFileSync(join(run, "champions", readdirSync(join(run, "champions")).sort().at(-1)), `${run}.json`);
}

/** What the native program says of a session, whose inputs() were these. */
export function again(champion, inputs, name) {
  const path = join(AMBLE_WORK, `${name}.json`);
  writeFileSync(path, inputs);
  return spawnSync(AMBLE_PROGRAM, ["trial", champion, "--inputs", path], { encoding: "utf8" });
}

if (process.argv[1] === fileURLToPath(import.meta.url)) {
  rmSync(AMBLE_CHAMPIONS, { recursive: true, force: true });
  mkdirSync(AMBLE_CHAMPIONS, { recursive: true });
  EVOLVED.forEach(evolve);
}
