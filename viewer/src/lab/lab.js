// The lab: form, lesson, a run, and what is shown of it.
import { Machine } from "../amble.js";
import { number } from "../plot.js";
import { element, onThemeChange } from "../theme.js";
import { askBeforeLeaving } from "../unsaved.js";
import { Curve, kindsOf } from "./curve.js";
import { Earlier } from "./earlier.js";
import { Ends } from "./ends.js";
import { Evolution } from "./evolution.js";
import { Files } from "./open.js";
import { Footfalls } from "./footfalls.js";
import { Form } from "./form.js";
import { Inside } from "./inside.js";
import { lessonList } from "./lesson.js";
import { MapView } from "./map_view.js";
import { DEFAULTS, WORLD, changedPlan, planOf, sameWorld, worldOf } from "./plan.js";
import { LabStage } from "./stage.js";
import { Thread } from "./thread.js";
import { Toolbar } from "./toolbar.js";

const SAY_EVERY = 10; // generations, to screen readers
const MORE = 100; // generations, after the end
const NAMED = 2; // settings, in the name of a run
const PREVIEW_MS = 250; // after the last change of a setting
const BRIEF_MS = 60_000; // from the start of a run
const byId = (id) => document.getElementById(id);

export class Lab {
  constructor(module, robots, { threads, still }) {
    Object.assign(this, { module, threads, robots: new Map(robots.map((robot) => [robot.id, robot])), progress: null, best: null, still });
    this.form = new Form(robots, (key) => this.chosen(key));
    byId("settings").append(this.form.run, this.form.world);
    byId("lesson").append(lessonList((experiment, step) => this.setUp(experiment, step)));
    this.toolbar = new Toolbar(this);
    this.curve = new Curve();
    this.ends = new Ends();
    this.map = new MapView((cell) => this.attempt(() => this.showElite(cell)));
    this.earlier = new Earlier((run) => this.attempt(() => this.showEarlier(run)));
    byId("curves").append(this.curve.element, this.earlier.element);
    byId("ends").append(this.ends.element);
    byId("cells").append(this.map.element);
    this.stage = new LabStage(module, byId("stage"), {
      now: (walk, time_s) => this.tellNow(time_s), shown: (walk) => this.showInside(walk),
      trouble: (error) => this.complain(error.message),
    });
    this.inside = new Inside(byId("inside"));
    this.footfalls = new Footfalls(byId("footfalls"), this.stage.clock);
    this.files = new Files(this);
    askBeforeLeaving(() => this.unsaved);
    onThemeChange(() => this.repaint());
  }

  async begin() {
    for (const robot of this.robots.values()) robot.facts = await this.facts(robot.text);
    this.form.set({ ...DEFAULTS, ...WORLD });
    this.form.setRobot(this.robot());
    await this.preview();
  }

  robot() {
    return this.robots.get(this.form.values().robot) ?? this.robots.values().next().value;
  }

  /** What the module says of a robot's or champion's file. */
  async facts(text) {
    const machine = await Machine.start(this.module);
    machine.give("robot_facts", text);
    const facts = JSON.parse(machine.given()), json = JSON.parse(text);
    return { ...facts, root_height_m: json.robot.bodies[0].position_m[2] };
  }

  // What the user does.

  /** Does something that may fail with a message. */
  async attempt(action) {
    byId("trouble").hidden = true;
    try {
      return await action();
    } catch (error) {
      this.complain(error.message);
    }
  }

  chosen(key) {
    if (key === "robot") this.form.setRobot(this.robot());
    if (!this.evolution) {
      clearTimeout(this.waiting);
      this.waiting = setTimeout(() => this.attempt(() => this.preview()), PREVIEW_MS);
    } else if (key in WORLD) {
      this.attempt(() => this.changeWorld());
    }
  }

  /** Whether the run has generations that were not saved. One that is over soon is made again as soon, by its seed. */
  get unsaved() {
    const { evolution, progress } = this;
    if (!evolution || !progress || this.saved === progress.generation) return false;
    return evolution.state === "running" || evolution.state === "paused" || performance.now() - this.opened_ms > BRIEF_MS;
  }

  /** Whether the run may be given up. */
  mayLeave() {
    const { state } = this.evolution ?? {}, over = state !== "running" && state !== "paused";
    return !this.unsaved || confirm(`${this.progress.generation + 1} generations are over, ${over ? "and were not saved" : "and the run is not"}. Leave it? What is not saved is lost.`);
  }

  /** Why the chosen robot cannot show an experiment, or null. */
  cannot({ title, steps }) {
    const { configs, facts } = this.robot(), name = facts.name;
    if (steps.some(({ set }) => set.controller && !configs[set.controller]))
      return `${title}: ${name} has no such controller, which needs nodes made for the robot; choose a robot of the list.`;
    if (steps.some(({ set }) => set.lost === "first") && facts.legs.length < 2) return `${title}: ${name} has one leg alone; choose another robot.`;
    return null;
  }

