// What is inside the walker on a stage: its network, and the patterns that it paints, as it walks.
import { drawCppn } from "../cppn.js";
import { Patterns } from "../patterns.js";
import { element } from "../theme.js";

const SUPG_NOTE = "Each leg’s joints, over one cycle of its timer. The line is where the leg is now; touch sends it back to the start.";
const WITHOUT_NOTES = {
  ctrnn: "This controller has no patterns over time: the network gives the weights of the neurons that move the joints.",
  network: "This controller has no patterns that touch begins anew: the network gives each joint its wave.",
};

const CPPN_NOTE = "The network that evolved (a CPPN). It does not steer the joints: it is asked once for what moves them, the patterns of SUPGs, waves, " +
  "or weights of neurons. Green links excite, orange ones inhibit.";

export class Inside {
  /** Fills a section, which is hidden until there is a walker. */
  constructor(section) {
    this.section = section;
    this.cppn = element("div", { class: "scroll cppn-box", id: "cppn", tabindex: "0", role: "group", "aria-label": "The network, which may be wider than the page" });
    this.below = element("div", { id: "patterns" });
    section.append(element("h2", { id: "inside-title" }, "Inside the walker"), element("p", { class: "lead" }, CPPN_NOTE), this.cppn, this.below);
  }

  /** Another walker; `text`: its champion's file. */
  begin(walk, text) {
    this.section.hidden = false;
    this.cppn.replaceChildren(drawCppn(JSON.parse(text).genome, walk.live.describe()));
    this.patterns = walk.supg ? new Patterns(walk) : null;
    const note = this.patterns ? SUPG_NOTE : WITHOUT_NOTES[walk.controller.kind] ?? "";
    this.below.replaceChildren(element("p", { class: "lead" }, note), ...(this.patterns ? [this.patterns.element] : []));
    this.show(0);
  }

  show(time_s) {
    this.patterns?.show(time_s);
  }
}
