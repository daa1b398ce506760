"""Every tool in tools/ says what it does when asked, and in one line what is wrong with what it was given.

    tools_test.py PROGRAM SOURCES
"""

import importlib.machinery
import importlib.util
import json
import os
import shutil
import subprocess
import sys
import tempfile
import unittest
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

PROGRAM, SOURCES = Path(sys.argv[1]).resolve(), Path(sys.argv[2]).resolve()
TOOLS = sorted(path.name for path in (SOURCES / "tools").iterdir() if path.is_file() and os.access(path, os.X_OK))
WRITTEN = [SOURCES / name for name in ("docs/SETTINGS.md", "docs/pictures/robots.svg", "results/encodings/recovery.csv")]

# What tools ask amble, answered at once. It writes down what it was asked but for its version.
STUB = """#!/bin/sh
[ "$1" = --version ] && { echo "amble ${VERSION:-1}"; exit; }
echo "$*" >>"$(dirname "$0")/asked.txt"
case "$*" in
  evolve*) echo "best: typically 3.00 in 1 s: half of 16 trials 2 to 4, 25 % fell (luckiest 5)"; echo "      60 evaluations" ;;
  trial*--unseen*) [ "$4" -lt 64 ] && echo "followed to 0.500 of 1; wrong by 0 m/s" || echo "followed to 0.400 of 1; wrong by 0 m/s" ;;
  trial*) echo "typically 2.00 m in 15 s" ;;
  compare*) echo '[{"evolved_in": "batch", "results": [{"engine": "batch", "distance_m": 1.0}]}]' ;;
  adapt*) while [ "$1" != -o ]; do shift; done
    echo '{"intact": 3, "damaged": 1, "adapted": 2, "trials": [{"expected": 4, "measured": 2}]}' >"$2" ;;
  *) echo "amble: what is $1?" >&2; exit 2 ;;
esac
"""

TABLES = {
    "runs": "condition,seed,engine,generations,train_m\na,1,batch,2,3.5\na,2,batch,2,4.5\nb,1,batch,2,5\n",
    "summary": "measure,condition,mean,mean_lower,mean_upper\ntrain_m,a,4,3,5\ntrain_m,b,5,5,5\n",
    "bests": "condition,seed,generation,best_m\na,1,0,3.5\na,2,0,4.5\nb,1,0,5\n",
    "claims": "claim,text,figure,ours,p_holm,verdict,reason\n1,A walks.,1 m,4 m,,confirmed,It does.\n",
}

STUDY_OF_ROBOTS = """name = "robots"
conditions = [{ name = "a-quick" }]
claims = [{ kind = "count", condition = "a-quick", threshold = 1.0, text = "A walks." }]
"""


def run_tool(name, *arguments, folder, tools=SOURCES / "tools", **environment):
    path = tools / name
    python = b"python3" in path.read_bytes().splitlines()[0]
    command = [*([sys.executable, "-B"] if python else []), path, *arguments]
    environment = {**os.environ, "AMBLE": str(folder / "no-program"), "PYTHONDONTWRITEBYTECODE": "1", **environment}
    return subprocess.run(list(map(str, command)), cwd=folder, env=environment, capture_output=True, text=True, timeout=120)


def runnable():
    return [name for name in TOOLS if shutil.which("node") or not name.endswith(".mjs")]


def tool_as_module(name):
    sys.path.insert(0, str(SOURCES / "tools"))
    loader = importlib.machinery.SourceFileLoader(name.replace("-", "_"), str(SOURCES / "tools" / name))
    module = importlib.util.module_from_spec(importlib.util.spec_from_loader(loader.name, loader))
    loader.exec_module(module)
    return module


