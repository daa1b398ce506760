// Live sessions of 3,000 steps, each of another champion on another ground with other damages and pushes: what is to come out alike
// in the native program and in WebAssembly.
export const STEPS = 3000;

/** A damage's settings, all of which a file must have. */
const part = (of) => ({ kind: "missing", leg: "", joint: "", body: "", angle_rad: 0, share: 0.5, mass_kg: 1, x_m: 0, y_m: 0, z_m: 0, from_s: 0, ...of });

const GROUNDS = ["plane", "hills", "rough", "stones", "blocks", "stairs", "hurdles"];

/** Damages of a robot by their number. */
function damageOf(number, { robot, mass_kg }) {
  const leg = robot.legs[number % robot.legs.length].name, joint = robot.joints[(3 * number + 1) % robot.joints.length];
  const angle_rad = 0.3 * joint.lower_rad + 0.7 * joint.upper_rad;
  const kinds = [
    [], [{ kind: "missing", leg }], [{ kind: "locked", joint: joint.name, angle_rad }], [{ kind: "payload", mass_kg: 0.3 * mass_kg, x_m: 0.01 }],
    [{ kind: "numb", leg }, { kind: "weak", joint: joint.name, share: 0.4 }], [{ kind: "slack", joint: joint.name }],
  ];
  return { parts: kinds[number % kinds.length].map(part) };
}

/** Lets a robot go through session `number`; `robot`: a LiveRobot in its start pose. */
export async function runSession(robot, number) {
  const description = robot.describe(), { mass_kg } = description;
  const tall_m = description.robot.bodies[0].position_m[2];
  const ground = { ...description.ground, kind: GROUNDS[number % GROUNDS.length], height_m: Math.max(0.08 * tall_m, 0.001), seed: number + 1,
                   slope_x: 0.02 * (number % 4), slope_y: -0.01 * (number % 3), friction: 0.5 + 0.2 * (number % 5) };
  robot.step(200);
  for (let k = 0; k < 30; ++k) {
    robot.push([0.002 * mass_kg * (k % 7), 0.01 * mass_kg, 0.001 * mass_kg * k]);
    robot.step(1);
  }
  await robot.setGround(ground);
  robot.step(770);
  await robot.setDamage(damageOf(number, description));
  robot.step(1000);
  robot.push([0.3 * mass_kg, -0.4 * mass_kg, 0.2 * mass_kg]);
  robot.step(500);
  await robot.setDamage({ parts: [] });
  await robot.lift(0.2 * tall_m);
  const { commands } = description;
  if (commands) await robot.command([0.5 * commands.most_speed_m_s, 0.4 * commands.most_turn_rad_s]);
  robot.step(250);
  if (commands) await robot.command([0, 0]);
  robot.step(STEPS - 2750);
}
