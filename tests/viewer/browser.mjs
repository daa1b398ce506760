// A headless Chromium that watches what a page says and asks for.
import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { mkdirSync, readFileSync, rmSync } from "node:fs";
import { join } from "node:path";
import { fileURLToPath, pathToFileURL } from "node:url";
import { chromium } from "../../viewer/node_modules/playwright-core/index.mjs";

const { AMBLE_PROGRAM, AMBLE_RECORDINGS, AMBLE_PAGES, CHROMIUM = "/usr/bin/chromium" } = process.env;
// The processor draws the pages' 3-D; it puts a page's parts together faster by itself than by this GL.
// Without the watchdog, as a picture may take long while other tests run.
const SOFTWARE_GL = ["--disable-gpu-watchdog", "--disable-gpu-compositing", "--use-gl=angle", "--use-angle=swiftshader", "--enable-unsafe-swiftshader"];

export const recording = (name) => join(AMBLE_RECORDINGS, name);
export const amble = (...words) => execFileSync(AMBLE_PROGRAM, words, { encoding: "utf8" });

/** Makes a page with `amble view`; gives its path. */
export function makePage(name, ...inputs) {
  mkdirSync(AMBLE_PAGES, { recursive: true });
  const path = join(AMBLE_PAGES, name);
  rmSync(path, { force: true });
  amble("view", ...inputs, "-o", path);
  return path;
}

export function launch({ gl = true } = {}) {
  const args = ["--no-sandbox", "--disable-dev-shm-usage", ...(gl ? SOFTWARE_GL : ["--disable-3d-apis"])];
  return chromium.launch({ executablePath: CHROMIUM, args });
}

/** False for what the browser says of the way in which it was started. */
export const isOurs = (message) => !/GPU stall due to ReadPixels/.test(message.text());

/** Opens a page, standing still at `at_s` (null: as a reader would, playing). `problems` collects what goes wrong. A quarter of the
 * pixels, because it is the processor that draws them. */
export async function open(browser, path, { at_s = 0, hash = null, ...context } = {}) {
  const page = await browser.newPage({ viewport: { width: 1280, height: 800 }, deviceScaleFactor: 0.5, ...context });
  page.setDefaultTimeout(60_000);
  page.on("dialog", (dialog) => dialog.accept()); // as long as a test does not listen itself
  const problems = [];
  const parts = [...(hash ? [hash] : []), ...(at_s === null ? [] : [`t=${at_s}`])];
  const url = pathToFileURL(path).href + (parts.length ? `#${parts.join("&")}` : "");
  page.on("console", (message) => isOurs(message) && problems.push(`console ${message.type()}: ${message.text()}`));
  page.on("pageerror", (error) => problems.push(`error: ${error.message}`));
  page.on("request", (request) => {
    if (request.url().split("#")[0] !== url.split("#")[0] && !/^(data|blob):/.test(request.url()))
      problems.push(`request: ${request.url()}`);
  });
  await page.goto(url);
  await page.waitForFunction(() => window.amble || !document.getElementById("trouble").hidden);
  return { page, problems };
}

/** The stage as numbers: how many colours it has, and a sum that changes with the picture. */
export const pictureOf = (page, which = "#stage canvas") =>
  page.evaluate((selector) => {
    window.amble.render();
    const stage = document.querySelector(selector);
    const copy = document.createElement("canvas");
    [copy.width, copy.height] = [stage.width, stage.height];
    const paint = copy.getContext("2d");
    paint.drawImage(stage, 0, 0);
    const { data } = paint.getImageData(0, 0, copy.width, copy.height);
    const colours = new Set();
    let hash = 0;
    for (let i = 0; i < data.length; i += 4) {
      const colour = (data[i] << 16) | (data[i + 1] << 8) | data[i + 2];
      colours.add(colour);
      hash = (Math.imul(hash, 31) + colour) | 0;
    }
    return { colours: colours.size, hash };
  }, which);

export const time = (page) => page.evaluate(() => window.amble.time());

/** Positions of the cursors of all diagrams in sight, and the places of the timers in the patterns. */
export const cursors = (page) =>
  page.evaluate(() => {
    window.amble.render();
    return {
      plots: [...document.querySelectorAll(".cursor")].map((line) => line.style.transform),
      patterns: [...document.querySelectorAll(".now-line")].map((line) => line.getAttribute("x1")),
    };
  });

/** Waits until the page has drawn the requested state. */
export const settled = (page) =>
  page.evaluate(() => new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(() => setTimeout(done)))));

const RULES = ["wcag2a", "wcag2aa", "wcag21a", "wcag21aa", "wcag22aa", "best-practice"];
const axe = () => readFileSync(fileURLToPath(new URL("../../viewer/node_modules/axe-core/axe.min.js", import.meta.url)), "utf8");

/** [rule, places] of what axe-core finds wrong. */
export async function violations(page) {
  if (!(await page.evaluate(() => "axe" in window))) await page.evaluate(axe());
  const found = await page.evaluate((runOnly) => window.axe.run(document, { runOnly, preload: false }), RULES);
  assert.ok(found.passes.length > 10, `${found.passes.length} rules applied`);
  return found.violations.map(({ id, nodes }) => [id, nodes.map(({ target }) => target.join(" "))]);
}

/** The same at two widths, light and dark: {"390 px, light": […]} of those where something is wrong. */
export async function violationsAnywhere(page) {
  const all = {};
  for (const width of [1000, 390])
    for (const colorScheme of ["light", "dark"]) {
      await page.setViewportSize({ width, height: 800 });
      await page.emulateMedia({ colorScheme });
      await settled(page);
      const found = await violations(page);
      if (found.length) all[`${width} px, ${colorScheme}`] = found;
    }
  return all;
}

/** What becomes of scripts that somebody else puts into a page: {ran, refused}, of which each is refused by a directive. */
export const intruders = (page) =>
  page.evaluate(async () => {
    const refused = [], element = (tag, attributes, text) => Object.assign(document.createElement(tag), attributes, { textContent: text });
    window.ran = [];
    addEventListener("securitypolicyviolation", ({ effectiveDirective }) => refused.push(effectiveDirective));
    const inline = element("script", {}, "window.ran.push('inline')"), address = element("script", { src: "data:text/javascript,window.ran.push('address')" }, "");
    const handler = element("button", {}, "");
    handler.setAttribute("onclick", "window.ran.push('handler')");
    for (const one of [inline, address, handler]) document.body.append(one);
    handler.click();
    await new Promise((done) => setTimeout(done, 300));
    for (const one of [inline, address, handler]) one.remove();
    return { ran: window.ran, refused: [...new Set(refused)].sort() }; // once for each policy, of which a page that is served has two
  });
export const NO_INTRUDERS = { ran: [], refused: ["script-src-attr", "script-src-elem"] };
