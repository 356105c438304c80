"""Figures that follow from the parameters of a scene, by closed forms and without the program."""

import math


def shear_modulus(p):
    return p["young"] / (2 * (1 + p["poisson"]))


def bulk_modulus(p):
    return p["young"] / (3 * (1 - 2 * p["poisson"]))


def in_plane_modulus(p):
    """lambda + G: the mean stress in the plane that a unit change of area makes in plane strain."""
    return bulk_modulus(p) + shear_modulus(p) / 3


def plane_strain_modulus(p):
    return p["young"] / (1 - p["poisson"] ** 2)


def diffusion_time(p):
    """Of the box: width^2 over the diffusivity of uniaxial strain, or that of heat. Without any storage there is none; then an hour."""
    if p.get("clock") == "heat":
        return p["width"] ** 2 * p["heat_capacity"] / p["conductivity"]
    modulus = bulk_modulus(p) + 4 / 3 * shear_modulus(p)
    storage = p["storage"] + p["alpha"] ** 2 / modulus
    if storage == 0:
        return 3600.0
    return p["width"] ** 2 * storage * p["viscosity"] / p["permeability"]


def layer(p):
    """sqrt(D dt): as far as a pressure diffuses in a step (m); without any storage there is no end to it."""
    storage = p["storage"] + p["alpha"] ** 2 / (bulk_modulus(p) + 4 / 3 * shear_modulus(p))
    return math.sqrt(p["permeability"] / p["viscosity"] * time_step(p) / storage) if storage else math.inf


def time_step(p):
    return p["relative_step"] * diffusion_time(p)


def end(p):
    return p["steps"] * time_step(p)


def length(p):
    return p["length"] * min(p["width"], p["height"])


def rate(p):
    """m^2/s: in half of the run as much as the given part of the fracture's volume."""
    if p["well"] == "none":
        return 0.0
    sign = -1 if p["well"] == "extract" else 1
    return sign * p["volume"] * length(p) * p["aperture"] / (0.5 * end(p))


def load_factor(p, t):
    """By which the horizontal load is multiplied at time t."""
    part = t / end(p)
    if p["history"] == "constant":
        return 1.0
    if p["history"] == "ramp":
        return part
    if p["history"] == "reversal":
        return 1 - 2 * part
    return math.cos(4 * math.pi * part)


def load_expression(p):
    """The same as text for a scene."""
    part = f"(t/{end(p)!r})"
    return {"constant": "1", "ramp": part, "reversal": f"(1-2*{part})", "cycle": f"cos(4*{math.pi!r}*{part})"}[p["history"]]


def stresses(p, t):
    """Total normal stress on the right and on the top side at time t (Pa), where stresses are given."""
    return -p["stress"] * p["ratio"] * load_factor(p, t), -p["stress"]


def family_option(p):
    """Of tools/stress."""
    family = "" if p["family"] == "separate" else f" --family {p['family']}"
    update = "" if p.get("update", "after_step") == "after_step" else f" --update {p['update']}"
    buoyant = " --buoyant" if p.get("buoyant") or "buoyancy" in p else ""
    scheme = p.get("solved", p.get("scheme", "monolithic"))
    swapped = " --swapped" if p.get("swapped") else ""
    return family + swapped + buoyant + update + ("" if scheme == "monolithic" or p["family"] == "growing" else f" --scheme {scheme}")
