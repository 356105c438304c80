#!/usr/bin/env python3
"""reference_test.py SPREKK: docs/reference is what `sprekk reference` writes now."""

import difflib
import subprocess
import sys
import tempfile
from pathlib import Path

from pages import ROOT

with tempfile.TemporaryDirectory() as scratch:
    subprocess.run([sys.argv[1], "reference", scratch], check=True)
    written = {file.name: file.read_text(encoding="utf-8") for file in Path(scratch).iterdir()}
kept = {file.name: file.read_text(encoding="utf-8") for file in (ROOT / "docs/reference").iterdir()}

different = False
for name in sorted(written.keys() | kept.keys()):
    old, new = kept.get(name, ""), written.get(name, "")
    if old != new:
        different = True
        sys.stdout.writelines(difflib.unified_diff(old.splitlines(True), new.splitlines(True), "docs/reference/" + name, "now"))
if different:
    sys.exit("docs/reference is out of date: run `sprekk reference docs/reference` and commit it")
