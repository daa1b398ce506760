// The map of a run that fills one: a grid as a picture, each cell as dark as its best gets far. A cell that is chosen walks.
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
const STEPS = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1] };

export class MapPicture {
  /** `choose(cell)` is called for a cell that is filled. */
  constructor(choose) {
    Object.assign(this, { choose, map: null, chosen: null, places: new Map() });
    this.picture = new Picture("The map", "lab-cells", (width) => (this.map?.axes.length > 1 ? Math.min(width, 460) : 40), (...all) => this.paint(...all));
    this.canvas = this.picture.element;
    this.canvas.tabIndex = 0;
    this.canvas.setAttribute("role", "button");
    this.canvas.addEventListener("click", (event) => this.hit(event));
    this.canvas.addEventListener("keydown", (event) => this.move(event));
    this.note = element("p", { class: "map-axis" });
    this.element = element("div", {}, this.canvas, this.note);
  }

  /** Gives what is to be said of it. */
  show(map, unit) {
    Object.assign(this, { map, unit });
    this.best = Math.max(1e-9, ...map.filled.map(([, objective]) => objective));
    this.element.hidden = map.axes.length === 0;
    this.places = new Map(map.filled.map(([cell, objective]) => {
      const { column, row } = placeOf(map.axes, cell);
      return [`${column},${row}`, { cell, objective, column, row }];
    }));
    if (map.axes.length) {
      this.note.textContent = `To the right: ${names(map.axes, 0)}${map.axes.length > 1 ? `; up: ${names(map.axes, 1)}` : ""}`;
      this.mark(this.chosen);
    }
    const walks = map.axes.length ? " Choose one, and it walks: by a click, or by the arrow keys." : "";
    return `${map.count} of ${map.cells} cells are filled${map.filled.length ? `; the best of them gets ${number(this.best, 2)}${unit}.${walks}` : "."}`;
  }

  /** Shows which cell walks; null: none. */
  mark(cell) {
    this.chosen = cell;
    const place = this.placeOfChosen(), which = place ? ` Cell ${cell} is chosen: ${number(place.objective, 2)}${this.unit}.` : "";
    this.picture.label(`The map: ${this.map?.count ?? 0} of ${this.map?.cells ?? 0} cells are filled.${which} Arrow keys choose the next that is filled, and it walks.`);
    this.picture.repaint();
  }
  placeOfChosen() {
    return this.chosen === null ? undefined : [...this.places.values()].find(({ cell }) => cell === this.chosen);
  }

  hit({ offsetX, offsetY }) {
    if (!this.map?.axes.length) return;
    const { axes } = this.map, { clientWidth, clientHeight } = this.canvas, rows = count(axes, 1);
    const column = Math.floor((offsetX / clientWidth) * count(axes, 0)), row = rows - 1 - Math.floor((offsetY / clientHeight) * rows);
    const place = this.places.get(`${column},${row}`);
    if (place) this.choose(place.cell);
  }

  /** Arrow keys go to the nearest cell on that side that is filled; from none, and by Enter, to the best. */
  move(event) {
    const step = STEPS[event.key], from = this.placeOfChosen();
    if ((!step && event.key !== "Enter") || event.ctrlKey || event.metaKey || event.altKey) return;
    event.preventDefault();
    event.stopPropagation();
    const next = step && from ? this.nextTo(from, step) : from ?? this.bestPlace();
    if (next) this.choose(next.cell);
  }
  nextTo(from, [right, up]) {
    let nearest = null, least = Infinity;
    for (const place of this.places.values()) {
      const x = place.column - from.column, y = place.row - from.row, ahead = x * right + y * up, aside = Math.abs(x * up) + Math.abs(y * right);
      const far = ahead + 3 * aside;
      if (ahead > 0 && far < least) [nearest, least] = [place, far];
    }
    return nearest;
  }
  bestPlace() {
    return [...this.places.values()].reduce((best, place) => (!best || place.objective > best.objective ? place : best), null);
  }

  paint(context, width, height) {
    if (!this.map?.axes.length) return;
    const { axes } = this.map, rows = count(axes, 1), wide = width / count(axes, 0), tall = height / rows;
    const box = ({ column, row }) => [column * wide, (rows - 1 - row) * tall, Math.max(wide - 0.6, 0.6), Math.max(tall - 0.6, 0.6)];
    context.fillStyle = colour("--panel");
    context.fillRect(0, 0, width, height);
    context.fillStyle = colour("--c0");
    for (const place of this.places.values()) {
      context.globalAlpha = 0.12 + 0.88 * Math.min(Math.max(place.objective / this.best, 0), 1);
      context.fillRect(...box(place));
    }
    context.globalAlpha = 1;
    const chosen = this.placeOfChosen();
    if (!chosen) return;
    const [x, y, w, h] = box(chosen);
    context.strokeStyle = colour("--c1");
    context.lineWidth = 2.5;
    context.strokeRect(x - 1, y - 1, w + 2, h + 2);
  }
}
