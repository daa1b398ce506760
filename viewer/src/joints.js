// What the diagrams need to know of a joint.

/** The angles between which a joint is drawn, rad: those it is commanded to, else its stops, if it has any. */
export function rangeOf({ command_rad, lower_rad, upper_rad }) {
  if (command_rad && command_rad[0] < command_rad[1]) return command_rad;
  return Number.isFinite(lower_rad) && Number.isFinite(upper_rad) ? [lower_rad, upper_rad] : [-Math.PI, Math.PI];
}