  setUp(experiment, step) {
    const trouble = this.cannot(experiment);
    if (trouble) return this.complain(trouble);
    if (!this.mayLeave()) return;
    if (this.evolution) this.anew();
    if (this.experiment !== experiment.id) {
      this.curve.forget();
      this.earlier.forget();
    }
    this.experiment = experiment.id;
    const { robot, seed } = this.form.values(); // a class shares seeds among its pupils
    this.form.set({ ...DEFAULTS, ...WORLD, robot, seed, ...step.set });
    this.form.setRobot(this.robot());
    this.step = { name: experiment.steps.length > 1 ? step.name : experiment.title, settings: this.form.values(), seed: step.set.seed };
    this.attempt(() => this.preview());
    this.say(`${experiment.title}: ${step.name}. The settings are in place; press Start.`);
    this.toolbar.start.focus({ preventScroll: true });
    byId("control").scrollIntoView({ block: "nearest", behavior: matchMedia("(prefers-reduced-motion: reduce)").matches ? "auto" : "smooth" });
  }

  /** Start, pause, go on, or more after the end. */
  toggle() {
    return this.attempt(async () => {
      const { state } = this.evolution ?? {};
      if (!this.evolution) await this.start();
      else if (state === "running") this.pause();
      else if (state === "ended") await this.more();
      else this.goOn();
    });
  }
  get more_generations() {
    return MORE;
  }

  async start() {
    const settings = this.form.values(), robot = this.robot(), plan = planOf(settings, robot);
    this.toolbar.busy("Starting");
    try {
      await this.open(plan, settings);
    } catch (error) {
      this.anew();
      throw error;
    }
    if (settings.lost !== "never" && robot.facts.legs.length > 1)
      this.evolution.changeAt(settings.lostAt, { missing: robot.facts.legs[0] }, true);
    this.goOn();
  }

  async more() {
    this.toolbar.busy("Starting");
    try {
      await this.evolution.more(MORE);
    } finally {
      this.refresh();
    }
    this.goOn();
  }

  async open(plan, settings, files = null) {
    clearTimeout(this.waiting);
    this.evolution = new Evolution(this.module, this.threads, {
      generation: (progress, champion) => this.take(progress, champion), ended: () => this.ended(),
      changedPlan: (changes) => this.nextPlan(changes), changed: (generation, changes) => this.worldChanged(generation, changes),
      trouble: (error) => this.broken(error),
    });
    Object.assign(this, { settings, progress: null, best: null, newest: null, elite: false, saved: null, opened_ms: performance.now() });
    await this.evolution.open(plan, files);
    this.curve.begin(this.runName(settings));
    this.ends.begin();
    this.map.begin();
    byId("map").hidden = settings.search !== "map-elites";
    this.form.lock(true);
    this.refresh();
  }

  /** The step that was set up, what was chosen otherwise, and the seed, unless the step is called by it. */
  runName(settings) {
    const { name, settings: others, seed } = this.step ?? { settings: { ...DEFAULTS, ...WORLD, robot: settings.robot } };
    const differences = this.form.differences(settings, others), many = differences.length > NAMED;
    return [name ?? this.robot().name, ...differences.slice(0, NAMED), ...(many ? ["…"] : []),
            ...(seed === settings.seed ? [] : [`seed ${settings.seed}`])].join(", ");
  }

  goOn() {
    this.elsewhere = null;
    this.evolution.goOn();
    this.say("Evolution runs.");
    this.refresh();
  }
  pause() {
    this.evolution.pause();
    this.say("Evolution pauses.");
    this.refresh();
  }

  /** Ends the run; settings can be chosen again. */
  anew() {
    this.evolution?.stop();
    if (this.newest) this.earlier.add({ name: this.curve.name, ...this.newest });
    Object.assign(this, { evolution: null, progress: null, newest: null, elite: false, elsewhere: null });
    this.map.mark(null);
    this.form.lock(false);
    byId("places").hidden = true;
    this.refresh();
  }

  /** From the next generation on, if it is a world in which the robot can be; after the end what walks is put there at once. */
  async changeWorld() {
    const { evolution, settings } = this, world = worldOf(this.form.values());
    if (evolution.state === "broken") return;
    const plan = changedPlan(evolution.plan, { ...settings, ...world }, this.robot());
    try {
      await this.checked(plan);
    } catch (error) {
      this.form.set(worldOf(settings));
      throw error;
    }
    evolution.forgetChanges();
    if (!sameWorld(world, settings)) evolution.changeAt(evolution.generation, world);
    if (evolution.state === "ended") {
      const { ground, damage } = JSON.parse(plan).config;
      this.elsewhere = { robot: this.stage.robotName, ground, damage };
      await this.stage.put(this.elsewhere);
      this.say("The walker is there now.");
    } else {
      this.say("The world changes with the next generation.");
    }
  }

