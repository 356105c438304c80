#!/usr/bin/env python3
"""release_test.py: the version is the same in CMakeLists.txt and CITATION.cff, the changelog begins with what is not released yet or with
this version, and its entries are newest first."""

import re

from pages import ROOT


def text(path):
    return (ROOT / path).read_text(encoding="utf-8")


version = re.search(r"project\(sprekk VERSION ([\d.]+)", text("CMakeLists.txt"))[1]
cited = re.search(r"^version: (\S+)$", text("CITATION.cff"), re.MULTILINE)[1]
assert cited == version, f"CITATION.cff has version {cited}, CMakeLists.txt {version}"

changelog = text("CHANGELOG.md")
releases = re.findall(r"^## \[(.+?)\]", changelog, re.MULTILINE)
assert releases and releases[0] in ("Unreleased", version), f"CHANGELOG.md begins with {releases[:1]}, the version is {version}"
for release in re.split(r"^## ", changelog, flags=re.MULTILINE)[1:]:
    days = re.findall(r"^### (\S+)$", release, re.MULTILINE)
    assert days and all(re.fullmatch(r"\d{4}-\d\d-\d\d", day) for day in days), f"days of a release are written as 2026-11-22: {days}"
    assert days == sorted(set(days), reverse=True), f"the newest day comes first: {days}"
assert not (ROOT / "docs/changes").exists(), "docs/changes has become CHANGELOG.md: write the entry there"
