// Starts the page's program, which stands in the page as src/page packs it: deflated, in base64. Where it stands as it is,
// as in dist/, the browser has started it already.
import { inflate } from "./data.js";

const packed = document.getElementById("amble-program");

async function start() {
  if (typeof DecompressionStream === "undefined") throw new Error("this browser is too old, it needs one of 2023 or later");
  const program = document.createElement("script");
  program.textContent = new TextDecoder().decode(await inflate(packed.textContent));
  document.body.append(program);
}

if (packed.type)
  start().catch((error) => {
    const trouble = document.getElementById("trouble");
    trouble.hidden = false;
    trouble.textContent = `The page could not start: ${error.message}.`;
  });
