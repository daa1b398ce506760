// node --experimental-wasm-relaxed-simd measure.mjs FOLDER CHAMPION...: us per robot-step in each module, of one robot and of sixteen.
import { readFileSync } from "node:fs";
import { join } from "node:path";
import { Machine } from "../../viewer/src/amble.js";

const [, , folder, ...champions] = process.argv;
for (const name of ["exact", "relaxed", "rounding"]) {
  const machine = await Machine.start(await WebAssembly.compile(readFileSync(join(folder, `measure-${name}.wasm`))));
  for (const path of champions) {
    const bytes = readFileSync(path), { memory, amble_text, amble_measure } = machine.exports;
    const at = amble_text(bytes.length);
    new Uint8Array(memory.buffer, at, bytes.length).set(bytes);
    const [one, sixteen] = [1, 16].map((robots) => amble_measure(at, bytes.length, robots, 1000).toFixed(1));
    console.log(`${path}, ${name}${machine.isExact() ? "" : " (other bits)"}: 1 robot ${one}, 16 robots ${sixteen} us per robot-step`);
  }
}
