// The experiments as a list that unfolds.
import { element } from "../theme.js";
import { button } from "../widgets.js";
import { EXPERIMENTS } from "./experiments.js";

/** `setUp(experiment, step)` is called for a step that was chosen. */
export function lessonList(setUp) {
  const list = element("div", { class: "experiments" });
  for (const experiment of EXPERIMENTS) {
    const steps = experiment.steps.map((step) => button(experiment.steps.length > 1 ? step.name : "Set it up", () => setUp(experiment, step)));
    const about = experiment.steps.length > 1 ? "Set up, one after the other:" : "";
    list.append(element("details", { class: "experiment", id: `experiment-${experiment.id}` }, element("summary", {}, experiment.title),
      element("p", { class: "question" }, experiment.question),
      ...(about ? [element("p", { class: "look" }, about)] : []), element("div", { class: "lab-buttons" }, ...steps),
      element("p", { class: "look" }, element("b", {}, "Look: "), experiment.look)));
  }
  list.addEventListener("toggle", ({ target }) => {
    if (target.open) for (const other of list.querySelectorAll("details[open]")) if (other !== target) other.open = false;
  }, true);
  return list;
}
