"""Heat, or a tracer, from the written fields: temperatures (concentrations) stay between those that were given, and nothing is lost.

Fluid that enters a cell brings what it carries, c m T with the fluid m that has entered since the start. So what the rock and the
fractures hold more than at the start is the sum over all cells of C (T - T_0) + c m T, in J per metre of depth; m follows from
pressures and apertures (and from the expansion of warmed fluid) where the rock does not take fluid by deformation (alpha = 0).
"""

import re
from dataclasses import dataclass
from typing import Callable

import numpy as np

from . import check_balance, check_pressure, heat, physics, tracer, written

PRECISION = 1e-8
LAST_DIGIT = 2.2e-16  # of a number in double precision
HALF_OF_LAST = 5e-3  # of a number with three digits


@dataclass(frozen=True)
class Kind:
    """What is carried. Functions take the parameters of a scene."""
    quantity: str
    value: str
    unit: str
    rock: str       # the owners of its values
    fractures: str
    amount: str     # the unit of what is held
    words: object   # the module that draws it: given, sides, of_fractures
    initial: Callable
    conduction: Callable     # the discretization in the rock
    conductivity: Callable
    capacity: Callable       # per volume of rock
    in_fractures: Callable   # the same of fractures
    per_volume: Callable     # of fluid
    injected: Callable
    is_before_flow: Callable
    decays: Callable


HEAT = Kind("heat", "temperature", "K", "heat", "water", "J/m", heat, lambda p: p["temperature"], lambda p: p["conduction"], lambda p: p["conductivity"],
            lambda p: p["heat_capacity"], lambda p: p["fluid_heat_capacity"], lambda p: p["fluid_heat_capacity"], lambda p: p["injected_temperature"],
            lambda p: p["order"] == "heat first", lambda p: False)
TRACER = Kind("tracer", "concentration", "kg/m^3", "salt", "brine", "kg/m", tracer, lambda p: p["concentration"], lambda p: p["diffused"],
              lambda p: p["porosity"] * p["diffusion"], lambda p: p["porosity"] * p["retardation"], lambda p: p["fracture_retardation"], lambda p: 1.0,
              lambda p: p["injected_concentration"], lambda p: p["tracer_order"] == "tracer first", lambda p: p["decays"] > 0)


def told(folder, kind=HEAT):
    """K by which the run itself says that temperatures of the rock are beyond all around them; a note has three digits."""
    return (1 + HALF_OF_LAST) * written.told(folder, f"{kind.rock}.{kind.value} beyond its surroundings", rf"by up to (\S+) {re.escape(kind.unit)}")


def values_of(instant, kind):
    return instant.cell(f"{kind.rock}.{kind.value}[{kind.unit}]"), instant.on_fractures(f"{kind.fractures}.{kind.value}", kind.unit)


def bounds(p, instants, told_in_rock=0.0, kind=HEAT):
    """Temperatures between those given. Conduction by MPFA may miss them by a part of the differences around, or in all of the
    rock, whose sides have the given temperatures: in the first short steps cells differ by much less than from their side, and a
    flux from there with the wrong sign is a part of the flux that the side makes. By what the run's note tells,
    `told_in_rock`, they may be beyond."""
    least, most = min(kind.words.given(p)), max(kind.words.given(p))
    on_sides = list(kind.words.sides(p).values())
    found = []
    for instant in instants:
        rock, fracture = values_of(instant, kind)
        around = check_pressure.differences_around(instant, rock, fracture)
        in_rock = max(rock.max(), *on_sides) - min(rock.min(), *on_sides) if on_sides else rock.max() - rock.min()
        for name, values, near in (("rock", rock, around[0]), ("fractures", fracture, around[1])):
            slack = PRECISION * most + (check_pressure.MISSED * np.maximum(near, in_rock) if kind.conduction(p) == "mpfa" else 0)
            if name == "rock":
                slack = np.maximum(slack, told_in_rock)
            over = np.maximum(values - most, least - values) - slack
            worst = int(np.argmax(over))
            if over[worst] > 0:
                found.append(f"{kind.value}: {values[worst]:.9g} {kind.unit} in the {name}, beyond {least:.6g} to {most:.6g} {kind.unit} at t = {instant.time:.6g} s")
    return found


