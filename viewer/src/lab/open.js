// Saving, and opening what was saved: walkers, robots, runs.
import { configsFor, DEFAULTS, WORLD } from "./plan.js";
import { download, readFile, runBlob } from "./files.js";
import { historyOf } from "./table.js";

export class Files {
  constructor(lab) {
    this.lab = lab;
    const over = (event, on) => {
      if (![...event.dataTransfer.types].includes("Files")) return;
      event.preventDefault();
      document.body.classList.toggle("dropping", on);
    };
    addEventListener("dragover", (event) => over(event, true));
    addEventListener("dragleave", (event) => over(event, false));
    addEventListener("drop", (event) => {
      over(event, false);
      if (event.dataTransfer.files[0]) this.open(event.dataTransfer.files[0]);
    });
  }

  saveBest() {
    download(new Blob([this.lab.best.text], { type: "application/json" }), "champion.json");
  }

  /** The run's folder, and what the lab remembers of it: how it looked, and which changes of the world are still to come. */
  async saveRun() {
    const { lab } = this, { evolution, curve, settings } = lab, { generation } = lab.progress, files = await evolution.files();
    const memory = { settings, robot: { name: lab.robot().name }, history: curve.history, marks: curve.marks, changes: evolution.changes };
    download(runBlob(files, memory), "amble-run.tar");
    lab.saved = generation;
  }

  open(file) {
    return this.lab.attempt(async () => {
      try {
        const read = readFile(new Uint8Array(await file.arrayBuffer()));
        if (read.run) await this.openRun(read.run);
        else await this.openRobot(read.champion ?? read.robot, read.champion);
      } catch (error) {
        throw new Error(`${file.name} was not opened: ${error.message}`);
      }
    });
  }

  async openRobot(text, champion) {
    const { lab } = this, facts = await lab.facts(text);
    if (!facts.legs.length) throw new Error("its robot has no legs");
    if (!lab.mayLeave()) return undefined;
    lab.anew();
    this.addRobot(facts, text);
    lab.form.set({ ...lab.form.values(), robot: "own" });
    lab.form.setRobot(lab.robot());
    await lab.preview();
    if (!champion) return lab.say(`${facts.name} is chosen. Press Start to evolve it.`);
    lab.best = { text, generation: JSON.parse(text).generation };
    await lab.stage.show(text, "From the file");
    lab.stage.random = true;
    return lab.refresh();
  }

  addRobot(facts, text, gravity = 1) {
    const { lab } = this, [model] = lab.robots.values(), name = `${facts.name} (yours)`;
    lab.robots.set("own", { id: "own", name, text, facts, gravity, configs: configsFor(facts, model) });
    lab.form.addRobot("own", name);
  }

  async openRun({ files, plan, table, memory, robot }) {
    const { lab } = this, facts = await lab.facts(robot), settings = { ...DEFAULTS, ...WORLD, ...memory.settings, robot: "own" };
    const history = historyOf(table, memory.history);
    if (!lab.mayLeave()) return;
    lab.anew();
    this.addRobot(facts, robot, settings.gravity);
    lab.form.set(settings);
    lab.form.setRobot(lab.robot());
    lab.form.set({ missing: settings.missing });
    lab.step = null;
    try {
      await lab.open(plan, settings, files);
    } catch (error) {
      lab.anew();
      throw error;
    }
    const changes = memory.changes ?? lossToCome(settings, memory.marks, facts);
    for (const { generation, settings: changed, planned } of changes) lab.evolution.changeAt(generation, changed, planned);
    await this.showRun(history, memory.marks);
    lab.saved = lab.progress?.generation;
    const loss = lab.evolution.changes.find(({ planned }) => planned);
    lab.say(`The run is open: ${lab.evolution.generation} generations are over. ${loss ? `A leg is lost at generation ${Math.max(loss.generation, lab.evolution.generation)}. ` : ""}` +
            (lab.evolution.state === "ended" ? "It can have more." : "Press Go on."));
    lab.refresh();
  }

  /** As the run's table says, which may have more generations than the lab computed. */
  async showRun(history, marks) {
    const { lab } = this, { evolution, curve } = lab, now = await evolution.progress();
    Object.assign(curve, { history: history.slice(0, evolution.generation), marks });
    curve.show();
    if (now.map) lab.map.add(now);
    const last = curve.history.at(-1), best = now.best_generation;
    lab.progress = last ? { ...last, best_generation: best, map: now.map } : null;
    const text = best < 0 ? await evolution.first() : await evolution.champion();
    lab.best = lab.newest = best < 0 ? null : { text, generation: best };
    await lab.stage.show(text, best < 0 ? "One of the next generation" : `Best of generation ${best}`);
    lab.stage.random = best < 0;
  }
}

/** Of a run that an earlier lab saved, which did not write down what was to come. */
function lossToCome({ lost, lostAt }, marks, { legs }) {
  return lost === "never" || marks.includes(lostAt) ? [] : [{ generation: lostAt, settings: { missing: legs[0] }, planned: true }];
}
