"""Fluid that expands where it is warmed, and presses: `thermal_pressurization` in scenes that have heat."""

from . import draws, physics


def draw(rng):
    return {"pressed": rng.random() < 0.5, "fluid_expansion": draws.log_uniform(rng, 1e-5, 1e-3), "porosity": draws.log_uniform(rng, 1e-2, 0.4)}


def is_in(p):
    return p.get("pressed", False)


def with_grains(p):
    """Grains expand as the rock does; porosities above Biot's coefficient are no rock then."""
    return p["expansion"] > 0 and p["alpha"] >= p["porosity"]


def of_rock(p):
    """Volume of fluid that a volume of rock presses out, 1/K."""
    if not is_in(p):
        return 0.0
    return p["porosity"] * p["fluid_expansion"] + ((p["alpha"] - p["porosity"]) * 3 * p["expansion"] if with_grains(p) else 0.0)


def of_fractures(p):
    """1/K"""
    return p["fluid_expansion"] if is_in(p) else 0.0


def can_be_stored(p):
    """The parameters with a fluid and pores that give way: otherwise no pressure is high enough where fluid is warmed in a closed place."""
    if not is_in(p):
        return p
    compressibility = p["compressibility"] or 1e-10
    return {**p, "compressibility": compressibility, "storage": max(p["storage"], p["porosity"] * compressibility)}


def pressures(p, temperatures):
    """Pa, by which pressures may differ from those of the scene without it: in closed rock, and in a closed fracture."""
    if not is_in(p):
        return 0.0
    warmed = max(temperatures) - min(temperatures)
    storage = p["storage"] + p["alpha"] ** 2 / (physics.bulk_modulus(p) + 4 / 3 * physics.shear_modulus(p))
    return warmed * max(of_rock(p) / storage, of_fractures(p) / p["compressibility"])


def couplers(p):
    if not is_in(p):
        return []
    grains = f", expansion: {p['expansion']!r} 1/K" if with_grains(p) else ""
    return [f"  - {{type: thermal_pressurization, between: [pore, conduit, heat, water], fluid_expansion: {p['fluid_expansion']!r} 1/K, "
            f"porosity: {p['porosity']!r}{grains}}}"]
