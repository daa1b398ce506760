// The web site in Chromium: its first walker is driven in the front page, and axe-core finds nothing wrong.
import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { join } from "node:path";
import { after, before, test } from "node:test";
import { pathToFileURL } from "node:url";
import { isOurs, launch, violationsAnywhere } from "./browser.mjs";

const { AMBLE_PAGES, AMBLE_PROGRAM, AMBLE_SOURCE } = process.env;

let browser, site;
before(async () => {
  site = join(AMBLE_PAGES, "site");
  execFileSync(join(AMBLE_SOURCE, "tools/make-site"), [site, "--program", AMBLE_PROGRAM]);
  browser = await launch();
});
after(() => browser?.close());

/** A page of the site, in which nothing may go wrong. */
async function inPage(name, options, steps) {
  const page = await browser.newPage({ viewport: { width: 1280, height: 900 }, deviceScaleFactor: 0.5, ...options }), problems = [];
  page.setDefaultTimeout(60_000);
  page.on("console", (message) => isOurs(message) && problems.push(`console ${message.type()}: ${message.text()}`));
  page.on("pageerror", (error) => problems.push(`error: ${error.message}`));
  page.on("request", (request) => /^(file|data|blob):/.test(request.url()) || problems.push(`request: ${request.url()}`));
  await page.goto(pathToFileURL(join(site, name)).href);
  await steps(page);
  assert.deepEqual(problems, []);
  await page.close();
}

/** Metres, as the page of a walker says them. */
const distance = async (walker) => Number((await walker.locator("#now dd").nth(1).textContent()).replace("−", "-").replace(" m", ""));

/** Tells the walker where to go, and pushes it. */
async function drive(walker, keyboard) {
  const told = walker.getByRole("group", { name: "Where to" }).getByRole("status");
  await told.filter({ hasText: "as it was evolved" }).waitFor();
  await keyboard.down("ArrowUp");
  await told.filter({ hasText: /^told: 0\.\d+ m\/s$/ }).waitFor();
  const from = await distance(walker);
  for (const end = Date.now() + 60_000; (await distance(walker)) < from + 0.1;) assert.ok(Date.now() < end, "it walks");
  await keyboard.up("ArrowUp");
  await told.filter({ hasText: "told: stop" }).waitFor();
  await walker.getByRole("button", { name: "right →", exact: true }).click();
}

test("the first walker is driven by keys in a frame of the front page, until it is closed", () =>
  inPage("index.html", {}, async (page) => {
    const door = page.getByRole("link", { name: "Drive it live" }).first();
    await door.click();
    await drive(page.frameLocator("iframe"), page.keyboard);
    await page.getByRole("button", { name: "Close", exact: true }).click();
    assert.equal(await page.locator("iframe").count(), 0);
    assert.ok(await door.isVisible());
  }));

test("on a phone its page opens by itself", () =>
  inPage("index.html", { viewport: { width: 390, height: 800 }, hasTouch: true, isMobile: true }, async (page) => {
    await page.getByRole("link", { name: "Drive it live" }).first().tap();
    await page.waitForURL(/walk\/hexapod-steered\.html#live$/);
    await drive(page, page.keyboard);
  }));

for (const name of ["index.html", "read/docs/LAB.html", "read/docs/BUILDING.html"])
  test(`axe-core finds nothing wrong in ${name}`, () => inPage(name, {}, async (page) => assert.deepEqual(await violationsAnywhere(page), {})));
