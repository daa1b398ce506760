// A run in this page: the search in one thread, trials in as many as there are. The same bits for any number of them, as what comes
// of a genome depends on genome and plan alone, and the search hears of it in the order of genomes.
import { Thread } from "./thread.js";

export class Evolution {
  /**
   * `hear`: {generation(progress, champion | null), ended(), trouble(Error), changedPlan(settings), changed(generation, settings)}.
   * @param {WebAssembly.Module} module of chooseModule()
   * @param {number} threads for trials
   */
  constructor(module, threads, hear) {
    Object.assign(this, { module, hear, generation: 0, state: "new" });
    this.search = new Thread(module);
    this.trials = Array.from({ length: threads }, () => new Thread(module));
    this.waiting = []; // what goes on when it is no longer paused
    this.changes = []; // {generation, settings, planned}, by rising generation
  }

  /** Prepares a new run, or with `files` the one that they are. Rejects with a message. */
  async open(plan, files = null) {
    this.plan = plan;
    await this.search.ask("plan", plan);
    this.description = files ? await this.search.ask("resume", files) : await this.search.ask("begin");
    this.generation = this.description.generation;
    this.generations = this.description.generations;
    await Promise.all(this.trials.map((thread) => thread.ask("plan", plan)));
    this.state = this.generation < this.generations ? "paused" : "ended";
    return this.description;
  }

  /** After its end: makes room for so many generations more. */
  async more(count) {
    const files = await this.files(), saved = files.find(({ path }) => path === "config.json");
    const config = { ...JSON.parse(new TextDecoder().decode(saved.bytes)), generations: this.generation + count };
    this.went = undefined;
    await this.open(JSON.stringify({ ...JSON.parse(this.plan), config, new: false }), files);
  }

  /** A champion's file: the first genome, before anything has walked; the best so far. */
  first() {
    return this.search.ask("first");
  }
  champion() {
    return this.search.ask("champion");
  }
  /** Of the generation that ended last, as generation() hears it; after open() with files its map alone is true. */
  progress() {
    return this.search.ask("progress");
  }
  elite(cell) {
    return this.search.ask("elite", cell);
  }
  /** [{path, bytes}] of the run's folder as it is between two generations. */
  files() {
    return this.search.ask("files");
  }

  goOn() {
    if (this.state !== "paused") return;
    this.state = "running";
    this.went ??= this.run();
    this.resume();
  }
  /** Takes effect as soon as the trials that run now have ended. */
  pause() {
    if (this.state === "running") this.state = "paused";
  }
  stop() {
    this.state = "stopped";
    this.resume();
    for (const thread of [this.search, ...this.trials]) thread.die();
  }

  /** From that generation on another world. `planned`: from the beginning, and not by who watches. */
  changeAt(generation, settings, planned = false) {
    this.changes.push({ generation, settings, planned });
    this.changes.sort((a, b) => a.generation - b.generation || a.planned - b.planned);
  }
  /** What was to come next by who watches does not. */
  forgetChanges() {
    this.changes = this.changes.filter(({ planned }) => planned);
  }

  async run() {
    try {
      while (this.generation < this.generations) {
        await this.going();
        await this.changeWorld();
        await this.oneGeneration();
      }
      this.state = "ended";
      this.hear.ended();
    } catch (error) {
      if (this.state === "stopped") return;
      this.state = "broken";
      this.hear.trouble(error);
    }
  }

  resume() {
    for (const done of this.waiting.splice(0)) done();
  }
  /** Waits while it is paused; each thread may. */
  async going() {
    while (this.state === "paused") await new Promise((done) => this.waiting.push(done));
    if (this.state === "stopped") throw new Error("stopped");
  }

  async changeWorld() {
    while (this.changes.length && this.changes[0].generation <= this.generation) {
      const { settings } = this.changes.shift(), plan = this.hear.changedPlan(settings);
      await this.search.ask("change", plan);
      this.plan = plan;
      await Promise.all(this.trials.map((thread) => thread.ask("plan", plan)));
      this.hear.changed(this.generation, settings);
    }
  }

  async oneGeneration() {
    const start_ms = performance.now();
    const chunks = await this.search.ask("chunks", this.trials.length);
    this.size = chunks.length;
    await Promise.all(this.trials.map((_, i) => this.evaluate(i, chunks)));
    const progress = await this.search.ask("tell", (performance.now() - start_ms) / 1000);
    const isNew = progress.best_generation === progress.generation;
    const champion = isNew ? await this.search.ask("champion") : null;
    ++this.generation;
    const took_s = (performance.now() - start_ms) / 1000;
    this.rate = this.rate ? 0.8 * this.rate + 0.2 / took_s : 1 / took_s;
    this.hear.generation(progress, champion);
  }

  /** Takes chunks, as long as there are some, for thread i. */
  async evaluate(i, chunks) {
    for (let chunk; (chunk = chunks.shift()); ) {
      await this.going();
      const told = await this.evaluated(i, chunk);
      await this.search.ask("take", chunk.first, told);
    }
  }

  /** A thread that died has a successor, which tries again once. */
  async evaluated(i, { bytes }) {
    try {
      return await this.trials[i].ask("evaluate", this.generation, bytes);
    } catch (error) {
      if (this.state === "stopped") throw error;
      this.trials[i].die(error);
      this.trials[i] = new Thread(this.module);
      await this.trials[i].ask("plan", this.plan);
      return this.trials[i].ask("evaluate", this.generation, bytes);
    }
  }
}
