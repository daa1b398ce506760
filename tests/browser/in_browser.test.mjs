// node in_browser.test.mjs firefox|chromium: the module in a browser computes the native program's bits, and amble's pages work there.
// Exit code 77 where that browser is not installed.
import assert from "node:assert/strict";
import { execFileSync, spawn } from "node:child_process";
import { readFileSync, readdirSync } from "node:fs";
import { join } from "node:path";
import { after, before, test } from "node:test";
import { LiveRobot, chooseModule } from "../../viewer/src/amble.js";
import { again, champions, source } from "./champions.mjs";
import { Browser, findBrowser, madeFolder } from "./harness.mjs";
import { amble, table } from "./lab_runs.mjs";
import { STEPS, runSession } from "./sessions.mjs";

const { AMBLE_PROGRAM, AMBLE_WORK } = process.env, [, , kind] = process.argv;
if (!findBrowser(kind)) {
  console.log(`skipped: ${kind} is not installed (./setup --${kind === "firefox" ? "dev" : "tools"})`);
  process.exit(77);
}
const GENERATIONS = 20, MORE = 2;
const SERVO = source("robots/servo/champion.json");
const text = (path) => readFileSync(path, "utf8");

/** Since when Chromium has relaxed SIMD, which is taken where the processor has fused multiply-adds. */
const FIRST_RELAXED = 114;
const fuses = kind === "chromium" && /\bfma\b/.test(readFileSync("/proc/cpuinfo", "utf8"));

let browser, module, version;
before(async () => {
  madeFolder(AMBLE_WORK);
  ({ module } = await chooseModule([{ name: "amble", bytes: readFileSync(source("viewer/dist/amble.wasm")) }]));
  browser = await Browser.open(kind, { jobs: "tests/browser/in_page.mjs", pages: AMBLE_WORK });
  const { agent, processors } = await browser.run("who");
  version = Number(/(?:Chrome|Firefox)\/(\d+)/.exec(agent)[1]);
  console.log(`# ${agent}; ${processors} processors`);
});
after(() => browser?.close());

/** Without WebGL, as where there is neither a graphics card nor a program that stands in for it, a page says so once, and draws outlines. */
const problemsOf = ({ problems }) => problems.filter((problem) => !/WebGL/i.test(problem));

/** A run as the lab saves it, unpacked into a folder of that name. */
function unpacked(tar, name) {
  const folder = madeFolder(join(AMBLE_WORK, name));
  execFileSync("tar", ["xf", "-", "-C", folder, "--strip-components=1"], { input: Buffer.from(tar, "base64") });
  return folder;
}

champions.forEach(([name, champion], number) =>
  test(`${name}: the same bits natively, in Node.js and here, in ${STEPS} steps of a session and in the trial of its file`, async () => {
    const robot = await LiveRobot.open(module, text(champion));
    await runSession(robot, number);
    const { recorded, asRecorded, hash, inputs, module: chosen } = await browser.run("session", { text: text(champion), number });
    if (fuses && version >= FIRST_RELAXED) assert.equal(chosen, "relaxed");
    assert.equal(hash, robot.hash());
    assert.equal(asRecorded, recorded);
    const { status, stdout, stderr } = again(champion, inputs, `session-${number}`);
    assert.equal(stderr, "");
    assert.match(stdout, new RegExp(`^steps +${STEPS}$`, "m"));
    assert.match(stdout, /^bits +the same in every step$/m);
    assert.equal(status, 0);
    console.log(`# ${name}: ${hash}, by ${chosen}`);
  }));

test("a page of recordings opens, and nothing goes wrong in it", async () => {
  amble("view", SERVO, "--undisturbed", "-o", join(AMBLE_WORK, "walk.html"));
  const told = await browser.run("view", { url: "/pages/walk.html#t=0" });
  assert.deepEqual(problemsOf(told), []);
  assert.match(told.title, /servo/i);
});

test("a champion's page simulates it with the bits of its file, and evolves in its worker", async () => {
  const told = await browser.run("live", { url: "/pages/walk.html#live", generations: GENERATIONS });
  assert.deepEqual(problemsOf(told), []);
  assert.match(told.bits, /Exact: .* in all 1500 steps/);
});

