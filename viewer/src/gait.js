// Gait name, and duty factor and phase of each leg.
import { element, legClass } from "./theme.js";

const GAITS = { walk_lateral: "lateral walk", walk_diagonal: "diagonal walk" };
const percent = (share) => `${(100 * share).toFixed(0)} %`;

/** `walk.gait` is the result of the gait analysis (see src/view/page.hpp), or null: then duty factors are counted here. */
export function gaitTable(walk) {
  const { gait } = walk;
  const legs = walk.robot.legs.map(({ name }, leg) => {
    const known = gait?.legs?.find((result) => result.name === name);
    return { name, leg, duty: known?.duty_factor ?? walk.dutyFactor(leg), phase: known?.phase, spread: known?.phase_spread };
  });
  const columns = [["Duty factor", ({ duty }) => (duty == null ? "–" : percent(duty))]];
  if (gait) columns.push(["Phase", ({ phase, spread }) =>
    (phase == null ? "–" : `${phase.toFixed(2)}${spread == null ? "" : ` ± ${spread.toFixed(2)}`}`)]);
  const table = element("table", { class: "gait" },
    element("tr", {}, element("th", {}), ...legs.map(({ name, leg }) =>
      element("th", {}, element("span", { class: `key ${legClass(leg)}` }, name)))),
    ...columns.map(([title, value]) =>
      element("tr", {}, element("th", {}, title), ...legs.map((leg) => element("td", {}, value(leg))))));
  const box = element("div", { class: "gait-box" });
  if (gait?.gait) box.append(element("p", { class: "gait-name" }, GAITS[gait.gait] ?? gait.gait));
  box.append(table);
  return box;
}
