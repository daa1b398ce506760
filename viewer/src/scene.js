// The stage: robots, ground, light and camera.
import {
  Color, DirectionalLight, Fog, Group, HemisphereLight, PCFShadowMap, PerspectiveCamera, Scene, Vector3, WebGLRenderer,
} from "three";
import { OrbitControls } from "three/addons/controls/OrbitControls.js";
import { Drawing } from "./drawing.js";
import { Ground, Trail } from "./ground.js";
import { heightAt } from "./heights.js";
import { RobotModel } from "./robot.js";
import { Terrain } from "./terrain.js";
import { colour, element, walkerLineColour } from "./theme.js";

export const CAMERAS = ["follow", "orbit", "still"];
const TURN_S = 20; // of the orbiting camera, once around
const SMOOTH_S = 0.4; // the camera follows the mean way over this long before and after
const REST_MS = 250, LATE_S = 0.07;
const NEAR = 4.1; // reaches; so far away is the camera from one walker
const MOST_SPREAD = { side: 8, ghosts: 6 }; // reaches; farther apart, the camera stays with the selected walker

/** Against gravity: on a slope the ground is z = 0 and gravity leans. */
function upwards({ gravity_m_s2 }) {
  const length = Math.hypot(...gravity_m_s2);
  return length > 0 ? gravity_m_s2.map((part) => -part / length) : [0, 0, 1];
}

/** Whether the processor draws, for want of a graphics card: then each picture costs what could compute. */
function drawnByProcessor(renderer) {
  const gl = renderer.getContext();
  let name = gl.getParameter(gl.RENDERER);
  if (name === "WebKit WebGL") name = gl.getParameter(gl.getExtension("WEBGL_debug_renderer_info")?.UNMASKED_RENDERER_WEBGL ?? gl.RENDERER);
  return /swiftshader|llvmpipe|softpipe|basic render/i.test(name);
}

export class Stage {
  constructor(parent, walks, onChange) {
    Object.assign(this, { parent, walks, onChange });
    this.picture = element("div", { class: "picture", role: "img", "aria-label": "The robot in motion; drag to turn, scroll to come nearer" });
    parent.prepend(this.picture);
    this.paper = element("canvas", { class: "paper" }); // what printers get: they cannot print WebGL
    parent.append(this.paper);
    this.pixelRatio = 2; // more is not seen
    this.makeSolid();

    this.scene = new Scene();
    this.scene.fog = new Fog("#fff", 1, 2);
    this.lanes = walks.map((walk, i) => this.addWalker(walk, i));
    this.reach = Math.max(...this.lanes.map(({ model }) => model.reach()));
    this.ground = new Ground(this.reach);
    this.scene.add(this.ground.group);
    this.addLights();

    this.camera = new PerspectiveCamera(32, 1, 0.02 * this.reach, 80 * this.reach);
    this.camera.up.set(...upwards(walks[0].robot));
    this.makeControls();
    this.mode = "follow";
    this.side = true;
    this.selected = 0;
    this.paint();
    this.arrange();
    this.time_s = 0;
    this.chooseRenderer(false);
    this.resetCamera();
  }

  /** What draws by WebGL, where the browser has it; `slow` where there is no graphics card for it. */
  makeSolid() {
    this.solid = null;
    this.slow = true;
    try {
      this.solid = new WebGLRenderer({ antialias: true, preserveDrawingBuffer: true });
    } catch (error) {
      return console.info(error.message);
    }
    this.solid.shadowMap.enabled = true;
    this.solid.shadowMap.type = PCFShadowMap;
    this.solid.domElement.addEventListener("webglcontextlost", () => {
      if (!this.solid) return;
      this.solid = null; // the browser took it away, for good: outlines do as well
      this.slow = true;
      this.onChange();
    });
    this.slow = drawnByProcessor(this.solid);
  }

  /** What draws the next picture: processors draw outlines, but for one that stays. */
  chooseRenderer(moves) {
    const chosen = this.solid && !(this.slow && moves) ? this.solid : (this.drawing ??= new Drawing());
    if (chosen === this.renderer) return;
    this.renderer = chosen;
    this.picture.replaceChildren(chosen.domElement);
    this.width = 0; // so that resize() sets the size anew
    this.resize();
  }

  drawnAs() {
    return this.renderer === this.solid ? "solid" : "outlines";
  }

  /** Takes the picture away, and what listens for it. */
  remove() {
    clearTimeout(this.resting);
    const { solid } = this;
    this.solid = null;
    solid?.dispose();
    solid?.forceContextLoss();
    this.controls.dispose();
    this.picture.remove();
    this.paper.remove();
  }

