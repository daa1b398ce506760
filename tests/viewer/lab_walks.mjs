// Ten walks through the lab and a live page, as people go: what they read they find by role and visible text, and they have a mouse, a
// keyboard or a finger. walks.test.mjs looks whether all is in order at each moment, tools/lab-walks.mjs makes pictures of it.
import assert from "node:assert/strict";
import { mkdirSync, readFileSync, rmSync } from "node:fs";
import { join } from "node:path";
import { amble, makePage, open } from "./browser.mjs";

const { AMBLE_PAGES, AMBLE_SOURCE } = process.env;
const LONG_MS = 120_000; // of a run, at most
const PHONE = 500; // px: narrower ones are touched

export const WIDTHS = [360, 800, 1400], SCHEMES = ["light", "dark"];

/** What the walks need: the lab, a live page, and a robot's file. */
export function makePages() {
  mkdirSync(AMBLE_PAGES, { recursive: true });
  const lab = join(AMBLE_PAGES, "lab.html"), run = join(AMBLE_PAGES, "own");
  for (const path of [lab, run]) rmSync(path, { force: true, recursive: true });
  amble("lab", "-o", lab);
  const tiny = ["--generations", "1", "--jobs", "1", "--set", "population.size=10", "--set", "trial.duration_s=1"];
  amble("evolve", join(AMBLE_SOURCE, "robots/biped/evolve.toml"), ...tiny, "--out", run);
  return { lab, live: makePage("steered.html", join(AMBLE_SOURCE, "robots/hexapod/steered.json"), "--undisturbed"), robot: join(run, "robot.json") };
}

/** Somebody before a page; `moment(name)` is called where there is something to look at. */
export class Person {
  constructor(page, pages, touches, moment) {
    Object.assign(this, { page, pages, touches, moment });
  }

  button(name) {
    return this.page.getByRole("button", { name, exact: true });
  }
  hit(what) {
    return this.touches ? what.tap() : what.click();
  }
  press(name) {
    return this.hit(this.button(name));
  }
  unfold(text) {
    return this.hit(this.page.locator("summary").getByText(text, { exact: true }).or(this.page.locator("summary").filter({ hasText: new RegExp(`^${text}$`) })).first());
  }
  control(role, name) {
    return this.page.getByRole(role, { name: new RegExp(`^${name}`) });
  }
  choose(name, option) {
    return this.control("combobox", name).selectOption({ label: option });
  }
  slide(name, value) {
    return this.control("slider", name).fill(String(value));
  }
  write(name, value) {
    return this.control("spinbutton", name).fill(String(value));
  }

  /** What a screen reader has said. */
  hears(text) {
    return this.page.getByRole("status").filter({ hasText: text }).first().waitFor({ state: "attached", timeout: LONG_MS });
  }
  sees(text) {
    return this.page.getByText(text).first().waitFor({ timeout: LONG_MS });
  }

  /** A run that takes seconds. */
  async small(generations = 4) {
    await this.choose("Robot", "servo");
    await this.slide("Population", 20);
    await this.slide("Length of a trial", 2);
    await this.write("Generations", generations);
  }
  async evolve() {
    await this.press("Start");
    await this.hears(/The run is over/);
  }

  /** What a click saves, as {name, path}. */
  async save(name) {
    const [download] = await Promise.all([this.page.waitForEvent("download"), this.press(name)]);
    const path = join(AMBLE_PAGES, download.suggestedFilename());
    await download.saveAs(path);
    return path;
  }
  async openFile(path) {
    const [chooser] = await Promise.all([this.page.waitForEvent("filechooser"), this.press("Open a file")]);
    await chooser.setFiles(path);
  }

  /** Carries a file over the page, and lets go of it or not. */
  async carry(path, name, events) {
    const bytes = readFileSync(path).toString("base64");
    const dataTransfer = await this.page.evaluateHandle(([base64, called]) => {
      const carried = new DataTransfer();
      carried.items.add(new File([Uint8Array.from(atob(base64), (c) => c.charCodeAt(0))], called, { type: "application/json" }));
      return carried;
    }, [bytes, name]);
    for (const event of events) await this.page.getByRole("main").dispatchEvent(event, { dataTransfer });
  }

