"""The web site holds together: links lead somewhere, nothing is fetched from another host, pages can be read without looking.

    site_test.py PROGRAM SOURCES
"""

import re
import subprocess
import sys
import tempfile
import unittest
from html.parser import HTMLParser
from pathlib import Path
from urllib.parse import unquote

PROGRAM, SOURCES = Path(sys.argv[1]).resolve(), Path(sys.argv[2]).resolve()
sys.dont_write_bytecode = True
sys.path.insert(0, str(SOURCES / "tools"))
import site_markdown  # noqa: E402

FETCHES = {"img": ["src", "srcset"], "script": ["src"], "link": ["href"], "iframe": ["src"], "source": ["src", "srcset"],
           "object": ["data"], "embed": ["src"], "video": ["src", "poster"], "audio": ["src"], "use": ["href", "xlink:href"],
           "image": ["href", "xlink:href"]}


class Page(HTMLParser):
    """What a page links to, fetches, and says of itself."""

    def __init__(self, path):
        super().__init__()
        self.links, self.fetched, self.ids, self.headings, self.images = [], [], set(), [], []
        self.language, self.title, self.inside, self.styles = None, "", None, ""
        self.text = path.read_text(encoding="utf-8")
        self.feed(self.text)

    def handle_starttag(self, tag, attributes):
        attributes = dict(attributes)
        self.inside = tag
        self.ids.add(attributes.get("id"))
        self.fetched += [attributes[name] for name in FETCHES.get(tag, []) if attributes.get(name)]
        if tag == "a" and attributes.get("href"):
            self.links.append(attributes["href"])
        if tag == "img":
            self.images.append(attributes)
        if tag == "html":
            self.language = attributes.get("lang")
        if re.fullmatch("h[1-6]", tag):
            self.headings.append(int(tag[1]))
        self.styles += attributes.get("style") or ""

    def handle_endtag(self, tag):
        self.inside = None

    def handle_data(self, data):
        if self.inside == "title":
            self.title += data
        if self.inside == "style":
            self.styles += data


def make(*arguments):
    command = [sys.executable, "-B", SOURCES / "tools/make-site", "--program", PROGRAM, *arguments]
    return subprocess.run(list(map(str, command)), capture_output=True, text=True)


