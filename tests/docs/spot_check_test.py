"""tools/spot-check, which `make reproduce-sample` calls, on a study that takes a second.

    spot_check_test.py PROGRAM SOURCES
"""

import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

PROGRAM, SOURCES = Path(sys.argv[1]).resolve(), Path(sys.argv[2]).resolve()
STUDY = SOURCES / "studies/smoke.toml"

# Runs amble, and puts another best into the record of what was repeated.
LIAR = """#!/bin/sh
"{program}" "$@" || exit
case "$*" in *--discard-runs*) sed -i 's/"best_m": [0-9.]*/"best_m": 9.5/; s/"digest": "[0-9a-f]*"/"digest": "0123456789abcdef"/' "$4"/ledger/*.json ;; esac
"""


class SpotCheck(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.scratch = tempfile.TemporaryDirectory()
        cls.folder = Path(cls.scratch.name)
        subprocess.run([PROGRAM, "study", STUDY, "--out", cls.folder / "results", "--discard-runs"], check=True, capture_output=True)

    @classmethod
    def tearDownClass(cls):
        cls.scratch.cleanup()

    def spot_check(self, program, *arguments):
        command = [sys.executable, "-B", SOURCES / "tools/spot-check", program, STUDY, self.folder / "results", *arguments]
        return subprocess.run(list(map(str, command)), capture_output=True, text=True)

    def test_runs_that_repeat_are_the_same_with_the_digests_of_the_ledger(self):
        done = self.spot_check(PROGRAM, 3, 5, 2)
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        self.assertEqual(len(done.stdout.splitlines()), 3)
        for line in done.stdout.splitlines():
            self.assertRegex(line, r"^\w+-\d{3}\.json: the same; digest [0-9a-f]{16} as in the ledger; \d+ s$")

    def test_the_draw_depends_on_the_seed_and_not_on_how_many_run_side_by_side(self):
        def names(*arguments):
            return [line.partition(":")[0] for line in self.spot_check(PROGRAM, *arguments).stdout.splitlines()]

        self.assertEqual(names(2, 5, 1), names(2, 5, 2))
        self.assertNotEqual(names(2, 5, 2), names(2, 6, 2))

    def test_a_run_that_does_not_repeat_is_named_with_what_differs(self):
        liar = self.folder / "liar"
        liar.write_text(LIAR.format(program=PROGRAM), encoding="utf-8")
        liar.chmod(0o755)
        done = self.spot_check(liar, 1, 5, 1)
        self.assertEqual(done.returncode, 1, done.stdout + done.stderr)
        self.assertRegex(done.stdout, r": DIFFERENT: best_m; digest 0123456789abcdef, in the ledger [0-9a-f]{16}; \d+ s\n$")


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
