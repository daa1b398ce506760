// Draws the scene on a 2-D canvas: every shape is one filled outline, the far ones first. For browsers without WebGL, or whose processor would
// draw for it (docs/BROWSER.md has what both take). What it leaves out: shadows on uneven ground, and what is hidden by hills.
import { BackSide, Color, Matrix4, Vector3 } from "three";
import { clipNear, cornersOf, hullOf } from "./outlines.js";

const MANY_TRIANGLES = 300; // a mesh of more is drawn as its convex hull
const RIBBON_BLOCK = 64, RIBBON_PARTS = 400; // rows that are seen or not together; so many parts at most, as a rule
const TERRAIN_STEP = 3; // cells of the ground that make one patch
const LEAST_LABEL_PX = 7;
const PATCHES_LAYER = -5.5; // over the numbers on the floor, under the path
const FOG_STOPS = 8, LINE_PIECES = 6;

/** What a mesh is drawn as, if not as any convex shape: foot, floor, lines, ribbon, shadow, label or patches. */
export function drawAs(mesh, drawn) {
  mesh.userData.drawn = drawn;
  return mesh;
}

export class Drawing {
  /** With the parts of WebGLRenderer that a Stage uses. */
  constructor() {
    this.domElement = document.createElement("canvas");
    this.backdrop = document.createElement("canvas");
    this.ratio = 1;
    this.known = new WeakMap(); // what is kept for each geometry and image
    this.colour = new Color();
    this.toClip = new Matrix4();
  }
  setPixelRatio(ratio) {
    this.ratio = ratio;
  }
  setSize(width, height) {
    Object.assign(this.domElement, { width: Math.round(width * this.ratio), height: Math.round(height * this.ratio) });
  }

  render(scene, camera) {
    scene.updateMatrixWorld();
    camera.updateMatrixWorld();
    this.paint = this.domElement.getContext("2d", { alpha: false, willReadFrequently: true });
    this.paint.lineJoin = "round";
    this.look(scene, camera);
    this.sky_css = scene.background.getStyle();
    for (const { mesh } of this.inOrder(scene)) this[`draw_${mesh.userData.drawn ?? "shape"}`](mesh);
    this.paint.globalAlpha = 1;
  }

  /** What holds for the whole picture: camera, light, haze. */
  look(scene, camera) {
    const { width, height } = this.domElement;
    Object.assign(this, { half: [width / 2, height / 2], fog: scene.fog, near_m: camera.near, camera });
    this.toClip.multiplyMatrices(camera.projectionMatrix, camera.matrixWorldInverse);
    this.eye = camera.getWorldPosition(new Vector3());
    const axis = (i) => new Vector3().setFromMatrixColumn(camera.matrixWorld, i).normalize();
    [this.right, this.up, this.back] = [axis(0), axis(1), axis(2)];
    const lights = scene.children.filter(({ isLight }) => isLight);
    this.sky = lights.find(({ isHemisphereLight }) => isHemisphereLight);
    this.sun = lights.find(({ isDirectionalLight }) => isDirectionalLight);
    this.toSky = this.sky.getWorldPosition(new Vector3()).normalize();
    this.toSun = this.sun.getWorldPosition(new Vector3()).sub(this.sun.target.getWorldPosition(new Vector3())).normalize();
    this.casters = [];
  }

  /** All that is seen, in layers, the far before the near; a foot over the leg that ends in it, with its outline before it. */
  inOrder(scene) {
    const seen = [];
    scene.traverseVisible((mesh) => {
      if (!mesh.isMesh) return;
      if (mesh.castShadow) this.casters.push(mesh);
      const layer = mesh.userData.drawn === "patches" ? PATCHES_LAYER : mesh.renderOrder;
      seen.push({ mesh, layer, depth: this.depthOfMesh(mesh) });
    });
    return seen.sort((a, b) => a.layer - b.layer || b.depth - a.depth);
  }

  depthOfMesh(mesh) {
    const { geometry, material, parent, userData } = mesh, abit_m = 0.1 * this.near_m;
    if (material.side === BackSide) return this.depthOfMesh(parent) + 0.5 * abit_m;
    geometry.boundingSphere ?? geometry.computeBoundingSphere();
    const own = this.depthOf(geometry.boundingSphere.center.clone().applyMatrix4(mesh.matrixWorld));
    if (userData.drawn !== "foot") return own;
    const others = parent.children.filter((other) => other.isMesh && other.userData.drawn !== "foot");
    return Math.min(own, ...others.map((other) => this.depthOfMesh(other))) - abit_m;
  }

