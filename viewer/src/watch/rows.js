// Lines of generations.csv as what the curve draws.
const MOST = 3000; // points of a curve

/** By the table's header, a function from a line to a row. Columns that a run has not are NaN. */
export function rowReader(header) {
  const names = header.split(",");
  return (line) => {
    const cells = line.split(","), row = {};
    names.forEach((name, i) => (row[name] = cells[i] === "" ? NaN : Number(cells[i])));
    return { ...row, count: row.species, species: [] };
  };
}

/** All of them if there are few, else evenly chosen ones and the last. */
export function thinned(rows, most = MOST) {
  const step = Math.ceil(rows.length / most);
  return step <= 1 ? rows : rows.filter((row, i) => i % step === 0 || i === rows.length - 1);
}

/** "0:07", "12:30", "3:05:00". */
export function clockText(seconds) {
  const whole = Math.max(0, Math.round(seconds)), two = (value) => String(value).padStart(2, "0");
  const hours = Math.floor(whole / 3600), minutes = Math.floor(whole / 60) % 60;
  return hours > 0 ? `${hours}:${two(minutes)}:${two(whole % 60)}` : `${minutes}:${two(whole % 60)}`;
}