class Case(unittest.TestCase):
    def setUp(self):
        scratch = tempfile.TemporaryDirectory()
        self.addCleanup(scratch.cleanup)
        self.folder = Path(scratch.name)

    def write(self, name, text, mode=0o644):
        path = self.folder / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text, encoding="utf-8")
        path.chmod(mode)
        return path

    def stub(self):
        return self.write("stub/amble", STUB, 0o755)

    def asked(self):
        path = self.folder / "stub/asked.txt"
        return path.read_text(encoding="utf-8").splitlines() if path.exists() else []

    def tables(self, **changed):
        for name, text in (TABLES | changed).items():
            self.write(f"tables/{name}.csv", text)

    def ledger(self, name, *records, **changed):
        """A folder of results with records that are in this repository."""
        for record in records:
            whole = json.loads((SOURCES / "results" / record).read_text(encoding="utf-8")) | changed
            self.write(f"{name}/ledger/{Path(record).name}", json.dumps(whole))
        return name

    def assertOneLine(self, done, *words):
        said = f"{done.args}\n{done.stdout}{done.stderr}"
        self.assertNotEqual(done.returncode, 0, said)
        self.assertNotIn("Traceback", done.stderr)
        self.assertEqual(len(done.stderr.splitlines()), 1, said)
        for word in words:
            self.assertIn(word, done.stderr)

    def wrong(self, name, *arguments, words=(), **environment):
        done = run_tool(name, *arguments, folder=self.folder, **environment)
        with self.subTest(f"{name} {' '.join(map(str, arguments))}"):
            self.assertOneLine(done, *words)
            self.assertEqual(done.stdout, "")

    def all_wrong(self, *cases):
        with ThreadPoolExecutor(3) as pool:
            for case, done in zip(cases, pool.map(lambda case: run_tool(*case, folder=self.folder), cases)):
                with self.subTest(" ".join(map(str, case))):
                    self.assertOneLine(done)
                    self.assertEqual(done.stdout, "")


class EveryTool(Case):
    def test_help_says_what_it_does_with_an_example_and_does_nothing(self):
        before = [path.read_bytes() for path in WRITTEN]
        cases = [(name, word) for name in runnable() for word in ("--help", "-h")]
        with ThreadPoolExecutor(3) as pool:
            all_done = list(pool.map(lambda case: run_tool(*case, folder=self.folder), cases))
        for (name, word), done in zip(cases, all_done):
            with self.subTest(f"{name} {word}"):
                self.assertEqual((done.returncode, done.stderr), (0, ""))
                self.assertRegex(done.stdout, rf"(?m)^ +tools/{name}\b")
                self.assertIn("Example", done.stdout)
                self.assertGreater(len(done.stdout.splitlines()), 4)
        self.assertEqual(list(self.folder.iterdir()), [])
        self.assertEqual([path.read_bytes() for path in WRITTEN], before)

    def test_help_comes_before_all_else(self):
        for name, arguments in [("recovery-study", ["hexapod", "./folder"]), ("task-table", ["folder"]), ("transfer-study", ["folder", "1"])]:
            done = run_tool(name, *arguments, "--help", folder=self.folder)
            self.assertEqual((done.returncode, done.stderr), (0, ""), name)
        self.assertEqual(list(self.folder.iterdir()), [])

    def test_an_unknown_option_is_one_line(self):
        self.all_wrong(*((name, "--no-such-option") for name in runnable()))
        self.assertEqual(list(self.folder.iterdir()), [])

    def test_without_what_it_needs_it_says_one_line(self):
        without = {"figure-robots", "gallery-table", "lint", "make-site", "measure-browser", "recovery-study", "task-table", "update-docs", "export-study"}
        self.all_wrong(*((name,) for name in runnable() if name not in without))

    def test_a_word_too_many_is_one_line(self):
        many = {"claim-power": 3, "defaults-table": 3, "fastest-table": 3, "figure-robots": 1, "gallery-table": 1, "make-site": 2, "map-record": 3, "measure-watch": 3,
                "recovery-of-maps": 4, "spot-check": 7, "task-table": 2, "update-docs": 2, "article-numbers": 2, "lab-table.mjs": 3, "lab-walks.mjs": 2,
                "render-video.mjs": 3}
        self.all_wrong(*((name, *["1"] * count) for name, count in many.items() if name in runnable()))

    def test_programs_that_are_missing_or_others_are_one_line(self):
        study, results = SOURCES / "studies/noise.toml", SOURCES / "results/noise"
        self.write("evolved/1/config.toml", "")
        for program in ("no-program", "/bin/true", "/bin"):
            self.all_wrong(
                ("article-numbers", program, "--results", "none"), ("cppn-sensitivity", program, results), ("gallery-table", "--steps", program),
                ("make-site", "site", "--program", program), ("measure-watch", program, "1"), ("printed-best", program, SOURCES / "configs/demo.toml", "1"),
                ("printed-best", program, "--ledger", results, "sine"), ("spot-check", program, study, results),
                ("recovery-study", "once", "./made", program), ("recovery-of-maps", "encodings", "made", program), ("update-docs", program))
        self.all_wrong(("steering-gains", "--command", "c", "--full-speed", "1", "champion"),
                       ("public-robots", "made"), ("transfer-study", "made"))
        self.assertEqual([path.name for path in self.folder.iterdir()], ["evolved"])


