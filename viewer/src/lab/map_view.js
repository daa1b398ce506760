// A map of elites that fills: a cell for each kind of walk, as dark as its best gets far. A cell that is chosen walks.
import { number } from "../plot.js";
import { element } from "../theme.js";
import { mapBins } from "./plan.js";

export class MapView {
  /** `choose(cell)` is called for a cell that has a walker. */
  constructor(choose) {
    this.cells = Array.from({ length: mapBins * mapBins }, (_, i) => this.cell(i, choose));
    const rows = Array.from({ length: mapBins }, (_, r) => element("tr", {}, ...this.cells.slice(r * mapBins, (r + 1) * mapBins).map(({ box }) => box)));
    this.note = element("p", { class: "lead" });
    this.table = element("table", { class: "lab-map", "aria-label": "The map: rows by how high the body is carried, columns by how long feet are on the ground" }, ...rows);
    this.element = element("div", {}, this.table,
      element("p", { class: "map-axis" }, "← feet in the air · feet on the ground →; top: body high, bottom: low"), this.note);
  }

  cell(i, choose) {
    const column = i % mapBins, row = mapBins - 1 - Math.floor(i / mapBins);
    const id = column * mapBins + row; // the last descriptor's bin is the first digit
    const button = element("button", { type: "button", tabindex: "-1", disabled: "", "aria-label": "empty" });
    button.addEventListener("click", () => {
      choose(id);
    });
    button.addEventListener("keydown", (event) => this.move(event, i));
    return { id, place: `column ${column + 1}, row ${row + 1} from below`, button, box: element("td", {}, button) };
  }

  /** Which cell walks; null: none. */
  mark(chosen) {
    for (const { id, button } of this.cells) button.setAttribute("aria-pressed", String(id === chosen));
  }

  /** Arrow keys go to the next cell that is filled. */
  move(event, from) {
    const step = { ArrowLeft: -1, ArrowRight: 1, ArrowUp: -mapBins, ArrowDown: mapBins }[event.key];
    if (!step) return;
    event.preventDefault();
    for (let i = from + step; i >= 0 && i < this.cells.length; i += step)
      if (!this.cells[i].button.disabled) return this.focus(i);
  }
  focus(i) {
    for (const { button } of this.cells) button.tabIndex = -1;
    this.cells[i].button.tabIndex = 0;
    this.cells[i].button.focus();
  }

  begin() {
    for (const { button } of this.cells) {
      button.disabled = true;
      button.style.removeProperty("--far");
      button.setAttribute("aria-label", "empty");
    }
    this.note.textContent = "";
    this.mark(null);
  }

  add({ map, unit }) {
    if (!map) return;
    const best = Math.max(0.01, ...map.map(([, score]) => score)), by = new Map(map), scored = (score) => number(score, 2) + unit;
    let first = null;
    for (const { id, place, button } of this.cells) {
      const score = by.get(id);
      button.disabled = score === undefined;
      if (score === undefined) {
        button.style.removeProperty("--far");
        continue;
      }
      first ??= button;
      button.style.setProperty("--far", `${Math.round(100 * (0.12 + (0.88 * score) / best))}%`);
      button.setAttribute("aria-label", `${place}: ${scored(score)}`);
      button.title = scored(score);
    }
    if (first && !this.cells.some(({ button }) => button.tabIndex === 0 && !button.disabled)) first.tabIndex = 0;
    this.note.textContent = `${map.length} of ${this.cells.length} cells are filled; the best of them gets ${scored(best)}. Choose one, and it walks.`;
  }
}
