"""Reads what runs of Sprekk have written into NumPy, and starts runs. See docs/python.md.

    import sprekk

    run = sprekk.run("scene.yaml", set={"time.step": "2 h"}, out="results/scene")
    print(run.times, run["injection_pressure"], run.fields()["pore.pressure"].max())
"""

from .files import Grid, chain, read_pvd, read_table, read_vtu
from .program import RunFailed, find_program, run
from .results import Fields, Results

__all__ = ["Fields", "Grid", "Results", "RunFailed", "chain", "find_program", "read_pvd", "read_table", "read_vtu", "run"]
