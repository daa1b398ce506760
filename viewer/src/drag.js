// Dragging a robot's body: a force from its trunk towards the pointer.
import { ConeGeometry, CylinderGeometry, Group, Mesh, MeshBasicMaterial, Plane, Raycaster, Vector2, Vector3 } from "three";
import { colour } from "./theme.js";

const MOST = 1.5; // weights, however far the pointer is

export class Drag {
  /** `live`: {walk, clock}. A pull as long as the robot reaches is its weight. */
  constructor(stage, live) {
    Object.assign(this, { stage, live, ray: new Raycaster(), plane: new Plane(), to: new Vector3() });
    this.makeArrow();
    const { picture } = stage;
    this.listening = new AbortController();
    const { signal } = this.listening;
    // Before the camera's controls, which listen on the picture itself, hear of it.
    picture.parentElement.addEventListener("pointerdown", (event) => this.begin(event), { capture: true, signal });
    picture.addEventListener("pointermove", (event) => this.isHeldBy(event) && this.move(event), { signal });
    for (const end of ["pointerup", "pointercancel"]) picture.addEventListener(end, (event) => this.isHeldBy(event) && this.end(), { signal });
  }

  /** Hears of nothing any more. */
  remove() {
    this.listening.abort();
  }

  /** Along y, one long, from the origin; seen through whatever is before it. */
  makeArrow() {
    const thick = 0.018 * this.stage.reach;
    this.material = new MeshBasicMaterial({ depthTest: false, transparent: true, opacity: 0.9 });
    this.shaft = new Mesh(new CylinderGeometry(thick, thick, 1, 12).translate(0, 0.5, 0), this.material);
    this.head = new Mesh(new ConeGeometry(3 * thick, 8 * thick, 16), this.material);
    this.arrow = new Group();
    this.arrow.add(this.shaft, this.head);
    for (const part of this.arrow.children) part.renderOrder = 9;
    this.arrow.visible = false;
    this.stage.scene.add(this.arrow);
  }

  aim(event) {
    const box = this.stage.picture.getBoundingClientRect();
    const at = new Vector2((2 * (event.clientX - box.left)) / box.width - 1, 1 - (2 * (event.clientY - box.top)) / box.height);
    this.ray.setFromCamera(at, this.stage.camera);
  }

  begin(event) {
    if (event.button !== 0 || !this.stage.picture.contains(event.target) || this.held) return; // one finger drags
    this.aim(event);
    const { group, model } = this.stage.lanes[0];
    const [hit] = this.ray.intersectObjects(model.parts.map(({ mesh }) => mesh).filter((mesh) => mesh.visible), false);
    if (!hit) return;
    const { clock } = this.live;
    if (clock.time_s < clock.duration_s) clock.seek(clock.duration_s); // what is past cannot be pushed
    this.stage.controls.enabled = false;
    this.stage.picture.setPointerCapture(event.pointerId);
    this.plane.setFromNormalAndCoplanarPoint(this.stage.camera.getWorldDirection(new Vector3()), hit.point);
    // Where the body was grasped, as seen from the middle of the trunk, which is what the force acts on.
    this.grasp = hit.point.clone().sub(group.position).sub(model.root.position);
    this.to.copy(hit.point);
    this.held = true;
    this.pointer = event.pointerId;
    clock.play();
  }

  isHeldBy({ pointerId }) {
    return this.held && pointerId === this.pointer;
  }

  move(event) {
    this.aim(event);
    this.ray.ray.intersectPlane(this.plane, this.to);
  }

  end() {
    this.held = false;
    this.arrow.visible = false;
    this.live.walk.force_n = [0, 0, 0];
    this.stage.controls.enabled = true;
  }

  /** Before each frame: the robot has moved, the pointer perhaps not. */
  update() {
    if (!this.held) return;
    const { walk } = this.live, { group, model } = this.stage.lanes[0];
    const from = model.root.position.clone().add(group.position).add(this.grasp);
    const pull = this.to.clone().sub(from);
    const g = Math.hypot(...walk.robot.gravity_m_s2) || 9.81;
    const share = pull.length() / this.stage.reach;
    const force = pull.clone().setLength(Math.min(share, MOST) * walk.description.mass_kg * g);
    walk.force_n = share > 0.02 ? force.toArray() : [0, 0, 0];
    this.arrow.position.copy(from);
    this.arrow.quaternion.setFromUnitVectors(new Vector3(0, 1, 0), this.to.clone().sub(from).normalize());
    const length = this.to.distanceTo(from);
    this.shaft.scale.y = length;
    this.head.position.y = length;
    this.material.color.set(colour("--ink"));
    this.arrow.visible = share > 0.02;
  }
}
