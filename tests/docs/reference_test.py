#!/usr/bin/env python3
"""reference_test.py SPREKK SPREKK_SPACE: docs/reference and docs/reference_in_space are what the programs write now."""

import difflib
import subprocess
import sys
import tempfile
from pathlib import Path

from pages import ROOT


def texts(folder):
    return {file.name: file.read_text(encoding="utf-8") for file in Path(folder).iterdir()}


out_of_date = []
for program, folder in zip(sys.argv[1:], ("docs/reference", "docs/reference_in_space"), strict=True):
    with tempfile.TemporaryDirectory() as scratch:
        subprocess.run([program, "reference", scratch], check=True)
        written = texts(scratch)
    kept = texts(ROOT / folder)
    if written == kept:
        continue
    out_of_date.append(f"`{Path(program).name} reference {folder}`")
    for name in sorted(written.keys() | kept.keys()):
        old, new = kept.get(name, "").splitlines(True), written.get(name, "").splitlines(True)
        sys.stdout.writelines(difflib.unified_diff(old, new, f"{folder}/{name}", "now"))
if out_of_date:
    sys.exit(f"the reference is out of date: run {' and '.join(out_of_date)}, and commit it")
