"""Ways to draw a value."""

import math


def log_uniform(rng, low, high):
    return 10 ** rng.uniform(math.log10(low), math.log10(high))


def sometimes(rng, special, share, usual):
    """The special value in a share of the scenes, for limits that a continuous range would never meet."""
    draw = usual()
    return special if rng.random() < share else draw


def choose(rng, **weights):
    return rng.choices(list(weights), list(weights.values()))[0]
