#!/usr/bin/env python3
"""site_test.py: the navigation of the site has every page of docs/, and the check of the site sees what it is to see."""

import re
import subprocess
import sys
import tempfile
from pathlib import Path

from pages import ROOT

GOOD = '<h1 id="top">x</h1><a href="b.html#there">x</a> <a href="https://example.org">x</a> <a href="#top">x</a>'
PLANTED = {  # a page, and what is to be said about it
    '<a href="c.html">x</a>': "links to c.html, which does not exist",
    '<a href="b.html#nowhere">x</a>': "links to b.html#nowhere, which has no such place",
    '<img src="missing.png">': "links to missing.png, which does not exist",
    '<script src="https://example.org/x.js"></script>': "loads https://example.org/x.js from a network",
    '<link rel="stylesheet" href="//example.org/x.css">': "loads //example.org/x.css from a network",
    "<style>@import url('http://example.org/f.css');</style>": "loads http://example.org/f.css from a network",
    '<p style="background: url(https://example.org/x.png)">x</p>': "loads https://example.org/x.png from a network",
}


def check(page, style=""):
    with tempfile.TemporaryDirectory() as folder:
        (Path(folder) / "a.html").write_text(page, encoding="utf-8")
        (Path(folder) / "b.html").write_text('<p id="there">x</p>', encoding="utf-8")
        (Path(folder) / "s.css").write_text(style, encoding="utf-8")
        run = subprocess.run([sys.executable, str(ROOT / "tools/site/check.py"), folder], capture_output=True, text=True)
        return run.returncode, run.stdout


def not_in_navigation():
    navigation = (ROOT / "tools/site/mkdocs.yml").read_text(encoding="utf-8")
    named = set(re.findall(r"([\w/]+\.md)", navigation))
    for page in sorted((ROOT / "docs").rglob("*.md")):
        path = str(page.relative_to(ROOT / "docs"))
        if path not in named and not path.startswith(("reference/", "reference_in_space/")):  # tools/docs adds these
            yield path


missing = list(not_in_navigation())
assert not missing, f"tools/site/mkdocs.yml lacks {missing}"
assert check(GOOD) == (0, ""), check(GOOD)
for page, message in PLANTED.items():
    assert check(GOOD + page) == (1, f"a.html {message}\n"), check(GOOD + page)
code, text = check(GOOD, "@font-face {src: url(https://example.org/f.woff)} p {background: url(gone.png)}")
assert code == 1 and "from a network" in text and "gone.png" in text, text
