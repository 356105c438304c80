#!/usr/bin/python3
"""step_times.py RESULTS…: where the time of a step went, from the run.json of each folder."""

import json
import sys
from pathlib import Path

print("\nscene of sec. 5.1: seconds a step on one thread (12 steps; 6 without and 6 with injection)")
print(f"{'folder':>8} {'cells':>7} {'unknowns':>9} {'factorizations':>14} {'order':>7} {'factor':>7} {'solve':>7} {'other':>7} {'all':>7}")
for folder in map(Path, sys.argv[1:]):
    run = json.loads((folder / "run.json").read_text())
    counts = run["counters"]
    seconds = {entry["name"]: entry["seconds"] for entry in run["profile"]}
    steps = counts["steps accepted"]
    order, factor, solve = (seconds[f"linear: {name}"] / steps for name in ("ordering", "factorization", "solve"))
    other = seconds["steps"] / steps
    print(f"{folder.name:>8} {counts['mesh: cells']:>7} {counts['unknowns']:>9} {counts['linear: factorizations'] / steps:>14.2f}"
          f" {order:>7.3f} {factor:>7.3f} {solve:>7.3f} {other:>7.3f} {order + factor + solve + other:>7.3f}")
