"""The text of the article, for tools/article-numbers: which numbers it names, and which numerals stand in it besides."""

import re

from tool_input import Wrong

BLANKED = "label ref cite texttt begin end sidefigure bibliography bibliographystyle".split()
WORDS = """two three four five six seven eight nine ten eleven twelve thirteen fifteen sixteen twenty thirty hundred thousand half
           third quarter"""


def braced(text, at):
    """What stands in the braces that open at `at`, and where they end."""
    depth = 0
    for end in range(at, len(text)):
        depth += {"{": 1, "}": -1}.get(text[end], 0)
        if depth == 0:
            return text[at + 1:end], end + 1
    raise Wrong(f"a brace is not closed: {text[at:at + 40]!r}")


def arguments(text, at, count):
    values = []
    for _ in range(count):
        value, at = braced(text, at)
        values.append(value)
    return values, at


class Article:
    def __init__(self, path):
        self.name = path.name
        # Comments become spaces, so that places stay.
        self.text = re.sub(r"(?<!\\)%.*", lambda found: " " * len(found[0]), path.read_text(encoding="utf-8"))
        self.begin, self.end = self.text.find(r"\begin{document}"), self.text.find(r"\end{document}")
        if min(self.begin, self.end) < 0:
            raise Wrong(f"{path}: no document")
        self.rows = {}
        for found in re.finditer(r"\\newcommand\{(\\\w+)\}\[(\d)\](?=\{)", self.text[:self.begin]):
            body, _ = braced(self.text, found.end())
            if re.search(r"\\num\{[^}]*#", body):
                self.rows[found[1]] = (int(found[2]), body)

    def line(self, at):
        return self.text.count("\n", 0, at) + 1

    def calls(self, name, count):
        for found in re.finditer(re.escape(name) + r"(?=\{)", self.text[self.begin:self.end]):
            at = self.begin + found.end()
            yield at - len(name), *arguments(self.text, at, count)

    def names(self):
        """Each name of a number, with its place, in the order of the text."""
        found = [(at, name) for at, [name], _ in self.calls(r"\num", 1)]
        for macro, (count, body) in self.rows.items():
            for at, values, _ in self.calls(macro, count):
                filled = re.sub(r"#(\d)", lambda number: values[int(number[1]) - 1], body)
                found += [(at, name) for name in re.findall(r"\\num\{([^}]*)\}", filled)]
        return sorted(found)

    def prose(self):
        """The text as it is read: with names, files, and what is not printed blanked."""
        prose = list(self.text[:self.end])

        def blank(start, end):
            prose[start:end] = [letter if letter == "\n" else " " for letter in prose[start:end]]

        blank(0, self.begin)
        for name in ["num", "holds", *BLANKED]:
            for at, _, end in self.calls("\\" + name, 1):
                blank(at, end)
        for macro, (count, body) in self.rows.items():
            named = {int(number) for name in re.findall(r"\\num\{([^}]*)\}", body) for number in re.findall(r"#(\d)", name)}
            for at, values, end in self.calls(macro, count):
                start = at + len(macro)
                blank(at, start)
                for number, value in enumerate(values, 1):
                    if number in named:
                        blank(start, start + len(value) + 2)
                    start += len(value) + 2
        return "".join(prose)


def check_numerals(article, path):
    """That every numeral and number word of the text is a macro or is listed with its source; and that nothing is listed in vain."""
    prose = article.prose()
    for number, line in enumerate(path.read_text(encoding="utf-8").splitlines(), 1):
        if not line.strip() or line.startswith("#"):
            continue
        phrase, mark, source = line.partition(" :: ")
        if not mark or not source.strip():
            raise Wrong(f"{path.name}:{number}: not “PHRASE :: SOURCE”: {line!r}")
        words = [re.escape(word) for word in phrase.split()]
        pattern = r"(?<![\w.])" + r"(?:\s|~|\\,)+".join(words) + r"(?!\w)"
        prose, count = re.subn(pattern, lambda found: re.sub(r"[^\n]", " ", found[0]), prose)
        if not count:
            raise Wrong(f"{path.name}:{number}: the text has no {phrase!r} (any more): remove the line")
    left = re.search(rf"\d[\d.,]*|\b(?:{'|'.join(WORDS.split())})\b", prose, re.I)
    if left:
        around = " ".join(article.text[max(0, left.start() - 25):left.end() + 25].split())
        raise Wrong(f"{article.name}:{article.line(left.start())}: the numeral {left[0]!r} (“… {around} …”) comes from no ledger: "
                    f"name it by \\num{{…}}, or list it with its source in {path.name}")
