"""Runs a scene once more: with a disturbed number, on two processes, or in two parts."""

from . import check_end, run


def failures(program, scene, place, limit, kind, disturbed, end_of_part):
    """Why the twin of this kind has no results in the folder `place`. `disturbed`: KEY=VALUE; `end_of_part`: s."""
    if kind == "disturbed":
        ended = run.run(program, scene, place, limit, more=("--set", disturbed))
    elif kind == "processes":
        ended = run.run(program, scene, place, 3 * limit, processes=2)
    else:
        part = run.run(program, scene, place, limit, more=("--set", f"time.end={end_of_part!r} s"))
        if part.code != 0:
            return [f"exit code {part.code} in the first part: {' '.join(part.stderr.split())[:200]}"]
        ended = run.run(program, scene, place, limit, more=("--restart",))
    bad = check_end.failures(ended)
    if not bad and ended.code != 0:
        bad = [f"exit code {ended.code}: {' '.join(ended.stderr.split())[:200]}"]
    return bad


def tolerance(kind, otherwise):
    """0 for a run in two parts, which has the same bits."""
    return otherwise if kind in ("disturbed", "processes") else 0
