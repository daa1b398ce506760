// The curve of a run, from its table (generations.csv), which tells of all generations wherever they were computed; from what the lab
// remembers is the rest, as the sizes of the species.

/** Columns of generations.csv that the curve shows, by their names there. */
const COLUMNS = ["generation", "best", "best_so_far", "median", "typical", "fell"];

/** Rows {generation, best, …, species: [[id, size], …], count} for Curve. `remembered`: those of lab.json. Throws an Error. */
export function historyOf(csv, remembered = []) {
  const [header, ...lines] = csv.trim().split("\n").map((line) => line.split(","));
  const place = (name) => header.indexOf(name), missing = COLUMNS.find((name) => place(name) < 0);
  if (missing) throw new Error(`generations.csv: there is no column ${missing}`);
  const counted = ["species", "elites"].find((name) => place(name) >= 0), known = new Map(remembered.map((row) => [row.generation, row]));
  return lines.map((cells) => {
    const row = Object.fromEntries(COLUMNS.map((name) => [name, Number(cells[place(name)])]));
    const before = known.get(row.generation), same = before?.best === row.best;
    const count = counted ? Number(cells[place(counted)]) : 0;
    return { species: [], ...(same ? before : {}), ...row, ...(counted === "elites" ? { cells: count } : { count }) };
  });
}

/** The generations that a config.toml asks for; `otherwise` where it does not say. */
export function generationsOf(toml, otherwise) {
  const found = /^generations[ \t]*=[ \t]*([0-9_]+)/m.exec(toml);
  return found ? Number(found[1].replaceAll("_", "")) : otherwise;
}
