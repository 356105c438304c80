"""What holds while fractures grow: the fluid of the whole run, contact, pressures within reach, nothing negative.

Fluid: what was injected follows from the rates of the scene; what is stored and what has left must make it up, to 1e-6 of the
largest of the three, from the first step to the last and over every growth; and to the tolerance of iterated schemes of what
loads press from the rock into its fluid, which the three do not show, since nothing leaves.
Pressures: twice what was given, the loads, the weight of the rock, what opens a fracture against its toughness, and what the
fluid injected until then makes of a fracture that it opens. Fluid that is drawn out, or that slip with dilation asks for,
may lower a pressure by as much; and from a closed fracture, whose walls do not yield, by what its fluid expands.
"""

import math
from dataclasses import replace

import numpy as np

from . import check_contact, check_finite, growing, physics

BALANCE = 1e-6
BENDS = 0.1
ROUND_OFF = 1e-12  # of the widest aperture: grown cells that touch have none of their own, and an opening of 0 to round-off


def pressed(p):
    """m^2: what loads take from the pores of the whole box, and its fluid, which cannot leave, gives back."""
    return p["alpha"] * p["stress"] * max(1, p["ratio"]) / physics.plane_strain_modulus(p) * p["width"] * p["height"]


def fluid(p, history):
    stored, injected, outflow = (history[f"fluid_{name}[m^2]"] for name in ("stored", "injected", "outflow"))
    size = max(np.abs(column).max() for column in (stored, injected, outflow))
    wanted = np.array([growing.injected(p, 0.0, t) for t in history["time[s]"]])
    iterated = growing.ITERATED * pressed(p) if p["scheme"] == "iterated" else 0.0
    found = []
    for name, error, allowed in (("what was injected", injected - wanted, BALANCE * np.abs(wanted).max()),
                                 ("the balance", stored + outflow - injected, BALANCE * size + iterated)):
        worst = int(np.argmax(np.abs(error)))
        if np.abs(error[worst]) > allowed:
            found.append(f"fluid: {name} is wrong by {error[worst]:.3g} of {size:.3g} m^2 at t = {history['time[s]'][worst]:.6g} s")
    return found


def reach(p, time):
    """Pa"""
    weight = 2500 * 9.81 * p["height"] if p["gravity"] else 0.0
    half = min(0.5 * math.dist(*line) for line in p["lines"].values())
    volume = sum(max(0.0, rate) * max(0.0, min(time, last) - first) for rate, first, last in p["source"])
    opened = 2 * physics.plane_strain_modulus(p) * volume / (math.pi * half**2) / 2
    toughness = p["toughness"] / math.sqrt(math.pi * half)
    loads = p["stress"] * max(1, p["ratio"])
    return 2 * (p["initial"] + loads + weight + toughness + opened)


def drawn(p, time):
    """Pa, by which the fluid of a closed fracture falls, whose volume is at least that at the initial aperture."""
    volume = sum(max(0.0, -rate) * max(0.0, min(time, last) - first) for rate, first, last in p["source"])
    held = p["aperture"] * min(math.dist(*line) for line in p["lines"].values()) * p["compressibility"]
    return 0.0 if volume == 0 else volume / held if held > 0 else math.inf


def pressures(p, instants):
    found = []
    for instant in instants:
        most = reach(p, instant.time)
        least = most + drawn(p, instant.time)
        for name, values in (("rock", instant.cell("pore.pressure[Pa]")),
                             ("fractures", instant.on_fractures("conduit.pressure", "Pa"))):
            for worst, limit in ((values.max(), most), (values.min(), -least)):
                if abs(worst) > abs(limit) and worst * limit > 0:
                    found.append(f"pressure: {worst:.4g} Pa in the {name}, beyond {limit:.4g} Pa, at t = {instant.time:.6g} s")
    return found


def negatives(instants, history):
    found = [f"negative: {name} of history.csv" for name, column in history.items()
             if not isinstance(column, list) and ("K_eq[" in name or "length[" in name) and (column < 0).any()]
    for instant in instants:
        aperture = instant.on_fractures("conduit.aperture", "m")
        if aperture.min() < -ROUND_OFF * aperture.max():
            found.append(f"negative: an aperture of {aperture.min():.3g} m at t = {instant.time:.6g} s")
    return found


def shrinks(p, history):
    """A fracture never heals. A path that is handed to the coarse mesh loses its small bends, and a little length."""
    return [f"negative: the growth in {name} of history.csv" for name, column in history.items()
            if not isinstance(column, list) and "length[" in name and
            (np.diff(column[np.isfinite(column)]) < -BENDS * p["fracture_size"]).any()]


def with_growth(p, instants):
    """The same, where a mesh that has changed follows none, nor what has taken several steps between two that are written: in
    the last of these a cell may stick that has slipped in the first."""
    found, before = [], None
    for instant in instants:
        lines = instant.fractures.points[instant.fractures.cells]
        same = before is None or (lines.shape == before.shape and np.array_equal(lines, before))
        found.append(replace(instant, follows=instant.follows and same and p["scheme"] != "subcycled"))
        before = lines
    return found


def failures(p, instants, history):
    known = {name: column for name, column in history.items() if not name.startswith("tips.")}  # a tip without K has an empty cell
    found = check_finite.failures(instants, known)
    if found or not instants:
        return found
    return (fluid(p, history) + check_contact.failures(p, with_growth(p, instants)) + pressures(p, instants) +
            negatives(instants, history) + shrinks(p, history))
