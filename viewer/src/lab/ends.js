// Where robots ended, seen from above: dots of this generation over those of generations before; under novelty search rings, too: the
// archive of those that ended where none had, with which the next are compared.
import { niceStep, number } from "../plot.js";
import { colour } from "../theme.js";
import { Picture, line, write } from "./picture.js";

const KEPT = 60; // generations whose dots stay
const PAD = 14;

export class Ends {
  constructor() {
    this.generations = [];
    this.archive = null;
    this.picture = new Picture("Where the robots ended, from above", "lab-ends", (width) => Math.min(0.8 * width, 340), (...all) => this.paint(...all));
    this.element = this.picture.element;
  }

  begin() {
    this.generations = [];
    this.archive = null;
    this.picture.repaint();
  }
  add({ ends, archive = null }) {
    this.generations.push(ends);
    this.archive = archive;
    if (this.generations.length > KEPT) this.generations.shift();
    this.picture.label(`Where the ${ends.length / 2} robots of this generation ended, from above: up to ${number(farthest(ends), 1)} m from the start${archive ? `; rings: the ${archive.length / 2} of the archive` : ""}`);
    this.picture.repaint();
  }

  paint(context, width, height) {
    const reach = Math.max(0.3, farthest(this.archive ?? []), ...this.generations.map(farthest));
    const scale = (Math.min(width, height) / 2 - PAD) / reach, x0 = width / 2, y0 = height / 2;
    const step = niceStep(reach, 3);
    for (let r = step; r * scale <= Math.min(width, height) / 2; r += step) {
      context.beginPath();
      context.arc(x0, y0, r * scale, 0, 2 * Math.PI);
      context.strokeStyle = colour("--hair");
      context.lineWidth = 1;
      context.stroke();
      if (r * scale < height / 2 - 12) write(context, `${number(r, step < 1 ? 1 : 0)} m`, x0 + 4, y0 - r * scale - 6, { size: 11 });
    }
    this.generations.forEach((ends, i) => {
      const now = i === this.generations.length - 1;
      context.fillStyle = colour(now ? "--c1" : "--soft");
      context.globalAlpha = now ? 0.9 : 0.16;
      for (let k = 0; k < ends.length; k += 2) {
        // Forward is up, left is left.
        context.beginPath();
        context.arc(x0 - ends[k + 1] * scale, y0 - ends[k] * scale, now ? 2.8 : 1.8, 0, 2 * Math.PI);
        context.fill();
      }
    });
    context.globalAlpha = 1;
    this.paintArchive(context, (x, y) => [x0 - y * scale, y0 - x * scale]);
    line(context, [[x0 - 5, y0], [x0 + 5, y0]], "--ink", 1.4);
    line(context, [[x0, y0 - 5], [x0, y0 + 5]], "--ink", 1.4);
    write(context, "forward ↑", width - 4, 10, { align: "right", size: 11 });
  }

  paintArchive(context, at) {
    if (!this.archive) return;
    context.strokeStyle = colour("--ink");
    context.lineWidth = 1;
    for (let k = 0; k < this.archive.length; k += 2) {
      context.beginPath();
      context.arc(...at(this.archive[k], this.archive[k + 1]), 4.2, 0, 2 * Math.PI);
      context.stroke();
    }
  }
}

/** The largest distance of points [x, y, x, y, …] from the start, m. */
function farthest(ends) {
  let most = 0;
  for (let k = 0; k < ends.length; k += 2) most = Math.max(most, Math.hypot(ends[k], ends[k + 1]));
  return most;
}
