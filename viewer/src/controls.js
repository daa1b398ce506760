// Buttons, slider, choices and keys.
import { SPEEDS } from "./clock.js";
import { CAMERAS } from "./scene.js";
import { element } from "./theme.js";

const FRAMES = "← →";
const KEYS = [
  ["Space", "play, pause"], [FRAMES, "a frame back, on"], ["Shift ← →", "a second back, on"],
  ["Home, End", "to start, end"], [", .", "slower, faster"], ["C", "camera: follow, orbit, still"], ["R", "camera to its place"],
];
const KEY_OF_ONE_THAT_OBEYS = ["← ↑ → ↓", "where it is to go, while they are held"];
const KEYS_OF_MANY = [["G", "side by side or ghosts"], ["1 … 9", "choose the walker of the diagrams"]];

/** Letters, digits and marks may stand for what somebody says to a computer that listens; so they can be switched off. */
const single = { keys: true };

const byId = (id) => document.getElementById(id);

/** A group of buttons of which one is chosen. */
export function choice(label, options, chosen, onChoose) {
  const buttons = options.map(([value, text]) => {
    const button = element("button", { type: "button", "data-value": value }, text);
    button.addEventListener("click", () => onChoose(value));
    return button;
  });
  const group = element("div", { class: "choice", role: "group", "aria-label": label }, ...buttons);
  const choose = (value) =>
    buttons.forEach((button) => button.setAttribute("aria-pressed", String(button.dataset.value === String(value))));
  choose(chosen);
  return { element: group, choose };
}

export function connectTransport(clock) {
  const slider = byId("slider"), play = byId("play"), speed = byId("speed"), output = byId("clock");
  slider.max = clock.duration_s;
  slider.addEventListener("input", () => {
    clock.playing = false;
    clock.seek(Number(slider.value));
  });
  for (const value of SPEEDS) speed.append(element("option", { value }, `${value}×`));
  speed.addEventListener("change", () => clock.setSpeed(Number(speed.value)));
  play.addEventListener("click", () => clock.toggle());
  byId("start").addEventListener("click", () => clock.seek(0));
  byId("back").addEventListener("click", () => clock.step(-1));
  byId("forth").addEventListener("click", () => clock.step(1));
  return () => {
    if (clock.more) slider.max = clock.duration_s;
    slider.value = clock.time_s;
    slider.setAttribute("aria-valuetext", `${clock.time_s.toFixed(2)} seconds`);
    speed.value = clock.speed;
    // What is simulated has no length, but while it is looked at again.
    const again = clock.more && clock.time_s < clock.duration_s, total = again ? clockText(clock.duration_s, 2) : clockText(clock.duration_s, 0);
    output.replaceChildren(clockText(clock.time_s, 2), ...(clock.more && !again ? [] : [element("span", {}, ` / ${total}`)]));
    const name = clock.playing ? "Pause" : "Play";
    if (play.getAttribute("aria-label") !== name) {
      play.setAttribute("aria-label", name);
      play.classList.toggle("playing", clock.playing);
    }
  };
}

/** "7.35", "4:05". */
function clockText(time_s, decimals) {
  if (time_s < 60) return `${time_s.toFixed(decimals)} s`;
  const seconds = (time_s % 60).toFixed(decimals).padStart(decimals ? decimals + 3 : 2, "0");
  return `${Math.floor(time_s / 60)}:${seconds}`;
}

export function connectKeys(page) {
  const { clock } = page;
  const actions = {
    " ": () => clock.toggle(),
    k: () => clock.toggle(),
    ArrowLeft: (event) => (event.shiftKey ? clock.seek(clock.time_s - 1) : clock.step(-1)),
    ArrowRight: (event) => (event.shiftKey ? clock.seek(clock.time_s + 1) : clock.step(1)),
    Home: () => clock.seek(0),
    End: () => clock.seek(clock.duration_s),
    ",": () => clock.shiftSpeed(-1),
    ".": () => clock.shiftSpeed(1),
    c: () => page.setCamera(CAMERAS[(CAMERAS.indexOf(page.camera) + 1) % CAMERAS.length]),
    r: () => page.resetCamera(),
    g: () => page.setLayout(page.layout === "side" ? "ghosts" : "side"),
  };
  for (let i = 1; i <= 9; ++i) actions[i] = () => page.select(i - 1);
  document.addEventListener("keydown", (event) => {
    if (event.ctrlKey || event.metaKey || event.altKey || event.target.tagName === "SELECT") return;
    if (event.target.tagName === "INPUT" && event.target.id !== "slider" && event.target.type !== "checkbox") return; // its own keys
    const { type, tagName } = event.target;
    if (event.key === " " && (type === "checkbox" || tagName === "SUMMARY" || tagName === "A")) return; // its own key
    if (/^Arrow(Left|Right)$/.test(event.key) && event.target.closest(".scroll")) return; // what is wider than the page
    const action = actions[event.key.length === 1 ? event.key.toLowerCase() : event.key];
    if (!action || (!single.keys && /^[^ ]$/.test(event.key))) return;
    event.preventDefault();
    if (event.target.tagName === "BUTTON") event.target.blur(); // or Space would press it as well
    action(event);
  });
}

export function keyTable(walks) {
  const obeys = Boolean(walks[0].live && walks[0].description.commands); // its arrows steer
  const own = obeys ? [KEY_OF_ONE_THAT_OBEYS, ...KEYS.filter(([keys]) => keys !== FRAMES)] : KEYS;
  const rows = [...own, ...(walks.length > 1 ? KEYS_OF_MANY : [])].map(([keys, what]) =>
    element("tr", {}, element("td", {}, element("kbd", {}, keys)), element("td", {}, what)));
  const box = element("input", { type: "checkbox", id: "single-keys" });
  box.checked = single.keys;
  box.addEventListener("change", () => (single.keys = box.checked));
  return element("details", { class: "help" }, element("summary", {}, "Keys"), element("table", {}, ...rows),
                 element("label", {}, box, " Letters, digits, comma and full stop are keys, too"));
}
