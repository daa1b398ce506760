// Steering a walker that obeys: a pad for pointers, the arrow keys, a gamepad.
import { number } from "./plot.js";
import { element } from "./theme.js";
import { button, group } from "./widgets.js";

const KEYS = { ArrowUp: [1, 0], ArrowDown: [-1, 0], ArrowLeft: [0, 1], ArrowRight: [0, -1] };
const STICK_MS = 100;
const STILL = 0.15; // of a stick that is let go of

/** What arrows are for itself. */
const hasArrows = (target) => target.tagName === "SELECT" || (target.tagName === "INPUT" && target.type !== "checkbox") || target.closest(".scroll");

export class Steer {
  /** `live`: {walk, clock}, whose walk has commands. */
  constructor(live) {
    Object.assign(this, { live, limits: live.walk.description.commands, held: new Set(), stick: false });
    this.knob = element("span", { class: "steer-knob" });
    this.pad = element("div", { class: "steer-pad", title: "Up: forward. To the side: turn." }, this.knob);
    this.said = element("output", { class: "steer-said" }, "as it was evolved");
    this.element = group("Where to", element("p", { class: "lead" }, "Arrow keys while they are held, a gamepad, or the pad."), this.pad, element("div", { class: "live-buttons" },
      button("↑ ahead", () => this.tell(1, 0)), button("↰ left", () => this.tell(1, 1)), button("↱ right", () => this.tell(1, -1)),
      button("stop", () => this.tell(0, 0))), this.said);
    this.followPointer();
    this.followKeys();
    this.followStick();
  }

  /** Shares of the greatest speed and turn of its evolution, from -1 to 1. */
  tell(ahead, left) {
    const { least_speed_m_s: back_m_s, most_speed_m_s: most_m_s, most_turn_rad_s: turn_rad_s } = this.limits;
    const command = [ahead < 0 ? -ahead * back_m_s : ahead * most_m_s, left * turn_rad_s];
    this.knob.style.transform = `translate(${-40 * left}px, ${-40 * ahead}px)`;
    if (this.told?.every((part, i) => part === command[i])) return;
    this.told = command;
    const { walk, clock } = this.live;
    walk.command = command;
    clock.seek(clock.duration_s); // what is past cannot be told
    clock.play();
    const [speed, turn] = command;
    const side = turn === 0 ? "" : `, ${number(Math.abs(turn), 2)} rad/s to the ${turn > 0 ? "left" : "right"}`;
    this.said.textContent = speed === 0 && turn === 0 ? "told: stop" : `told: ${number(speed, 2)} m/s${side}`;
  }

  /** It follows the commands of its evolution again. */
  forget() {
    this.told = null;
    this.knob.style.transform = "";
    this.said.textContent = "as it was evolved";
  }

  followPointer() {
    const follow = (event) => {
      const box = this.pad.getBoundingClientRect();
      const share = (at, from, length) => Math.min(Math.max((2 * (at - from)) / length - 1, -1), 1);
      const near = (part) => (Math.abs(part) < STILL ? 0 : Math.round(part * 20) / 20);
      this.tell(near(-share(event.clientY, box.top, box.height)), near(-share(event.clientX, box.left, box.width)));
    };
    this.pad.addEventListener("pointerdown", (event) => {
      this.pad.setPointerCapture(event.pointerId);
      follow(event);
    });
    this.pad.addEventListener("pointermove", (event) => this.pad.hasPointerCapture(event.pointerId) && follow(event));
  }

  /** The arrows as long as they are held, before the page takes them for the clock; with Shift they are the clock's. */
  followKeys() {
    const change = (event) => {
      if (!(event.key in KEYS)) return;
      // A key that is held is let go of wherever that happens, and whatever else is held by then.
      const others = event.shiftKey || event.ctrlKey || event.metaKey || event.altKey || hasArrows(event.target);
      if (event.type === "keydown" ? others : !this.held.has(event.key)) return;
      event.preventDefault();
      event.stopPropagation();
      if (event.type === "keydown") this.held.add(event.key);
      else this.held.delete(event.key);
      const sum = [...this.held].reduce(([a, b], key) => [a + KEYS[key][0], b + KEYS[key][1]], [0, 0]);
      this.tell(...sum);
    };
    for (const kind of ["keydown", "keyup"]) document.addEventListener(kind, change, { capture: true });
    window.addEventListener("blur", () => {
      if (this.held.size) this.tell(0, 0);
      this.held.clear();
    });
  }

  /** A stick also wakes what pauses, when no frame asks for it. */
  followStick() {
    const moved = () => [...(navigator.getGamepads?.() ?? [])].some((gamepad) => gamepad?.axes.slice(0, 2).some((part) => Math.abs(part) >= STILL));
    let before = false; // so that a stick which is held does not undo a pause
    addEventListener("gamepadconnected", () => (this.asking ??= setInterval(() => {
      const now = moved();
      if (now && !before && !this.live.clock.playing) this.update();
      before = now;
    }, STICK_MS)));
  }

  /** Before each frame: the left stick of the first gamepad, until it is let go of or unplugged. */
  update() {
    const axes = [...(navigator.getGamepads?.() ?? [])].find((gamepad) => gamepad?.axes.length > 1)?.axes ?? [0, 0];
    const [left, ahead] = [-axes[0], -axes[1]].map((part) => (Math.abs(part) < STILL ? 0 : Math.round(part * 20) / 20));
    const moved = left !== 0 || ahead !== 0;
    if (moved || this.stick) this.tell(ahead, left);
    this.stick = moved;
  }
}
