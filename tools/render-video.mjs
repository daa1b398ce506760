#!/usr/bin/env node
// Renders a page made by `amble view` to a video (MP4) or a picture (PNG), frame by frame, with headless Chromium and,
// for videos, ffmpeg:
//
//   tools/render-video.mjs PAGE.html OUT.mp4 [--from S] [--to S] [--speed 1] [--fps 50] [--size 1280x720] [--scheme light|dark]
//   tools/render-video.mjs PAGE.html OUT.png [--at S] [--size 1280x720] [--scheme light|dark] [--whole]
//
// The stage alone is shown; --whole keeps title and diagrams. --camera follow|orbit|still, --layout side|ghosts. Once before:
// viewer/install-packages. CHROMIUM=PATH names another browser.
import { spawn } from "node:child_process";
import { once } from "node:events";
import { existsSync } from "node:fs";
import { resolve } from "node:path";
import { pathToFileURL } from "node:url";
import { parseArgs } from "node:util";

const fail = (text) => { console.error(`render-video: ${text}`); process.exit(2); };
const text = { type: "string" };

function readArguments() {
  const options = { from: text, to: text, at: text, speed: text, fps: text, size: text, scheme: text, camera: text, layout: text,
                    whole: { type: "boolean" } };
  try {
    const { values, positionals } = parseArgs({ options, allowPositionals: true });
    const [page, out] = positionals;
    if (!out || !/\.(mp4|png)$/.test(out)) fail("usage: render-video.mjs PAGE.html OUT.mp4|OUT.png (see its first lines)");
    if (!existsSync(page)) fail(`${page}: no such file`);
    const [width, height] = (values.size ?? "1280x720").split("x").map(Number);
    if (!(width > 0 && height > 0)) fail(`--size ${values.size}: expected WIDTHxHEIGHT`);
    return { page, out, width, height, ...values };
  } catch (error) {
    return fail(error.message);
  }
}

async function openPage({ page: file, width, height, scheme, whole, camera, layout }) {
  const { chromium } = await import("../viewer/node_modules/playwright-core/index.mjs")
    .catch(() => fail("playwright-core is missing: run viewer/install-packages"));
  const browser = await chromium.launch({
    executablePath: process.env.CHROMIUM ?? "/usr/bin/chromium",
    args: ["--no-sandbox", "--disable-dev-shm-usage", "--use-gl=angle", "--use-angle=swiftshader", "--enable-unsafe-swiftshader"],
  });
  const page = await browser.newPage({ viewport: { width, height }, colorScheme: scheme ?? "light" });
  await page.goto(`${pathToFileURL(resolve(file)).href}#t=0`);
  await page.waitForFunction(() => !!window.amble);
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
  ffmpeg.on("error", () => fail("ffmpeg is missing (Debian: apt-get install ffmpeg)"));
  const frames = Math.floor(((end_s - start_s) / Number(speed)) * Number(fps)) + 1;
  for (let k = 0; k < frames; ++k)
    if (!ffmpeg.stdin.write(await shoot(page, start_s + (k * Number(speed)) / Number(fps)))) await once(ffmpeg.stdin, "drain");
  ffmpeg.stdin.end();
  const [code] = await once(ffmpeg, "close");
  if (code !== 0) fail(`ffmpeg ended with ${code}`);
}

const options = readArguments();
const { browser, page } = await openPage(options);
if (options.out.endsWith(".mp4")) await video(page, options);
else await import("node:fs").then(async ({ writeFileSync }) => writeFileSync(options.out, await shoot(page, Number(options.at ?? 0))));
await browser.close();
console.log(options.out);
