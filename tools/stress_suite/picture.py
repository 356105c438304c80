"""Draws the distribution of Newton's iterations, and of cuts over the scenes."""

from collections import Counter

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402


def draw(record, path):
    figure, (left, right) = plt.subplots(1, 2, figsize=(9, 3.4), dpi=100, width_ratios=(2, 1))
    iterations = {int(k): v for k, v in record["iterations"].items()}
    left.bar(list(iterations), list(iterations.values()), color="#27608f", width=0.9)
    left.set_yscale("log")
    left.set_xlabel("Newton iterations of an accepted step")
    left.set_ylabel("steps")
    cuts = Counter(min(entry["rejected"], 10) for entry in record["cuts"])
    cuts[0] = record["scenes"] - record["scenes with cuts"]
    right.bar(list(cuts), list(cuts.values()), color="#b0562c", width=0.9)
    right.set_yscale("log")
    right.set_xlim(-0.7, 10.7)
    right.set_xlabel("cuts of a scene (10: or more)")
    right.set_ylabel("scenes")
    figure.suptitle(f"{record['scenes']} scenes, {record['steps accepted']} steps, {record['steps cut']} cut", fontsize=10)
    figure.tight_layout()
    figure.savefig(path)