  /** Goes on by the Tab key until something of this name has the focus. */
  async tabTo(name) {
    for (let i = 0; i < 80; ++i) {
      await this.page.keyboard.press("Tab");
      if (await this.page.evaluate((start) => {
        const { activeElement: at } = document;
        return (at.labels?.[0] ?? at).textContent.trim().startsWith(start) || (at.ariaLabel ?? "").startsWith(start);
      }, name)) return;
    }
    throw new Error(`the Tab key leads to no “${name}”`);
  }
  async keys(...keys) {
    for (const key of keys) await this.page.keyboard.press(key);
  }

  /** A finger from the middle of something to another place of it, shares of its size away from there; until `held` has ended. */
  async drag(what, [right, down], held) {
    await what.evaluate((element) => element.scrollIntoView({ block: "end" })); // a page's player stays at the top, over what is scrolled
    const box = await what.boundingBox(), from = { x: box.x + box.width / 2, y: box.y + box.height / 2 };
    const to = { x: from.x + right * box.width, y: from.y + down * box.height };
    const session = await this.page.context().newCDPSession(this.page);
    const touch = (type, ...touchPoints) => session.send("Input.dispatchTouchEvent", { type, touchPoints });
    await touch("touchStart", from);
    for (let i = 1; i <= 4; ++i) await touch("touchMove", { x: from.x + ((to.x - from.x) * i) / 4, y: from.y + ((to.y - from.y) * i) / 4 });
    await held();
    await touch("touchEnd");
    await session.detach();
  }
}

async function first(person) {
  await person.moment("opened");
  await person.unfold("The first steps");
  await person.sees("The first networks are random. Will any of them walk?");
  await person.press("Set it up");
  await person.hears(/press Start/);
  await person.small();
  await person.evolve();
  await person.sees(/Best of generation \d+: /);
  await person.moment("evolved");
}

async function luck(person) {
  await person.unfold("Luck");
  await person.moment("question");
  for (const seed of ["Seed 1", "Seed 2"]) {
    await person.press(seed);
    await person.small(3);
    await person.evolve();
  }
  await person.sees(/^before: Seed 1, /);
  await person.moment("two seeds");
}

async function leg(person) {
  await person.small(6);
  await person.unfold("More: feet, mutation, a lost leg");
  await person.choose("It loses a leg", "its first");
  await person.write("at generation", 3);
  await person.moment("planned");
  await person.evolve();
  assert.equal(await person.control("combobox", "Leg that is missing").inputValue(), "front_left");
  await person.moment("lost");
}

async function novelty(person) {
  await person.unfold("Novelty against distance");
  for (const step of ["Reward distance", "Reward what is new"]) {
    await person.press(step);
    await person.small(4);
    await person.evolve();
  }
  await person.sees("Where they ended");
  await person.moment("two searches");
}

async function map(person) {
  await person.unfold("Not one winner, but many");
  await person.press("Set it up");
  await person.small(4);
  await person.moment("set up");
  await person.evolve();
  const cells = person.page.getByRole("table", { name: /^The map: rows/ }).getByRole("button", { name: / m$/ });
  await person.hit(cells.first());
  await person.sees(/^Of the map: /);
  await person.moment("a cell walks");
}

async function own(person) {
  await person.carry(person.pages.robot, "robot.json", ["dragenter", "dragover"]);
  await person.moment("carried over the page");
  await person.carry(person.pages.robot, "robot.json", ["dragover", "drop"]);
  await person.hears(/biped is chosen\. Press Start/);
  await person.slide("Population", 10);
  await person.slide("Length of a trial", 2);
  await person.write("Generations", 3);
  await person.moment("dropped");
  await person.evolve();
  await person.moment("evolved");
}

async function world(person) {
  await person.small(3);
  await person.evolve();
  await person.choose("Ground", "stairs");
  await person.hears(/The walker is there now/);
  await person.slide("Uphill", 0.1);
  await person.choose("Leg that is missing", "front right");
  await person.hears(/The walker is there now/);
  await person.moment("another world");
  await person.press("100 more generations");
  await person.hears(/the world is another one|^Generation \d+: best/);
  await person.press("Pause");
  await person.moment("grown up there");
}