class Tables(Case):
    def test_numbers_names_and_folders_that_are_wrong(self):
        self.tables()
        self.write("study.toml", STUDY_OF_ROBOTS)
        self.write("broken.toml", "conditions = [")
        self.write("verdicts.csv", "study,claim,verdict\nother,1,confirmed\n")
        table = ["summary-table", "tables"]
        self.all_wrong(
            ("summary-table", "nowhere", "train_m"), (*table, "best@-5"), (*table, "best@x"), (*table, "reach@nan"), (*table, "condition"),
            (*table, "engine"), (*table, "train_m/engine"), (*table, "train_m>=x"), (*table, "walked_m"), (*table, "train_m*x"),
            (*table, "--conditions", "c", "train_m"), (*table, "--test", "--conditions", "a", "train_m"), (*table, "train_m", "walked_m"),
            ("claims-table", "nowhere"), ("claims-table", "--before", "verdicts.csv", "tables"), ("claims-table", "--changes", "nowhere.csv", "tables"),
            ("claims-table", "--before", "broken.toml", "tables"), ("defaults-table", "study.toml", "nowhere"),
            ("defaults-table", "study.toml", "tables"), ("defaults-table", "broken.toml", "tables"), ("defaults-table", "nowhere.toml", "tables"),
            ("defaults-table", SOURCES / "studies/paper.toml", "tables"), ("claim-power", "study.toml", "tables"),
            ("claim-power", "broken.toml", "tables"), ("claim-power", SOURCES / "configs/demo.toml", "tables"), ("claim-power", "study.toml", "nowhere"))

    def test_files_that_are_empty_cut_or_foreign(self):
        for text in ("", "a,b\n1,2\n", TABLES["runs"][:-9], TABLES["runs"].splitlines()[0] + "\n", "\0\n"):
            self.tables(runs=text, claims=text)
            self.all_wrong(("summary-table", "tables", "train_m"), ("claims-table", "tables"))
        self.tables(bests=TABLES["bests"].replace("5\n", "far\n"))
        self.wrong("summary-table", "tables", "train_m", words=["bests.csv"])
        self.tables(bests=TABLES["bests"].replace("b,1,0,5\n", ""))
        self.wrong("summary-table", "tables", "train_m", words=["'b'", "seed 1"])

    def test_right_ones_are_printed(self):
        self.tables()
        done = run_tool("summary-table", "tables", "train_m", "best@0", "train_m>=4", folder=self.folder)
        self.assertEqual(done.stdout, "| | a | b |\n|---|---|---|\n| train_m | 4.0 [3.0, 5.0] | 5.0 [5.0, 5.0] |\n"
                                      "| best@0 | 4.0 | 5.0 |\n| train_m>=4 | 1 of 2 | 1 of 1 |\n")
        done = run_tool("claims-table", "tables", folder=self.folder)
        self.assertIn("| 1 | A walks | 1 m | 4 m | confirmed |", done.stdout)

    def test_task_table(self):
        config = SOURCES / "configs/tasks/swimmer.toml"
        self.write("tasks/study.toml", f"""
            name = "tasks"
            seeds = [2, 3, 4]
            conditions = [{{ name = "swimmer-sine", title = "Swimmer: sine wave", config = "{config}", settings = ["controller.kind=network"] }}]
            tests = [{{ name = "swimmer", score = true, conditions = ["swimmer-sine"] }}]""")
        for run, (seed, scores) in (("001", (2, [103, 104, 125])), ("002", (3, [130, 130, 140]))):
            episodes = [{"outcome": "completed" if score > 103 else "fell", "score": score} for score in scores]
            self.ledger("tasks", f"noise/ledger/supg-{run}.json", condition="swimmer-sine", seed=seed, evaluations=1000,
                        tests=[{"name": "swimmer", "episodes": episodes}])
        done = run_tool("task-table", "tasks", folder=self.folder)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("| Swimmer | sine wave | 17 | 4, 30 | 17 | 1000 | ", done.stdout)
        self.assertIn("| `configs/tasks/swimmer.toml --set controller.kind=network --seed 2` |\n\n2 of 3 runs, on ", done.stdout)
        # The score of these stands in what they include first.
        spec = (self.folder / "tasks/study.toml").read_text(encoding="utf-8")
        self.write("tasks/study.toml", spec.replace("swimmer.toml", "swimmer-oscillators.toml"))
        self.assertIn("| Swimmer | sine wave | 17 | 4, 30 | ", run_tool("task-table", "tasks", folder=self.folder).stdout)
        self.ledger("tasks", "noise/ledger/supg-001.json", condition="swimmer-sine")
        self.wrong("task-table", "tasks", words=["supg-001.json", "scores in its test swimmer"])
        self.wrong("task-table", SOURCES / "results/noise", words=["study.toml", "not of studies/tasks.toml"])
        self.wrong("task-table", "nowhere")

    def test_fastest_table(self):
        done = run_tool("fastest-table", SOURCES / "results/baseline", "noisy-batch", folder=self.folder)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("| Quadruped: oscillators, open loop | 10 of 10 | 2,100 | 2.3 | AVX-512 | 2,700 | 5.1 |\n", done.stdout)
        self.assertIn("| Quadruped: sine wave network | 0 of 10 | – | – | – | – | – |\n", done.stdout)
        self.wrong("fastest-table", SOURCES / "results/baseline", "rough", words=["study.toml", "no test 'rough' with reach_m"])
        self.wrong("fastest-table", SOURCES / "results/noise", "noisy-batch")
        self.wrong("fastest-table", "nowhere", "noisy-batch")
        self.wrong("fastest-table", SOURCES / "results/baseline", "noisy-batch", "--again", "no-program", words=["no-program"])

    def test_typical_table(self):
        noise = SOURCES / "results/noise"
        self.ledger("good", "noise/ledger/supg-001.json")
        shutil.copy(noise / "study.toml", self.folder / "good")
        self.write("cut/study.toml", (noise / "study.toml").read_text(encoding="utf-8"))
        self.write("cut/ledger/supg-001.json", (noise / "ledger/supg-001.json").read_text(encoding="utf-8")[:5000])
        self.write("broken/study.toml", "name = ")
        self.write("other/study.toml", "name = 'x'\n")
        self.ledger("without", "noise/ledger/supg-001.json", tests=[{"name": "milli"}])
        shutil.copy(noise / "study.toml", self.folder / "without")
        self.all_wrong(*(("typical-table", name) for name in ("nowhere", "good:nobody", "cut", "broken", "other", "without", ".")),
                       ("typical-table", SOURCES / "results/paper:nobody"))


