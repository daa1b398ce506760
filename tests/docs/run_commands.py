"""Runs every command of the documentation as a reader would: each line of each ```sh block, page by page, in one copy of the project.

    run_commands.py PROGRAM SOURCES

What takes long is cut by one rule (`shortened`): a run evolves 3 generations of 40 genomes in trials of 2 s, what walks for 300 s
walks for 30, and a study but that in miniature is asked how far it is. Commands that are not run stand in not_run.txt with the reason.

What a command prints is what the page says: a printed table whose header the page or README has must stand there row by row.
"""

import os
import re
import shutil
import subprocess
import sys
import tempfile
import time
from pathlib import Path

PAGES = ["README.md", "docs/*.md", "robots/*.md", "robots/*/*.md", "examples/*/*.md", "CONTRIBUTING.md"]
CUT = "--set population.size=40 --set trial.duration_s=2 --set search.map_elites.trials=1"


def pages(source):
    return [path for pattern in PAGES for path in sorted(source.glob(pattern))]


def commands_of(page):
    """Each command of a page: a line, with those that continue it, without its comment."""
    for block in re.findall(r"^```sh\n(.*?)^```", page.read_text(), re.M | re.S):
        yield from commands_in(block)


def commands_in(block):
    command = ""
    for line in block.splitlines():
        command += line + "\n"
        if line.endswith("\\") or command.count("'") % 2:
            continue
        text = re.sub(r"\s+#\s.*$", "", command.strip(), flags=re.M)
        if text and not text.startswith("#"):
            yield text
        command = ""


def shortened(command):
    """The rule by which long commands are cut."""
    # Options that stand twice count in their last form; settings are laid one over the other.
    command = re.sub(r"(amble evolve [^&|;]*?)(?= *(&&|$))",
                     lambda found: re.sub(r" --generations \d+", "", found[1]) + f" {CUT} --generations 3", command)
    command = re.sub(r"(--seconds [0-9,]*)300", r"\g<1>30", command)
    command = re.sub(r"(amble resume +\S+) --generations \d+", r"\1 --generations 4", command)
    return re.sub(r"amble study +(?!studies/smoke)(\S+\.toml)((?:(?! --slurm| --status)[^&|;])*)$", r"amble study \1\2 --status", command)


def reasons(path):
    """Beginnings of commands that are not run, and why."""
    lines = [line for line in path.read_text().splitlines() if line and not line.startswith("#")]
    return [tuple(part.strip() for part in line.split(" :: ", 1)) for line in lines]


def prepare(workspace, program, source):
    """A copy of the project with the program where the build has it, and the model that pages call the reader's own."""
    for name in ["configs", "studies", "robots", "docs", "results", "tools", "examples", "src", "include", "viewer", "tests"]:
        if name in ("results", "docs"):
            shutil.copytree(source / name, workspace / name)
        else:
            (workspace / name).symlink_to(source / name)
    (workspace / "build/release/src/cli").mkdir(parents=True)
    (workspace / "build/release/src/cli/amble").symlink_to(program)
    (workspace / "build/release/configs").symlink_to(source / "configs")
    model = source / "robots/quadruped/authors.xml"
    for name in ["my_robot.xml"]:
        (workspace / name).parent.mkdir(parents=True, exist_ok=True)
        shutil.copy(model, workspace / name)


def forget_outputs(commands, workspace):
    """Removes what an earlier page made under a name that this one gives to an output of its own."""
    for name in ["my_robot"] + [name for command in commands for name in re.findall(r" (?:--out|-o) +(\S+)", command)]:
        if name.startswith("results/") and name != "results/smoke":
            continue
        shutil.rmtree(workspace / name, ignore_errors=True)


def run(command, workspace, program):
    environment = dict(os.environ, PATH=f"{program.parent}:{os.environ['PATH']}", PYTHONDONTWRITEBYTECODE="1")
    return subprocess.run(["bash", "-c", command], cwd=workspace, env=environment, capture_output=True, text=True, timeout=600)


def cells_of(line):
    return [cell.strip() for cell in line.strip().strip("|").split("|")]


def differences(printed, page):
    """Of a printed Markdown table that the page has, each row that it has not; and how many tables were compared. The page may
    have more rows, and more columns to the right."""
    rows = [cells_of(line) for line in page.read_text().splitlines() if line.startswith("|")]

    def in_page(line):
        cells = cells_of(line)
        return any(row[: len(cells)] == cells for row in rows)

    lines = printed.splitlines()
    compared, missing, of_page = 0, [], False
    for line, following in zip(lines, lines[1:] + [""]):
        if not line.startswith("|"):
            of_page = False
        elif re.fullmatch(r"[|:\- ]+", following):
            of_page = in_page(line)
            compared += of_page
        elif of_page and not re.fullmatch(r"[|:\- ]+", line) and not in_page(line):
            missing.append(line)
    return compared, missing


def main():
    program, source = Path(sys.argv[1]).resolve(), Path(sys.argv[2]).resolve()
    wanted = sys.argv[3:]
    not_run = reasons(Path(__file__).with_name("not_run.txt"))
    used, failed, ran, tables = set(), 0, 0, 0
    reported = set()  # pages that stand alone give one report again and again: its tables stay
    with tempfile.TemporaryDirectory() as folder:
        workspace = Path(folder)
        prepare(workspace, program, source)
        for page in pages(source):
            name = page.relative_to(source)
            if wanted and str(name) not in wanted:
                continue
            commands = list(commands_of(page))
            forget_outputs(commands, workspace)
            for command in commands:
                excuse = next((pair for pair in not_run if command.startswith(pair[0])), None)
                if excuse:
                    used.add(excuse)
                    continue
                if command in reported:
                    continue
                began = time.monotonic()
                done = run(shortened(command), workspace, program)
                ran += 1
                if re.match("amble report results/(?!smoke)", command) and done.returncode == 0:
                    reported.add(command)
                print(f"{time.monotonic() - began:5.1f} s  {name}: {command.splitlines()[0]}", flush=True)
                if done.returncode != 0:
                    failed += 1
                    print(f"FAILED ({done.returncode}): {shortened(command)}\n{done.stdout[-2000:]}{done.stderr[-2000:]}")
                for reader in {page, source / "README.md"} if shortened(command) == command else ():
                    compared, missing = differences(done.stdout, reader)
                    tables += compared
                    failed += len(missing)
                    for row in missing:
                        print(f"FAILED: {reader.name} has another row than `{command}` prints: {row}")
    if not wanted and tables == 0:
        failed += 1
        print("FAILED: no printed table was found in a page, so none was compared")
    stale = [] if wanted else [pair for pair in not_run if pair not in used]
    for beginning, _ in stale:
        print(f"FAILED: not_run.txt: no page has a command that begins with '{beginning}'")
    print(f"{ran} commands ran, {failed} failed, {tables} tables are as printed; {len(not_run)} kinds are not run")
    return 1 if failed or stale or ran == 0 else 0


if __name__ == "__main__":
    sys.exit(main())
