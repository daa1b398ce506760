// The map of a run that fills one: a grid as a picture, each cell as dark as its best gets far.
import { colour, element } from "../theme.js";
import { number } from "../plot.js";
import { Picture } from "../lab/picture.js";

/** The place of a cell: dimensions nest as in figures/map_figure.hpp, the last one's bin running fastest. */
export function placeOf(axes, cell) {
  const bins = axes.map(() => 0);
  for (let i = axes.length - 1; i >= 0; --i) {
    bins[i] = cell % axes[i].bins;
    cell = Math.floor(cell / axes[i].bins);
  }
  const along = (first) => axes.reduce((at, axis, i) => (i % 2 === first ? at * axis.bins + bins[i] : at), 0);
  return { column: along(0), row: along(1) };
}

const across = (axes, first) => axes.filter((_, i) => i % 2 === first);
const count = (axes, first) => across(axes, first).reduce((product, { bins }) => product * bins, 1);
const names = (axes, first) => across(axes, first).map(({ name }) => name.replaceAll("_", " ")).join(", within it ");

export class MapPicture {
  constructor() {
    this.map = null;
    this.picture = new Picture("The map", "lab-cells", (width) => (this.map?.axes.length > 1 ? Math.min(width, 460) : 40), (...all) => this.paint(...all));
    this.note = element("p", { class: "map-axis" });
    this.element = element("div", {}, this.picture.element, this.note);
  }

  /** Gives what is to be said of it. */
  show(map, unit) {
    this.map = map;
    this.best = Math.max(1e-9, ...map.filled.map(([, objective]) => objective));
    this.element.hidden = map.axes.length === 0;
    if (map.axes.length) {
      this.note.textContent = `To the right: ${names(map.axes, 0)}${map.axes.length > 1 ? `; up: ${names(map.axes, 1)}` : ""}`;
      this.picture.label(`The map: ${map.count} of ${map.cells} cells are filled`);
      this.picture.repaint();
    }
    return `${map.count} of ${map.cells} cells are filled${map.filled.length ? `; the best of them gets ${number(this.best, 2)}${unit}` : ""}.`;
  }

  paint(context, width, height) {
    if (!this.map?.axes.length) return;
    const { axes, filled } = this.map, rows = count(axes, 1), wide = width / count(axes, 0), tall = height / rows;
    context.fillStyle = colour("--panel");
    context.fillRect(0, 0, width, height);
    context.fillStyle = colour("--c0");
    for (const [cell, objective] of filled) {
      const { column, row } = placeOf(axes, cell);
      context.globalAlpha = 0.12 + 0.88 * Math.min(Math.max(objective / this.best, 0), 1);
      context.fillRect(column * wide, (rows - 1 - row) * tall, Math.max(wide - 0.6, 0.6), Math.max(tall - 0.6, 0.6));
    }
    context.globalAlpha = 1;
  }
}
