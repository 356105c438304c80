"""When a tip that grows has a length: by increments after steps, or continuously within them."""

import numpy as np


def time_to(wanted, time, length):
    """The time at which the tip is critical with the wanted length, or NaN. `time`, `length`: rows of history.csv.

    Where the length jumps, from L to L + increment, the tip had the toughness at L: the states (time of the jump, length
    before it) are those of a tip that grows continuously, and the time is linear between them. The length after a jump
    is ahead by up to an increment, until the tip is critical again. The last jump is continued with the speed before."""
    grows = np.flatnonzero(np.diff(length) > 1e-9) + 1
    times, before = time[grows], length[grows - 1]
    if not len(grows) or length[grows[-1]] < wanted:
        return np.nan
    after = int(np.argmax(before >= wanted)) if before[-1] >= wanted else len(grows) - 1
    if after == 0:
        return times[0] if before[0] >= wanted else np.nan
    speed = (times[after] - times[after - 1]) / (before[after] - before[after - 1])
    return times[after - 1] + (wanted - before[after - 1]) * speed


def time_within_steps(wanted, time, length):
    """The same for growth within steps: the length is continuous, and the tip has the toughness at the end of each step."""
    after = int(np.argmax(length >= wanted))
    if length[after] < wanted:
        return np.nan
    return float(np.interp(wanted, length[after - 1:after + 1], time[after - 1:after + 1]))
