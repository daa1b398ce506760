// What may be done to a walker that is simulated: the panel beside the stage.
import { number } from "./plot.js";
import { element } from "./theme.js";
import { button, group, row, slider } from "./widgets.js";

const PUSH_S = 0.1, PUSH_M_S = 0.25; // a push by button gives the whole robot this speed

export class LivePanel {
  /** `page`: {walk, clock, changed(): what the stage shows besides the state is another}. */
  constructor(parent, page, bits) {
    Object.assign(this, { page, walk: page.walk, rows: [] });
    this.said = element("p", { class: "note", role: "status", hidden: "" });
    this.bits = element("p", { class: "lead live-bits" }, bits);
    parent.append(
      element("h2", {}, "Live"),
      element("p", { class: "lead" }, "The champion is simulated now, in this page. Drag its body to push it; change what it walks on and what it is. " +
              "The clock’s buttons and the diagrams work as always: go back in time, and Play repeats what was, and goes on."),
      this.said,
      ...(page.steer ? [page.steer.element] : []),
      element("div", { class: "live-buttons" },
        button("Start again", () => this.restart({})), button("As it was evolved", () => this.restart({ asEvolved: true })),
        button("Save what was done", () => this.save(), { title: "A file with which `amble trial --inputs` does it again, to the bit" })),
      this.pushes(), this.ground(), this.body(), this.bits, page.evolve.element);
    parent.hidden = false;
    this.read();
  }

  say(text) {
    this.said.hidden = text === "";
    this.said.textContent = text;
  }

  /** Does something that the module may refuse. */
  async attempt(action) {
    this.say("");
    try {
      await action();
    } catch (error) {
      this.say(error.message);
    }
    this.walk.renew();
    const { clock } = this.page;
    clock.seek(clock.duration_s); // what is past stays as it was
    this.page.changed();
    this.read();
  }

  restart(options) {
    return this.attempt(() => {
      this.walk.restart(options);
      if (options.asEvolved) this.page.steer?.forget();
      this.page.clock.duration_s = 0;
      this.page.clock.seek(0);
      this.page.clock.play();
    });
  }

  save() {
    const blob = new Blob([this.walk.live.inputs()], { type: "application/json" });
    const link = element("a", { href: URL.createObjectURL(blob), download: "live-inputs.json" });
    link.click();
    setTimeout(() => URL.revokeObjectURL(link.href), 1000);
  }

  pushes() {
    const push = (x, y) => () => {
      const force = (this.walk.description.mass_kg * PUSH_M_S) / PUSH_S;
      this.walk.kick = { force_n: [x * force, y * force, 0], until_s: this.walk.seconds + PUSH_S };
      const { clock } = this.page;
      clock.seek(clock.duration_s); // what is past cannot be pushed
      clock.play();
    };
    const tall_m = this.tall_m(), step_m = 10 ** Math.floor(Math.log10(tall_m / 10));
    const height = slider(step_m, 4 * Math.ceil(tall_m / step_m) * step_m, step_m, Math.round(tall_m / step_m) * step_m);
    const from = row("Height of a drop", height, () => `${number(Number(height.value), 2)} m`);
    from.show();
    from.label.addEventListener("input", from.show);
    const drop = () => {
      const { clock } = this.page;
      clock.seek(clock.duration_s);
      this.walk.live.lift(Number(height.value));
      clock.play();
    };
    return group("Push and drop", element("div", { class: "live-buttons" },
      button("← left", push(0, 1)), button("right →", push(0, -1)), button("↑ forward", push(1, 0)), button("↓ back", push(-1, 0)),
      button("Lift and drop", drop)), from.label);
  }

  /** How high its trunk is as it starts. */
  tall_m() {
    return this.walk.robot.bodies[0].position_m[2] || 0.5;
  }

  ground() {
    const { ground_kinds: kinds } = this.walk.description;
    this.kind = element("select", { "aria-label": "Kind of ground" }, ...kinds.map((kind) => element("option", { value: kind }, kind)));
    const tall_m = this.tall_m(); // what is rough for an insect is smooth for a horse
    const step_m = 10 ** Math.floor(Math.log10(tall_m / 20));
    this.first = { height_m: Math.max(step_m, Math.round((0.1 * tall_m) / step_m) * step_m), length_m: Math.min(Math.max(2.5 * tall_m, 0.01), 100) };
    this.height = slider(step_m, Math.ceil((0.6 * tall_m) / step_m) * step_m, step_m, this.first.height_m);
    this.seed = element("input", { type: "number", min: 1, max: 99999, step: 1, value: 1 });
    this.slopeX = slider(-0.4, 0.4, 0.01, 0);
    this.slopeY = slider(-0.4, 0.4, 0.01, 0);
    this.friction = slider(0.05, 2, 0.05, 1);
    const rows = [
      row("Kind", this.kind, () => ""),
      row("Height", this.height, () => `${number(exact(this.height), 3)} m`),
      row("Seed", this.seed, () => ""),
      row("Uphill, forward", this.slopeX, () => `${number(100 * exact(this.slopeX), 0)} %`),
      row("Uphill, to the left", this.slopeY, () => `${number(100 * exact(this.slopeY), 0)} %`),
      row("Friction", this.friction, () => this.frictionText()),
    ];
    this.rows.push(...rows);
    for (const control of [this.kind, this.height, this.seed, this.slopeX, this.slopeY, this.friction])
      control.addEventListener("change", () => this.setGround(control));
    for (const { label, show } of rows) label.addEventListener("input", show);
    return group("Ground", ...rows.map(({ label }) => label));
  }

