// What diagrams over generations share: their margins, their axes, and the lines of their keys.
import { niceStep } from "../plot.js";
import { element, svgElement } from "../theme.js";
import { line, write } from "./picture.js";

export const LEFT = 54, RIGHT = 12, TOP = 12, AXIS = 24;

/** A hairline at each tick, with its number; the highest with the unit. */
export function paintLevels(context, ticks, { text, unit, y, width }) {
  for (const tick of ticks) {
    line(context, [[LEFT, y(tick)], [width - RIGHT, y(tick)]], "--hair", 1);
    write(context, tick === ticks.at(-1) ? text(tick) + unit : text(tick), LEFT - 8, y(tick), { align: "right", size: 11.5 });
  }
}

/** Generations from 0 to `most`, at the height `y`. */
export function paintGenerations(context, x, y, most, width) {
  const step = Math.max(1, niceStep(most, width < 500 ? 4 : 8));
  write(context, "generation 0", LEFT - 8, y, { size: 11.5 });
  for (let at = step; at <= most; at += step)
    if (x(at) > LEFT + 84) write(context, String(at), Math.min(x(at), width - RIGHT - 8), y, { align: "center", size: 11.5 });
}

/** A line as in the picture, and what it is. */
export function lineKey(text, css, thick, dash = []) {
  const shown = svgElement("line", { x1: 1, y1: 5, x2: 27, y2: 5, stroke: `var(${css})`, "stroke-width": Math.max(thick, 1.4), "stroke-dasharray": dash.join(" "), "stroke-linecap": "round" });
  return element("span", { class: "line-key" }, svgElement("svg", { width: 28, height: 10, "aria-hidden": "true" }, shown), text);
}
