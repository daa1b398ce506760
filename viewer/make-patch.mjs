// What one WebAssembly module differs by from another: node make-patch.mjs BASE MODULE PATCH. src/patch.js puts them together again.
//
// A number has seven bits a byte, lowest first, the eighth of each saying that there are more; one with a sign has that as its lowest bit.
// First the module's length. Then, until that is reached: how many bytes are new, and these; how far from the end of the last copy the next one
// begins in the base (signed), and its length; and in it, until it is covered: how many bytes are as they are, how many are not, and what is to
// be added to each of those, modulo 256. Modules that differ in some functions, and so in the numbers of others, differ little by that.
import { readFileSync, writeFileSync } from "node:fs";

const GRAM = 16; // bytes that are looked for as they are
const MOST_PLACES = 8; // that are tried
const LEAST_SCORE = 12; // of a copy: a byte alike counts 1, another −2
const PATIENCE = 24; // by how much the score may fall

const gramAt = (bytes, at) => {
  let hash = 0;
  for (let i = at; i < at + GRAM; ++i) hash = Math.imul(hash, 0x01000193) ^ bytes[i];
  return hash;
};

/** Where each gram stands in the base. */
function placesOf(base) {
  const places = new Map();
  for (let at = 0; at + GRAM <= base.length; ++at) {
    const gram = gramAt(base, at), known = places.get(gram);
    if (!known) places.set(gram, [at]);
    else if (known.length < MOST_PLACES) known.push(at);
  }
  return places;
}

/** How far a copy from there is worth it. */
function copyOf(base, from, module, at) {
  let score = 0, best = 0, length = 0;
  for (let i = 0; from + i < base.length && at + i < module.length && score >= best - PATIENCE; ++i) {
    score += base[from + i] === module[at + i] ? 1 : -2;
    if (score > best) [best, length] = [score, i + 1];
  }
  return { from, length, score: best };
}

class Writer {
  bytes = [];
  number(value) {
    for (; value > 127; value = Math.floor(value / 128)) this.bytes.push((value % 128) | 128);
    this.bytes.push(value);
  }
  signed(value) {
    this.number(value < 0 ? -2 * value - 1 : 2 * value);
  }
  /** Bytes that are new. */
  fresh(bytes) {
    this.number(bytes.length);
    for (const byte of bytes) this.bytes.push(byte);
  }
  /** A copy's bytes that differ. */
  differences(base, from, module, at, length) {
    const alike = (i) => base[from + i] === module[at + i];
    for (let i = 0; i < length; ) {
      let same = i, end;
      while (same < length && alike(same)) ++same;
      for (end = same; end < length && !alike(end); ) ++end;
      this.number(same - i);
      this.number(end - same);
      for (let k = same; k < end; ++k) this.bytes.push((module[at + k] - base[from + k]) & 255);
      i = end;
    }
  }
}

/** @returns {Uint8Array} the patch that makes `module` of `base` */
export function makePatch(base, module) {
  const places = placesOf(base), writer = new Writer();
  writer.number(module.length);
  let written = 0, copied = 0; // how far, in the module and in the base
  for (let at = 0; at < module.length; ) {
    const candidates = [copied + at - written, ...(at + GRAM <= module.length ? (places.get(gramAt(module, at)) ?? []) : [])];
    let best = { score: LEAST_SCORE - 1 };
    for (const from of candidates) {
      const copy = copyOf(base, from, module, at);
      if (copy.score > best.score) best = copy;
    }
    if (best.length === undefined) {
      ++at;
      continue;
    }
    writer.fresh(module.subarray(written, at));
    writer.signed(best.from - copied);
    writer.number(best.length);
    writer.differences(base, best.from, module, at, best.length);
    at += best.length;
    [written, copied] = [at, best.from + best.length];
  }
  if (written < module.length) {
    writer.fresh(module.subarray(written));
    writer.signed(0);
    writer.number(0);
  }
  return Uint8Array.from(writer.bytes);
}

if (import.meta.url === `file://${process.argv[1]}`) {
  const [base, module] = process.argv.slice(2, 4).map((name) => readFileSync(name));
  writeFileSync(process.argv[4], makePatch(base, module));
}
