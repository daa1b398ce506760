// The ground: lines and numbers of the distance, shadows, and the way of the centre of mass.
import {
  BufferAttribute, BufferGeometry, CanvasTexture, Group, Mesh, MeshBasicMaterial, PlaneGeometry, ShadowMaterial,
  SRGBColorSpace,
} from "three";
import { drawAs } from "./drawing.js";
import { heightAt } from "./heights.js";
import { colour } from "./theme.js";

const LINES = 24; // to each side
const LABELS = 6;
const ABOVE_M = 0.01; // of the path over uneven ground, whose triangles are not quite its own

/** 1, 2 or 5 × 10^k near `size`, never above it: the distance between marks. */
export function markStep(size_m) {
  const power = 10 ** Math.floor(Math.log10(size_m));
  return power * [5, 2, 1].find((factor) => factor * power <= size_m * 1.0001);
}

export class Ground {
  constructor(reach_m) {
    this.step_m = markStep(reach_m);
    this.group = new Group();
    const extent = LINES * this.step_m;
    this.plane = drawAs(new Mesh(new PlaneGeometry(8 * extent, 8 * extent), new MeshBasicMaterial({ depthWrite: false })), "floor");
    this.shadow = drawAs(new Mesh(new PlaneGeometry(2 * extent, 2 * extent), new ShadowMaterial({ opacity: 0.2, depthWrite: false })), "shadow");
    this.shadow.receiveShadow = true;
    this.lines = drawAs(new Mesh(gridGeometry(this.step_m, extent), new MeshBasicMaterial({ depthWrite: false })), "lines");
    this.labels = Array.from({ length: 2 * LABELS + 1 }, () => this.makeLabel());
    this.textures = new Map();
    this.group.add(this.plane, this.shadow, this.lines, ...this.labels);
    // All of it lies in one plane: what is drawn when, not the depth, says what covers what.
    [this.plane, this.lines, this.shadow, ...this.labels].forEach((part, i) => (part.renderOrder = Math.min(i, 3) - 9));
    this.paint();
  }

  makeLabel() {
    const material = new MeshBasicMaterial({ transparent: true, depthWrite: false });
    return drawAs(new Mesh(new PlaneGeometry(0.5 * this.step_m, 0.25 * this.step_m), material), "label");
  }

  /** Numbers at whole marks, so that the pictures of all are few. */
  texture(index) {
    if (!this.textures.has(index)) {
      const canvas = document.createElement("canvas");
      [canvas.width, canvas.height] = [256, 128];
      const paint = canvas.getContext("2d");
      paint.font = `500 76px ${colour("--sans")}`;
      paint.fillStyle = colour("--soft");
      paint.textAlign = "left";
      paint.textBaseline = "middle";
      const decimals = Math.max(0, -Math.floor(Math.log10(this.step_m)));
      paint.fillText(`${(index * this.step_m).toFixed(decimals).replace("-", "−")} m`, 6, 64);
      const texture = new CanvasTexture(canvas);
      texture.colorSpace = SRGBColorSpace;
      texture.anisotropy = 8;
      this.textures.set(index, texture);
    }
    return this.textures.get(index);
  }

  /** Pictures of numbers take room, and a walker passes many. */
  forgetFar(middle) {
    for (const [index, texture] of this.textures) {
      if (Math.abs(index - middle) <= 4 * LABELS) continue;
      texture.dispose();
      this.textures.delete(index);
    }
  }

  paint() {
    this.plane.material.color.set(colour("--floor"));
    this.lines.material.color.set(colour("--floor-line"));
    for (const texture of this.textures.values()) texture.dispose();
    this.textures.clear();
  }

