"""Scenes of the family heat with --buoyant: gravity in any direction, and a density of the fluid that follows its temperature.

What is drawn comes from random numbers of its own, so a scene of the family heat has the same values with and without it. The rock
has no weight.
"""

import math
import random

from . import draws, heat

GRAVITY = 9.81  # m/s^2


def draw(seed, number):
    rng = random.Random(f"buoyancy:{seed}:{number}")
    return {"buoyancy": {
        "law": draws.choose(rng, linear=0.5, exponential=0.5),
        "expansion": draws.log_uniform(rng, 1e-5, 1e-3),
        "compressibility": draws.sometimes(rng, 0.0, 0.5, lambda: draws.log_uniform(rng, 1e-11, 1e-9)),
        "density": draws.log_uniform(rng, 300, 3000),
        "direction": rng.uniform(0, 2 * math.pi),
    }}


def of_flow(p):
    """Lines of a component of flow."""
    if "buoyancy" not in p:
        return []
    b = p["buoyancy"]
    x, y = GRAVITY * math.cos(b["direction"]), GRAVITY * math.sin(b["direction"])
    return [f"    gravity: [{x!r} m/s^2, {y!r} m/s^2]", f"    fluid_density: {b['density']!r} kg/m^3"]


def couplers(p):
    if "buoyancy" not in p:
        return []
    b = p["buoyancy"]
    return [f"  - {{type: buoyancy, between: [pore, conduit, heat, water], law: {b['law']}, fluid_density: {b['density']!r} kg/m^3, "
            f"fluid_expansion: {b['expansion']!r} 1/K, reference_temperature: {p['temperature']!r} K, "
            f"compressibility: {b['compressibility']!r} 1/Pa, reference_pressure: {p['initial']!r} Pa}}"]


def weight(p):
    """Pa, of the heaviest fluid between two corners of the box."""
    if "buoyancy" not in p:
        return 0.0
    b = p["buoyancy"]
    warmer = b["expansion"] * (max(heat.given(p)) - min(heat.given(p)))
    return b["density"] * math.exp(warmer) * GRAVITY * math.hypot(p["width"], p["height"])


def describe(p):
    if "buoyancy" not in p:
        return ""
    b = p["buoyancy"]
    return f"{b['law']} density, beta = {b['expansion']:.0e}, gravity at {math.degrees(b['direction']):.0f} deg, "