  depthOf(point) {
    return this.back.dot(this.eye) - this.back.dot(point);
  }

  /** [x, y, w]: of the picture, in pixels times w, and how far before the eye. */
  project(point) {
    const e = this.toClip.elements, { x, y, z } = point, [halfWidth, halfHeight] = this.half;
    const w = e[3] * x + e[7] * y + e[11] * z + e[15];
    return [halfWidth * (w + e[0] * x + e[4] * y + e[8] * z + e[12]), halfHeight * (w - (e[1] * x + e[5] * y + e[9] * z + e[13])), w];
  }

  /** Points of a mesh's own frame in the picture, or null if one of them is behind the eye. */
  seenAll(corners, matrix) {
    const at = new Vector3(), seen = [];
    for (const corner of corners) {
      const [x, y, w] = this.project(at.copy(corner).applyMatrix4(matrix));
      if (w < this.near_m) return null;
      seen.push([x / w, y / w]);
    }
    return seen;
  }

  /** Adds a polygon to the path. */
  trace(points) {
    points.forEach(([x, y], i) => (i ? this.paint.lineTo(x, y) : this.paint.moveTo(x, y)));
    this.paint.closePath();
  }

  // ---- light ----

  /** A material's colour as CSS, where its surface faces `normal`, at a depth: Lambert's law for a sky and a sun, then haze. */
  lit(material, normal, depth, shade = 1) {
    const shown = this.colour.copy(material.color).multiplyScalar(shade);
    if (material.isMeshLambertMaterial) {
      const bright = (this.sky.intensity * (0.75 + 0.25 * this.toSky.dot(normal)) + this.sun.intensity * Math.max(0, this.toSun.dot(normal))) / Math.PI;
      shown.multiplyScalar(bright).add(material.emissive);
    }
    return this.hazy(shown, depth).getStyle();
  }

  hazy(shown, depth) {
    return shown.lerp(this.fog.color, this.hidden(depth));
  }

  /** The share of haze before what is so far away, as three.js has it. */
  hidden(depth) {
    const share = Math.min(Math.max((depth - this.fog.near) / (this.fog.far - this.fog.near), 0), 1);
    return share * share * (3 - 2 * share);
  }

  /**
   * A colour on the plane z = 0 in haze: as it is nearby, transparent at the horizon. On the plane, equal depths are parallel lines in the
   * picture. As it is everywhere where the plane is seen from right above, or from below.
   */
  throughHaze(css) {
    const across = Math.hypot(this.right.z, this.up.z);
    if (across < 1e-3 || this.eye.z <= 0) return css;
    const pixels = this.half[1] / Math.tan((this.camera.fov * Math.PI) / 360);
    // A point at this depth is (right · q + up · s − back) · depth from the eye; z = 0 gives how far it is along (right.z, up.z).
    const along = (depth) => (this.back.z - this.eye.z / depth) / across;
    const place = (value) => [this.half[0] + (pixels * value * this.right.z) / across, this.half[1] - (pixels * value * this.up.z) / across];
    const { near, far } = this.fog, first = along(near), last = along(far);
    const gradient = this.paint.createLinearGradient(...place(first), ...place(last));
    const [r, g, b] = css.match(/\d+/g);
    for (let i = 0; i <= FOG_STOPS; ++i) {
      const depth = near * (far / near) ** (i / FOG_STOPS);
      gradient.addColorStop(Math.min(Math.max((along(depth) - first) / (last - first), 0), 1), `rgba(${r}, ${g}, ${b}, ${1 - this.hidden(depth)})`);
    }
    return gradient;
  }

  // ---- kinds of meshes ----

  /** With the sky: kept while the camera only follows the walker, as a gradient over all of the picture takes long. */
  draw_floor(mesh) {
    const { width, height } = this.domElement, floor_css = this.lit(mesh.material, this.up, 0);
    const key = [width, height, this.sky_css, floor_css, this.camera.fov, ...[this.eye.z, this.fog.near, this.fog.far, ...this.back, ...this.up].map((value) => value.toFixed(5))].join();
    if (key !== this.backdropKey) this.paintBackdrop(mesh, floor_css);
    this.backdropKey = key;
    this.paint.globalAlpha = 1;
    this.paint.drawImage(this.backdrop, 0, 0);
  }