class Site(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.scratch = tempfile.TemporaryDirectory()
        cls.folder = Path(cls.scratch.name) / "site"
        done = make(cls.folder, "--repository", "https://example.org/amble.git")
        if done.returncode != 0:
            raise AssertionError(done.stderr)
        cls.pages = {path: Page(path) for path in sorted(cls.folder.rglob("*.html"))}
        cls.front = cls.pages[cls.folder / "index.html"]

    @classmethod
    def tearDownClass(cls):
        cls.scratch.cleanup()

    @property
    def made_by_amble(self):
        """Pages whose fragments are words to a program."""
        return {path for path in self.pages if path.parent.name == "walk" or path.name in ["lab.html", "drive.html"]}

    def test_every_relative_link_and_picture_leads_to_a_file_and_a_place_in_it(self):
        count = 0
        for path, page in self.pages.items():
            with self.subTest(path.relative_to(self.folder)):
                for link in page.links + page.fetched:
                    if re.match("[a-z]+:", link):
                        continue
                    count += 1
                    file, _, fragment = link.partition("#")
                    self.assertFalse(file.startswith("/"), f"{link}: not relative")
                    target = (path.parent / unquote(file)).resolve() if file else path
                    self.assertTrue(target.is_file(), f"{link}: no such file")
                    self.assertTrue(target.is_relative_to(self.folder.resolve()), f"{link}: leads out of the site")
                    if fragment and target not in self.made_by_amble:
                        self.assertIn(fragment, self.pages[target].ids, f"{link}: no such place")
        self.assertGreater(count, 500)

    def test_nothing_is_fetched_from_another_host(self):
        elsewhere = re.compile(r"^\s*(?!data:|blob:)([a-z]+:)?//", re.I)
        for path, page in self.pages.items():
            with self.subTest(path.relative_to(self.folder)):
                for address in page.fetched:
                    self.assertNotRegex(address, elsewhere)
                self.assertNotRegex(page.styles, r"@import|url\(\s*[\"']?(https?:)?//")
        for path in [*self.folder.rglob("*.css"), *self.folder.rglob("*.js"), *self.folder.rglob("*.svg")]:
            text = path.read_text(encoding="utf-8")
            self.assertNotRegex(text, r"@import|url\(\s*[\"']?(https?:)?//|(href|src)=[\"'](https?:)?//|fetch\(|import\(", str(path))

    def test_every_page_says_its_title_and_language_and_has_one_main_heading(self):
        titles = {}
        for path, page in self.pages.items():
            with self.subTest(path.relative_to(self.folder)):
                self.assertTrue(page.title.strip())
                self.assertEqual(page.language, "en")
                self.assertEqual(page.headings.count(1), 1)
                self.assertNotIn(page.title, titles, f"has the title of {titles.get(page.title)}")
                titles[page.title] = path.name
        self.assertEqual(len(self.pages), len(titles))

    def test_every_picture_has_words_in_its_place(self):
        count = 0
        for path, page in self.pages.items():
            with self.subTest(path.relative_to(self.folder)):
                for image in page.images:
                    count += 1
                    self.assertTrue((image.get("alt") or "").strip(), image.get("src"))
        self.assertGreater(count, 20)

    def test_headings_of_the_front_page_skip_no_level(self):
        for before, after in zip(self.front.headings, self.front.headings[1:]):
            self.assertLessEqual(after, before + 1)

    def test_every_robot_with_a_champion_walks_from_the_gallery(self):
        names = {"quadruped"} | {path.parent.name for path in SOURCES.glob("robots/*/champion.json")}
        names |= {f"{path.parent.name}-steered" for path in SOURCES.glob("robots/*/steered.json")}
        self.assertEqual({path.stem for path in self.folder.glob("walk/*.html")}, names)
        for name in names:
            self.assertIn(f"walk/{name}.html#live", self.front.links)
            page = self.pages[self.folder / f"walk/{name}.html"]
            self.assertIn("live", page.ids, "nothing to drive")
        self.assertIn("lab.html", self.front.links)

    def test_the_first_screen_waits_for_no_walker(self):
        at_once = [image["src"] for image in self.front.images if image.get("loading") != "lazy"]
        self.assertEqual(at_once, ["pictures/steered.png"])
        self.assertNotIn("<iframe", self.front.text)
        files = [self.folder / name for name in ["index.html", "site.css", "site.js", *at_once]]
        self.assertLess(sum(path.stat().st_size for path in files), 200_000)

    def test_numbers_of_a_finding_stand_in_what_it_quotes_and_the_pages_say_that(self):
        findings = re.findall(r'<figure class="finding">(.*?)</figure>', self.front.text, re.S)
        self.assertGreaterEqual(len(findings), 5)
        number = r"\d+(?:[.,]\d+)*"
        for finding in findings:
            with self.subTest(re.search("<h3>(.*?)</h3>", finding)[1]):
                quotes = re.findall(r"<!-- (\S+\.md): (.*?) -->", finding)
                self.assertTrue(quotes)
                for page, quote in quotes:
                    self.assertIn(quote, " ".join((SOURCES / page).read_text(encoding="utf-8").split()), page)
                quoted = re.findall(number, " ".join(quote for _, quote in quotes))
                words = re.sub(r"<!--.*?-->|<.*?>", " ", finding, flags=re.S)
                self.assertLessEqual(set(re.findall(number, words)), set(quoted))

    def test_no_mark_of_markdown_is_left_over(self):
        for path in sorted(set(self.folder.glob("read/**/*.html")) - self.made_by_amble):
            with self.subTest(path.relative_to(self.folder)):
                text = re.sub(r"<pre.*?</pre>|<code>.*?</code>", "", self.pages[path].text, flags=re.S)
                self.assertNotRegex(re.sub("<[^>]+>", "", text), re.compile(r"\*\*|\]\(|`|\0|^#+ |^\| ", re.M))

    def test_the_repository_is_named_where_it_was_given(self):
        for path, page in self.pages.items():
            with self.subTest(path.relative_to(self.folder)):
                if path not in self.made_by_amble:
                    self.assertIn("https://example.org/amble.git", page.links)

    def test_a_folder_of_somebody_else_is_left_as_it_is(self):
        other = Path(self.scratch.name) / "other"
        other.mkdir()
        (other / "index.html").write_text("mine")
        done = make(other)
        self.assertEqual(done.returncode, 1)
        self.assertIn("did not make; name another folder", done.stderr)
        self.assertEqual(len(done.stderr.splitlines()), 1)
        self.assertEqual([path.name for path in other.iterdir()], ["index.html"])

    def test_a_program_that_is_missing_is_one_line_and_leaves_nothing(self):
        target = Path(self.scratch.name) / "none"
        done = make("--program", "nowhere", target)
        self.assertEqual(done.returncode, 1)
        self.assertRegex(done.stderr, r"^tools/make-site: .*nowhere: no such program\n$")
        self.assertFalse(target.exists())


class Markdown(unittest.TestCase):
    def html(self, text):
        return site_markdown.Page(text, lambda link: None if link == "nowhere" else link + "!").html

    def test_headings_have_githubs_fragments(self):
        self.assertIn('<h2 id="what--does-it-cost-1">', self.html("# What & does `it` cost\n## What & does `it` cost\n"))
        self.assertEqual(site_markdown.anchor_of("A [link](x.md), and `code`: 5 %"), "a-link-and-code-5-")

    def test_what_stands_in_code_is_left_alone(self):
        self.assertIn("<code>*a* &lt;b&gt; [c](d)</code>", self.html("`*a* <b> [c](d)`"))
        self.assertIn("<code># no heading\n| no | table |</code>", self.html("```sh\n# no heading\n| no | table |\n```"))

    def test_html_in_markdown_is_text(self):
        self.assertEqual(self.html('<script src="x">'), '<p>&lt;script src="x"&gt;</p>')

    def test_links_lead_where_they_are_told_or_become_words(self):
        self.assertEqual(self.html("[a *b*](c) [d](nowhere)"), '<p><a href="c!">a <em>b</em></a> d</p>')
        self.assertIn('<img src="p.svg!" alt="a b"', self.html("![a *b*](p.svg)"))

    def test_tables_have_cells_with_bars_and_heads(self):
        html = self.html("| a | b |\n|---|---|\n| `x\\|y` | **z** |\n\nafter")
        self.assertIn('<th scope="col">a</th>', html)
        self.assertIn("<td><code>x|y</code></td><td><strong>z</strong></td>", html)
        self.assertTrue(html.endswith("<p>after</p>"))

    def test_lists_go_on_over_lines_and_hold_code(self):
        html = self.html("- one\n  goes on\n\n- two\n  ```\n  code\n  ```\n\nafter")
        self.assertIn("<li>one\ngoes on", re.sub("</?p>", "", html))
        self.assertIn("<code>code</code></pre></li></ul>\n<p>after</p>", html)
        self.assertIn('<ol start="3"><li>three</li><li>four</li></ol>', self.html("3. three\n4. four"))

    def test_stars_and_underscores_inside_words_are_no_emphasis(self):
        self.assertEqual(self.html("2 * 3 * 4 and a_b_c"), "<p>2 * 3 * 4 and a_b_c</p>")


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
