#!/usr/bin/env python3
"""links_test.py: relative links and pictures of the pages exist, their anchors too; scenes, tools and sources that they name
exist; excerpts (```yaml from=FILE) are in the file."""

import re
import sys

from pages import ROOT, blocks, pages

PATH = re.compile(r"`((?:framework|components|couplers|configs|tests|tools|docs)/[\w./-]*\w)`")


def anchors(page):
    headings = re.findall(r"^#+ (.*)$", page.read_text(encoding="utf-8"), re.MULTILINE)
    return {re.sub(r"[^\w\- ]", "", heading.lower()).replace(" ", "-") for heading in headings}


def problems(page):
    text = page.read_text(encoding="utf-8")
    prose = re.sub(r"^```.*?^```", "", text, flags=re.DOTALL | re.MULTILINE)
    for target in re.findall(r"\]\(([^)\s]+)\)", prose):
        if re.match(r"[a-z]+:", target):
            continue
        path, _, anchor = target.partition("#")
        linked = (page.parent / path).resolve() if path else page
        if not linked.exists():
            yield f"links to {target}, which does not exist"
        elif anchor and linked.suffix == ".md" and anchor not in anchors(linked):
            yield f"links to {target}, which has no such heading"
    example = {path for other in pages() for block in blocks(other) for word in block.words
               for path in [word.partition("=")[2]] if word.startswith("file=")}
    for path in PATH.findall(prose) if page.name != "CHANGELOG.md" else ():  # its files may have moved since
        if not (ROOT / path).exists() and path not in example and not any(e.startswith(path + "/") for e in example):
            yield f"names {path}, which does not exist"
    for block in blocks(page):
        for word in block.words:
            key, _, path = word.partition("=")
            if key == "from" and block.text not in (ROOT / path).read_text(encoding="utf-8"):
                yield f"shows what is not in {path} (line {block.line})"


count = 0
for page in pages():
    for problem in problems(page):
        print(f"{page.relative_to(ROOT)} {problem}")
        count += 1
sys.exit(1 if count else 0)