  frictionText() {
    const own = this.walk.description.friction;
    if (!this.frictionSet && own === "inf") return "never slips";
    return number(exact(this.friction), 2);
  }

  setGround(control) {
    if (control === this.friction) this.frictionSet = true;
    const now = this.walk.description.ground;
    const settings = { ...now, kind: this.kind.value, seed: Number(this.seed.value) || 1, height_m: exact(this.height),
                       slope_x: exact(this.slopeX), slope_y: exact(this.slopeY) };
    if (now.kind === "plane") Object.assign(settings, this.first);
    if (this.frictionSet) settings.friction = exact(this.friction);
    return this.attempt(() => this.walk.live.setGround(settings));
  }

  body() {
    const { legs, joints } = this.walk.robot;
    this.legs = legs.map(({ name }) => {
      const box = element("input", { type: "checkbox", checked: "" });
      box.addEventListener("change", () => this.setLeg(name, box.checked));
      return { name, box };
    });
    this.joint = element("select", { "aria-label": "Joint to lock" }, element("option", { value: "" }, "none"),
                         ...joints.map(({ name }) => element("option", { value: name }, name)));
    this.joint.addEventListener("change", () => this.setLock(this.joint.value));
    this.load = slider(0, 1, 0.05, 0);
    this.load.addEventListener("change", () => this.setLoad(exact(this.load) * this.walk.description.mass_kg));
    const load = row("Load on its back", this.load, () => `${number(exact(this.load) * this.walk.description.mass_kg, 2)} kg`);
    load.label.addEventListener("input", load.show);
    const lock = row("Joint locked as it is", this.joint, () => "");
    this.rows.push(load, lock);
    const boxes = this.legs.map(({ name, box }) => element("label", { class: "live-leg" }, box, ` ${name}`));
    return group("Body", element("div", { class: "live-row" }, element("span", {}, "Legs it has"), element("div", { class: "live-legs" }, ...boxes)), lock.label, load.label);
  }

  // Of a body's damages only the one that is chosen becomes another: it may have more than this panel can show.

  setLeg(name, there) {
    return this.setPart(({ kind, leg }) => kind === "missing" && leg === name, there ? null : { kind: "missing", leg: name });
  }
  setLock(joint) {
    return this.setPart((part) => part === this.lock, joint ? { kind: "locked", joint, angle_rad: this.angleNow(joint) } : null);
  }
  setLoad(mass_kg) {
    return this.setPart((part) => part === this.payload, mass_kg > 0 ? { ...this.payload, kind: "payload", mass_kg } : null);
  }
  setPart(isOld, part) {
    const parts = this.walk.description.damage.parts.filter((each) => !isOld(each));
    if (part) parts.push({ ...PART, ...part });
    return this.attempt(() => this.walk.live.setDamage({ parts }));
  }

  /** Within the joint's stops, which it may be beyond by a little. */
  angleNow(name) {
    const { joints } = this.walk.robot, j = joints.findIndex((joint) => joint.name === name);
    const { lower_rad, upper_rad } = joints[j];
    return Math.min(Math.max(this.walk.angles[j][this.walk.table.count - 1], lower_rad), upper_rad);
  }

  /** Shows what the module says. */
  read() {
    const { ground, friction, damage } = this.walk.description;
    this.kind.value = ground.kind;
    this.seed.value = ground.seed;
    put(this.height, ground.height_m);
    put(this.slopeX, ground.slope_x);
    put(this.slopeY, ground.slope_y);
    this.frictionSet = ground.friction >= 0;
    if (friction !== "inf") put(this.friction, friction);
    this.showLegs();
    this.lock = damage.parts.find(({ kind }) => kind === "locked");
    this.payload = damage.parts.find(({ kind }) => kind === "payload");
    this.joint.value = this.lock?.joint ?? "";
    put(this.load, (this.payload?.mass_kg ?? 0) / this.walk.description.mass_kg);
    const uneven = ground.kind !== "plane";
    this.height.disabled = this.seed.disabled = !uneven;
    for (const { show } of this.rows) show();
  }

  /** Which legs it has now: some are lost on the way. */
  showLegs() {
    const missing = this.walk.missingLegs(this.walk.seconds);
    this.legs.forEach(({ box }, leg) => (box.checked = !missing.includes(leg)));
  }
}

// A slider has steps and ends, which what it stands for need not have.
function put(control, value) {
  control.value = value;
  control.exact = { value, shown: control.value };
}
const exact = (control) => (control.value === control.exact?.shown ? control.exact.value : Number(control.value));

/** A damage's settings, all of which a file must have. */
const PART = { kind: "missing", leg: "", joint: "", body: "", angle_rad: 0, share: 0.5, mass_kg: 1, x_m: 0, y_m: 0, z_m: 0, from_s: 0 };
