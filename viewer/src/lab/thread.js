// A worker that answers: thread.ask("evaluate", …) is a promise.

/** Bundled as text by build.mjs. */
const startWorker = () => new Worker(URL.createObjectURL(new Blob([AMBLE_LAB_WORKER], { type: "text/javascript" })));

export class Thread {
  constructor(module) {
    this.waiting = new Map();
    this.asked = 0;
    this.worker = startWorker();
    this.worker.onmessage = ({ data: { id, value, error } }) => {
      const { done, failed } = this.waiting.get(id);
      this.waiting.delete(id);
      if (error === undefined) done(value);
      else failed(new Error(error));
    };
    this.worker.onerror = (event) => this.die(new Error(event.message || "a thread of the page ended"));
    this.ask("start", module).catch(() => {}); // what is asked next fails with the same message
  }

  ask(does, ...values) {
    if (this.dead) return Promise.reject(this.dead);
    return new Promise((done, failed) => {
      const id = ++this.asked;
      this.waiting.set(id, { done, failed });
      this.worker.postMessage({ id, does, with: values });
    });
  }

  /** Ends it; what is waited for fails. */
  die(error = new Error("stopped")) {
    this.dead = error;
    this.worker.terminate();
    for (const { failed } of this.waiting.values()) failed(error);
    this.waiting.clear();
  }
}