  paintBackdrop(floor, floor_css) {
    const { width, height } = this.domElement, picture = this.paint;
    if (this.backdrop.width !== width || this.backdrop.height !== height) Object.assign(this.backdrop, { width, height });
    this.paint = this.backdrop.getContext("2d", { alpha: false, willReadFrequently: true });
    this.paint.globalAlpha = 1;
    this.paint.fillStyle = this.sky_css;
    this.paint.fillRect(0, 0, width, height);
    this.paint.fillStyle = this.throughHaze(floor_css);
    const { position } = floor.geometry.attributes, at = new Vector3();
    const corners = [0, 1, 3, 2].map((k) => this.project(at.fromBufferAttribute(position, k).applyMatrix4(floor.matrixWorld))); // of a PlaneGeometry
    const seen = clipNear(corners, this.near_m);
    if (this.within(seen)) this.fillSeen(seen);
    this.paint = picture;
  }

  /** Lines on the floor, each four vertices in turn: in pieces of one tone each, as thin gradients take very long. */
  draw_lines(mesh) {
    const { near, far } = this.fog, { position } = mesh.geometry.attributes, at = new Vector3();
    const ends = [this.near_m, ...Array.from({ length: LINE_PIECES }, (_, i) => near * (far / near) ** (i / LINE_PIECES)), far];
    const shares = ends.slice(1).map((end, i) => 1 - this.hidden(Math.sqrt(ends[i] * end)));
    this.paint.fillStyle = this.lit(mesh.material, this.up, 0);
    for (let i = 0; i < position.count; i += 4) {
      const [a, b, c, d] = [0, 1, 2, 3].map((k) => this.project(at.fromBufferAttribute(position, i + k).applyMatrix4(mesh.matrixWorld)));
      const alongX = Math.abs(position.getX(i + 1) - position.getX(i)) > Math.abs(position.getY(i + 3) - position.getY(i));
      this.fillStrip(alongX ? [[a, b], [d, c]] : [[a, d], [b, c]], ends, shares);
    }
  }

  /** A narrow band between two edges, each [from, to] in [x, y, w], cut where it reaches a depth of `ends`, each piece as opaque as `shares` says. */
  fillStrip(edges, ends, shares) {
    const [[from], [to]] = [edges.map(([start]) => start), edges.map(([, end]) => end)], long = to[2] - from[2];
    const [least, most] = long > 0 ? [from[2], to[2]] : [to[2], from[2]];
    for (let i = 1; i < ends.length; ++i) {
      const near = Math.max(ends[i - 1], least), far = Math.min(ends[i], most);
      if (near > far || (near === far && long !== 0)) continue;
      const places = long === 0 ? [0, 1] : [(near - from[2]) / long, (far - from[2]) / long];
      const [[p, q], [s, r]] = edges.map(([start, end]) => places.map((share) => start.map((value, axis) => value + share * (end[axis] - value))));
      if (!this.within([p, q, r, s])) continue;
      this.paint.globalAlpha = shares[i - 1];
      this.fillSeen([p, q, r, s]);
    }
  }

  fillSeen(polygon) {
    this.paint.beginPath();
    this.trace(polygon.map(([x, y, w]) => [x / w, y / w]));
    this.paint.fill();
  }

  /** What stands between the sun and the plane, all in one tone. */
  draw_shadow(mesh) {
    if (this.toSun.z <= 0.05) return;
    this.paint.globalAlpha = mesh.material.opacity;
    this.paint.fillStyle = "#000";
    this.paint.beginPath();
    for (const caster of this.casters) {
      const fallen = this.kept(caster.geometry).corners.map((corner) => {
        const at = corner.clone().applyMatrix4(caster.matrixWorld);
        return at.addScaledVector(this.toSun, -at.z / this.toSun.z);
      });
      const seen = this.seenAll(fallen, IDENTITY);
      if (seen) this.trace(hullOf(seen));
    }
    this.paint.fill();
  }

