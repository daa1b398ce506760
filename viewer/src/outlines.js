// Outlines of convex shapes, of which a picture can be drawn without a depth for every pixel.
import { Vector3 } from "three";

const DIRECTIONS = 72; // in which a round shape is touched: its outline has some twenty corners

/** Unit vectors spread evenly over a sphere (a Fibonacci lattice). */
const directions = Array.from({ length: DIRECTIONS }, (_, i) => {
  const z = 1 - (2 * i + 1) / DIRECTIONS, around = i * Math.PI * (3 - Math.sqrt(5)), flat = Math.sqrt(1 - z * z);
  return new Vector3(flat * Math.cos(around), flat * Math.sin(around), z);
});

/** The vertices of a geometry that lie farthest in some direction, in its own frame: the corners of its convex hull, fewer where it is round. */
export function cornersOf(geometry) {
  const { position } = geometry.attributes, found = new Set(), at = new Vector3();
  for (const direction of directions) {
    let best = 0, most = -Infinity;
    for (let i = 0; i < position.count; ++i) {
      const reach = at.fromBufferAttribute(position, i).dot(direction);
      if (reach > most) [best, most] = [i, reach];
    }
    found.add(best);
  }
  return [...found].map((i) => new Vector3().fromBufferAttribute(position, i));
}

const turn = (a, b, c) => (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);

/** The convex hull of points [x, y], always the same way around (Andrew's monotone chain). Sorts the points. */
export function hullOf(points) {
  points.sort((a, b) => a[0] - b[0] || a[1] - b[1]);
  const half = (ordered) => {
    const chain = [];
    for (const point of ordered) {
      while (chain.length > 1 && turn(chain.at(-2), chain.at(-1), point) <= 0) chain.pop();
      chain.push(point);
    }
    return chain.slice(0, -1);
  };
  return [...half(points), ...half(points.reverse())];
}

/** What of a polygon of [x, y, w] lies before the eye, at w of at least `least` (Sutherland and Hodgman). */
export function clipNear(polygon, least) {
  return polygon.flatMap((to, i) => {
    const from = polygon.at(i - 1), inside = to[2] >= least, crossing = [];
    if (inside !== from[2] >= least) {
      const share = (least - from[2]) / (to[2] - from[2]);
      crossing.push(from.map((value, axis) => value + share * (to[axis] - value)));
    }
    return inside ? [...crossing, to] : crossing;
  });
}
