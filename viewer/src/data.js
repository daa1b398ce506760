// Reads what src/page put into the page.

/** The JSON in the page. */
export function pageData(document) {
  return JSON.parse(document.getElementById("amble-data").textContent);
}

/** Undoes deflate and base64. */
export async function inflate(base64) {
  const bytes = Uint8Array.from(atob(base64), (character) => character.charCodeAt(0));
  const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream("deflate"));
  return new Uint8Array(await new Response(stream).arrayBuffer());
}

/** The same of a text; null of null. */
export async function inflateText(base64) {
  return base64 === null ? null : new TextDecoder().decode(await inflate(base64));
}

/**
 * Frames as src/record packs them: the bytes of the float32 numbers sorted, all highest bytes first, column by
 * column. Gives {count, first_s, step_s, get(name) → Float32Array or undefined}.
 */
export async function unpackFrames({ columns, first_s, step_s, count, data }) {
  const sorted = await inflate(data);
  const all = columns.length * count;
  if (sorted.length !== 4 * all) throw new Error("the data in this page is damaged");
  const bits = new Uint32Array(all);
  for (let i = 0; i < all; ++i)
    bits[i] = (sorted[i] << 24) | (sorted[all + i] << 16) | (sorted[2 * all + i] << 8) | sorted[3 * all + i];
  const values = new Float32Array(bits.buffer);
  const byName = new Map(columns.map((name, c) => [name, values.subarray(c * count, (c + 1) * count)]));
  return { count, first_s, step_s, names: columns, get: (name) => byName.get(name) };
}