  /** A picture that lies on the ground. */
  draw_label(mesh) {
    const { image } = mesh.material.map ?? {}, { position } = mesh.geometry.attributes;
    if (!image) return;
    const corners = [0, 1, 2].map((i) => new Vector3().fromBufferAttribute(position, i)), seen = this.seenAll(corners, mesh.matrixWorld);
    if (!seen) return;
    const [[x, y], wide, high] = seen, depth = this.depthOf(mesh.getWorldPosition(new Vector3()));
    if (Math.hypot(high[0] - x, high[1] - y) < LEAST_LABEL_PX) return;
    this.paint.globalAlpha = 1 - this.hidden(depth);
    const shown = Math.hypot(wide[0] - x, wide[1] - y) < image.width / 2 ? this.reduced(image) : image;
    const [width, height] = [shown.width, shown.height];
    this.paint.setTransform((wide[0] - x) / width, (wide[1] - y) / width, (high[0] - x) / height, (high[1] - y) / height, x, y);
    this.paint.drawImage(shown, 0, 0);
    this.paint.resetTransform();
  }

  /** A third as large, once for all pictures: a canvas makes small what is large without care, or slowly. */
  reduced(image) {
    if (!this.known.has(image)) {
      const small = document.createElement("canvas");
      [small.width, small.height] = [Math.round(image.width / 3), Math.round(image.height / 3)];
      const paint = small.getContext("2d", { willReadFrequently: true });
      paint.imageSmoothingQuality = "high";
      paint.drawImage(image, 0, 0, small.width, small.height);
      this.known.set(image, small);
    }
    return this.known.get(image);
  }

  /** A band of pairs of vertices, left and right, as far as its draw range says: what of it is not behind the haze. */
  draw_ribbon(mesh) {
    const { position } = mesh.geometry.attributes, rows = Math.floor(mesh.geometry.drawRange.count / 6) + 1, at = new Vector3();
    const vertex = (i) => this.project(at.fromBufferAttribute(position, i).applyMatrix4(mesh.matrixWorld));
    const blocks = [];
    for (let first = 0; first + 1 < rows; first += RIBBON_BLOCK)
      if ([first, Math.min(first + RIBBON_BLOCK, rows - 1)].some((row) => vertex(2 * row)[2] < this.fog.far)) blocks.push(first);
    // Powers of two, so that a path that grows keeps its vertices.
    const step = Math.min(RIBBON_BLOCK, 2 ** Math.max(1, Math.ceil(Math.log2((blocks.length * RIBBON_BLOCK) / RIBBON_PARTS))));
    this.paint.globalAlpha = mesh.material.opacity;
    this.paint.fillStyle = this.lit(mesh.material, this.up, 0);
    this.paint.beginPath();
    for (const first of blocks) {
      const left = [], right = [], last = Math.min(first + RIBBON_BLOCK, rows - 1);
      for (let row = first; row <= last; row = row < last ? Math.min(row + step, last) : last + 1) {
        const pair = [vertex(2 * row), vertex(2 * row + 1)];
        if (pair.some(([, , w]) => w < this.near_m)) continue;
        const [one, other] = pair.map(([x, y, w]) => [x / w, y / w]);
        left.push(one);
        right.push(other);
      }
      if (left.length > 1) this.trace([...left, ...right.reverse()]);
    }
    this.paint.fill();
  }

  /** Uneven ground: a square of vertices with shades. */
  draw_patches(mesh) {
    const { position, color } = mesh.geometry.attributes, side = Math.round(Math.sqrt(position.count)), patches = [];
    const at = new Vector3(), vertices = new Map();
    const vertex = (i) => {
      if (!vertices.has(i)) vertices.set(i, this.project(at.fromBufferAttribute(position, i).applyMatrix4(mesh.matrixWorld)));
      return vertices.get(i);
    };
    for (let j = 0; j + TERRAIN_STEP < side; j += TERRAIN_STEP)
      for (let i = 0; i + TERRAIN_STEP < side; i += TERRAIN_STEP) {
        const a = j * side + i, b = a + TERRAIN_STEP * side, corners = [a, a + TERRAIN_STEP, b + TERRAIN_STEP, b], seen = corners.map(vertex);
        if (seen.some(([, , w]) => w < this.near_m) || !this.within(seen)) continue;
        patches.push({ corners, seen, depth: seen[0][2] });
      }
    patches.sort((a, b) => b.depth - a.depth);
    this.paint.globalAlpha = 1;
    const point = (i) => new Vector3().fromBufferAttribute(position, i);
    for (const { corners, seen, depth } of patches) {
      const origin = point(corners[0]), normal = point(corners[1]).sub(origin).cross(point(corners[3]).sub(origin)).normalize();
      this.fillPolygon(seen.map(([x, y, w]) => [x / w, y / w]), this.lit(mesh.material, normal, depth, color.getX(corners[0])));
    }
  }