async function keep(person) {
  await person.small(40);
  await person.press("Start");
  await person.button("Save the run").waitFor();
  await person.press("Pause");
  const file = await person.save("Save the run");
  await person.save("Save the walker");
  await person.page.reload();
  await person.button("Start").waitFor();
  await person.openFile(file);
  await person.hears(/The run is open: \d+ generations? (is|are) over/);
  await person.moment("opened again");
  await person.press("Go on");
  await person.hears(/The run is over\. Generation 39/);
  await person.moment("over");
}

async function keyboard(person) {
  await person.keys("Tab");
  await person.moment("skip link");
  await person.keys("Enter");
  await person.tabTo("Robot");
  await person.page.keyboard.type("servo");
  await person.tabTo("Population");
  await person.keys("Home", "ArrowRight");
  await person.tabTo("Generations");
  await person.keys("Control+A", "3");
  await person.tabTo("Length of a trial");
  await person.keys("Home");
  await person.tabTo("Seed");
  await person.keys("Control+A", "5", "Enter");
  await person.moment("set");
  for (let i = 0; i < 3; ++i) await person.keys("Shift+Tab");
  await person.page.keyboard.press("Control+Home");
  await person.button("Start").focus();
  await person.keys("Space");
  await person.hears(/The run is over\. Generation 2/);
  await person.moment("evolved");
}

async function steer(person) {
  const { page } = person, told = page.getByRole("group", { name: "Where to" }).getByRole("status");
  const says = (text) => told.filter({ hasText: text }).waitFor();
  await person.moment("opened");
  await person.drag(page.getByTitle("Up: forward. To the side: turn."), [0.1, -0.45], async () => {
    await says(/^told: 0\.\d+ m\/s, .* to the right$/);
    await person.moment("steered");
  });
  await person.press("right →");
  await person.drag(page.getByRole("region", { name: "Replay" }).locator("canvas").first(), [0.3, -0.1], () => person.moment("dragged"));
  await person.choose("Kind", "rough");
  await person.hit(page.getByRole("checkbox").first());
  await person.press("stop");
  await says("told: stop");
  await person.moment("on rough ground, with a leg less");
  await person.hit(page.getByText("What sensors, neurons and SUPGs say to each other"));
  await page.getByRole("img", { name: /^The network: / }).waitFor();
  await person.moment("what it says to itself");
}

/** `looks`: [width, scheme] in which the test takes the walk. */
export const WALKS = [
  { id: "first", title: "a first walker evolves", go: first, looks: [[360, "light"], [1400, "dark"]] },
  { id: "luck", title: "two seeds", go: luck, looks: [[800, "light"]] },
  { id: "leg", title: "a leg is lost", go: leg, looks: [[360, "dark"]] },
  { id: "novelty", title: "novelty against distance", go: novelty, looks: [[1400, "light"]] },
  { id: "map", title: "a map, and one of its cells", go: map, looks: [[360, "light"]] },
  { id: "own", title: "a robot of one's own is dropped onto the page", go: own, looks: [[800, "dark"]] },
  { id: "world", title: "the world changes after the end", go: world, looks: [[360, "dark"]] },
  { id: "keep", title: "a run is saved, opened again, and goes on", go: keep, looks: [[800, "dark"]] },
  { id: "keyboard", title: "by keyboard alone", go: keyboard, looks: [[1400, "light"]], context: { hasTouch: false, isMobile: false } },
  { id: "steer", title: "a walker is steered and pushed by touch", go: steer, page: "live", looks: [[360, "light"], [800, "dark"]], context: { hasTouch: true } },
];

/** Goes a walk in a window; `moment(page, name)` at each of its moments. Gives what went wrong in the page. */
export async function take(browser, pages, walk, [width, colorScheme], moment, more = {}) {
  const phone = width < PHONE, context = { viewport: { width, height: phone ? 740 : 900 }, colorScheme, hasTouch: phone, isMobile: phone, ...walk.context, ...more };
  const { page, problems } = await open(browser, pages[walk.page ?? "lab"], { at_s: null, hash: walk.page ? "live" : "threads=2", ...context });
  try {
    if (!walk.page) await page.getByText(/^A random network: /).waitFor();
    await walk.go(new Person(page, pages, context.hasTouch, (name) => moment(page, name)));
    return problems;
  } finally {
    await page.close();
  }
}
