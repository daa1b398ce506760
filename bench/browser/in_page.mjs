// What a page does for measure.mjs: robot-steps in a module, and amble's own pages in a frame.
import { Machine } from "../../viewer/src/amble.js";
import { inFrame, press, textOf, until } from "../../tests/browser/frame.mjs";

/** µs per robot-step of each champion, of one robot and of sixteen; null where the browser does not take the module. */
async function steps({ name, champions, count }) {
  const bytes = await (await fetch(`/pages/${name}`)).arrayBuffer();
  if (!WebAssembly.validate(bytes)) return null;
  return stepsIn(await WebAssembly.compile(bytes), champions, count);
}

/** The same with a compiled module: {exact, us: [[one, sixteen], …]}. */
export async function stepsIn(module, champions, count) {
  const machine = await Machine.start(module), us = [];
  for (const champion of champions) {
    const bytes = new TextEncoder().encode(champion), { memory, amble_text, amble_measure } = machine.exports;
    const at = amble_text(bytes.length);
    new Uint8Array(memory.buffer, at, bytes.length).set(bytes);
    us.push([1, 16].map((robots) => amble_measure(at, bytes.length, robots, count)));
  }
  return { exact: machine.isExact(), us };
}

/** Lets a champion's page walk so long: frames, and seconds in which its own thread worked on them. */
const live = ({ url, seconds }) => inFrame(url, async (page) => {
  await until("it walks", () => page.amble.live() && page.amble.time() > 1);
  let busy_ms = 0;
  const ask = page.requestAnimationFrame.bind(page);
  page.requestAnimationFrame = (draw) => ask((now_ms) => {
    const start_ms = performance.now();
    draw(now_ms);
    busy_ms += performance.now() - start_ms;
  });
  const begin_ms = performance.now(), from_s = page.amble.time();
  page.amble.frames().length = 0;
  await fetch("/clock?begin"); // the processes' seconds from here on
  await until("its time is over", () => performance.now() - begin_ms > 1000 * seconds);
  await fetch("/clock?end");
  const passed_s = (performance.now() - begin_ms) / 1000;
  return { frames_s: page.amble.frames().length / passed_s, busy_share: busy_ms / 1000 / passed_s, speed: (page.amble.time() - from_s) / passed_s };
});

/** Moves a page's slider all over its walk: ms of script that each frame took. */
const scrub = ({ url, inputs }) => inFrame(url, async (page) => {
  await until("it stands", () => page.amble?.duration);
  page.amble.pause();
  page.amble.frames().length = 0;
  const slider = page.document.getElementById("slider");
  for (let i = 1; i <= inputs; ++i) {
    slider.value = page.amble.duration * ((i * 37) % inputs) / inputs;
    slider.dispatchEvent(new page.Event("input"));
    await new Promise((then) => page.requestAnimationFrame(then));
  }
  return { frames_ms: [...page.amble.frames()] };
});

/** Lets a champion's page simulate so many seconds ahead, diagrams and all: ms. */
const ahead = ({ url, seconds }) => inFrame(url, async (page) => {
  await until("it walks", () => page.amble.live() && page.amble.time() > 1);
  page.amble.pause();
  const begin_ms = performance.now();
  page.amble.simulate(seconds);
  return { took_ms: performance.now() - begin_ms };
});

/** Lets a page that only clears a canvas do so: pictures/s. */
const blank = ({ url, seconds }) => inFrame(url, async (page) => {
  const begin_ms = performance.now();
  page.amble.pictures = 0;
  await fetch("/clock?begin");
  await until("its time is over", () => performance.now() - begin_ms > 1000 * seconds);
  await fetch("/clock?end");
  return { frames_s: page.amble.pictures / ((performance.now() - begin_ms) / 1000) };
});

/** A run of the lab with its first settings until its best so far has walked so many metres: robot-steps up to there, and seconds. */
const lab = ({ url, seed, metres, generations }) => inFrame(url, async (page) => {
  const { amble } = page;
  amble.form.set({ seed, generations });
  amble.chosen("robot");
  amble.stage.clock.pause();
  press(page, "Start");
  const begin_ms = performance.now(), now = () => amble.progress;
  const ended = () => amble.evolution && amble.evolution.state !== "running" && amble.evolution.state !== "paused" && amble.evolution.state !== "new";
  await until(`it has walked ${metres} m`, () => now()?.best_so_far >= metres || ended(), 600_000);
  const told = { seconds: (performance.now() - begin_ms) / 1000, generation: now().generation, best_m: now().best_so_far, typical_m: now().typical ?? null };
  const { history } = amble.curve;
  told.steps = now().steps;
  amble.anew();
  return { ...told, robot: amble.robot().name, rows: history.length, said: textOf(page, "#said") };
});

export default { who: () => navigator.userAgent, steps, live, scrub, ahead, blank, lab };
