// The server's events of one run, connected as long as the page is in sight: a browser keeps six connections to a server, of all its tabs.
const EVENTS = ["folder", "runs", "begin", "rows", "population", "end"];
const AGAIN_MS = 3000;

export class Stream {
  /** `hear`: a function for each event, with its data; connected(); lost(text). */
  constructor(hear) {
    this.hear = hear;
    this.over = false;
    document.addEventListener("visibilitychange", () => (document.hidden ? this.rest() : this.connect()));
    addEventListener("pagehide", () => this.rest());
  }

  open(run) {
    this.rest();
    this.run = run;
    this.connect();
  }

  connect() {
    clearTimeout(this.waiting);
    if (this.source || this.over || this.run === undefined || document.hidden) return;
    const source = (this.source = new EventSource(`events?run=${encodeURIComponent(this.run)}`));
    source.onopen = () => this.hear.connected();
    source.onerror = () => source === this.source && this.fail();
    for (const name of EVENTS)
      source.addEventListener(name, (event) => {
        if (source !== this.source) return;
        const data = JSON.parse(event.data);
        if (name === "end") this.finish();
        this.hear[name](data);
      });
  }

  /** Says why, where the server does, and tries again. */
  async fail() {
    this.rest();
    let text = "The program that serves this page does not answer: it has ended, or was killed.";
    try {
      const answer = await fetch("runs", { cache: "no-store" });
      text = answer.ok ? "The connection was lost." : (await answer.text()).trim();
    } catch (error) {
      console.info(error.message);
    }
    if (this.over || this.source) return;
    this.hear.lost(text);
    this.waiting = setTimeout(() => this.connect(), AGAIN_MS);
  }

  finish() {
    this.over = true;
    this.rest();
  }
  rest() {
    clearTimeout(this.waiting);
    this.source?.close();
    this.source = null;
  }
}
