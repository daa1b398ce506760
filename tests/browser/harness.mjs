// A browser without a driver: a server on this computer alone gives it a page, which asks for jobs and posts what comes out.
import { spawn } from "node:child_process";
import { existsSync, mkdirSync, mkdtempSync, readFileSync, readdirSync, rmSync, writeFileSync } from "node:fs";
import { createServer, request } from "node:http";
import { tmpdir } from "node:os";
import { delimiter, extname, join, normalize } from "node:path";
import { fileURLToPath } from "node:url";

const SOURCE = fileURLToPath(new URL("../../", import.meta.url));
const TYPES = { ".html": "text/html; charset=utf-8", ".mjs": "text/javascript", ".js": "text/javascript", ".wasm": "application/wasm", ".patch": "application/octet-stream", ".json": "application/json" };
const JOB_S = 240;

// What a browser of that name is called, what makes it start alone, and what keeps it from asking anybody for anything.
const PREFERENCES = {
  "app.normandy.enabled": false, "app.update.enabled": false, "browser.aboutwelcome.enabled": false, "browser.shell.checkDefaultBrowser": false,
  "browser.startup.homepage_override.mstone": "ignore", "datareporting.policy.dataSubmissionEnabled": false, "datareporting.healthreport.uploadEnabled": false,
  "browser.safebrowsing.malware.enabled": false, "browser.safebrowsing.phishing.enabled": false, "browser.safebrowsing.downloads.enabled": false,
  "extensions.getAddons.cache.enabled": false, "extensions.systemAddon.update.enabled": false, "extensions.update.enabled": false,
  "network.captive-portal-service.enabled": false, "network.connectivity-service.enabled": false, "network.dns.disablePrefetch": true,
  "network.proxy.type": 0, "services.settings.server": "http://127.0.0.1:9/", "toolkit.telemetry.enabled": false, "toolkit.telemetry.unified": false,
  "webgl.force-enabled": true, "dom.disable_open_during_load": false,
};
// Chromium draws on the processor, or on what Vulkan has as a graphics device.
const WITHOUT_DEVICE = ["--disable-gpu-compositing", "--use-gl=angle", "--use-angle=swiftshader", "--enable-unsafe-swiftshader"];
const WITH_DEVICE = ["--ignore-gpu-blocklist", "--enable-gpu-rasterization", "--disable-gpu-sandbox", "--use-gl=angle", "--use-angle=vulkan"];
const BROWSERS = {
  firefox: { programs: ["firefox-esr", "firefox"], variable: "FIREFOX",
             words: (profile, url) => ["--headless", "--no-remote", "--profile", profile, url],
             prepare: (profile) => writeFileSync(join(profile, "user.js"), Object.entries(PREFERENCES).map(([name, value]) => `user_pref("${name}", ${JSON.stringify(value)});\n`).join("")) },
  chromium: { programs: ["chromium", "chromium-browser"], variable: "CHROMIUM",
              words: (profile, url, device) => ["--headless", "--no-sandbox", "--disable-dev-shm-usage", "--no-first-run", "--disable-background-networking", "--disable-component-update",
                                        ...(device ? WITH_DEVICE : WITHOUT_DEVICE), "--window-size=1280,800", `--user-data-dir=${profile}`, url],
              prepare: () => {} },
};

/** The program of a browser, "firefox" or "chromium"; null if it is not installed. */
export function findBrowser(kind) {
  const { programs, variable } = BROWSERS[kind], named = process.env[variable];
  if (named) return existsSync(named) ? named : null;
  const all = programs.flatMap((name) => process.env.PATH.split(delimiter).map((folder) => join(folder, name)));
  return all.find((path) => existsSync(path)) ?? null;
}

/** First in each page: keeps what goes wrong in window.problems. */
const EAR = `<script>window.problems = [];
addEventListener("error", (event) => problems.push("error: " + event.message));
addEventListener("unhandledrejection", (event) => problems.push("rejected: " + event.reason));
addEventListener("securitypolicyviolation", (event) => problems.push("policy: " + event.violatedDirective + " " + event.blockedURI));
for (const kind of ["debug", "log", "info", "warn", "error"]) console[kind] = (...words) => problems.push("console " + kind + ": " + words.join(" "));
</script>`;
const withEar = (html) => html.replace("<head>", () => `<head>${EAR}`);