  addWalker(walk, i) {
    const group = new Group();
    const model = new RobotModel(walk.robot, i);
    const several = this.walks.length > 1; // are seen from farther away
    const trail = new Trail(walk, (several ? 0.045 : 0.03) * model.reach());
    group.add(model.root, trail.group);
    const terrain = walk.ground ? new Terrain(walk.ground) : null;
    if (terrain) group.add(terrain.mesh);
    this.scene.add(group);
    return { walk, group, model, trail, terrain };
  }

  /** For the camera's upright as it is now. */
  makeControls() {
    const target = this.controls?.target;
    this.controls?.dispose();
    this.controls = new OrbitControls(this.camera, this.picture);
    if (target) this.controls.target.copy(target);
    this.controls.maxPolarAngle = 0.495 * Math.PI;
    this.controls.minDistance = 0.8 * this.reach;
    this.controls.maxDistance = 25 * this.reach;
    this.controls.addEventListener("change", this.onChange);
  }

  /** Takes over a walker's ground and gravity, which may have changed. */
  renew(i) {
    const lane = this.lanes[i];
    if (lane.terrain) {
      lane.group.remove(lane.terrain.mesh);
      lane.terrain.mesh.geometry.dispose();
    }
    lane.terrain = lane.walk.ground ? new Terrain(lane.walk.ground) : null;
    if (lane.terrain) lane.group.add(lane.terrain.mesh);
    const up = upwards(lane.walk.robot);
    if (this.camera.up.toArray().every((part, axis) => Math.abs(part - up[axis]) < 1e-9)) return;
    this.camera.up.set(...up);
    this.makeControls();
    this.controls.update();
  }

  addLights() {
    this.sky = new HemisphereLight("#ffffff", "#b9bfc6", 2.3);
    this.sun = new DirectionalLight("#ffffff", 1.5);
    this.sun.castShadow = true;
    this.sun.shadow.mapSize.set(2048, 2048);
    this.sun.shadow.camera.near = 0.1;
    this.sun.shadow.bias = -0.0005;
    this.sun.shadow.radius = 2.5;
    this.scene.add(this.sky, this.sun, this.sun.target);
  }

  /** Colours again, after light and dark changed. */
  paint() {
    this.scene.background = new Color(colour("--sky"));
    this.scene.fog.color.set(colour("--sky"));
    this.ground.paint();
    this.lanes.forEach(({ model, trail, terrain }, i) => {
      model.paint();
      terrain?.paint();
      trail.paint(this.lanes.length > 1 ? walkerLineColour(i) : colour("--ink"));
    });
  }

  /** Side by side, or all from the same place and all but the selected one as ghosts. */
  arrange(side = this.side, selected = this.selected) {
    [this.side, this.selected] = [side, selected];
    const spacing = side ? 1.5 * this.reach : 0;
    this.lanes.forEach(({ group, model }, i) => {
      group.position.y = ((this.lanes.length - 1) / 2 - i) * spacing;
      model.setGhost(!side && i !== selected);
    });
  }

  setMode(mode) {
    this.mode = mode;
  }

  /** Keeps the picture for paper. */
  copyToPaper() {
    const { domElement } = this.renderer;
    [this.paper.width, this.paper.height] = [domElement.width, domElement.height];
    this.paper.getContext("2d").drawImage(domElement, 0, 0);
  }

  /** Where each walker's centre of mass is over the ground at time t, smoothed. */
  places(t) {
    const samples = [-1, -0.5, 0, 0.5, 1].map((share) => t + share * SMOOTH_S);
    return this.lanes.map(({ walk, group }) => {
      const sum = new Vector3();
      for (const at of samples) sum.add(new Vector3(...walk.comAt(at)));
      return sum.divideScalar(samples.length).add(group.position).setZ(0);
    });
  }

  /**
   * What the camera looks at: the middle of the walkers, but no farther than the greatest spread from the selected
   * one. `spread` is from there to the farthest, `places` those of the walkers; m.
   */
  focus(t) {
    const most = MOST_SPREAD[this.side ? "side" : "ghosts"] * this.reach;
    const places = this.places(t), selected = places[this.selected];
    const middle = places.reduce((sum, place) => sum.add(place), new Vector3()).divideScalar(places.length);
    const target = middle.sub(selected).clampLength(0, most).add(selected);
    const spread = Math.min(Math.max(...places.map((place) => place.distanceTo(target))), most);
    const { walk, group } = this.lanes[this.selected];
    const ground_m = heightAt(walk.ground, target.x - group.position.x, target.y - group.position.y);
    target.z = 0.8 * this.lanes[0].walk.robot.bodies[0].position_m[2] + ground_m;
    return { time_s: t, target, spread, places };
  }

  /** From how far away all walkers are in sight. */
  distance(spread) {
    return (NEAR * this.reach + 2.4 * spread) * Math.max(1, 1.45 / this.camera.aspect);
  }

