#!/usr/bin/env python3
"""tools/count_sources counts what a planted folder has."""

import subprocess
import sys
import tempfile
from pathlib import Path

TOOL = Path(__file__).resolve().parents[2] / "tools" / "count_sources"

HEADER = """/*
 * Copyright (C) somebody
 */

/// Told.
class Told {
 public:
  enum Kind { a };  // beside code: no comment line

  // A line
  /* and
     two more, one of them: SPREKK_ASSERT(no code) */
  int x;
};

/**
 * Told in another style.
 */
struct AlsoTold {};
"""
SOURCE = """#include "a.hpp"
void f(int x) {
  SPREKK_EXPECT(x > 0, x);
  if (x > 3)
    SPREKK_ASSERT(x < 9);
  ASSERT_EQ(x, 5);
}
"""

with tempfile.TemporaryDirectory() as place:
    (Path(place) / "a.hpp").write_text(HEADER)
    (Path(place) / "deeper").mkdir()
    (Path(place) / "deeper" / "b.cc").write_text(SOURCE)
    (Path(place) / "notes.md").write_text("// no source\n" * 50)
    found = subprocess.run([TOOL, place], capture_output=True, text=True, check=True).stdout.splitlines()
    folders = subprocess.run([TOOL, "--folders", place], capture_output=True, text=True, check=True).stdout.splitlines()
    empty = subprocess.run([TOOL, Path(place) / "deeper" / "none"], capture_output=True, text=True)

characters = [len(HEADER.split("*/\n\n", 1)[1]), len(SOURCE)]
expected = [
    "2 files, 22 lines; median 11, 95th percentile 15, longest 15 lines",
    f"in thousands of characters: median {sum(characters) / 2000:.1f}, 95th percentile {max(characters) / 1000:.1f}, "
    f"longest {max(characters) / 1000:.1f}",
    "7 comment lines, 32 %",
    "3 assertions, 136.4 per 1,000 lines",
    "3 public types, 1 undocumented",
]
if found != expected or empty.returncode == 0 or "no C++ sources" not in empty.stderr:
    sys.exit(f"found {found}\ninstead of {expected}\n{empty}")
by_folder = [f"   1 {Path(place).resolve()}", f"   1 {Path(place).resolve() / 'deeper'}", "2 files in 2 folders, the largest has 1"]
if folders != by_folder:
    sys.exit(f"found {folders}\ninstead of {by_folder}")
print("a planted folder is counted as it is")
