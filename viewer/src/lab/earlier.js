// The best walkers of runs before, which can walk once more beside that of now.
import { element } from "../theme.js";
import { button } from "../widgets.js";

const MOST = 3; // as many as there are curves of runs before

export class Earlier {
  /** `show(run)`: for a run that was chosen, {name, text, generation}. */
  constructor(show) {
    this.show = show;
    this.runs = []; // the latest first
    this.element = element("div", { class: "earlier", role: "group", "aria-labelledby": "earlier-title", hidden: "" });
  }

  add(run) {
    this.runs = [run, ...this.runs].slice(0, MOST);
    this.refresh();
  }
  forget() {
    this.runs = [];
    this.refresh();
  }

  refresh() {
    this.element.hidden = !this.runs.length;
    this.element.replaceChildren(element("p", { class: "look", id: "earlier-title" }, "Let the best of a run before walk once more:"),
      element("div", { class: "lab-buttons" }, ...this.runs.map((run) => button(run.name, () => this.show(run)))));
  }
}