  /** Whether a polygon of [x, y, w] may be in the picture, and not behind the haze. */
  within(seen) {
    const [width, height] = this.half.map((value) => 2 * value);
    return seen.some(([x]) => x > 0) && seen.some(([x, , w]) => x < width * w) && seen.some(([, y]) => y > 0) &&
           seen.some(([, y, w]) => y < height * w) && seen.some(([, , w]) => w < this.fog.far);
  }

  /** With a line around it, so that no seam is seen beside its neighbours. */
  fillPolygon(points, style) {
    this.paint.fillStyle = this.paint.strokeStyle = style;
    this.paint.beginPath();
    this.trace(points);
    this.paint.fill();
    this.paint.stroke();
  }

  /** A geometry's corners, and its faces where they are few and flat. */
  kept(geometry) {
    if (!this.known.has(geometry)) this.known.set(geometry, { corners: cornersOf(geometry), faces: facesOf(geometry) });
    return this.known.get(geometry);
  }

  draw_foot(mesh) {
    this.draw_shape(mesh);
  }

  draw_shape(mesh) {
    const { corners, faces } = this.kept(mesh.geometry), { material } = mesh;
    const depth = this.depthOf(mesh.getWorldPosition(new Vector3()));
    this.paint.globalAlpha = material.opacity;
    if (faces && material.isMeshLambertMaterial && material.opacity === 1) return this.drawFaces(mesh, faces, depth);
    const seen = this.seenAll(corners, mesh.matrixWorld);
    if (!seen) return;
    this.paint.fillStyle = this.roundly(material, seen, depth);
    this.paint.beginPath();
    this.trace(hullOf(seen));
    this.paint.fill();
  }

  /** A round shape is lit above and dark below. */
  roundly(material, seen, depth) {
    if (!material.isMeshLambertMaterial) return this.lit(material, this.up, depth);
    let [top, bottom] = [Infinity, -Infinity];
    for (const [, y] of seen) [top, bottom] = [Math.min(top, y), Math.max(bottom, y)];
    const gradient = this.paint.createLinearGradient(0, top, 0, bottom), normal = new Vector3();
    for (const height of [0.9, 0.3, -0.5, -0.95])
      gradient.addColorStop((1 - height) / 2, this.lit(material, normal.copy(this.up).multiplyScalar(height).addScaledVector(this.back, Math.sqrt(1 - height * height)), depth));
    return gradient;
  }

  drawFaces(mesh, faces, depth) {
    const centre = new Vector3(), facing = [];
    for (const { corners, normal } of faces) {
      const outwards = normal.clone().transformDirection(mesh.matrixWorld);
      centre.copy(corners[0]).applyMatrix4(mesh.matrixWorld);
      if (outwards.dot(this.eye) <= outwards.dot(centre)) continue;
      const seen = this.seenAll(corners, mesh.matrixWorld);
      if (seen) facing.push({ seen, outwards, depth: this.depthOf(centre) });
    }
    facing.sort((a, b) => b.depth - a.depth);
    for (const { seen, outwards } of facing) this.fillPolygon(seen, this.lit(mesh.material, outwards, depth));
  }
}

const IDENTITY = new Matrix4();

/** Flat faces, each with its corners and normal; null for what is round or has too many. */
function facesOf(geometry) {
  const { position, normal } = geometry.attributes;
  const corners = (indices) => indices.map((i) => new Vector3().fromBufferAttribute(position, i));
  const face = (indices) => ({ corners: corners(indices), normal: new Vector3().fromBufferAttribute(normal, indices[0]) });
  if (geometry.type === "BoxGeometry") return Array.from({ length: 6 }, (_, side) => face([0, 1, 3, 2].map((i) => 4 * side + i)));
  if (geometry.type !== "BufferGeometry" || geometry.index || position.count > 3 * MANY_TRIANGLES) return null;
  return Array.from({ length: position.count / 3 }, (_, i) => face([3 * i, 3 * i + 1, 3 * i + 2]));
}