export class Browser {
  /**
   * Starts it in a fresh profile. `jobs`: a module below the sources whose default export has a function for each job; `pages`: a
   * folder whose files are at /pages/; a job takes at most `longest_s`; `device`: variables of the environment by which Chromium finds a
   * graphics device, if it shall have one.
   */
  static async open(kind, { jobs, pages, longest_s = JOB_S, device = null }) {
    const browser = new Browser();
    Object.assign(browser, { kind, pages, longest_s, device, asked: [], clock: [], waiting: null, told: new Map(), count: 0, output: "" });
    browser.server = createServer((ask, answer) => browser.answer(ask, answer).catch((error) => answer.writeHead(500).end(error.message)));
    await new Promise((done) => browser.server.listen(0, "127.0.0.1", done));
    browser.url = `http://127.0.0.1:${browser.server.address().port}`;
    browser.start(`${browser.url}/start?jobs=${encodeURIComponent(`/source/${jobs}`)}`);
    return browser;
  }

  start(url) {
    const { words, prepare } = BROWSERS[this.kind];
    this.profile = mkdtempSync(join(tmpdir(), "amble-browser-"));
    prepare(this.profile);
    const environment = { ...process.env, HOME: this.profile, MOZ_CRASHREPORTER_DISABLE: "1", MOZ_DISABLE_AUTO_SAFE_MODE: "1", ...this.device };
    this.process = spawn(findBrowser(this.kind), words(this.profile, url, this.device), { stdio: ["ignore", "pipe", "pipe"], env: environment });
    for (const stream of [this.process.stdout, this.process.stderr]) stream.on("data", (text) => (this.output = (this.output + text).slice(-4000)));
    this.ended = new Promise((done) => this.process.on("exit", done));
    this.ended.then(() => this.fail("the browser ended"));
    this.interrupted = () => this.close().then(() => process.exit(1));
    for (const signal of ["SIGINT", "SIGTERM"]) process.once(signal, this.interrupted);
  }

  /** Does a job in the page; gives what it gives, or rejects with its message. */
  run(job, given = {}) {
    return new Promise((done, failed) => {
      const id = ++this.count;
      const timer = setTimeout(() => this.fail(`${job}: no answer after ${this.longest_s} s`), 1000 * this.longest_s);
      this.told.set(id, { done, failed, timer });
      this.asked.push({ id, job, given });
      this.hand();
    });
  }

  fail(text) {
    for (const { failed, timer } of this.told.values()) {
      clearTimeout(timer);
      failed(new Error(`${text}\n${this.output}`));
    }
    this.told.clear();
  }

  /** Gives the page that waits the next job. */
  hand() {
    if (!this.waiting || !this.asked.length) return;
    this.waiting.writeHead(200, { "content-type": "application/json" }).end(JSON.stringify(this.asked.shift()));
    this.waiting = null;
  }

  async answer(ask, answer) {
    const { pathname, search } = new URL(ask.url, this.url);
    if (pathname === "/start") return this.send(answer, "start.html", START);
    if (pathname === "/next") {
      this.waiting = answer;
      return this.hand();
    }
    if (pathname === "/clock") {
      this.clock.push(processorSeconds(this.process.pid));
      return answer.writeHead(204).end();
    }
    if (pathname === "/told") return this.hear(ask, answer);
    const [, root, ...rest] = decodeURIComponent(pathname).split("/"), name = normalize(`/${rest.join("/")}`);
    if (root === "program" && this.program) return this.passOn(`${name}${search}`, ask, answer);
    const path = { source: join(SOURCE, name), pages: join(this.pages ?? "/nowhere", name) }[root];
    if (!path || !TYPES[extname(path)] || !existsSync(path)) return answer.writeHead(404).end();
    const bytes = readFileSync(path);
    this.send(answer, path, root === "pages" && extname(path) === ".html" ? withEar(bytes.toString()) : bytes);
  }

