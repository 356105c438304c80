#!/usr/bin/env python3
"""references_test.py: wherever the sources and pages give the number of an equation, a section or a table, they say of which text:
"the paper's Eq. 6", "Eq. 6 of the paper", "Nordbotten 2016, sec. 3". Then checks itself."""

import re
import sys

from pages import ROOT, pages

REFERENCE = re.compile(r"\b(?:(?:Eqs?\.|Equations?|[Ss]ecs?\.|[Ss]ections?|Tables?|Figs?\.|Figures?) ?|Algorithm )\d[\d.]*")
NAMED = re.compile(r"paper|Dang|\btheir |\b(?:18|19|20)\d\d\b|\*[A-Z][^*]+\*, ")  # or an author with a year, or a *Title*
BEFORE, AFTER = 160, 60


def prose(text):
    """Without the marks of comments, quotes and new lines, which stand between the words of a sentence."""
    return re.sub(r"\s+", " ", re.sub(r'"\s*\n\s*"|^\s*(?://+<?|#)', " ", text, flags=re.MULTILINE))


def texts(code):
    """The strings of a source, those beside one another as one."""
    return re.findall(r'"(?:\\.|[^"\\\n])*"', re.sub(r'"\s*\n\s*"|//[^\n]*', "", code))


def bare(text):
    """The references without a name in the sentences around them."""
    text = prose(text)
    for found in REFERENCE.finditer(text):
        if not NAMED.search(text[max(0, found.start() - BEFORE) : found.end() + AFTER]):
            yield found.group() + " in: …" + text[max(0, found.start() - 60) : found.end() + 20] + "…"


def sources():
    for room in ("framework", "components", "couplers"):
        yield from sorted(path for path in (ROOT / room).rglob("*") if path.suffix in (".hpp", ".cpp"))
    yield from sorted((ROOT / "configs").rglob("*.yaml"))
    yield from (page for page in pages() if page.name != "CHANGELOG.md")


for planted in ('.source = "Eq. 6",', "/// The flux (sec. 2.3).", "as Table 1 says"):
    assert list(bare(planted)), f"not noticed: {planted}"
for clean in ('.source = "the paper\'s Eq. 6"', "/// Eqs. 4 and 1 of the\n/// paper", "Nordbotten 2016, sec. 3", "section of `mesh:`"):
    assert not list(bare(clean)), f"accused: {clean}"

count = 0
for path in sources():
    content = path.read_text(encoding="utf-8")
    pieces = [content, *(texts(content) if path.suffix in (".hpp", ".cpp") else ())]
    for problem in {problem: None for piece in pieces for problem in bare(piece)}:
        print(f"{path.relative_to(ROOT)} does not name the text of {problem}")
        count += 1
sys.exit(1 if count else 0)
