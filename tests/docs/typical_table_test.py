"""tools/typical-table on a study of which a run is missing.

    typical_table_test.py SOURCES
"""

import json
import shutil
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

SOURCES = Path(sys.argv[1]).resolve()


class TypicalTable(unittest.TestCase):
    def setUp(self):
        self.scratch = tempfile.TemporaryDirectory()
        self.results = Path(self.scratch.name) / "gallery"
        shutil.copytree(SOURCES / "results/gallery", self.results)

    def tearDown(self):
        self.scratch.cleanup()

    def table(self):
        command = [sys.executable, "-B", SOURCES / "tools/typical-table", self.results]
        return subprocess.run(list(map(str, command)), capture_output=True, text=True, check=True)

    def test_a_whole_condition_has_a_row(self):
        done = self.table()
        self.assertIn("| `gallery`, servo-supg | 3 |", done.stdout)
        self.assertEqual(done.stderr, "")

    def test_a_condition_with_a_missing_run_has_none_and_is_named(self):
        (self.results / "ledger/servo-supg-002.json").unlink()
        done = self.table()
        self.assertNotIn("servo-supg", done.stdout)
        self.assertIn("| `gallery`, hexapod-supg | 10 |", done.stdout)
        self.assertIn("left out servo-supg, runs missing: 1", done.stderr)

    def test_a_condition_with_a_run_that_lacks_a_test_has_none_and_is_named(self):
        path = self.results / "ledger/servo-supg-002.json"
        record = json.loads(path.read_text())
        record["tests"] = [test for test in record["tests"] if test["name"] != "milli"]
        path.write_text(json.dumps(record))
        done = self.table()
        self.assertNotIn("servo-supg", done.stdout)
        self.assertIn("left out servo-supg, runs without a test of 15 s at milli", done.stderr)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
