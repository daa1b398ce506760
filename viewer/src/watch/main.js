import { chooseModule } from "../amble.js";
import { pageData } from "../data.js";
import { element } from "../theme.js";
import { Watch } from "./watch.js";

async function start() {
  const answer = await fetch("amble.wasm"); // the simulator, for the best walker
  if (!answer.ok) throw new Error(await answer.text());
  const bytes = new Uint8Array(await answer.arrayBuffer());
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
