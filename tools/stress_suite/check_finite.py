"""No figure that is not a number, in fields or tables."""

import numpy as np


def failures(instants, history, left_out=()):
    """`left_out`: owners of fields that are on some of the fractures only."""
    found = []
    for name, column in history.items():
        if not isinstance(column, list) and not np.isfinite(column).all():
            found.append(f"not finite: {name} of history.csv")
    for instant in instants:
        for grid in (instant.matrix, instant.fractures):
            for name, values in grid.cell_data.items():
                if name.partition(".")[0] not in left_out and not np.isfinite(values).all():
                    found.append(f"not finite: {name} at t = {instant.time:.6g} s")
    return found
