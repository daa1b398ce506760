// The page of `amble report`, for the study in miniature: two conditions, three seeds, five generations.
import assert from "node:assert/strict";
import { mkdirSync, rmSync } from "node:fs";
import { join } from "node:path";
import { after, before, test } from "node:test";
import { pathToFileURL } from "node:url";
import { NO_INTRUDERS, amble, intruders, launch, violationsAnywhere } from "./browser.mjs";

const { AMBLE_PAGES, AMBLE_SOURCE } = process.env;
const WIDTHS = [360, 768, 1280];
let browser, path;

before(async () => {
  rmSync(AMBLE_PAGES, { recursive: true, force: true });
  mkdirSync(AMBLE_PAGES, { recursive: true });
  const study = join(AMBLE_PAGES, "study");
  amble("study", join(AMBLE_SOURCE, "studies/smoke.toml"), "--out", study, "--jobs", "2");
  path = join(AMBLE_PAGES, "report.html");
  amble("report", study, "-o", path);
  browser = await launch({ gl: false });
});
after(() => browser.close());

/** Runs `steps` on a freshly opened page that may say nothing and ask for nothing. */
async function onPage(options, steps) {
  const page = await browser.newPage(options);
  const problems = [];
  const url = pathToFileURL(path).href;
  page.on("console", (message) => problems.push(`console ${message.type()}: ${message.text()}`));
  page.on("pageerror", (error) => problems.push(`error: ${error.message}`));
  page.on("request", (request) => {
    if (request.url() !== url) problems.push(`request: ${request.url()}`);
  });
  try {
    await page.goto(url);
    await steps(page);
    assert.deepEqual(problems, []);
  } finally {
    await page.close();
  }
}

/** How far the page is wider than the window, with everything unfolded. */
const overflow = (page) =>
  page.evaluate(() => {
    for (const part of document.querySelectorAll("details")) part.open = true;
    return document.documentElement.scrollWidth - document.documentElement.clientWidth;
  });

/** Pairs of texts within one figure in sight that overlap. */
const overlaps = (page) =>
  page.evaluate(() => {
    const found = [];
    for (const figure of document.querySelectorAll("figure svg")) {
      const texts = [...figure.querySelectorAll("text")].map((text) => [text.textContent, text.getBoundingClientRect()]);
      for (let i = 0; i < texts.length; ++i)
        for (let k = 0; k < i; ++k) {
          const [[a, one], [b, other]] = [texts[i], texts[k]];
          const across = Math.min(one.right, other.right) - Math.max(one.left, other.left);
          const down = Math.min(one.bottom, other.bottom) - Math.max(one.top, other.top);
          if (across > 1 && down > 4) found.push(`${a} / ${b}`);
        }
    }
    return found;
  });

/** The contrast of a colour of text with the page behind it (WCAG 2.1). */
const contrast = (page, selector) =>
  page.evaluate((words) => {
    const luminance = (colour) => {
      const [r, g, b] = colour.match(/[\d.]+/g).slice(0, 3).map((value) => {
        const share = value / 255;
        return share <= 0.04045 ? share / 12.92 : ((share + 0.055) / 1.055) ** 2.4;
      });
      return 0.2126 * r + 0.7152 * g + 0.0722 * b;
    };
    const [one, other] = [getComputedStyle(document.querySelector(words)).color, getComputedStyle(document.body).backgroundColor]
      .map(luminance).sort((a, b) => b - a);
    return (one + 0.05) / (other + 0.05);
  }, selector);

for (const colorScheme of ["light", "dark"])
  for (const width of WIDTHS)
    test(`at ${width} px, ${colorScheme}: nothing sticks out, no labels overlap, no errors`, () =>
      onPage({ viewport: { width, height: 800 }, colorScheme }, async (page) => {
        assert.equal(await page.locator("section").count(), 11);
        assert.ok((await overflow(page)) <= 0, "wider than the window");
        assert.deepEqual(await overlaps(page), []);
        for (const part of [".verdict.confirmed", ".verdict.contradicted", ".verdict.not-confirmed", "section > p"])
          assert.ok((await contrast(page, part)) >= 4.5, part);
      }));

test("axe-core finds nothing wrong, also in what is folded away", () =>
  onPage({}, async (page) => {
    await overflow(page); // unfolds
    assert.deepEqual(await violationsAnywhere(page), {});
  }));

test("a script that is put into it does not run", async () => {
  const page = await browser.newPage();
  await page.goto(pathToFileURL(path).href);
  assert.deepEqual(await intruders(page), NO_INTRUDERS);
  await page.close();
});

test("in print everything is unfolded, light and within the paper", () =>
  onPage({ viewport: { width: 673, height: 950 }, colorScheme: "dark" }, async (page) => { // A4 within its margins
    await page.emulateMedia({ media: "print" });
    const folded = page.locator("details:not([open]) table").first();
    assert.ok(await folded.isVisible(), "a folded part is printed");
    const { sheet, ink, scheme } = await page.evaluate(() => ({
      sheet: document.documentElement.scrollWidth - document.documentElement.clientWidth,
      ink: getComputedStyle(document.body).color,
      scheme: getComputedStyle(document.documentElement).colorScheme,
    }));
    assert.ok(sheet <= 0, `wider than the paper by ${sheet} px`);
    assert.deepEqual([ink, scheme], ["rgb(22, 25, 29)", "light"]);
    assert.ok((await page.pdf({ format: "A4" })).length > 20_000);
  }));

test("the contents lead to the sections", () =>
  onPage({ viewport: { width: 1280, height: 800 } }, async (page) => {
    for (const link of await page.locator("nav a").all()) {
      const target = await link.getAttribute("href");
      assert.equal(await page.locator(`section${target}`).count(), 1, target);
    }
  }));