  resetCamera() {
    this.resize();
    const { target, spread } = (this.focused = this.focus(this.time_s));
    this.controls.target.copy(target);
    this.camera.position.set(0.42, -0.86, 0.34).normalize().multiplyScalar(this.distance(spread)).add(target);
    this.controls.update();
  }

  /** Moves the camera as its mode wants, from the time it last showed to t. */
  moveCamera(t) {
    const focused = this.focus(t), { target, spread } = focused;
    if (this.mode !== "still") {
      const away = this.camera.position.clone().sub(this.controls.target);
      away.multiplyScalar(this.distance(spread) / this.distance(this.focused.spread));
      this.controls.target.add(target).sub(this.focused.target);
      this.camera.position.copy(this.controls.target).add(away);
    }
    if (this.mode === "orbit") {
      const turn = ((t - this.focused.time_s) * 2 * Math.PI) / TURN_S;
      this.camera.position.sub(this.controls.target).applyAxisAngle(this.camera.up, turn).add(this.controls.target);
    }
    this.focused = focused;
    this.controls.update();
  }

  /** Brings the ground to where the camera looks, its numbers to the far side of all paths, upright. */
  moveGround(target, away) {
    const side = this.camera.position.y < target.y ? 1 : -1;
    const farthest = Math.max(...this.focused.places.map((place) => side * place.y));
    const size = Math.min(Math.max(away / (NEAR * this.reach), 1), 1.8);
    this.ground.follow(target.x, target.y, { side, way_m: side * farthest, away_m: 0.75 * this.reach, size });
  }

  /** Puts the light where it shades all walkers; the shadow's box grows in steps, or its edges would flicker. */
  moveSun(target) {
    this.sun.target.position.copy(target);
    this.sun.position.set(0.5, -1.4, 4).multiplyScalar(this.reach).add(target);
    const box = this.sun.shadow.camera, size = this.reach * (1.3 + Math.ceil(this.focused.spread / this.reach));
    if (box.right === size) return;
    [box.left, box.right, box.top, box.bottom, box.far] = [-size, size, size, -size, 12 * this.reach + 2 * size];
    box.updateProjectionMatrix();
  }

  /** Where a walker's root is in the picture: −1 … 1 to the right and up. */
  seen(i) {
    const { x, y } = this.lanes[i].model.root.getWorldPosition(new Vector3()).project(this.camera);
    return [x, y];
  }

  /** While it plays: is it too early for the next picture? Processors draw thirty a second. */
  rests(now_ms) {
    if (!this.slow) return false;
    if (now_ms - (this.drawn_ms ?? -1e9) < 30) return true;
    this.drawn_ms = now_ms;
    return false;
  }

  /** The picture of what has come to rest, a moment later, where it takes a processor long. */
  afterRest(draw) {
    clearTimeout(this.resting);
    if (this.slow && this.solid) this.resting = setTimeout(draw, REST_MS);
  }

  /** While it plays: how long ago the picture before was. After `most` in a row that came late there is less to draw. */
  keepUp(passed_s, most) {
    this.late = passed_s > LATE_S ? (this.late ?? 0) + 1 : 0;
    if (this.late < most) return;
    this.late = 0;
    this.simplify();
  }

  /** Less to draw, for machines that cannot keep up: first without shadows, then outlines. */
  simplify() {
    this.slow ||= this.simple;
    this.simple = true;
    if (this.solid) this.solid.shadowMap.enabled = false;
    this.sun.castShadow = false;
    this.pixelRatio = 1;
    this.width = 0; // so that resize() sets the size anew
  }

  resize() {
    const { clientWidth: width, clientHeight: height } = this.parent;
    if (width === 0 || height === 0 || (width === this.width && height === this.height)) return;
    [this.width, this.height] = [width, height];
    this.renderer.setPixelRatio(Math.min(devicePixelRatio, this.slow ? 1 : this.pixelRatio));
    this.renderer.setSize(width, height, false);
    this.camera.aspect = width / height;
    this.camera.updateProjectionMatrix();
  }

  /** The picture at time t; `moves`: others follow. */
  show(t, moves = false) {
    this.chooseRenderer(moves);
    this.time_s = t;
    for (const { walk, model, trail, terrain } of this.lanes) {
      model.setPose(walk.pose(t));
      const [x, y] = walk.comAt(t);
      terrain?.follow(x, y);
      model.setMissing(walk.missingLegs(t));
      walk.robot.legs.forEach((_, leg) => model.setTouch(leg, walk.touching(leg, t)));
      trail.setRow(walk.place(t).row);
    }
    this.moveCamera(t);
    const { target } = this.controls;
    const away = this.camera.position.distanceTo(target);
    this.moveGround(target, away);
    this.moveSun(target);
    this.scene.fog.near = away + 2 * this.reach;
    this.scene.fog.far = away + 18 * this.reach;
    this.renderer.render(this.scene, this.camera);
  }
}