  /**
   * Brings marks to where the camera looks. The numbers are on the left (side 1) or right (−1) of y = `way_m` and at
   * least `away_m` from it, `size` times as large as seen from nearby; they read upright from the other side. They keep
   * still while way_m stays near.
   */
  follow(x_m, y_m, { side, way_m, away_m, size }) {
    const snap = (value) => Math.round(value / this.step_m) * this.step_m;
    const lane_m = snap(way_m) + side * (0.5 * this.step_m + away_m);
    for (const part of [this.plane, this.shadow, this.lines]) [part.position.x, part.position.y] = [snap(x_m), snap(y_m)];
    const middle = Math.round(x_m / this.step_m);
    this.forgetFar(middle);
    this.labels.forEach((label, i) => {
      const index = middle + i - LABELS;
      label.position.x = (index + side * (0.04 + 0.25 * size)) * this.step_m;
      label.position.y = lane_m;
      label.rotation.z = side > 0 ? 0 : Math.PI;
      label.scale.setScalar(size);
      label.material.map = this.texture(index);
    });
  }
}

/** Lines as narrow rectangles: they keep their width on the ground. */
function gridGeometry(step_m, extent) {
  const half = 0.006 * step_m, points = [], indices = [];
  const rectangle = (x0, y0, x1, y1) => {
    const first = points.length / 3;
    points.push(x0, y0, 0, x1, y0, 0, x1, y1, 0, x0, y1, 0);
    indices.push(first, first + 1, first + 2, first, first + 2, first + 3);
  };
  for (let i = -LINES; i <= LINES; ++i) {
    rectangle(i * step_m - half, -extent, i * step_m + half, extent);
    rectangle(-extent, i * step_m - half, extent, i * step_m + half);
  }
  return new BufferGeometry().setAttribute("position", new BufferAttribute(new Float32Array(points), 3)).setIndex(indices);
}

/** The way of the centre of mass as a ribbon on the ground; what is past is drawn stronger. */
export class Trail {
  constructor(walk, width_m) {
    Object.assign(this, { walk, width_m, made: 0, side: [0, 1] });
    const rows = walk.com[0].length; // of what is simulated, more than there are so far
    const indices = [];
    for (let k = 1; k < rows; ++k) indices.push(2 * k - 2, 2 * k - 1, 2 * k, 2 * k - 1, 2 * k + 1, 2 * k);
    this.points = new BufferAttribute(new Float32Array(rows * 6), 3);
    this.extend();
    const geometry = () => new BufferGeometry().setAttribute("position", this.points).setIndex(indices);
    const material = (opacity) => new MeshBasicMaterial({ transparent: true, opacity, depthWrite: false, side: 2 });
    this.past = drawAs(new Mesh(geometry(), material(0.75)), "ribbon");
    this.whole = drawAs(new Mesh(geometry(), material(0.16)), "ribbon");
    this.past.frustumCulled = this.whole.frustumCulled = false;
    this.group = new Group();
    this.group.add(this.whole, this.past);
    [this.whole.renderOrder, this.past.renderOrder] = [-5, -4];
  }

  /** Makes the rows that the walk has and the ribbon has not; all anew where the walk has begun again. */
  extend() {
    const { walk, width_m } = this, [x, y] = walk.com, { count } = walk.poses, points = this.points.array;
    if (count < this.made) this.made = 0;
    if (count === this.made) return;
    const first = this.made;
    for (let k = first; k < count; ++k) {
      const ahead = Math.min(k + 3, count - 1), behind = Math.max(k - 3, 0);
      const dx = x[ahead] - x[behind], dy = y[ahead] - y[behind], length = Math.hypot(dx, dy);
      if (length > 1e-6) this.side = [-dy / length, dx / length];
      for (const [s, sign] of [[0, 1], [3, -1]]) {
        const at = 6 * k + s;
        points[at] = x[k] + sign * this.side[0] * width_m / 2;
        points[at + 1] = y[k] + sign * this.side[1] * width_m / 2;
        points[at + 2] = walk.ground ? heightAt(walk.ground, points[at], points[at + 1]) + ABOVE_M : 0;
      }
    }
    this.made = count;
    this.points.clearUpdateRanges();
    this.points.addUpdateRange(6 * first, 6 * (count - first));
    this.points.needsUpdate = true;
  }

  paint(css) {
    for (const part of [this.past, this.whole]) part.material.color.set(css);
  }
  setRow(row) {
    this.extend();
    this.whole.geometry.setDrawRange(0, 6 * (this.made - 1));
    this.past.geometry.setDrawRange(0, 6 * row);
  }
}
