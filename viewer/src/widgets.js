// What panels are made of.
import { element } from "./theme.js";

export const slider = (min, max, step, value) => element("input", { type: "range", min, max, step, value });

/** A row of a panel: a name, what is chosen by, and its value as text. */
export function row(name, control, text) {
  const output = element("output", {});
  const show = () => (output.textContent = text());
  const label = element("label", { class: "live-row" }, element("span", {}, name), control, output);
  return { label, show };
}

export function button(text, onClick, attributes = {}) {
  const made = element("button", { type: "button", ...attributes }, text);
  made.addEventListener("click", onClick);
  return made;
}

export const group = (title, ...content) => element("fieldset", {}, element("legend", {}, title), ...content);
