"""Draws the parameters of a scene. A family, a seed and a number give the same parameters on every machine."""

import random

from . import buoyancy, faults, growing, heat, limited_wells, schemes, space, swaps, tracer
from .draws import choose, log_uniform, sometimes


def material(rng):
    alpha = sometimes(rng, 0.0, 0.12, lambda: sometimes(rng, 1.0, 0.12, lambda: rng.uniform(0, 1)))
    return {
        "young": log_uniform(rng, 1e9, 1e11),
        "poisson": sometimes(rng, 0.0, 0.08, lambda: choose_poisson(rng)),
        "alpha": alpha,
        "permeability": log_uniform(rng, 1e-24, 1e-10),
        "viscosity": log_uniform(rng, 1e-4, 1e-2),
        "storage": sometimes(rng, 0.0, 0.15, lambda: log_uniform(rng, 1e-13, 1e-6)),
        "compressibility": sometimes(rng, 0.0, 0.05, lambda: log_uniform(rng, 1e-11, 3e-9)),
        "friction": sometimes(rng, 0.0, 0.08, lambda: rng.uniform(0, 2)),
        "dilation": sometimes(rng, 0.0, 0.2, lambda: rng.uniform(0, 20)),
        "aperture": log_uniform(rng, 1e-6, 1e-2),
    }


def choose_poisson(rng):
    return rng.uniform(0, 0.4) if rng.random() < 0.6 else 0.5 - log_uniform(rng, 1e-4, 1e-1)


def geometry(rng):
    width = log_uniform(rng, 0.5, 300)
    return {
        "width": width,
        "height": width * rng.uniform(0.6, 1.6),
        "mesh": choose(rng, gmsh=0.6, twisted=0.4),
        "fractures": choose(rng, one=0.6, parallel=0.2, in_line=0.2),
        "place": choose(rng, inside=0.65, near_side=0.28, on_side=0.07),
        "length": rng.uniform(0.08, 0.7),             # of the shorter side of the box
        "angle": rng.uniform(0, 180),                 # degrees
        "gap": log_uniform(rng, 3e-3, 0.2),           # between two tips or walls, or tip and side; of the length
        "cells": rng.randint(4, 20),                  # on a fracture
        "coarse": rng.uniform(4, 10),                 # cells along the box
        "growth": rng.uniform(0.2, 2.0),
        "sliver": rng.uniform(5, 40),                 # smallest angle of a twisted mesh, degrees
        "shuffle": rng.randint(0, 2**31),
    }


def loading(rng):
    load = log_uniform(rng, 1e6, 1e8)
    return {
        "sides": choose(rng, stress=0.85, shear_box=0.15),
        "stress": load,
        "ratio": log_uniform(rng, 0.1, 10),
        "history": choose(rng, constant=0.4, ramp=0.15, reversal=0.25, cycle=0.2),
        "shear": rng.uniform(-3, 3),
    }


def fluid(rng):
    return {
        "discretization": choose(rng, mpfa=0.85, tpfa=0.15),
        "initial": sometimes(rng, 0.0, 0.6, lambda: log_uniform(rng, 1e5, 3e7)),
        "boundary": choose(rng, none=0.35, right=0.3, across=0.35),
        "boundary_pressure": sometimes(rng, 0.0, 0.4, lambda: log_uniform(rng, 1e5, 3e7)),
        "well": choose(rng, none=0.25, inject=0.4, extract=0.2, inject_extract=0.15),
        "volume": log_uniform(rng, 1e-4, 1.0),        # of the volume of the fracture, in the whole run
    }


def time(rng):
    return {"relative_step": log_uniform(rng, 1e-6, 1e6), "steps": rng.randint(3, 7)}


def meeting(rng):
    """Fractures that cross, touch, begin at one point, or meet in threes."""
    return {
        "fractures": choose(rng, cross=0.4, touch=0.25, corner=0.15, star=0.2),
        "cut": rng.choice((-1, 1)) * rng.uniform(12, 90),  # degrees from the first to the second fracture
        "next_cut": rng.uniform(20, 60),                   # and on to the third one
        "at": rng.uniform(0.1, 0.9),                       # the place on the first one, of its length
        "arms": [rng.uniform(0.1, 0.5) for _ in range(3)], # of the others, of the length of the first one
    }


FAMILIES = ("separate", "meeting", "growing", "heat", "wells", "tracer", "space", "faults")
IN_SPACE = {"space": space, "faults": faults}
MORE = {"meeting": meeting, "heat": heat.draw, "wells": limited_wells.draw, "tracer": tracer.draw}  # what families draw besides


def draw(seed, number, family="separate", update=growing.UPDATES[0], scheme=schemes.MONOLITHIC, swapped=False, buoyant=False):
    rng = random.Random(f"{seed}:{number}" if family == "separate" else f"{family}:{seed}:{number}")
    if family == "growing":
        return {"seed": seed, "number": number, "family": family, "update": update, **growing.draw(rng)}
    if family in IN_SPACE:
        return {"seed": seed, "number": number, "family": family, **IN_SPACE[family].draw(rng)}
    p = {"seed": seed, "number": number, "family": family, "solved": scheme, **material(rng), **geometry(rng), **loading(rng), **fluid(rng),
         **time(rng)}
    if swapped:
        p.update(swaps.draw(seed, number, family), swapped=True)
    if family in MORE:
        p.update(MORE[family](rng))
    if buoyant:
        p.update(buoyancy.draw(seed, number))
    return heat.with_fluid(p) if family == "heat" else tracer.with_pores(p) if family == "tracer" else p
