"""How a run may end: with an answer, or with a refusal that says what is wrong. Never with a signal, or not at all."""

import re

from . import written

NOISE = re.compile(r"runtime error:|AddressSanitizer|terminate called|Segmentation fault|std::\w+|_GLIBCXX|a broken (?:invariant|precondition)|\bassert", re.I)
REASONS = ("did not converge", "is too long", "has no data")


def failures(ended):
    if ended.timed_out:
        return [f"endless: no end after {ended.seconds:.0f} s"]
    if ended.code < 0:
        return [f"crash: signal {-ended.code}"]
    noise = NOISE.search(ended.stderr)
    if noise:
        return [f"crash: says '{noise.group(0)}'"]
    if ended.code not in (0, 1, 2):
        return [f"crash: exit code {ended.code}"]
    if ended.code == 2 and not ended.stderr.strip():
        return ["refusal: exit code 2 without a reason"]
    if ended.code == 1 and not (ended.folder / "run.json").exists():
        return [f"crash: exit code 1 and no results: {' '.join(ended.stderr.split())[:200]}"]
    if ended.code == 1:
        reason = written.exit_record(ended.folder)["exit"]["reason"]
        if not any(text in reason for text in REASONS):
            return [f"refusal: exit code 1 with the reason '{reason}'"]
    return []


def is_refused(ended):
    """The scene makes no sense, and the program said so before it began."""
    return ended.code == 2


def gave_up(ended):
    """No step was small enough."""
    return ended.code == 1
