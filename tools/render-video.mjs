#!/usr/bin/env node
// Renders a page made by `amble view` to a video (MP4) or a picture (PNG), frame by frame, with headless Chromium and,
// for videos, ffmpeg:
//
//   tools/render-video.mjs PAGE.html OUT.mp4 [--from S] [--to S] [--speed 1] [--fps 50] [--size 1280x720] [--scheme light|dark]
//   tools/render-video.mjs PAGE.html OUT.png [--at S] [--size 1280x720] [--scheme light|dark] [--whole]
//
// The stage alone is shown; --whole keeps title and diagrams. --camera follow|orbit|still, --layout side|ghosts. Once before:
// viewer/install-packages. CHROMIUM=PATH names another browser.
// Example: tools/render-video.mjs walker.html walker.mp4 --to 5
import { spawn, spawnSync } from "node:child_process";
import { once } from "node:events";
import { existsSync, writeFileSync } from "node:fs";
import { resolve } from "node:path";
import { pathToFileURL } from "node:url";
import { fail, readArguments as read } from "./tool_input.mjs";

const text = { type: "string" };
const { CHROMIUM = "/usr/bin/chromium" } = process.env;

function readArguments() {
  const options = { from: text, to: text, at: text, speed: text, fps: text, size: text, scheme: text, camera: text, layout: text,
                    whole: { type: "boolean" } };
  const { values, positionals: [page, out] } = read(options, 2);
  if (!out || !/\.(mp4|png)$/.test(out)) fail("expected PAGE.html OUT.mp4|OUT.png (tools/render-video.mjs --help)");
  if (!existsSync(page)) fail(`${page}: no such file`);
  const [, width, height] = (/^(\d+)x(\d+)$/.exec(values.size ?? "1280x720") ?? []).map(Number);
  if (!(width > 0 && height > 0)) fail(`--size ${values.size}: expected WIDTHxHEIGHT`);
  if (out.endsWith(".mp4") && (width % 2 || height % 2)) fail(`--size ${values.size}: a video needs even numbers`);
  for (const name of ["from", "to", "at", "speed", "fps"]) {
    const value = values[name], least = ["speed", "fps"].includes(name) ? Number.MIN_VALUE : 0;
    if (value !== undefined && !(value.trim() && Number(value) >= least && Number(value) < Infinity))
      fail(`--${name} ${value}: expected a number ${least ? "above" : "of at least"} 0`);
  }
  if (values.to !== undefined && Number(values.to) < Number(values.from ?? 0)) fail(`--to ${values.to}: expected a time after --from`);
  for (const [name, all] of Object.entries({ scheme: ["light", "dark"], camera: ["follow", "orbit", "still"], layout: ["side", "ghosts"] }))
    if (values[name] !== undefined && !all.includes(values[name])) fail(`--${name} ${values[name]}: expected one of ${all.join(", ")}`);
  return { page, out, ...values, width, height };
}

/** What must be installed; says what is missing. */
function checkTools(out) {
  if (!existsSync(CHROMIUM)) fail(`${CHROMIUM} is missing (Debian: apt-get install chromium; or CHROMIUM=PATH)`);
  if (out.endsWith(".mp4") && spawnSync("ffmpeg", ["-version"]).error) fail("ffmpeg is missing (Debian: apt-get install ffmpeg)");
}

async function openPage({ page: file, width, height, scheme, whole, camera, layout }) {
  const { chromium } = await import("../viewer/node_modules/playwright-core/index.mjs")
    .catch(() => fail("playwright-core is missing: run viewer/install-packages"));
  const browser = await chromium.launch({
    executablePath: CHROMIUM,
    args: ["--no-sandbox", "--disable-dev-shm-usage", "--use-gl=angle", "--use-angle=swiftshader", "--enable-unsafe-swiftshader"],
  });
  const page = await browser.newPage({ viewport: { width, height }, colorScheme: scheme ?? "light" });
  await page.goto(`${pathToFileURL(resolve(file)).href}#t=0`);
  await page.waitForFunction(() => !!window.amble, null, { timeout: 20_000 })
    .catch(() => fail(`${file}: not a page of \`amble view\``));
  if (!whole)
    await page.addStyleTag({ content: "#stage{position:fixed;inset:0;height:auto!important;border-radius:0;z-index:99;margin:0} .views{display:none!important}" });
  await page.evaluate(([mode, arrangement]) => {
    window.amble.render();
    if (arrangement) window.amble.layout(arrangement);
    window.amble.resetCamera();
    if (mode) window.amble.camera(mode);
  }, [camera, layout]);
  return { browser, page };
}

async function shoot(page, time_s) {
  await page.evaluate((t) => { window.amble.seek(t); window.amble.render(); }, time_s);
  return page.screenshot({ type: "png" });
}

async function video(page, { out, from, to, speed = 1, fps = 50 }) {
  const start_s = Number(from ?? 0), end_s = Number(to ?? (await page.evaluate(() => window.amble.duration)));
  const ffmpeg = spawn("ffmpeg", ["-y", "-loglevel", "error", "-f", "image2pipe", "-framerate", String(fps), "-i", "-",
                                  "-c:v", "libx264", "-pix_fmt", "yuv420p", "-crf", "18", "-movflags", "+faststart", out],
                       { stdio: ["pipe", "inherit", "inherit"] });
  ffmpeg.stdin.on("error", () => {}); // its exit code tells
  const frames = Math.floor(((end_s - start_s) / Number(speed)) * Number(fps)) + 1;
  const ended = once(ffmpeg, "close");
  for (let k = 0; k < frames && ffmpeg.exitCode === null; ++k)
    if (!ffmpeg.stdin.write(await shoot(page, start_s + (k * Number(speed)) / Number(fps))))
      await Promise.race([once(ffmpeg.stdin, "drain"), ended]);
  ffmpeg.stdin.end();
  const [code] = await ended;
  if (code !== 0) fail(`ffmpeg ended with ${code}`);
}

const options = readArguments();
checkTools(options.out);
try {
  const { browser, page } = await openPage(options);
  if (options.out.endsWith(".mp4")) await video(page, options);
  else writeFileSync(options.out, await shoot(page, Number(options.at ?? 0)));
  await browser.close();
} catch (error) {
  fail(error.message.split("\n")[0]);
}
console.log(options.out);