  send(answer, name, bytes) {
    answer.writeHead(200, { "content-type": TYPES[extname(name)], "cache-control": "no-store" }).end(bytes);
  }

  async hear(ask, answer) {
    const parts = [];
    for await (const part of ask) parts.push(part);
    answer.writeHead(204).end();
    const { id, value, error } = JSON.parse(Buffer.concat(parts).toString()), one = this.told.get(id);
    if (!one) return;
    this.told.delete(id);
    clearTimeout(one.timer);
    if (error === undefined) one.done(value);
    else one.failed(new Error(error));
  }

  /** What is at /program/ is asked from the program that serves at this address, as if by a page of its own. */
  passOn(path, ask, answer) {
    const { hostname, port } = new URL(this.program);
    const asked = request({ hostname, port, path, headers: { host: `${hostname}:${port}`, accept: ask.headers.accept ?? "*/*" } }, (from) => {
      answer.writeHead(from.statusCode, { "content-type": from.headers["content-type"] });
      if (path !== "/") return from.pipe(answer);
      const parts = [];
      from.on("data", (part) => parts.push(part)).on("end", () => answer.end(withEar(Buffer.concat(parts).toString())));
    });
    asked.on("error", () => answer.destroy());
    answer.on("close", () => asked.destroy());
    asked.end();
  }

  async close() {
    for (const signal of ["SIGINT", "SIGTERM"]) process.off(signal, this.interrupted);
    for (const { timer } of this.told.values()) clearTimeout(timer);
    this.told.clear();
    this.process.kill("SIGKILL"); // those that it started end with it
    await this.ended;
    this.server.closeAllConnections();
    this.server.close();
    rmSync(this.profile, { recursive: true, force: true, maxRetries: 10, retryDelay: 100 });
  }
}

/** Asks for a job, does it, says what came out, and asks again. */
const START = `<!DOCTYPE html><html lang="en"><head><meta charset="utf-8"><link rel="icon" href="data:,"><title>amble in a browser</title>
<style>body { margin: 0 } iframe { display: block; border: 0; width: 1280px; height: 800px }</style></head><body><script type="module">
const { default: jobs } = await import(new URLSearchParams(location.search).get("jobs"));
for (;;) {
  const { id, job, given } = await (await fetch("/next")).json();
  const told = { id };
  try {
    told.value = (await jobs[job](given)) ?? null;
  } catch (error) {
    told.error = String(error.stack ?? error);
    if (!told.error.includes(error.message)) told.error = error.message + "\\n" + told.error;
  }
  await fetch("/told", { method: "POST", body: JSON.stringify(told) });
}
</script></body></html>`;

/**
 * What a process and all that it started have used of processors so far, s, by thread: {id, main: whether it is its process's first, content:
 * whether that process shows pages, name, used_s}.
 */
function processorSeconds(root) {
  const read = (path) => readFileSync(path, "utf8"), numbers = (path) => readdirSync(path).filter((name) => /^\d+$/.test(name));
  const unlessEnded = (look) => {
    try {
      return look();
    } catch {
      return [];
    }
  };
  const parents = numbers("/proc").flatMap((pid) => unlessEnded(() => [[Number(pid), Number(read(`/proc/${pid}/stat`).replace(/^.*\) /s, "").split(" ")[1])]]));
  const family = (pid) => [pid, ...parents.filter(([, parent]) => parent === pid).flatMap(([child]) => family(child))];
  return family(root).flatMap((pid) => unlessEnded(() => {
    const content = /--type=renderer|-contentproc/.test(read(`/proc/${pid}/cmdline`));
    return numbers(`/proc/${pid}/task`).flatMap((task) => unlessEnded(() => [{
      id: `${pid}.${task}`, main: Number(task) === pid, content, name: read(`/proc/${pid}/task/${task}/comm`).trim(),
      used_s: Number(read(`/proc/${pid}/task/${task}/schedstat`).split(" ")[0]) / 1e9,
    }]));
  }));
}

/** A folder for pages, which is made. */
export function madeFolder(path) {
  rmSync(path, { recursive: true, force: true });
  mkdirSync(path, { recursive: true });
  return path;
}