class Ledgers(Case):
    def test_spot_check(self):
        study, results = SOURCES / "studies/ode.toml", SOURCES / "results/ode"
        whole = [PROGRAM, study, results]
        self.write("empty/ledger/none.txt", "")
        self.all_wrong(("spot-check", *whole, "10"), ("spot-check", *whole, "0"), ("spot-check", *whole, "-1"), ("spot-check", *whole, "x"),
                       ("spot-check", *whole, "1", "x"), ("spot-check", *whole, "1", "1", "0"), ("spot-check", PROGRAM, "nowhere.toml", results),
                       ("spot-check", PROGRAM, study, "nowhere"), ("spot-check", PROGRAM, study, "empty"))
        self.wrong("spot-check", *whole, "10", words=["RUNS 10", "9 of the study's runs"])

    def test_spot_check_compares_all_but_what_older_records_do_not_say(self):
        tool = tool_as_module("spot-check")
        older = SOURCES / "results/emitters/ledger/hexapod-supg-line-001.json"
        self.ledger("now", "emitters/ledger/hexapod-supg-line-001.json", map_trials=32)
        [now] = (self.folder / "now/ledger").iterdir()
        self.assertEqual(tool.compare(now, older), ([], []))
        self.assertEqual(tool.compare(older, now), (["map_trials"], []))
        self.ledger("other", "emitters/ledger/hexapod-supg-line-001.json", map_trials=32, hidden=99)
        [other] = (self.folder / "other/ledger").iterdir()
        self.assertEqual(tool.compare(other, older), (["hidden"], []))
        self.assertEqual(tool.compare(now, other), (["hidden"], []))

    def test_spot_check_shows_what_amble_says_where_it_fails(self):
        liar = self.write("liar", f'#!/bin/sh\ncase "$*" in *--discard-runs*) echo "amble: no disk" >&2; exit 4 ;; esac\nexec "{PROGRAM}" "$@"\n', 0o755)
        for program in (liar, self.stub()):
            done = run_tool("spot-check", program, SOURCES / "studies/ode.toml", SOURCES / "results/ode", "1", folder=self.folder)
            self.assertOneLine(done, "amble: ")

    def test_printed_best_compares_what_a_study_was_scored_by(self):
        stub = self.stub()
        self.ledger("steered", "steering-public/ledger/mixed-001.json", best_m=0.8)
        done = run_tool("printed-best", stub, "--ledger", "steered", folder=self.folder)
        self.assertEqual(done.stderr, "")
        self.assertEqual(done.stdout.splitlines()[2].split(), ["1", "0.50", "0.80", "0.40", "1.25", "2.00"])
        self.assertFalse([line for line in self.asked() if line.startswith("compare")])
        self.ledger("walking", "noise/ledger/supg-001.json", best_m=3.0)
        done = run_tool("printed-best", stub, "--ledger", "walking", "supg", folder=self.folder)
        self.assertEqual(done.stdout.splitlines()[2].split(), ["1", "2.00", "3.00", "1.00", "2.00", "3.00"])

    def test_printed_best_refuses_what_it_cannot_compare(self):
        stub, config = self.stub(), SOURCES / "configs/quick/ctrnn.toml"
        self.ledger("biped", "gallery/ledger/biped-ctrnn-001.json")
        self.ledger("still", "paper/ledger/supg-novelty-001.json")
        self.write("cut/ledger/supg-001.json", (SOURCES / "results/noise/ledger/supg-001.json").read_text(encoding="utf-8")[:5000])
        self.all_wrong(
            ("printed-best", stub, "--ledger"), *(("printed-best", stub, "--ledger", name) for name in ("nowhere", "biped", "still", "cut", ".")),
            ("printed-best", stub, "--ledger", "biped", "nobody"), ("printed-best", stub), ("printed-best", stub, config, "x"),
            ("printed-best", stub, config, "-1"), ("printed-best", stub, config, "0"), ("printed-best", stub, config, "1", "x"),
            ("printed-best", stub, config, "1"), ("printed-best", PROGRAM, "nowhere.toml", "1"),
            ("printed-best", PROGRAM, config, "1", "generations=x"))
        self.wrong("printed-best", stub, "--ledger", "biped", "biped-ctrnn", words=["neither the distance nor how well commands are followed"])

    def test_tools_that_read_ledgers_of_this_repository_say_which_is_missing(self):
        tools = self.folder / "tools"
        shutil.copytree(SOURCES / "tools", tools, ignore=shutil.ignore_patterns("__pycache__"))
        for name in ("figure-robots", "gallery-table"):
            self.assertOneLine(run_tool(name, tools=tools, folder=self.folder), "no such folder")
        self.ledger("results/robot", "gallery/ledger/biped-ctrnn-001.json")
        self.ledger("results/gallery", "robot/ledger/supg-unit-001.json")
        for name in ("figure-robots", "gallery-table"):
            self.assertOneLine(run_tool(name, tools=tools, folder=self.folder), "001.json")
        self.assertFalse((self.folder / "docs").exists())
        self.all_wrong(("cppn-sensitivity", PROGRAM, "nowhere"), ("cppn-sensitivity", PROGRAM, "."), ("article-numbers", PROGRAM, "--paper", "nowhere"),
                       ("article-numbers", PROGRAM, "--results", "nowhere"))

    def test_a_record_of_a_map(self):
        rows = "generation,evaluations,steps,elites,qd_score,map_best,wall_s\n0,1000,50,5,1.5,0.5,1\n"
        for name, text in {"generations.csv": rows, "archive.bin": "a", "config.toml": "seed = 1\n"}.items():
            self.write(f"run/{name}", text)
            self.write(f"bare/{name}", text.replace("elites", "others"))
            self.write(f"cut/{name}", text[:-4])
        self.write("other.json", "{}")
        self.write("broken.json", '{"a')
        self.all_wrong(("map-record", "nowhere"), ("map-record", "bare"), ("map-record", "cut"), ("map-record", "run", "other.json"),
                       ("map-record", "run", "broken.json"), ("map-record", "run", "other.json/deeper.json"))
        self.assertEqual(run_tool("map-record", "run", "new/record.json", folder=self.folder).returncode, 0)
        self.assertEqual(run_tool("map-record", "run", "new/record.json", folder=self.folder).stdout, "the same\n")


