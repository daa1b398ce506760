// The robot's own geometry, moved by its joints.
import {
  BackSide, BoxGeometry, BufferGeometry, CapsuleGeometry, CylinderGeometry, Float32BufferAttribute, Group, Mesh,
  MeshBasicMaterial, MeshLambertMaterial, SphereGeometry, Vector3,
} from "three";
import { drawAs } from "./drawing.js";
import { colour, legColour, walkerColour } from "./theme.js";

/** Flat faces: no two triangles share a vertex. */
function meshGeometry({ vertices_m, triangles }) {
  const corners = triangles.flatMap((triangle) => triangle.flatMap((corner) => vertices_m[corner]));
  const geometry = new BufferGeometry().setAttribute("position", new Float32BufferAttribute(corners, 3));
  geometry.computeVertexNormals();
  return geometry;
}

function geometryOf(geom) {
  const { shape, size_m } = geom;
  const [a, b, c] = size_m;
  switch (shape) {
    case "sphere": return new SphereGeometry(a, 24, 16);
    case "box": return new BoxGeometry(2 * a, 2 * b, 2 * c);
    // three's axis is y, ours z
    case "capsule": return new CapsuleGeometry(a, 2 * b, 6, 20).rotateX(Math.PI / 2);
    case "cylinder": return new CylinderGeometry(a, a, 2 * b, 24).rotateX(Math.PI / 2);
    case "mesh": return meshGeometry(geom);
  }
  throw new Error(`unknown shape ${shape}`);
}

const OUTLINE = 0.28; // thickness, as a share of half the shape's least extent

/** The shape grown to all sides, of which only the inside is seen: an outline around what is in it. */
function outlineOf(geometry) {
  geometry.computeBoundingBox();
  const middle = geometry.boundingBox.getCenter(new Vector3());
  const half = geometry.boundingBox.getSize(new Vector3()).multiplyScalar(0.5).clampScalar(1e-6, Infinity);
  const thick = OUTLINE * Math.min(half.x, half.y, half.z);
  const outline = new Mesh(geometry, new MeshBasicMaterial({ side: BackSide }));
  outline.scale.set(1 + thick / half.x, 1 + thick / half.y, 1 + thick / half.z);
  outline.position.copy(middle).sub(middle.clone().multiply(outline.scale));
  outline.visible = false;
  return outline;
}

const place = (object, position, rotation) => {
  object.position.fromArray(position);
  const [w, x, y, z] = rotation;
  object.quaternion.set(x, y, z, w);
  return object;
};

const carries = (robot, body, other) => {
  while (other > body) other = robot.bodies[other].parent;
  return other === body;
};

/** The shapes of a leg's foot; recordings have a number where it is one. */
const footGeoms = ({ foot_geom, foot_geoms }) => foot_geoms ?? [foot_geom];

/** The leg that a body belongs to, or −1 for the trunk, to which bodies with feet of several legs belong, too. */
function legOfBody(robot, body) {
  if (robot.legs.filter((leg) => carries(robot, body, robot.geoms[footGeoms(leg)[0]].body)).length > 1) return -1;
  for (let b = body; b >= 0; b = robot.bodies[b].parent) {
    const leg = robot.legs.findIndex(({ joints }) => joints.some((joint) => robot.joints[joint]?.body === b));
    if (leg >= 0) return leg;
  }
  return -1;
}

export class RobotModel {
  constructor(robot, walker) {
    this.robot = robot;
    this.walker = walker;
    this.root = new Group();
    this.hinges = [];
    this.parts = []; // {mesh, material, leg, foot, mark}; a mark, as a nose, shows where the front is
    const frames = this.makeBodies();
    this.addGeoms(frames);
    this.paint();
  }

  /** Nested groups, one chain per body; gives the group that carries each body's geoms. */
  makeBodies() {
    const { bodies, joints } = this.robot;
    const frames = [];
    bodies.forEach((body, b) => {
      if (b === 0) return frames.push(this.root);
      let frame = place(new Group(), body.position_m, body.rotation);
      frames[body.parent].add(frame);
      const chain = joints.map((joint, j) => ({ joint, j })).filter(({ joint }) => joint.body === b);
      chain.sort((p, q) => p.joint.chain_index - q.joint.chain_index);
      for (const { joint, j } of chain) {
        // A hinge turns what follows about its anchor, which stays where it is.
        const hinge = new Group();
        hinge.position.fromArray(joint.anchor_m);
        const back = new Group();
        back.position.fromArray(joint.anchor_m).negate();
        frame.add(hinge);
        hinge.add(back);
        this.hinges[j] = { group: hinge, axis: new Vector3().fromArray(joint.axis) };
        frame = back;
      }
      frames.push(frame);
    });
    return frames;
  }

