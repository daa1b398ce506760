// Ten walks through the lab and a live page, as people go (lab_walks.mjs): at each of their moments nothing runs over, no text is cut, and all
// controls have names. Each at one or two widths, light or dark; tools/lab-walks.mjs makes pictures of all.
import assert from "node:assert/strict";
import { after, before, test } from "node:test";
import { launch } from "./browser.mjs";
import { SCHEMES, WALKS, WIDTHS, makePages, take } from "./lab_walks.mjs";

let browser, pages;
before(async () => {
  pages = makePages();
  browser = await launch();
});
after(() => browser?.close());

/** How much wider the page is than its window, texts that are cut, and controls that a screen reader cannot name. */
const faults = (page) =>
  page.evaluate(() => {
    const inSight = (element) => element.checkVisibility({ visibilityProperty: true }) && !element.closest(".unseen");
    const all = [...document.body.querySelectorAll("*")].filter(inSight);
    const pen = document.createElement("canvas").getContext("2d");
    const words = (element) => element.textContent.trim().slice(0, 40);
    const hidden = all.filter((element) => words(element) && element.scrollWidth > element.clientWidth + 1 && /hidden|clip/.test(getComputedStyle(element).overflowX));
    // What is chosen in a list has no width of its own; 22 px are the arrow's.
    const lists = all.filter((element) => {
      if (element.tagName !== "SELECT") return false;
      const { font, paddingLeft, paddingRight } = getComputedStyle(element);
      pen.font = font;
      return pen.measureText(element.selectedOptions[0].text).width + parseFloat(paddingLeft) + parseFloat(paddingRight) + 22 > element.clientWidth;
    });
    // Words that stand out of the box that they are in, over what is beside it.
    const boxOf = (element) => (/^(inline|contents)$/.test(getComputedStyle(element).display) ? boxOf(element.parentElement) : element);
    const beyond = all.filter((element) => {
      if (![...element.childNodes].some((node) => node.nodeType === Node.TEXT_NODE && node.data.trim()) || element.closest("svg, .scroll, select")) return false;
      const range = document.createRange();
      range.selectNodeContents(element);
      return range.getBoundingClientRect().right > boxOf(element).getBoundingClientRect().right + 1.5;
    });
    const controls = all.filter((element) => element.matches("a, button, input, select, summary, [tabindex='0']"));
    const nameless = controls.filter((control) => !((control.labels?.[0] ?? control).textContent.trim() || control.ariaLabel || control.getAttribute("aria-labelledby")));
    return { wider: Math.max(0, document.documentElement.scrollWidth - innerWidth), cut: [...new Set([...hidden, ...lists, ...beyond])].map(words), nameless: nameless.map((one) => one.outerHTML) };
  });

for (const walk of WALKS)
  for (const look of walk.looks)
    test(`${walk.title}, ${look[0]} px, ${look[1]}`, async () => {
      let moments = 0;
      const problems = await take(browser, pages, walk, look, async (page, name) => {
        ++moments;
        assert.deepEqual(await faults(page), { wider: 0, cut: [], nameless: [] }, name);
      });
      assert.deepEqual(problems, []);
      assert.ok(moments > 0);
    });

test("a text that is cut, one that stands out of its box, and a button without a name would be found", async () => {
  const page = await browser.newPage({ viewport: { width: 300, height: 300 } });
  await page.setContent(`<p style="width: 60px; overflow: hidden; white-space: nowrap">cut off, as it is long</p><select style="width: 60px"><option>quite a long choice</select>
    <div style="width: 60px"><b style="white-space: nowrap">over what is beside it</b></div><button></button><p style="width: 400px">wide</p>`);
  assert.deepEqual(await faults(page), { wider: 108, cut: ["cut off, as it is long", "quite a long choice", "over what is beside it"], nameless: ["<button></button>"] });
  await page.close();
});

test("each width and each scheme is among them", () => {
  const looks = new Set(WALKS.flatMap(({ looks: all }) => all.map(String)));
  for (const width of WIDTHS) for (const scheme of SCHEMES) assert.ok(looks.has(`${width},${scheme}`), `${width} px, ${scheme}`);
  assert.equal(WALKS.length, 10);
});
