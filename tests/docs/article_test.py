"""The article's numbers are what the ledgers give, and tools/article-numbers says in one line where they are not. No LaTeX.

    article_test.py PROGRAM SOURCES
"""

import json
import re
import shutil
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

PROGRAM, SOURCES = Path(sys.argv[1]).resolve(), Path(sys.argv[2]).resolve()


class Article(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.scratch = tempfile.TemporaryDirectory()
        cls.folder = Path(cls.scratch.name)
        cls.tables = cls.folder / "tables"
        cls.committed = cls.run_tool("--check", paper=SOURCES / "paper")

    @classmethod
    def tearDownClass(cls):
        cls.scratch.cleanup()

    @classmethod
    def run_tool(cls, *arguments, paper=None, tables=None):
        command = [sys.executable, "-B", SOURCES / "tools/article-numbers", PROGRAM, *arguments, "--tables", tables or cls.tables,
                   "--paper", paper or cls.folder / "paper"]
        return subprocess.run(list(map(str, command)), capture_output=True, text=True)

    def setUp(self):
        self.paper = self.folder / "paper"
        shutil.rmtree(self.paper, ignore_errors=True)
        shutil.copytree(SOURCES / "paper", self.paper)

    def change(self, name, before, after):
        path = self.paper / name
        text = path.read_text(encoding="utf-8")
        self.assertIn(before, text)
        path.write_text(text.replace(before, after, 1), encoding="utf-8")

    def append(self, name, line):
        path = self.paper / name
        path.write_text(path.read_text(encoding="utf-8") + line + "\n", encoding="utf-8")

    def refused(self, *words, arguments=("--check",), tables=None):
        """That the tool fails with one line that has these words."""
        done = self.run_tool(*arguments, tables=tables)
        self.assertEqual(done.returncode, 1, done.stdout)
        self.assertEqual(len(done.stderr.splitlines()), 1, done.stderr)
        for word in words:
            self.assertIn(word, done.stderr)

    def test_committed_numbers_are_those_of_the_ledgers(self):
        self.assertEqual(self.committed.returncode, 0, self.committed.stderr)
        self.assertRegex(self.committed.stdout, r"^numbers.tex: \d{3} numbers, ")

    def test_without_check_the_numbers_are_written_again(self):
        (self.paper / "numbers.tex").unlink()
        self.assertEqual(self.run_tool().returncode, 0)
        self.assertEqual((self.paper / "numbers.tex").read_bytes(), (SOURCES / "paper/numbers.tex").read_bytes())

    def test_a_changed_number_is_found(self):
        line = next(line for line in (self.paper / "numbers.tex").read_text(encoding="utf-8").splitlines()
                    if line.startswith(r"\setnum{paper.supg-novelty.five-min.distance_m.mean}"))
        self.change("numbers.tex", line, line.replace("{42}", "{43}"))
        self.refused("numbers.tex differs", "paper.supg-novelty.five-min.distance_m.mean", "{43}", "{42}")

    def test_a_number_that_nobody_names_is_found(self):
        self.append("numbers.tex", "\\setnum{paper.more}{1}")
        self.refused("does not name", "paper.more")

    def test_a_name_that_no_ledger_has_is_found(self):
        for name, reason in [("paper.supg-novelty.train_n.mean", "summary.csv has 0 rows"), ("papers.runs", "no ledger has a study"),
                             ("paper.nonsense", "no such kind"), ("paper.claim-47.p", "claims.csv has 0 rows"),
                             ("paper.supg-novelty.train_m.mode", "no ledger has this number")]:
            with self.subTest(name):
                self.setUp()
                self.change("article.tex", r"\section{Introduction}", rf"\section{{Introduction}} \num{{{name}}}")
                self.refused("article.tex:", name, reason)

    def test_a_numeral_of_no_ledger_is_found(self):
        for text in ["walks 43~m", "walks forty-three or twenty metres", "is 1.9 times as far"]:
            with self.subTest(text):
                self.setUp()
                self.change("article.tex", r"\subsection{What came out}", r"\subsection{What came out} It " + text + ".")
                self.refused("comes from no ledger", "published.txt", re.search(r"\d[\d.]*|twenty", text)[0])

    def test_a_listed_phrase_that_is_gone_and_one_without_source_are_found(self):
        self.append("published.txt", "over eleven times :: sec. 5")
        self.refused("published.txt", "over eleven times", "remove the line")
        self.setUp()
        self.append("published.txt", "over eight")
        self.refused("published.txt", "PHRASE :: SOURCE")

    def test_words_that_rest_on_a_verdict_are_held_to_it(self):
        self.change("article.tex", r"\holds{paper.claim-41.verdict = contradicted}", r"\holds{paper.claim-41.verdict = confirmed}")
        self.refused("rests on paper.claim-41.verdict = confirmed", "it is contradicted")
        self.setUp()
        self.change("article.tex", r"\holds{paper.claim-8.p > 0.01}", r"\holds{paper.claim-8.p < 0.01}")
        self.refused("rests on paper.claim-8.p < 0.01")

    def test_an_unfinished_study_is_refused(self):
        tables = self.folder / "unfinished"
        shutil.copytree(self.tables, tables, dirs_exist_ok=True)
        report = json.loads((tables / "paper/report.json").read_text(encoding="utf-8"))
        report["runs_done"] = 119
        (tables / "paper/report.json").write_text(json.dumps(report), encoding="utf-8")
        self.refused("results/paper is unfinished (119 of 120 runs)", tables=tables)

    def test_where_names_what_is_printed(self):
        done = self.run_tool("--where", "19.3")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("paper.supg-novelty/ctrnn-novelty.milli-five-min.distance_m.ratio: 19.3", done.stdout)
        self.refused("no number of the ledgers is printed as '123456'", arguments=("--where", "123456"))

    def test_metadata_has_the_articles_title_and_names_what_only_the_owner_knows(self):
        metadata = (self.paper / "metadata.yaml").read_text(encoding="utf-8")
        title = re.search(r"\\title\{(.*)\}", (self.paper / "article.tex").read_text(encoding="utf-8"))[1]
        self.assertIn(f'title: "{title}"\n', metadata)
        for key in ["name", "orcid", "email", "affiliations", "url", "doi"]:
            self.assertRegex(metadata, rf"{key}: OWNER")


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
