// A map of elites: which cells walk, as the page's address says (#cells=12,40), and how others are chosen.
import { element } from "./theme.js";

const MOST_ABREAST = 2;

/** The cells that the address names, of those that the page has walkers of; the first walker's if none. */
export function chosenCells(walkers, hash) {
  const named = /(?:^#|&)cells=([\d,]+)/.exec(hash)?.[1].split(",").map(Number) ?? [];
  const known = [...new Set(named)].filter((cell) => walkers.some((walker) => walker.cell === cell));
  return known.length ? known.slice(0, MOST_ABREAST) : [walkers[0].cell];
}

/** The cells after a choice: the chosen one alone, or beside the first of those that walk. */
export function afterChoice(cells, cell, beside) {
  if (!beside) return [cell];
  if (cells.includes(cell)) return cells.length > 1 ? cells.filter((other) => other !== cell) : cells;
  return [...cells.slice(0, MOST_ABREAST - 1), cell];
}

/** A figure that came with the page. */
function figure(svg, className) {
  const box = element("div", { class: `scroll ${className}` });
  box.innerHTML = svg;
  return box;
}

/** A table whose rows are cells that can be chosen. */
function table({ table: [head, ...rows], table_title, table_note }, cells, onChoose) {
  const body = rows.map((row) => {
    const cell = Number(row[0]);
    const choose = element("button", { type: "button", "aria-pressed": String(cells.includes(cell)) }, row[0]);
    choose.addEventListener("click", (event) => onChoose(afterChoice(cells, cell, event.shiftKey)));
    return element("tr", {}, element("th", { scope: "row" }, choose), ...row.slice(1).map((text) => element("td", {}, text)));
  });
  const made = element("table", { class: "trials" }, element("tr", {}, ...head.map((text) => element("th", { scope: "col" }, text))), ...body);
  return [element("h2", {}, table_title), element("p", { class: "lead" }, table_note), element("div", { class: "scroll", tabindex: "0", role: "group", "aria-label": table_title }, made)];
}

/** Fills the section of the map. `onChoose` gets the cells that shall walk. */
export function showMap(section, { map, walkers }, cells, onChoose) {
  const picture = figure(map.svg, "map-box");
  picture.firstElementChild.setAttribute("role", "group"); // in a picture as such screen readers find no buttons
  for (const walker of walkers) {
    const group = picture.querySelector(`.cell${walker.cell}`);
    group.classList.add("walks");
    group.setAttribute("role", "button");
    group.setAttribute("tabindex", "0");
    group.setAttribute("aria-label", walker.title);
    group.setAttribute("aria-pressed", String(cells.includes(walker.cell)));
    const place = cells.indexOf(walker.cell);
    if (place >= 0) group.classList.add("chosen", `walker${place}`);
    group.addEventListener("click", (event) => onChoose(afterChoice(cells, walker.cell, event.shiftKey)));
    group.addEventListener("keydown", (event) => {
      if (event.key !== "Enter" && event.key !== " ") return;
      event.preventDefault();
      onChoose(afterChoice(cells, walker.cell, event.shiftKey));
    });
  }
  section.hidden = false;
  section.append(element("h2", {}, "Map"), element("p", { class: "lead" }, map.note), picture);
  if (map.table.length) section.append(...table(map, cells, onChoose));
  if (map.curves_svg)
    section.append(element("details", {}, element("summary", {}, "How it filled"),
      element("p", { class: "lead" }, "The candidates of each generation, and the map after it."),
      figure(map.curves_svg, "curves-box")));
}
