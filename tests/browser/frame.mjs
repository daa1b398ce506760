// amble's own pages in a frame of a page that the harness serves.
const pause = (ms) => new Promise((done) => setTimeout(done, ms));

/** Waits until something holds, and gives it; `what`: its name if it never does. */
export async function until(what, holds, longest_ms = 200_000) {
  for (const end = performance.now() + longest_ms; performance.now() < end; await pause(30)) {
    const value = holds();
    if (value) return value;
  }
  throw new Error(`it never came that ${what}`);
}

/** Opens a page; `steps(window)` gives what is told, to which what went wrong is added. */
export async function inFrame(url, steps) {
  const frame = document.createElement("iframe");
  frame.src = url;
  document.body.replaceChildren(frame);
  await new Promise((done) => frame.addEventListener("load", done, { once: true }));
  const page = frame.contentWindow, shown = page.document.getElementById("trouble");
  await until("the page has started", () => page.amble || !shown.hidden);
  if (!shown.hidden) throw new Error(`the page says: ${shown.textContent}`);
  const told = await steps(page);
  if (!shown.hidden) throw new Error(`the page says: ${shown.textContent}`);
  const problems = [...page.problems]; // not what comes of the page's end
  frame.remove();
  return { ...told, problems };
}

export const textOf = (page, selector) => page.document.querySelector(selector)?.textContent ?? "";
export const press = (page, name) => [...page.document.querySelectorAll("button")].find((button) => button.textContent === name).click();
