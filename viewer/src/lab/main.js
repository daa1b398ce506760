import { chooseModule, modulesOf } from "../amble.js";
import { inflate, pageData } from "../data.js";
import { element } from "../theme.js";
import { Lab } from "./lab.js";

const MOST_THREADS = 8;

function complain(text) {
  const trouble = document.getElementById("trouble");
  trouble.hidden = false;
  trouble.textContent = text;
}

/** #threads=2 in the address; else one for each processor. */
function threads() {
  const asked = /(?:^#|&)threads=(\d+)/.exec(location.hash);
  return Math.min(Math.max(asked ? Number(asked[1]) : (navigator.hardwareConcurrency ?? 2), 1), MOST_THREADS);
}

async function start() {
  if (typeof DecompressionStream === "undefined") throw new Error("This browser is too old: it needs one of 2023 or later.");
  const { made_by, robots: packed } = pageData(document);
  const robots = JSON.parse(new TextDecoder().decode(await inflate(packed)));
  const { module } = await chooseModule(await modulesOf(document));
  const still = matchMedia("(prefers-reduced-motion: reduce)").matches;
  const lab = new Lab(module, robots, { threads: threads(), still });
  document.getElementById("app").hidden = false;
  document.body.append(element("footer", {}, element("p", {}, `Made by ${made_by}. What is evolved here has the bits of the native program: save a run, unpack it, and “amble resume” goes on with it.`)));
  await lab.begin();
  window.amble = lab;
}

start().catch((error) => {
  console.error(error);
  complain(`The lab could not start: ${error.message}`);
});
