// From what is chosen to what the module takes: a config with all its keys, and a robot.

/** What a lesson begins with. World: what may change while a run goes on. */
export const DEFAULTS = {
  robot: "hexapod", controller: "supg", search: "objective", population: 20, generations: 300, seed: 1, seconds: 8,
  feels: true, mutation: "all", lost: "never", lostAt: 50,
};
export const WORLD = { noise: "little", ground: "plane", roughness: 0.12, slope: 0, gravity: 1, missing: "" };

/** Of settings those of the world. */
export const worldOf = (settings) => Object.fromEntries(Object.keys(WORLD).map((key) => [key, settings[key] ?? WORLD[key]]));
export const sameWorld = (one, other) => Object.keys(WORLD).every((key) => one[key] === (other[key] ?? WORLD[key]));

/** A damage's settings, all of which a config must have. */
const PART = { kind: "missing", leg: "", joint: "", body: "", angle_rad: 0, share: 0.5, mass_kg: 1, x_m: 0, y_m: 0, z_m: 0, from_s: 0 };
const NO_NOISE = { push_m_s: 0, start_joint_rad: 0, start_tilt_rad: 0, start_height_m: 0, touch_flip_probability: 0, joint_sensor_rad: 0,
                   attitude_sensor_rad: 0, latency_ticks: 0, episodes: 1, first_undisturbed: false };
// The level milli of docs/GAITS-NOT-TRAJECTORIES.md: enough that no walk depends on one exact start.
const LITTLE_NOISE = { ...NO_NOISE, start_joint_rad: 1e-3, start_tilt_rad: 1e-3, start_height_m: 1e-4 };
const BINS = 10; // of a map, in each direction

export const mapBins = BINS;

/** Of the legs, and of the trunk over the ground at the start, m. */
const heightOf = (facts) => facts.leg_height_m || 0.2;

function search(config, settings, facts) {
  const { search: made } = config, samples = Math.max(1, Math.floor((settings.seconds * 100) / 10));
  made.kind = settings.search;
  // How far apart paths must be to be new, at first; it adapts.
  Object.assign(made.novelty, { path_stride: 10, path_first_step: 1, compare_with: "archive_and_population",
                                threshold: 0.05 * made.novelty.neighbours * samples * heightOf(facts) ** 2 });
  if (settings.search !== "map-elites") return;
  Object.assign(made.map_elites, {
    batch: settings.population, initial: 3 * settings.population,
    descriptors: [{ quantity: "duty_factor", leg: "", least: 0, most: 1, bins: BINS },
                  { quantity: "height", leg: "", least: 0.4 * facts.root_height_m, most: 1.2 * facts.root_height_m, bins: BINS }],
  });
}

function variation(config, { mutation }) {
  if (mutation !== "all") Object.assign(config.mutation, { add_node_share: 0, add_link_share: 0 });
  if (mutation === "none") {
    config.reproduction.asexual_probability = 0;
    config.crossover.mutate_child = false;
  }
}

function world(config, settings, facts) {
  const tall_m = heightOf(facts), now = { ...WORLD, ...settings };
  if (now.noise !== "strong") Object.assign(config.noise, now.noise === "little" ? LITTLE_NOISE : NO_NOISE);
  Object.assign(config.ground, { kind: now.ground, slope_x: now.slope });
  if (now.ground !== "plane")
    Object.assign(config.ground, { height_m: now.roughness * tall_m, length_m: Math.min(Math.max(2.5 * tall_m, 0.05), 100), start_radius_m: 2.25 * tall_m,
                                   cell_m: Math.min(Math.max(0.2 * tall_m, 0.005), 0.04), vary: "generations" });
  config.damage.parts = now.missing ? [{ ...PART, leg: now.missing }] : [];
}

/**
 * @param {object} settings DEFAULTS and WORLD, with what was chosen
 * @param {{text: string, facts: object, configs: object}} robot
 * @returns {string} a plan for the module
 */
export function planOf(settings, robot, { fresh = true } = {}) {
  const config = structuredClone(robot.configs[settings.controller]);
  Object.assign(config, { name: `${robot.name} in the lab`, seed: settings.seed, generations: settings.generations, referees: [] });
  config.population.size = settings.population;
  config.champion = { episodes: 0, score: "as_in_evolution" };
  config.trial.duration_s = settings.seconds;
  if (!settings.feels && config.controller.kind === "supg") Object.assign(config.controller.supg, { trigger: "none", idle: "wrap" });
  variation(config, settings);
  search(config, settings, robot.facts);
  world(config, settings, robot.facts);
  return JSON.stringify({ config, robot: robot.text, gravity: settings.gravity / (robot.gravity ?? 1), new: fresh });
}

/** The plan of a run that goes on, in another world. */
export function changedPlan(plan, settings, robot) {
  const changed = JSON.parse(plan);
  const base = structuredClone(robot.configs[settings.controller]);
  Object.assign(changed.config, { noise: base.noise, ground: base.ground, damage: base.damage });
  world(changed.config, settings, robot.facts);
  return JSON.stringify({ ...changed, robot: robot.text, gravity: settings.gravity / (robot.gravity ?? 1) });
}

/** The configs of one's own robot: those of one in the gallery, with the times and pushes that fit its size. */
export function configsFor(facts, model) {
  const configs = {};
  for (const [name, config] of Object.entries(model.configs)) {
    if (name === "together") continue; // its nodes are those of that robot
    const made = structuredClone(config), { size } = facts;
    made.controller.substrate = AUTOMATIC(made.controller.substrate);
    if (size) {
      made.controller.supg.period_s = made.controller.substrate.sine_period_s = size.period_s;
      Object.assign(made.noise, { push_m_s: size.push_m_s, start_height_m: size.start_height_m });
    }
    made.drop_m = Math.min(made.drop_m, 0.02);
    configs[name] = made;
  }
  return configs;
}

/** Nodes from the robot's own legs and joints. */
const AUTOMATIC = (substrate) => ({ ...substrate, layout: "auto", coordinates: [], outputs: [], nodes: [], links: [], properties: [] });
