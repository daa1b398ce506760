// Uneven ground around a walker.
import { BufferAttribute, BufferGeometry, Mesh, MeshLambertMaterial } from "three";
import { drawAs } from "./drawing.js";
import { colour } from "./theme.js";

const HALF = 90; // cells to each side of the walker
const DARKEST = 0.55; // of the colour of the highest places
const STEP = 12; // the mesh moves by so many cells at once: a multiple of what drawing.js makes patches of

/** A square of the ground that follows its walker. */
export class Terrain {
  constructor(ground) {
    this.ground = ground;
    const side = 2 * HALF + 1, indices = [];
    for (let j = 0; j + 1 < side; ++j)
      for (let i = 0; i + 1 < side; ++i) {
        const a = j * side + i, b = a + side;
        indices.push(a, a + 1, b + 1, a, b + 1, b);
      }
    this.side = side;
    this.points = new BufferAttribute(new Float32Array(3 * side * side), 3);
    this.shades = new BufferAttribute(new Float32Array(3 * side * side), 3);
    const geometry = new BufferGeometry().setAttribute("position", this.points).setAttribute("color", this.shades);
    geometry.setIndex(indices);
    this.mesh = drawAs(new Mesh(geometry, new MeshLambertMaterial({ vertexColors: true })), "patches");
    this.mesh.receiveShadow = true;
    this.mesh.frustumCulled = false;
    this.paint();
    this.follow(0, 0);
  }

  paint() {
    this.mesh.material.color.set(colour("--terrain"));
  }

  follow(x_m, y_m) {
    const snap = (value_m) => Math.round(value_m / this.ground.cell_m / STEP) * STEP;
    const i0 = snap(x_m), j0 = snap(y_m);
    if (this.i0 === i0 && this.j0 === j0) return;
    [this.i0, this.j0] = [i0, j0];
    const { cell_m, lowest_m, highest_m } = this.ground;
    let k = 0;
    for (let j = -HALF; j <= HALF; ++j)
      for (let i = -HALF; i <= HALF; ++i) {
        const height = this.ground.height(i0 + i, j0 + j);
        // Hollows are darker than hills.
        const shade = DARKEST + ((1 - DARKEST) * (height - lowest_m)) / Math.max(highest_m - lowest_m, 1e-6);
        this.shades.setXYZ(k, shade, shade, shade);
        this.points.setXYZ(k++, (i0 + i) * cell_m, (j0 + j) * cell_m, height);
      }
    this.points.needsUpdate = this.shades.needsUpdate = true;
    this.mesh.geometry.computeVertexNormals();
  }
}