def held(p, instants, kind=HEAT):
    """J/m that are held more than at the start, and the size of what was added up, at each instant; only for alpha = 0, and
    as long as all steps are written."""
    found = []
    fluid, apart, earlier = kind.per_volume(p), None, None
    for instant in instants:
        if not instant.follows:
            break
        ends = instant.fractures.points[instant.fractures.cells]
        length = np.linalg.norm(ends[:, 1] - ends[:, 0], axis=1)
        aperture, pressure = instant.on_fractures("conduit.aperture", "m"), instant.on_fractures("conduit.pressure", "Pa")
        if apart is None:
            apart = {"aperture": np.full(len(length), p["aperture"]), "pressure": np.full(len(length), p["initial"]), "fluid": 0.0}
        stored = aperture - apart["aperture"] + check_balance.compressed(p, apart["aperture"], aperture, pressure - apart["pressure"])
        in_rock, in_fractures = check_balance.expanded(p, instant, earlier)
        apart["fluid"] = apart["fluid"] + length * (stored - in_fractures)
        apart["expanded"] = apart.get("expanded", 0.0) + in_rock
        earlier = instant
        apart.update(aperture=aperture, pressure=pressure)
        area = check_balance.cell_areas(instant.matrix)
        rock, water = values_of(instant, kind)
        parts = [kind.capacity(p) * area * (rock - kind.initial(p)),
                 fluid * (p["storage"] * area * (instant.cell("pore.pressure[Pa]") - p["initial"]) - apart["expanded"]) * rock,
                 kind.in_fractures(p) * p["aperture"] * length * (water - kind.words.of_fractures(p)), fluid * apart["fluid"] * water]
        found.append((instant.time, sum(part.sum() for part in parts), max(np.abs(part).sum() for part in parts)))
    return found


def row(history, time):
    return int(np.argmin(abs(np.asarray(history["time[s]"]) - time)))


def allowed_exchange(p, instants, kind=HEAT):
    """J/m that all cells together may be wrong by, in all steps: a residual of the largest heat that conduction and fluid
    exchange between two cells, round-off of the temperatures from which heat that flows is computed, and the last digit of those
    from which the heat of cells is: in a short step it may hold more than all that moves."""
    allowed = 0.0
    for instant in instants:
        rock, water = values_of(instant, kind)
        conductance = kind.conductivity(p) * check_balance.conductances(instant).max()
        difference, level = rock.max() - rock.min() + abs(rock.max() - water).max(), max(kind.words.given(p))
        flow, flow_level = check_balance.flows(p, instant)
        carried = kind.per_volume(p)
        residual = conductance * difference + carried * level * flow
        digits = conductance * level + carried * (level * flow + difference * flow_level)
        allowed += LAST_DIGIT * level * kind.capacity(p) * check_balance.cell_areas(instant.matrix).sum()
        allowed += (check_balance.RESIDUAL * residual + check_balance.ROUND_OFF * digits) * physics.time_step(p) * len(rock)
    return allowed


def balances(p, instants, history, kind=HEAT):
    stored, injected, outflow, error = (np.asarray(history[f"{kind.quantity}_{name}[{kind.amount}]"]) for name in ("stored", "injected", "outflow", "balance_error"))
    size = max(np.abs(stored).max(), np.abs(injected).max(), np.abs(outflow).max())
    allowed = PRECISION * size + allowed_exchange(p, instants, kind)
    found = []
    if np.abs(error).max() > allowed:
        found.append(f"{kind.quantity}: the balance is wrong by {np.abs(error).max():.3g} of {size:.3g} {kind.amount} (allowed {allowed:.2g})")
    if p["alpha"] == 0 and not kind.is_before_flow(p) and not kind.decays(p):
        for time, amount, parts in held(p, instants, kind):
            wrong = abs(stored[row(history, time)] - amount)
            if wrong > allowed + PRECISION * parts:
                found.append(f"{kind.quantity}: {stored[row(history, time)]:.9g} {kind.amount} are said to be stored, and {amount:.9g} are there at t = {time:.6g} s")
    if p["well"] == "inject" and p["boundary"] == "none":  # what enters through sides is injected, too
        half = 0.5 * physics.end(p)
        for time, amount in zip(history["time[s]"], injected):
            wanted = physics.rate(p) * min(time, half) * kind.per_volume(p) * kind.injected(p)
            if not kind.is_before_flow(p) and abs(amount - wanted) > PRECISION * max(abs(wanted), size * 1e-4):
                found.append(f"{kind.quantity}: {amount:.9g} {kind.amount} instead of {wanted:.9g} were injected at t = {time:.6g} s")
    return found


def failures(p, instants, history, told_in_rock=0.0, kind=HEAT):
    return bounds(p, instants, told_in_rock, kind) + balances(p, instants, history, kind)
