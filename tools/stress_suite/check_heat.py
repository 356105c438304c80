"""Heat, from the written fields: temperatures stay between those that were given, and nothing is lost.

Fluid that enters a cell brings its heat, c m T with the fluid m that has entered since the start. So what the rock and the
fractures hold more than at the start is the sum over all cells of C (T - T_0) + c m T, in J per metre of depth; m follows from
pressures and apertures where the rock does not take fluid by deformation (alpha = 0).
"""

import numpy as np

from . import check_balance, check_pressure, heat, physics, written

PRECISION = 1e-8
LAST_DIGIT = 2.2e-16  # of a number in double precision
HALF_OF_LAST = 5e-3  # of a number with three digits


def told(folder):
    """K by which the run itself says that temperatures of the rock are beyond all around them; a note has three digits."""
    return (1 + HALF_OF_LAST) * written.told(folder, "heat.temperature beyond its surroundings", r"by up to (\S+) K")


def bounds(p, instants, told_in_rock=0.0):
    """Temperatures between those given. Conduction by MPFA may miss them by a part of the differences around, or in all of the
    rock, whose sides have the given temperatures: in the first short steps cells differ by much less than from their side, and a
    flux from there with the wrong sign is a part of the flux that the side makes. By what the run's note tells,
    `told_in_rock`, they may be beyond."""
    least, most = min(heat.given(p)), max(heat.given(p))
    on_sides = list(heat.sides(p).values())
    found = []
    for instant in instants:
        rock, fracture = instant.cell("heat.temperature[K]"), instant.on_fractures("water.temperature", "K")
        around = check_pressure.differences_around(instant, rock, fracture)
        in_rock = max(rock.max(), *on_sides) - min(rock.min(), *on_sides) if on_sides else rock.max() - rock.min()
        for name, values, near in (("rock", rock, around[0]), ("fractures", fracture, around[1])):
            slack = PRECISION * most + (check_pressure.MISSED * np.maximum(near, in_rock) if p["conduction"] == "mpfa" else 0)
            if name == "rock":
                slack = np.maximum(slack, told_in_rock)
            over = np.maximum(values - most, least - values) - slack
            worst = int(np.argmax(over))
            if over[worst] > 0:
                found.append(f"temperature: {values[worst]:.9g} K in the {name}, beyond {least:.6g} to {most:.6g} K at t = {instant.time:.6g} s")
    return found


def held(p, instants):
    """J/m that are held more than at the start, and the size of what was added up, at each instant; only for alpha = 0, and
    as long as all steps are written."""
    found = []
    fluid, apart = p["fluid_heat_capacity"], None
    for instant in instants:
        if not instant.follows:
            break
        ends = instant.fractures.points[instant.fractures.cells]
        length = np.linalg.norm(ends[:, 1] - ends[:, 0], axis=1)
        aperture, pressure = instant.on_fractures("conduit.aperture", "m"), instant.on_fractures("conduit.pressure", "Pa")
        if apart is None:
            apart = {"aperture": np.full(len(length), p["aperture"]), "pressure": np.full(len(length), p["initial"]), "fluid": 0.0}
        stored = aperture - apart["aperture"] + check_balance.compressed(p, apart["aperture"], aperture, pressure - apart["pressure"])
        apart["fluid"] = apart["fluid"] + length * stored
        apart.update(aperture=aperture, pressure=pressure)
        area = check_balance.cell_areas(instant.matrix)
        rock, water = instant.cell("heat.temperature[K]"), instant.on_fractures("water.temperature", "K")
        parts = [p["heat_capacity"] * area * (rock - p["temperature"]),
                 fluid * p["storage"] * area * (instant.cell("pore.pressure[Pa]") - p["initial"]) * rock,
                 fluid * p["aperture"] * length * (water - heat.of_fractures(p)), fluid * apart["fluid"] * water]
        found.append((instant.time, sum(part.sum() for part in parts), max(np.abs(part).sum() for part in parts)))
    return found


def row(history, time):
    return int(np.argmin(abs(np.asarray(history["time[s]"]) - time)))


def allowed_exchange(p, instants):
    """J/m that all cells together may be wrong by, in all steps: a residual of the largest heat that conduction and fluid
    exchange between two cells, round-off of the temperatures from which heat that flows is computed, and the last digit of those
    from which the heat of cells is: in a short step it may hold more than all that moves."""
    allowed = 0.0
    for instant in instants:
        rock, water = instant.cell("heat.temperature[K]"), instant.on_fractures("water.temperature", "K")
        conductance = p["conductivity"] * check_balance.conductances(instant).max()
        difference, level = rock.max() - rock.min() + abs(rock.max() - water).max(), max(heat.given(p))
        flow, flow_level = check_balance.flows(p, instant)
        residual = conductance * difference + p["fluid_heat_capacity"] * level * flow
        digits = conductance * level + p["fluid_heat_capacity"] * (level * flow + difference * flow_level)
        allowed += LAST_DIGIT * level * p["heat_capacity"] * check_balance.cell_areas(instant.matrix).sum()
        allowed += (check_balance.RESIDUAL * residual + check_balance.ROUND_OFF * digits) * physics.time_step(p) * len(rock)
    return allowed


def balances(p, instants, history):
    stored, injected, outflow, error = (np.asarray(history[f"heat_{name}[J/m]"]) for name in ("stored", "injected", "outflow", "balance_error"))
    size = max(np.abs(stored).max(), np.abs(injected).max(), np.abs(outflow).max())
    allowed = PRECISION * size + allowed_exchange(p, instants)
    found = []
    if np.abs(error).max() > allowed:
        found.append(f"heat: the balance is wrong by {np.abs(error).max():.3g} of {size:.3g} J/m (allowed {allowed:.2g})")
    if p["alpha"] == 0 and p["order"] != "heat first":
        for time, amount, parts in held(p, instants):
            wrong = abs(stored[row(history, time)] - amount)
            if wrong > allowed + PRECISION * parts:
                found.append(f"heat: {stored[row(history, time)]:.9g} J/m are said to be stored, and {amount:.9g} are there at t = {time:.6g} s")
    if p["well"] == "inject" and p["boundary"] == "none":  # what enters through sides is injected, too
        half = 0.5 * physics.end(p)
        for time, amount in zip(history["time[s]"], injected):
            wanted = physics.rate(p) * min(time, half) * p["fluid_heat_capacity"] * p["injected_temperature"]
            if p["order"] != "heat first" and abs(amount - wanted) > PRECISION * max(abs(wanted), size * 1e-4):
                found.append(f"heat: {amount:.9g} J/m instead of {wanted:.9g} were injected at t = {time:.6g} s")
    return found


def failures(p, instants, history, told_in_rock=0.0):
    return bounds(p, instants, told_in_rock) + balances(p, instants, history)
