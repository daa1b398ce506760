// A table of all runs of a folder: how far each is. A run that is chosen is shown above.
import { number } from "../plot.js";
import { element } from "../theme.js";
import { button } from "../widgets.js";
import { clockText } from "./rows.js";

const HEAD = ["run", "generation", "best so far", "typically", "left", "state"];
export const STAGES = { waiting: "not begun", running: "runs", stopped: "stopped", ended: "has ended", gone: "its folder has vanished" };

export class RunList {
  constructor(choose) {
    this.choose = choose;
    this.rows = new Map();
    this.body = element("tbody", {});
    const head = element("thead", {}, element("tr", {}, ...HEAD.map((text) => element("th", { scope: "col" }, text))));
    this.element = element("table", { class: "run-list" }, head, this.body);
  }

  show(summaries, chosen) {
    for (const summary of summaries) {
      const row = this.rows.get(summary.id) ?? this.add(summary.id);
      row.choose.setAttribute("aria-pressed", String(summary.id === chosen));
      if (row.summary === summary) continue;
      row.summary = summary;
      this.fill(row, summary);
    }
  }

  add(id) {
    const choose = button(id, () => this.choose(id)), bar = element("progress", { "aria-hidden": "true" });
    const cells = HEAD.slice(1).map(() => element("td", {})), text = document.createTextNode("");
    cells[0].append(bar, text);
    const line = element("tr", {}, element("th", { scope: "row" }, choose), ...cells);
    const after = [...this.rows].find(([other]) => other > id)?.[1].line ?? null;
    this.body.insertBefore(line, after);
    const row = { choose, bar, text, cells, line };
    this.rows.set(id, row);
    this.rows = new Map([...this.rows].sort(([a], [b]) => (a < b ? -1 : 1)));
    return row;
  }

  fill(row, { done, generations, best, typical, left_s, unit, stage, trouble }) {
    const value = (number_) => (number_ === null ? "–" : number(number_, 2) + unit);
    row.bar.max = Math.max(generations, 1);
    row.bar.value = done;
    row.text.data = generations ? `${done} of ${generations}` : `${done}`;
    const texts = [value(best), value(typical), left_s === null ? "" : clockText(left_s), trouble || STAGES[stage]];
    texts.forEach((text, i) => (row.cells[i + 1].textContent = text));
    row.cells.at(-1).className = `stage-${stage}`;
  }
}
