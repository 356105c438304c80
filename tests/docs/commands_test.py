#!/usr/bin/env python3
"""commands_test.py SPREKK: what the pages show on the terminal is what happens.

In a ```console test block every line that begins with "$ " is run by bash in one folder that holds configs/ and tools/, and
the lines after it must be what it prints; a line "…" stands for any lines, and "…" inside a line for any text. A block
```console test fails shows commands that end with another code than 0. Blocks of one page share the folder. A ```yaml
test=FILE block is written to FILE there.
"""

import os
import re
import subprocess
import sys
import tempfile
from pathlib import Path

from pages import ROOT, blocks, pages


def pattern(lines):
    parts = []
    for line in lines:
        parts.append("(?:.*\n)*?" if line == "…" else ".*?".join(map(re.escape, line.split("…"))) + "\n")
    return re.compile("".join(parts))


def commands(text):
    """[(command, lines that it prints)]"""
    found = []
    for line in text.splitlines():
        if line.startswith("$ "):
            found.append((line[2:], []))
        else:
            found[-1][1].append(line)
    return found


def check_page(page, environment):
    failures = 0
    with tempfile.TemporaryDirectory() as folder:
        for name in ("configs", "tools"):
            os.symlink(ROOT / name, Path(folder) / name)
        for block in blocks(page):
            for word in block.words:
                if word.startswith("test="):
                    (Path(folder) / word[len("test="):]).write_text(block.text, encoding="utf-8")
            if block.language != "console" or "test" not in block.words:
                continue
            for command, lines in commands(block.text):
                run = subprocess.run(["bash", "-c", command], cwd=folder, env=environment, text=True, timeout=300,
                                     stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
                if (run.returncode != 0) != ("fails" in block.words) or not pattern(lines).fullmatch(run.stdout):
                    failures += 1
                    print(f"{page.relative_to(ROOT)}:{block.line}: $ {command}\nexit code {run.returncode}, it prints\n{run.stdout}")
    return failures


with tempfile.TemporaryDirectory() as bin_folder:
    os.symlink(os.path.abspath(sys.argv[1]), Path(bin_folder) / "sprekk")
    environment = dict(os.environ, PATH=bin_folder + ":" + os.environ["PATH"])
    sys.exit(1 if sum(check_page(page, environment) for page in pages()) else 0)
