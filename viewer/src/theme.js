// The page's colours, for what is painted and not styled.

const LEG_COLOURS = 8;
let cache = new Map();

/** A custom property of the page, as "--ink". */
export function colour(name) {
  if (!cache.has(name)) cache.set(name, getComputedStyle(document.documentElement).getPropertyValue(name).trim());
  return cache.get(name);
}
export const legColour = (leg) => colour("--c" + (leg % LEG_COLOURS));
/** A class that sets --leg. */
export const legClass = (leg) => "leg" + (leg % LEG_COLOURS);
/** Trunk of a walker: the first is grey. */
export const walkerColour = (walker) => colour("--w" + (walker % 4));
/** Its curves and path: the same, as strong as lines must be. */
export const walkerLineColour = (walker) => colour("--l" + (walker % 4));

/** Calls `listener` when light, dark or paper takes over. */
export function onThemeChange(listener) {
  for (const query of ["(prefers-color-scheme: dark)", "print"])
    matchMedia(query).addEventListener("change", () => {
      cache = new Map();
      listener();
    });
}

/** An element with attributes, style class and children. */
export function element(tag, attributes = {}, ...children) {
  const made = document.createElement(tag);
  for (const [name, value] of Object.entries(attributes)) made.setAttribute(name, value);
  made.append(...children);
  return made;
}

/** The same for SVG. */
export function svgElement(tag, attributes = {}, ...children) {
  const made = document.createElementNS("http://www.w3.org/2000/svg", tag);
  for (const [name, value] of Object.entries(attributes)) made.setAttribute(name, value);
  made.append(...children);
  return made;
}