class Kept(Case):
    """What an earlier call made is taken if the same command of the same program made it, and never otherwise."""

    def test_recovery_of_maps_reads_the_folder_that_it_is_given(self):
        stub, committed = self.stub(), (SOURCES / "results/encodings/recovery.csv").read_bytes()
        self.write("mine/study.toml", 'name = "encodings"\n')
        (self.folder / "mine/runs/quadruped-supg-003").mkdir(parents=True)

        def table(version="1"):
            return run_tool("recovery-of-maps", "encodings", "mine", stub, folder=self.folder, VERSION=version)

        first = table()
        self.assertEqual((first.returncode, len(self.asked())), (0, 4), first.stderr)
        self.assertIn("4 of 120 cases", first.stderr)
        self.assertEqual(first.stdout.splitlines()[2:], ["| quadruped, SUPG | 4.00 | 3.00 | 1.00 | 2.00 | 50 % of 4 | 4 | 50 |", "",
                                                         "quadruped, adapted, means over maps: SUPG 2.00 m"])
        self.assertEqual(table().stdout, first.stdout)
        self.assertEqual(len(self.asked()), 4)
        self.assertOneLine(table("2"), "recovery.by.txt", "amble 1 adapt", "amble 2 adapt")
        csv = self.folder / "mine/recovery.csv"
        csv.write_text(csv.read_text(encoding="utf-8")[:-20], encoding="utf-8")
        self.assertOneLine(table(), "recovery.csv")
        (self.folder / "mine/recovery.by.txt").unlink()
        self.assertOneLine(table(), "not known which program")
        self.assertEqual((SOURCES / "results/encodings/recovery.csv").read_bytes(), committed)

    def test_recovery_of_maps_refuses_folders_of_others(self):
        stub = self.stub()
        self.write("empty/study.toml", 'name = "encodings"\n')
        self.write("broken/study.toml", "name = ")
        self.all_wrong(*(("recovery-of-maps", "encodings", name, stub) for name in
                         ("nowhere", "empty", "broken", SOURCES / "results/noise", SOURCES / "results/encodings")),
                       ("recovery-of-maps", "others"))
        tools = self.folder / "tools"
        shutil.copytree(SOURCES / "tools", tools, ignore=shutil.ignore_patterns("__pycache__"))
        self.assertOneLine(run_tool("recovery-of-maps", "sizes", tools=tools, folder=self.folder), "no recovery.csv yet")
        self.assertEqual(self.asked(), [])

    def test_recovery_study_starts_nothing_that_was_not_meant(self):
        stub = self.stub()
        self.write("file", "")
        self.write("other/1/config.toml", 'name = "another"\nseed = 1\n')
        self.write("known/adapted/leg-fl-ode-01.json", "{}")
        self.write("older/made-by.txt", "amble 0\n")
        (self.folder / "empty").mkdir()
        self.all_wrong(*(("recovery-study", *words, stub) for words in
                         (["octopod"], ["file"], ["once", "file"], ["other"], ["known"], ["older"], ["--trials"], ["once", "--trials"])),
                       ("recovery-study", "empty", stub, "x"), ("recovery-study", "empty", stub, "0"), ("recovery-study", "empty", stub, "--trials", "4"))
        self.assertEqual(self.asked(), [])
        self.assertFalse((self.folder / "octopod").exists())

    def test_transfer_study(self):
        stub = str(self.stub())
        self.write("file", "")
        self.write("other/run", "")
        self.write("older/made-by.txt", "amble 0\n")
        for words in (["made", "x"], ["made", "0"], ["made", "1.5"], ["made", "1", "x"], ["made", "1", "1", "nobody"], ["file"], ["other"], ["older"]):
            self.wrong("transfer-study", *words, AMBLE=stub)
        self.assertFalse((self.folder / "made").exists())
        self.assertEqual(self.asked(), [])

    def test_public_robots(self):
        tools, stub = self.folder / "tools", str(self.stub())
        shutil.copytree(SOURCES / "tools", tools, ignore=shutil.ignore_patterns("__pycache__"))
        self.write("tools/public-robots.csv", "robot,kind,repository,commit,model\n" + f"Nobody,biped,{self.folder}/none,{40 * '0'},robot.urdf\n")
        self.write("file", "")
        for words in (["file"], ["made", "Somebody"], ["made", "--init"]):
            done = run_tool("public-robots", *words, tools=tools, folder=self.folder, AMBLE=stub)
            self.assertOneLine(done)
        self.assertEqual(list((self.folder / "made/models").iterdir()), [])
        self.write("made/nobody.row", "| Nobody | a row of an older program |\n")
        self.assertOneLine(run_tool("public-robots", "made", tools=tools, folder=self.folder, AMBLE=stub), "nobody.row")


