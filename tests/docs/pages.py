#!/usr/bin/env python3
"""Code blocks of the pages in docs/.

pages.py extract PAGE FOLDER writes every block whose fence says file=PATH to FOLDER/PATH, and leaves files alone that have
not changed, so that nothing is built anew without need. Sources there that are not in the page any more are removed.
"""

import re
import sys
from dataclasses import dataclass
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]


@dataclass
class Block:
    line: int
    language: str
    words: list
    text: str


def blocks(page):
    """The fenced code blocks of a page, in their order."""
    found, start, text = [], None, []
    for number, line in enumerate(Path(page).read_text(encoding="utf-8").splitlines(), start=1):
        fence = re.match(r"```(\S*)\s*(.*)$", line)
        if fence and start is None:
            start, text = (number, fence[1], fence[2].split()), []
        elif line.startswith("```") and start is not None:
            found.append(Block(*start, "\n".join(text) + "\n"))
            start = None
        elif start is not None:
            text.append(line)
    if start is not None:
        sys.exit(f"{page}:{start[0]}: a code block does not end")
    return found


def files(page):
    """{path: text} of the blocks that are files."""
    named = {}
    for block in blocks(page):
        for word in block.words:
            key, _, path = word.partition("=")
            if key == "file":
                named[path] = block.text
    return named


def pages():
    return [*(ROOT / name for name in ("README.md", "CONTRIBUTING.md", "CHANGELOG.md")), *sorted((ROOT / "docs").rglob("*.md"))]


def extract(page, folder):
    for old in Path(folder).rglob("*.[ch]pp"):
        if old.relative_to(folder).as_posix() not in files(page):
            old.unlink()
    for path, text in files(page).items():
        file = Path(folder) / path
        if file.exists() and file.read_text(encoding="utf-8") == text:
            continue
        file.parent.mkdir(parents=True, exist_ok=True)
        file.write_text(text, encoding="utf-8")


if __name__ == "__main__":
    if len(sys.argv) != 4 or sys.argv[1] != "extract":
        sys.exit(__doc__)
    extract(sys.argv[2], sys.argv[3])
