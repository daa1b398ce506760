import { pageData } from "./data.js";
import { heightAt } from "./heights.js";
import { Live, liveChoice, liveWalk, openedLive } from "./live.js";
import { chosenCells, showMap } from "./map.js";
import { Page } from "./page.js";
import { Walk } from "./walk.js";

function complain(text) {
  const trouble = document.getElementById("trouble");
  trouble.hidden = false;
  trouble.textContent = text;
}

/** #t=2.5 opens the page at that time, not playing. */
const askedTime = () => {
  const match = /(?:^#|&)t=([\d.]+)/.exec(location.hash);
  return match ? Number(match[1]) : null;
};

/** What scripts and tests may ask of the page. Times in seconds, walkers by their place. */
const publicApi = (page) => ({
  duration: page.clock.duration_s, // so far, of one that is simulated
  walkers: page.walks.map(({ title }) => title),
  time: () => page.clock.time_s,
  playing: () => page.clock.playing,
  play: () => page.clock.play(),
  pause: () => page.clock.pause(),
  seek: (t) => page.clock.seek(t),
  step: (frames) => page.clock.step(frames),
  speed: (factor) => page.clock.setSpeed(factor),
  camera: (mode) => page.setCamera(mode),
  resetCamera: () => page.resetCamera(),
  layout: (layout) => page.setLayout(layout),
  select: (i) => page.select(i),
  /** {root: [x, y, z, qw, qx, qy, qz], com: [x, y, z], angles: […]} */
  pose: (i, t) => page.walks[i].pose(t),
  joints: (i) => page.walks[i].robot.joints.map(({ name }) => name),
  touching: (i, leg, t) => page.walks[i].touching(leg, t),
  /** [from, to], … without chatter, as the gait figures count them */
  stances: (i, leg) => page.walks[i].stances[leg],
  /** Height of walker i's ground at (x, y), m. */
  groundAt: (i, x_m, y_m) => heightAt(page.walks[i].ground, x_m, y_m),
  /** Where the stage has put a walker's root and feet: [[x, y, z], …]; the root first. */
  placed: (i) => page.stage.lanes[i].model.placed(),
  /** {colour, outlined, there} of a foot now. */
  foot: (i, leg) => page.stage.lanes[i].model.footLook(leg),
  /** Where it is in the picture: [x, y], −1 … 1 to the right and up. */
  seen: (i) => page.stage.seen(i),
  /** Draws now, without waiting for the browser's next frame. */
  render: () => page.show(),
  /** How long the last frames took to compute and draw, ms. */
  frames: () => page.frames,
  /** What has drawn the picture that is shown: "solid" (WebGL) or "outlines". */
  drawnAs: () => page.stage.drawnAs(),
  /** For a walker that is simulated (null: it is recorded): its LiveRobot, and simulating so many seconds at once. */
  live: () => page.live?.walk.live ?? null,
  simulate: (seconds) => page.clock.seek((page.clock.duration_s = page.clock.more(page.clock.duration_s + seconds))),
});

/** All walkers; of a map those of the cells in the page's address, which the reader changes by choosing others. */
function shownWalkers(data) {
  if (!data.map) return data.walkers;
  const cells = chosenCells(data.walkers, location.hash);
  showMap(document.getElementById("map"), data, cells, (chosen) => (location.hash = `cells=${chosen}`));
  addEventListener("hashchange", () => location.reload());
  return cells.map((cell) => data.walkers.find((walker) => walker.cell === cell));
}

/** The walker in place `live` (null: none) as it is simulated, and its place; where that was not asked for and is not possible, its recording walks. */
async function simulated(walkers, live) {
  if (!walkers[live]?.champion) return { live: null, walk: null };
  try {
    return { live, walk: await liveWalk(walkers[live]) };
  } catch (error) {
    if (location.hash !== "") throw error;
    complain(`It cannot be driven here: ${error.message}. This is its recording.`);
    return { live: null, walk: null };
  }
}

async function start() {
  if (typeof DecompressionStream === "undefined") {
    complain("This browser is too old to unpack the recording in this page: it needs one of 2023 or later.");
    return;
  }
  const data = pageData(document);
  const opened = openedLive(data.walkers, location.hash), { live, walk } = await simulated(data.walkers, opened);
  const walks = walk ? [walk] : await Promise.all(shownWalkers(data).map(Walk.unpack));
  const page = new Page(data, walks);
  const links = liveChoice(data.walkers, live);
  if (links) {
    document.getElementById("subtitle").after(links);
    addEventListener("hashchange", () => openedLive(data.walkers, location.hash) !== opened && location.reload());
  }
  if (walk) new Live(page, walk);
  const time_s = askedTime();
  if (time_s !== null) page.clock.seek(time_s);
  else if (!matchMedia("(prefers-reduced-motion: reduce)").matches) page.clock.play();
  page.show();
  window.amble = publicApi(page);
}

start().catch((error) => {
  console.error(error);
  complain(`This page could not be shown: ${error.message}`);
});