test("pushed, dropped, on other ground and without a leg it walks as natively, to the bit, and asks nobody for anything", async () => {
  const told = await browser.run("drive", { url: "/pages/walk.html#live" });
  assert.deepEqual(problemsOf(told), []);
  assert.deepEqual(told.asked, []);
  const { inputs } = JSON.parse(told.inputs);
  for (const what of ["push_n_s", "lift_m", "ground", "damage"]) assert.ok(inputs.some((input) => what in input), what);
  assert.match(again(SERVO, told.inputs, "driven").stdout, /^bits +the same in every step$/m);
});

test(`${GENERATIONS} generations in the lab, in its workers, have the table and the champions of amble evolve`, async () => {
  amble("lab", "-o", join(AMBLE_WORK, "lab.html"));
  const settings = { robot: "servo", population: 20, seconds: 2, generations: GENERATIONS };
  const told = await browser.run("lab", { url: "/pages/lab.html#threads=2", settings });
  assert.deepEqual(problemsOf(told), []);
  assert.equal(told.history, GENERATIONS);
  const run = unpacked(told.tar, "lab-here"), native = join(AMBLE_WORK, "lab-native");
  amble("evolve", join(run, "config.toml"), "--jobs", "1", "--out", native);
  const names = (folder) => readdirSync(join(folder, "champions")).sort();
  assert.deepEqual(table(run), table(native));
  assert.deepEqual(names(run), names(native));
  assert.ok(names(run).length > 1);
  for (const name of names(run)) assert.equal(text(join(run, "champions", name)), text(join(native, "champions", name)), name);
});

test("a run of the lab goes on natively, and from there on in the lab, in the generations of one that never stopped", async () => {
  const run = join(AMBLE_WORK, "lab-here"), native = join(AMBLE_WORK, "lab-native");
  amble("resume", run, "--generations", String(GENERATIONS + MORE), "--jobs", "1");
  const [header, ...rows] = table(run).map((line) => line.split(",")), shown = rows.map((cells) => Number(cells[header.indexOf("best")]));
  const tar = execFileSync("tar", ["cf", "-", "-C", AMBLE_WORK, "lab-here"], { maxBuffer: 1e8 }).toString("base64");
  const told = await browser.run("goOn", { url: "/pages/lab.html#threads=2", tar, generations: GENERATIONS + MORE, longer: MORE });
  assert.deepEqual(problemsOf(told), []);
  const back = unpacked(told.tar, "lab-back"), over = table(back).length - 1;
  assert.ok(over >= GENERATIONS + 2 * MORE, `${over} generations`);
  amble("resume", native, "--generations", String(over), "--jobs", "1");
  assert.deepEqual(table(back), table(native));
  assert.deepEqual(told.bests, shown);
});

test("the lab says what is wrong with files that it cannot open", async () => {
  const champion = text(SERVO);
  const files = [{ name: "broken.json", text: champion.slice(0, 2000) }, { name: "altered.json", text: champion.replace('"generation": ', '"generation": 1') },
                 { name: "other.json", text: '{"format": "amble-repertoire"}' }];
  const told = await browser.run("refused", { url: "/pages/lab.html#threads=2", files, good: { name: "servo.json", text: champion } });
  assert.deepEqual(problemsOf(told), []);
  for (const [i, message] of [/neither/, /checksum does not fit/, /no robot, champion or run/].entries()) assert.match(told.said[i], message);
});

test("the page of a run, which the program serves, shows its curve and lets its best walk", async () => {
  const server = spawn(AMBLE_PROGRAM, ["view", "--live", join(AMBLE_WORK, "lab-native")]);
  try {
    browser.program = await new Promise((found, failed) => {
      let said = "";
      server.stderr.on("data", (more) => {
        const match = /watch it at (\S+)\n/.exec((said += more));
        if (match) found(match[1]);
      });
      server.on("exit", () => failed(new Error(said)));
    });
    const told = await browser.run("watch", { rows: table(join(AMBLE_WORK, "lab-native")).length - 1 });
    assert.deepEqual(problemsOf(told), []);
    assert.match(told.said, /The run has ended/);
  } finally {
    server.kill("SIGINT");
  }
});
