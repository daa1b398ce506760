// Pages run their own scripts alone: their Content-Security-Policy names those by hashes (viewer/build.mjs). watch.test.mjs asks it of a page
// that is served, report.test.mjs of one without scripts.
import assert from "node:assert/strict";
import { createHash } from "node:crypto";
import { mkdirSync, readFileSync, rmSync } from "node:fs";
import { join } from "node:path";
import { after, before, test } from "node:test";
import { inflateSync } from "node:zlib";
import { NO_INTRUDERS, amble, intruders, launch, makePage, open } from "./browser.mjs";

const { AMBLE_PAGES, AMBLE_SOURCE } = process.env;

let browser, lab, walker;
before(async () => {
  mkdirSync(AMBLE_PAGES, { recursive: true });
  lab = join(AMBLE_PAGES, "lab.html");
  rmSync(lab, { force: true });
  amble("lab", "-o", lab);
  walker = makePage("walker.html", join(AMBLE_SOURCE, "robots/servo/champion.json"), "--undisturbed");
  browser = await launch();
});
after(() => browser?.close());

for (const [what, path, hash] of [["the lab", () => lab, "threads=1"], ["a recorded walker", () => walker, null], ["a simulated walker", () => walker, "live"]])
  test(`a script that is put into the page of ${what} does not run`, async () => {
    const { page, problems } = await open(browser, path(), { hash });
    assert.deepEqual(problems, [], "its own run");
    assert.deepEqual(await intruders(page), NO_INTRUDERS);
    await page.close();
  });

test("the policies name the programs as they are packed in pages", () => {
  for (const path of [lab, walker]) {
    const html = readFileSync(path, "utf8"), [, policy] = /http-equiv="Content-Security-Policy" content="([^"]+)"/.exec(html);
    const program = inflateSync(Buffer.from(/id="amble-program">([^<]+)</.exec(html)[1], "base64"));
    assert.ok(policy.includes(`'sha256-${createHash("sha256").update(program).digest("base64")}'`), path);
    assert.ok(!/script-src[^;]*unsafe-inline/.test(policy));
    for (const directive of ["base-uri 'none'", "form-action 'none'"]) assert.ok(policy.includes(directive), directive);
  }
});
