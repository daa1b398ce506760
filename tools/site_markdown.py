"""Markdown as amble's pages use it, to HTML, for tools/make-site: headings, paragraphs, lists, quotes, tables, code, pictures, links,
emphasis. No HTML in Markdown, no footnotes: what begins with `<` is text."""

import re
from html import escape

FENCE, HEADING, ITEM = r"^( *)(`{3,})(\w*)\s*$", r"^(#{1,6}) +(.*?) *#*$", r"^(?:[-*+]|(\d+)\.) +"
ENDS_PARAGRAPH = rf"{FENCE}|{HEADING}|^[>|]|^(?:[-*+]|1\.) +"


def anchor_of(text):
    """The fragment that GitHub gives a heading."""
    text = re.sub(r"!?\[([^\]]*)\]\([^)]*\)", r"\1", text).strip().lower()
    return re.sub(r"[^\w\- ]", "", text).replace(" ", "-")


def plain(text):
    """A line of Markdown without its marks."""
    text = re.sub(r"!?\[([^\]]*)\]\([^)]*\)", r"\1", text)
    return re.sub(r"[`*]", "", text)


class Page:
    """One page. `address(link)` gives where a link or picture leads in the site, or None if nowhere: then its words stand alone."""

    def __init__(self, text, address):
        self.address, self.anchors, self.title = address, set(), None
        self.html = self.blocks(text.expandtabs(4).splitlines())

    def inline(self, text):
        kept = []

        def keep(html):
            kept.append(html)
            return f"\0{len(kept) - 1}\0"

        def code(found):
            inside = found[2].replace("\n", " ")
            spaced = len(inside) > 2 and inside[0] == inside[-1] == " "
            return keep(f"<code>{escape(inside[1:-1] if spaced else inside, quote=False)}</code>")

        def link(found):
            address = self.address(found[2])
            return found[1] if address is None else keep(f'<a href="{escape(address)}">') + found[1] + keep("</a>")

        def picture(found):
            alt = escape(plain(found[1]).replace("\n", " "))
            return keep(f'<img src="{escape(self.address(found[2]))}" alt="{alt}" loading="lazy">')

        text = re.sub(r"(?<!`)(`+)(?!`)(.+?)(?<!`)\1(?!`)", code, text, flags=re.S)
        text = re.sub(r"\\([\\`*_{}\[\]()#+.!|<>-])", lambda found: keep(escape(found[1])), text)
        text = escape(text, quote=False)
        text = re.sub(r"!\[([^\]]*)\]\(([^)\s]+)\)", picture, text)
        text = re.sub(r"\[([^\[\]]*)\]\(([^)\s]+)\)", link, text)
        text = re.sub(r"\*\*(?!\s)(.+?)(?<!\s)\*\*", r"<strong>\1</strong>", text, flags=re.S)
        text = re.sub(r"(?<![\w*])\*(?![\s*])(.+?)(?<![\s*])\*(?![\w*])", r"<em>\1</em>", text, flags=re.S)
        while "\0" in text:
            text = re.sub("\0(\\d+)\0", lambda found: kept[int(found[1])], text)
        return text

    def heading(self, level, words):
        anchor = base = anchor_of(words)
        number = 0
        while anchor in self.anchors:
            number += 1
            anchor = f"{base}-{number}"
        self.anchors.add(anchor)
        # One h1 per page: its title.
        if level == 1 and self.title is not None:
            level = 2
        self.title = self.title or plain(words)
        return f'<h{level} id="{escape(anchor)}">{self.inline(words)}</h{level}>'

    def table(self, lines):
        rows = [[cell.strip().replace("\\|", "|") for cell in re.split(r"(?<!\\)\|", line.strip().removeprefix("|").removesuffix("|"))]
                for line in lines]
        head, body = rows[0], rows[2:]
        kinds = "".join(f"<th scope=\"col\">{self.inline(cell)}</th>" if cell else "<td></td>" for cell in head)
        out = f"<thead><tr>{kinds}</tr></thead>" if any(head) else ""
        cells = ("".join(f"<td>{self.inline(cell)}</td>" for cell in row) for row in body)
        out += "<tbody>" + "".join(f"<tr>{row}</tr>" for row in cells) + "</tbody>"
        return f'<div class="scroll" role="group" aria-label="Table" tabindex="0"><table>{out}</table></div>'

    def listing(self, lines):
        """A list, from its first line to the last that belongs to it."""
        items, first = [], re.match(ITEM, lines[0])
        for line in lines:
            mark = re.match(ITEM, line)
            if mark:
                items.append([])
                width = mark.end()
            items[-1].append(line[width:] if mark else re.sub(rf"^ {{0,{width}}}", "", line))
        out = []
        for item in items:
            simple = not any(re.match(ITEM + "|" + FENCE, line) or not line for line in item)
            out.append("<li>" + (self.inline("\n".join(item)) if simple else self.blocks(item)) + "</li>")
        return f'<ol start="{first[1]}">{"".join(out)}</ol>' if first[1] else f"<ul>{''.join(out)}</ul>"

    def blocks(self, lines):
        out, at = [], 0
        while at < len(lines):
            line = lines[at]
            following = lines[at + 1] if at + 1 < len(lines) else ""
            end = at + 1
            if not line.strip():
                pass
            elif fence := re.match(FENCE, line):
                while end < len(lines) and not re.match(rf"^ *{fence[2]}`* *$", lines[end]):
                    end += 1
                code = "\n".join(re.sub(rf"^ {{0,{len(fence[1])}}}", "", inside) for inside in lines[at + 1:end])
                out.append(f'<pre tabindex="0"><code>{escape(code, quote=False)}</code></pre>')
                end += 1
            elif heading := re.match(HEADING, line):
                out.append(self.heading(len(heading[1]), heading[2]))
            elif line.startswith("|") and re.fullmatch(r"[|:\- ]+", following):
                while end < len(lines) and lines[end].startswith("|"):
                    end += 1
                out.append(self.table(lines[at:end]))
            elif re.match(ITEM, line):
                while end < len(lines) and (lines[end].startswith("  ") or re.match(ITEM, lines[end]) or
                                            self.goes_on(lines, end)):
                    end += 1
                out.append(self.listing(lines[at:end]))
            elif line.startswith(">"):
                while end < len(lines) and lines[end].startswith(">"):
                    end += 1
                out.append(f"<blockquote>{self.blocks([re.sub('^> ?', '', quoted) for quoted in lines[at:end]])}</blockquote>")
            elif re.fullmatch(r"(-{3,}|\*{3,})\s*", line):
                out.append("<hr>")
            else:
                while end < len(lines) and lines[end].strip() and not re.match(ENDS_PARAGRAPH, lines[end]):
                    end += 1
                out.append(f"<p>{self.inline(chr(10).join(lines[at:end]))}</p>")
            at = end
        return "\n".join(out)

    @staticmethod
    def goes_on(lines, at):
        """Whether a list that has come to this line, which is neither indented nor an item, goes on with it."""
        if not lines[at].strip():
            rest = next((line for line in lines[at:] if line.strip()), "")
            return rest.startswith("  ") or bool(re.match(ITEM, rest))
        # A line that merely was not indented belongs to the paragraph of its item.
        return bool(lines[at - 1].strip()) and not re.match(ENDS_PARAGRAPH, lines[at])
