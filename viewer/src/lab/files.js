// What the lab saves and opens: champions, robots, and runs as folders in one file.
import { element } from "../theme.js";
import { generationsOf } from "./table.js";
import { fromTar, isTar, toTar } from "./tar.js";

const FOLDER = "amble-run";
const VERSION = 1;

export function download(blob, name) {
  const link = element("a", { href: URL.createObjectURL(blob), download: name });
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 10_000);
}

/** A run's files with what the lab remembers of it ({settings, history, marks, changes}), as a tar of the folder. */
export function runBlob(files, memory) {
  const lab = new TextEncoder().encode(JSON.stringify({ format: "amble-lab", version: VERSION, ...memory }));
  return toTar([...files, { path: "lab.json", bytes: lab }].map(({ path, bytes }) => ({ path: `${FOLDER}/${path}`, bytes })));
}

/**
 * What a file is: {run: {files, plan, memory}}, {champion: text} or {robot: text}. Throws an Error that says what is wrong.
 * @param {Uint8Array} bytes
 */
export function readFile(bytes) {
  if (isTar(bytes)) return { run: readRun(fromTar(bytes)) };
  let json;
  const text = new TextDecoder().decode(bytes);
  try {
    json = JSON.parse(text);
  } catch {
    throw new Error("it is neither a robot.json, nor a champion’s file, nor a run that the lab has saved");
  }
  if (json?.format === "amble-champion") return { champion: text };
  if (json?.format === "amble-robot") return { robot: text };
  throw new Error(`it is JSON, but no robot, champion or run of amble${json?.format ? ` (its format: ${json.format})` : ""}`);
}

function readRun(all) {
  const files = all.map(({ path, bytes }) => ({ path: path.replace(/^(\.\/)?[^/]+\//, ""), bytes }));
  const text = (path) => {
    const file = files.find((one) => one.path === path);
    if (!file) throw new Error(`there is no ${path} in it: the lab opens runs that it has saved`);
    return new TextDecoder().decode(file.bytes);
  };
  const memory = JSON.parse(text("lab.json")), config = JSON.parse(text("config.json")), robot = text("robot.json");
  if (memory.format !== "amble-lab" || memory.version !== VERSION) throw new Error("its lab.json is of another version");
  config.generations = generationsOf(text("config.toml"), config.generations); // which amble resume makes longer
  const plan = JSON.stringify({ config, robot, new: false });
  return { files: files.filter(({ path }) => path !== "lab.json"), plan, table: text("generations.csv"), memory, robot };
}
