// What is inside the walker on a stage: its network, and the patterns that it paints, as it walks.
import { drawCppn } from "../cppn.js";
import { Patterns } from "../patterns.js";
import { element } from "../theme.js";

const SUPG_NOTE = "Each leg’s joints, over one cycle of its timer. The line is where the leg is now; touch sends it back to the start.";
const WITHOUT_NOTES = {
  ctrnn: "This controller has no patterns over time: the network gives the weights of the neurons that move the joints.",
  sine: "This controller has no patterns that touch begins anew: the network gives each joint its wave.",
};

export class Inside {
  /** In a section that is hidden until there is a walker, with places for both: {section, cppn, patterns}. */
  constructor(places) {
    this.places = places;
  }

  /** Another walker; `text`: its champion's file. */
  begin(walk, text) {
    const { section, cppn, patterns } = this.places, { cppn_inputs: inputs, cppn_outputs: outputs } = walk.live.describe();
    section.hidden = false;
    cppn.replaceChildren(drawCppn(JSON.parse(text).genome, { inputs, outputs }));
    this.patterns = walk.supg ? new Patterns(walk) : null;
    patterns.replaceChildren(element("p", { class: "lead" }, this.patterns ? SUPG_NOTE : WITHOUT_NOTES[walk.controller.kind] ?? ""), ...(this.patterns ? [this.patterns.element] : []));
    this.show(0);
  }

  show(time_s) {
    this.patterns?.show(time_s);
  }
}
