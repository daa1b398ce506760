import { chooseModule } from "../amble.js";
import { inflate, pageData } from "../data.js";
import { element } from "../theme.js";
import { Watch } from "./watch.js";

async function start() {
  if (typeof DecompressionStream === "undefined") throw new Error("This browser is too old: it needs one of 2023 or later.");
  const bytes = await inflate(document.getElementById("amble-module").textContent);
  const { module } = await chooseModule([{ name: "amble", bytes }]);
  const watch = new Watch(module, { still: matchMedia("(prefers-reduced-motion: reduce)").matches });
  document.getElementById("app").hidden = false;
  document.body.append(element("footer", {}, element("p", {}, `Made by ${pageData(document).made_by}. It shows what is in the run’s files, and changes nothing.`)));
  watch.begin();
  window.amble = watch;
}

start().catch((error) => {
  console.error(error);
  const trouble = document.getElementById("trouble");
  trouble.hidden = false;
  trouble.textContent = `The page could not start: ${error.message}`;
});