class Others(Case):
    def test_failed_tests_are_told_apart_from_what_passed_around_them(self):
        rule = "-" * 58 + "\n"
        block = "{0}/2 Testing: {1}\n{0}/2 Test: {1}\nOutput:\n" + rule + "{2}<end of output>\nTest time = 0 sec\n" + rule + "Test Failed.\n\n"
        said = "ok 1 - before\nnot ok 2 - a claim\n  error: '2 == 3'\n" + "".join(f"line {i}\n" for i in range(99)) + "ok 3 - behind\n"
        log = rule + block.format(1, "Viewer.page", said) + rule + block.format(2, "quiet", "".join(f"at {i}\n" for i in range(30)))
        self.write("build/Testing/Temporary/LastTest.log", log)
        self.write("build/Testing/Temporary/LastTestsFailed.log", "7:Viewer.page\n8:quiet\n9:absent\n")
        done = run_tool("failed-tests", "build", folder=self.folder)
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        page, absent, quiet = "--- Viewer.page failed:", "--- absent failed:\nit did not run\n", "--- quiet failed:\nat 10\n"
        for part in (f"{page}\nnot ok 2 - a claim\n  error: '2 == 3'\nline 0\n", absent, quiet):
            self.assertIn(part, done.stdout)
        for part in ("before", "behind", "line 50", "at 9\n"):
            self.assertNotIn(part, done.stdout)
        self.wrong("failed-tests", "nowhere", words=["nowhere", "ctest"])

    def test_champions_settings_and_sources_that_are_wrong(self):
        self.write("page.html", "")
        champion = SOURCES / "robots/hexapod/steered.json"
        gains = ["steering-gains", "--command", SOURCES / "robots/hexapod/steer.toml", "--full-speed"]
        cases = [(*gains, "0", champion), (*gains, "x", champion), (*gains, "1", "--episodes", "0", champion), (*gains, "1", "--turn-gains", "x", champion),
                 ("steering-table", "--trials", "0", champion), ("steering-table", "--speed", "x", champion), ("export-study", "nowhere"),
                 ("lint", "nowhere.cpp"), ("lint", "--alone", "more"), ("measure-browser", "--seeds"), ("measure-browser", "--seeds", "x"),
                 ("measure-browser", "nowhere.json"), ("make-site", "page.html", "--program", PROGRAM), ("measure-watch", PROGRAM, "0"),
                 ("make-site", "site", "--program", PROGRAM, "--repository", "x")]
        mjs = [("lab-table.mjs", PROGRAM, "second"), ("lab-table.mjs", PROGRAM, "first", "--seeds", "x"), ("lab-table.mjs", PROGRAM, "experiments", "--only", "x"),
               ("lab-table.mjs", "nowhere", "first"), ("lab-table.mjs", "/bin/false", "first"), ("lab-table.mjs", PROGRAM, "first", "--processes", "0"),
               ("lab-walks.mjs", "nowhere"), ("lab-walks.mjs", PROGRAM, "--scale", "0"), ("render-video.mjs", "nowhere.html", "out.mp4"),
               ("render-video.mjs", "page.html", "out.txt"), ("render-video.mjs", "page.html", "out.mp4", "--fps", "0"),
               ("render-video.mjs", "page.html", "out.mp4", "--from", "3", "--to", "1"), ("render-video.mjs", "page.html", "out.mp4", "--size", "3"),
               ("render-video.mjs", "page.html", "out.png", "--scheme", "x")]
        self.all_wrong(*cases, *(case for case in mjs if case[0] in runnable()))
        self.assertEqual([path.name for path in self.folder.iterdir()], ["page.html"])

    def test_what_is_written_is_left_where_the_program_fails(self):
        tools = self.folder / "tools"
        shutil.copytree(SOURCES / "tools", tools, ignore=shutil.ignore_patterns("__pycache__"))
        page = self.write("docs/SETTINGS.md", "as it was\n")
        self.assertOneLine(run_tool("update-docs", self.stub(), tools=tools, folder=self.folder), "amble: what is settings?")
        self.assertEqual(page.read_text(encoding="utf-8"), "as it was\n")
        self.assertEqual(list(page.parent.iterdir()), [page])


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