  addGeoms(frames) {
    this.feet = []; // by leg: {shapes: [{mesh, material, outline}, …], touching}
    this.robot.geoms.forEach((geom, g) => {
      const material = new MeshLambertMaterial();
      const mesh = place(new Mesh(geometryOf(geom), material), geom.position_m, geom.rotation);
      mesh.castShadow = true;
      frames[geom.body].add(mesh);
      const leg = legOfBody(this.robot, geom.body);
      const foot = this.robot.legs.findIndex((each) => footGeoms(each).includes(g));
      if (foot >= 0) {
        drawAs(mesh, "foot");
        const outline = outlineOf(mesh.geometry);
        mesh.add(outline);
        (this.feet[foot] ??= { shapes: [], touching: null }).shapes.push({ mesh, material, outline });
      }
      this.parts.push({ mesh, material, leg, foot, mark: leg < 0 && !geom.collides });
    });
  }

  paint() {
    for (const { material, leg, foot, mark } of this.parts) {
      material.color.set(leg < 0 ? walkerColour(this.walker) : legColour(leg));
      if (mark) material.color.multiplyScalar(0.2);
      if (foot >= 0) this.feet[foot].touching = null; // painted anew by setTouch
    }
  }

  setPose({ root, angles }) {
    place(this.root, root.slice(0, 3), root.slice(3));
    this.hinges.forEach(({ group, axis }, j) => group.quaternion.setFromAxisAngle(axis, angles[j]));
  }

  /** A foot on the ground is white with an outline, whatever the colour of its leg. */
  setTouch(leg, touching) {
    const foot = this.feet[leg];
    if (!foot || foot.touching === touching) return;
    foot.touching = touching;
    for (const { material, outline } of foot.shapes) {
      material.color.set(touching ? colour("--touch") : legColour(leg));
      material.emissive.set(touching ? colour("--touch-glow") : "#000");
      outline.material.color.set(colour("--touch-line"));
      outline.visible = touching && !this.ghost;
    }
  }

  /** Legs that are there no more are not to be seen. */
  setMissing(legs) {
    for (const { mesh, leg } of this.parts) mesh.visible = !legs.includes(leg);
  }

  /** What a foot looks like now: its colour, and whether it has an outline, and is there. */
  footLook(leg) {
    const { mesh, material, outline } = this.feet[leg].shapes[0];
    return { colour: `#${material.color.getHexString()}`, outlined: outline.visible, there: mesh.visible };
  }

  setGhost(ghost) {
    this.ghost = ghost;
    for (const foot of this.feet) if (foot) foot.touching = null; // outlined anew by setTouch
    for (const { material, mesh } of this.parts) {
      material.transparent = ghost;
      material.opacity = ghost ? 0.28 : 1;
      material.depthWrite = !ghost;
      material.needsUpdate = true;
      mesh.castShadow = !ghost;
    }
  }

  /** Where root and feet are, in the walker's own lane. */
  placed() {
    this.root.updateMatrixWorld(true);
    const lane = this.root.parent.position;
    const middle = ({ shapes }) => {
      const sum = new Vector3();
      for (const { mesh } of shapes) sum.add(mesh.getWorldPosition(new Vector3()));
      return sum.divideScalar(shapes.length);
    };
    const centres = this.feet.map((foot) => middle(foot).sub(lane).toArray());
    return [this.root.position.toArray(), ...centres];
  }

  /** How far the robot reaches around its middle in the start pose, m. */
  reach() {
    const first = this.robot.bodies[0];
    place(this.root, first.position_m, first.rotation);
    for (const { group } of this.hinges) group.quaternion.identity();
    this.root.updateMatrixWorld(true);
    const points = this.parts.map(({ mesh }) => {
      mesh.geometry.computeBoundingSphere();
      return { centre: mesh.getWorldPosition(new Vector3()), radius: mesh.geometry.boundingSphere.radius };
    });
    const middle = this.root.position;
    return Math.max(...points.map(({ centre, radius }) => centre.distanceTo(middle) + radius));
  }
}
