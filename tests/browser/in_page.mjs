// What a page does for in_browser.test.mjs: sessions of champions, and amble's own pages in a frame.
import { LiveRobot, chooseModule } from "../../viewer/src/amble.js";
import { patched } from "../../viewer/src/patch.js";
import { inFrame, press, textOf, until } from "./frame.mjs";
import { runSession } from "./sessions.mjs";

let module = null;

/** As amble's pages choose it. */
async function chosenModule() {
  const [bytes, patch] = await Promise.all(["amble.wasm", "amble-relaxed.patch"].map(async (file) =>
    new Uint8Array(await (await fetch(`/source/viewer/dist/${file}`)).arrayBuffer())));
  return chooseModule([{ name: "relaxed", bytes: patched(bytes, patch) }, { name: "amble", bytes }]);
}

async function champion(text) {
  module ??= await chosenModule();
  return LiveRobot.open(module.module, text);
}

/** What a button saves, a blob. */
async function saved(page, name) {
  const make = page.URL.createObjectURL;
  const blob = await new Promise((done) => {
    page.URL.createObjectURL = (given) => {
      done(given);
      return make.call(page.URL, given);
    };
    press(page, name);
  });
  page.URL.createObjectURL = make;
  return blob;
}

/** Gives the lab a file, as who chooses one does. */
function give(page, name, content) {
  const data = new page.DataTransfer(), input = page.document.getElementById("file");
  data.items.add(new page.File([content], name));
  input.files = data.files;
  input.dispatchEvent(new page.Event("change"));
}

/** The run of the lab as it saves it, a tar in base64. */
async function savedRun(page) {
  const bytes = new Uint8Array(await (await saved(page, "Save the run")).arrayBuffer());
  return btoa(Array.from(bytes, (byte) => String.fromCharCode(byte)).join(""));
}

export default {
  who: () => ({ agent: navigator.userAgent, processors: navigator.hardwareConcurrency }),

  /** Session `number` of a champion. */
  async session({ text, number }) {
    const robot = await champion(text), recorded = robot.describe().recorded_steps, asRecorded = robot.stepsAsRecorded();
    await runSession(robot, number);
    return { recorded, asRecorded, hash: robot.hash(), inputs: robot.inputs(), module: module.name };
  },

  /** A page of recordings: that it starts, and what it is called. */
  view: ({ url }) => inFrame(url, async (page) => ({ title: textOf(page, "#title") })),

  /** The page of a champion that is simulated: compares with its file, walks, and evolves so many generations in its worker. */
  live: ({ url, generations }) => inFrame(url, async (page) => {
    await until("it has walked", () => page.amble.live() && page.amble.time() > 0.2);
    const bits = await until("it has compared", () => /in all|from step/.test(textOf(page, ".live-bits")) && textOf(page, ".live-bits"));
    for (const [label, value] of [["Population", 20], ["Length of a trial", 2]]) {
      const row = [...page.document.querySelectorAll("#live .live-row")].find(({ textContent }) => textContent.includes(label));
      const slider = row.querySelector("input");
      slider.value = value;
      slider.dispatchEvent(new page.Event("change", { bubbles: true }));
    }
    const said = () => [...page.document.querySelectorAll("#live [role=status]")].at(-1).textContent;
    press(page, "Evolve");
    await until(`${generations} generations have evolved`, () => Number(/Generation (\d+)/.exec(said())?.[1] ?? -1) >= generations - 1);
    return { bits, said: said() };
  }),

  /** The page of a champion, driven by its controls: what was done, as the page saves it, and what the page has asked for. */
  drive: ({ url }) => inFrame(url, async (page) => {
    const walk = async (seconds) => {
      const from = page.amble.time();
      await until(`it has walked ${seconds} s`, () => page.amble.live() && page.amble.time() > from + seconds);
    };
    await until("it walks", () => page.amble.live() && page.amble.time() > 0.2);
    press(page, "right →");
    await walk(0.3);
    press(page, "Lift and drop");
    await walk(0.3);
    const kind = page.document.querySelector("[aria-label='Kind of ground']");
    kind.value = "rough";
    kind.dispatchEvent(new page.Event("change", { bubbles: true }));
    page.document.querySelector("#live .live-legs input").click();
    await walk(0.5);
    page.amble.pause();
    const asked = page.performance.getEntriesByType("resource").map(({ name }) => name).filter((name) => !/^(data|blob):/.test(name));
    return { inputs: await (await saved(page, "Save what was done")).text(), asked };
  }),

  /** What the lab says of files that it cannot open; the last one it can. */
  refused: ({ url, files, good }) => inFrame(url, async (page) => {
    const said = [];
    for (const file of files) {
      give(page, file.name, file.text);
      said.push(await until(`${file.name} is refused`, () => textOf(page, "#trouble").startsWith(file.name) && textOf(page, "#trouble")));
    }
    give(page, good.name, good.text);
    await until("the other walks", () => /From the file/.test(textOf(page, "#story")));
    return { said };
  }),

  /** A run of the lab in workers, and what it is saved as. */
  lab: ({ url, settings }) => inFrame(url, async (page) => {
    const lab = page.amble;
    lab.form.set(settings);
    lab.chosen("robot");
    press(page, "Start");
    await until("the run has ended", () => lab.evolution?.state === "ended" || lab.evolution?.state === "broken");
    return { said: textOf(page, "#said"), history: lab.curve.history.length, tar: await savedRun(page) };
  }),

  /** A run that ended after so many generations opens in the lab, and goes on for a hundred more: what it is saved as when it has done `longer` of them. */
  goOn: ({ url, tar, generations, longer }) => inFrame(url, async (page) => {
    const lab = page.amble;
    give(page, "run.tar", Uint8Array.from(atob(tar), (letter) => letter.charCodeAt(0)));
    await until("the run is open", () => lab.evolution?.state === "ended" && lab.curve.history.length === generations);
    const bests = lab.curve.history.map(({ best }) => best);
    press(page, "100 more generations");
    await until("it goes on", () => lab.evolution.generation >= generations + longer);
    press(page, "Pause");
    await until("it pauses", () => lab.evolution.state === "paused");
    return { bests, tar: await savedRun(page) };
  }),

  /** The page of a run that has ended, served by the program. */
  watch: ({ rows }) => inFrame("/program/", async (page) => {
    await until("its curve is there", () => page.amble.rows.length === rows);
    await until("its best walks", () => /Best of generation \d+: /.test(textOf(page, "#story")));
    return { said: textOf(page, "#stage-text") };
  }),
};
