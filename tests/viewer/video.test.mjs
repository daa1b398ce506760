// tools/render-video.mjs where ffmpeg is installed.
import assert from "node:assert/strict";
import { spawnSync } from "node:child_process";
import { readFileSync } from "node:fs";
import { test } from "node:test";
import { fileURLToPath } from "node:url";
import { makePage, recording } from "./browser.mjs";

const skip = spawnSync("ffmpeg", ["-version"]).status === 0 ? false : "ffmpeg is not installed"; // CMakeLists.txt looks for this

test("render-video.mjs makes a video", { skip }, () => {
  const page = makePage("walk.html", recording("walk.rec")), video = page.replace(".html", ".mp4");
  const tool = fileURLToPath(new URL("../../tools/render-video.mjs", import.meta.url));
  const made = spawnSync(process.execPath, [tool, page, video, "--to", "0.1", "--size", "64x48"], { encoding: "utf8" });
  assert.equal(made.status, 0, made.stderr);
  assert.equal(readFileSync(video).subarray(4, 8).toString(), "ftyp");
});