  nextPlan(changes) {
    this.settings = { ...this.settings, ...changes };
    return changedPlan(this.evolution.plan, this.settings, this.robot());
  }

  /** Rejects where the module refuses a plan. */
  async checked(plan) {
    const thread = new Thread(this.module);
    try {
      await thread.ask("plan", plan);
    } finally {
      thread.die();
    }
  }

  // What the run says.

  take(progress, champion) {
    this.progress = progress;
    if (champion) this.takeBest(champion, progress.generation);
    this.curve.add({ ...progress, ends: undefined, map: undefined, cells: progress.map?.length });
    byId("places").hidden = false;
    this.ends.add(progress);
    this.map.add(progress);
    if (progress.generation % SAY_EVERY === 0) this.say(this.summary());
    this.refresh();
  }

  /** A new best, which walks next unless a cell of the map was chosen. */
  takeBest(text, generation) {
    this.newest = { text, generation };
    if (this.elite) return;
    this.best = this.newest;
    this.attempt(() => this.stage.show(text, `Best of generation ${generation}`, { soon: !this.stage.walk || this.stage.random }));
    this.stage.random = false;
  }

  summary() {
    const { generation, best, best_so_far, median, fell, unit } = this.progress;
    const scored = (value) => number(value, 2) + unit;
    return `Generation ${generation}: best ${scored(best)}, median ${scored(median)}, best so far ${scored(best_so_far)}; ${fell} fell; ${kindsOf(this.progress)}.`;
  }

  worldChanged(generation, changes) {
    this.curve.mark(generation);
    this.form.set(changes);
    this.say(`Generation ${generation}: the world is another one. The best starts anew.`);
  }
  ended() {
    this.say(`The run is over. ${this.summary()}`);
    this.refresh();
  }
  broken(error) {
    this.complain(`The run ended: ${error.message}. Its best walker can still be saved.`);
    this.refresh();
  }

  // What is shown.

  /** The robot with a first random network. */
  async preview() {
    const settings = this.form.values(), plan = planOf(settings, this.robot());
    this.looker?.die();
    const looker = (this.looker = new Thread(this.module));
    try {
      await looker.ask("plan", plan);
      await looker.ask("begin");
      const text = await looker.ask("first");
      if (looker !== this.looker || this.evolution) return;
      this.best = null;
      await this.stage.show(text, "A random network");
      this.stage.random = true;
      if (!this.still) this.stage.clock.play();
      this.refresh();
    } catch (error) {
      if (looker === this.looker) throw error;
    } finally {
      looker.die();
    }
  }

  /** The walker of a cell, until the best is asked for again. */
  async showElite(cell) {
    const { evolution } = this, text = await evolution.elite(cell);
    if (evolution !== this.evolution) return;
    this.map.mark(cell);
    Object.assign(this, { elite: true, best: { text, generation: this.progress.generation } });
    await this.showNow(text, "Of the map");
  }
  /** The best of a run before; that of now comes back when it is asked for. */
  async showEarlier({ name, text, generation }) {
    clearTimeout(this.waiting);
    this.looker?.die();
    this.looker = null;
    Object.assign(this, { elite: true, best: { text, generation } });
    this.map.mark(null);
    await this.showNow(text, name);
  }
  async showBest() {
    Object.assign(this, { elite: false, best: this.newest });
    this.map.mark(null);
    await this.showNow(this.best.text, `Best of generation ${this.best.generation}`);
  }

  /** At once, and where the walker before was put after the end of the run. */
  async showNow(text, title) {
    await this.stage.show(text, title);
    this.refresh();
    // Another robot stays where it evolved: legs and heights are those of this one.
    if (this.elsewhere?.robot === this.stage.robotName) await this.stage.put(this.elsewhere);
    this.stage.clock.play();
  }

  tellNow(time_s) {
    const story = this.stage.story(time_s);
    if (byId("story").textContent !== story) byId("story").textContent = story;
    this.inside.show(time_s);
    this.footfalls.show();
  }

  showInside(walk) {
    this.footfalls.begin(walk);
    this.inside.begin(walk, this.stage.text);
  }

  render() {
    this.stage.draw();
  }
  refresh() {
    this.toolbar.show();
  }
  repaint() {
    this.stage.paint();
    this.footfalls.repaint();
    this.curve.picture.repaint();
    this.ends.picture.repaint();
  }
  say(text) {
    byId("said").textContent = text;
  }
  complain(text) {
    const trouble = byId("trouble");
    trouble.hidden = false;
    trouble.textContent = text;
    trouble.scrollIntoView({ block: "nearest" });
  }
}
