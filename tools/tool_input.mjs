// What tools in JavaScript are given; where it is not what they expect, they end with one line that says so. A tool's first words
// are its --help.
import { execFileSync } from "node:child_process";
import { accessSync, constants, readFileSync, statSync } from "node:fs";
import { basename, resolve } from "node:path";
import { parseArgs } from "node:util";

const NAME = `tools/${basename(process.argv[1])}`;

export function fail(text) {
  console.error(`${NAME}: ${text}`);
  process.exit(2);
}

process.on("uncaughtException", (error) => {
  const said = String(error.stderr ?? "");
  if (!said && !error.status) fail(String(error.message ?? error).split("\n")[0]);
  process.stderr.write(said); // a program says itself why it failed
  process.exit(1);
});

function printHelp() {
  const [, comment] = /^#!.*\n((?:\/\/.*\n)+)/.exec(readFileSync(process.argv[1], "utf8"));
  process.stdout.write(comment.replaceAll(/^\/\/ ?/gm, ""));
  process.exit(0);
}

/** The values of options, and at most so many other words. */
export function readArguments(options, most) {
  if (process.argv.slice(2).some((word) => ["-h", "--help"].includes(word))) printHelp();
  try {
    const { values, positionals } = parseArgs({ options, allowPositionals: true });
    if (positionals.length > most) fail(`${positionals[most]}: one word too many (${NAME} --help)`);
    return { values, positionals };
  } catch (error) {
    return fail(`${error.message.split(/[.\n]/)[0]} (${NAME} --help)`);
  }
}

/** Of an option. */
export function count(name, text) {
  if (!/^[1-9]\d*$/.test(text)) fail(`${name} ${text}: expected a whole number of at least 1`);
  return Number(text);
}

/** Of an option that names some of these; all without it. */
export function someOf(name, text, all) {
  const named = text?.split(",") ?? all.map(String), unknown = named.find((one) => !all.map(String).includes(one));
  if (unknown !== undefined) fail(`${name} ${unknown}: no such one; there are ${all.join(", ")}`);
  return named;
}

export function programAt(path) {
  try {
    accessSync(path, constants.X_OK);
    if (statSync(path).isFile()) return resolve(path);
  } catch {} // said below
  return fail(`${path}: no such program; expected amble, as \`make build\` makes it in build/release/src/cli`);
}

/** Name and version, as results may depend on it. */
export function versionOf(program) {
  try {
    const [found] = /^amble \S+/.exec(execFileSync(program, ["--version"], { encoding: "utf8", stdio: ["ignore", "pipe", "ignore"] }));
    return found;
  } catch {
    return fail(`${program}: it does not say which version of amble it is; expected amble, as \`make build\` makes it`);
  }
}
