// Heights of uneven ground.
import { unpackFrames } from "./data.js";

/** Heights that repeat themselves; null for the plane. */
export async function unpackGround(json) {
  if (!json) return null;
  const frames = await unpackFrames(json.heights);
  const columns = json.heights.columns.map((name) => frames.get(name));
  const wrap = (i) => ((i % frames.count) + frames.count) % frames.count;
  const height = (i, j) => columns[wrap(i)][wrap(j)] * json.unit_m;
  let lowest = Infinity, highest = -Infinity;
  for (const column of columns)
    for (const value of column) [lowest, highest] = [Math.min(lowest, value), Math.max(highest, value)];
  return { cell_m: json.cell_m, height, lowest_m: lowest * json.unit_m, highest_m: highest * json.unit_m };
}

/** Height of the ground at a place, between its nodes as the engines have it. */
export function heightAt(ground, x_m, y_m) {
  if (!ground) return 0;
  const u = x_m / ground.cell_m, v = y_m / ground.cell_m;
  const i = Math.floor(u), j = Math.floor(v), s = u - i, t = v - j;
  const near = ground.height(i, j) * (1 - s) + ground.height(i + 1, j) * s;
  const far = ground.height(i, j + 1) * (1 - s) + ground.height(i + 1, j + 1) * s;
  return near * (1 - t) + far * t;
}
