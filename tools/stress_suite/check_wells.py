"""Wells with limits, from history.csv and the written fields: what binds first, and the pressure at their points.

A well that is to bring the rate Q > 0 and keep below the pressure P has q = Q and p <= P, or 0 <= q <= Q and p = P, or q = 0 and
p >= P; for Q < 0 it is the mirror image. At its place the rate is index times the difference from the pressure of the cells that
share it (well_shares); in a fracture without an index the fracture itself resists between the place and their centres.
"""

import numpy as np

from . import limited_wells, physics, well_shares

PRECISION = 1e-8


def column(history, name, what, unit):
    return np.asarray(history[f"wells.{name}.{what}[{unit}]"])


def largest(p, instants, history):
    """(rate, pressure) that errors are small against."""
    rates = [abs(limited_wells.rate(p, well, 0)) for well in p["wells"].values() if well["kind"] != "pressure"]
    rates += [np.abs(column(history, name, "rate", "m^2/s")).max() for name in p["wells"]]
    pressures = [np.abs(column(history, name, "pressure", "Pa")).max() for name in p["wells"]]
    pressures += [max(np.abs(i.cell("pore.pressure[Pa]")).max(), np.abs(i.on_fractures("conduit.pressure", "Pa")).max(),
                      np.abs(i.on_fractures("rock.wall_traction", "Pa")).max()) for i in instants]
    return max(rates), max(pressures)


def conditions(p, instants, history):
    found = []
    some_rate, some_pressure = (PRECISION * size for size in largest(p, instants, history))
    for name, well in p["wells"].items():
        given = limited_wells.given_pressure(p, well)
        for t, q, pressure in zip(history["time[s]"], column(history, name, "rate", "m^2/s"), column(history, name, "pressure", "Pa")):
            def wrong(text):
                found.append(f"well: {name} ({well['kind']}) {text}, with {q:.9g} m^2/s and {pressure:.9g} Pa at t = {t:.6g} s")
            if given is not None:
                if abs(pressure - given) > some_pressure:
                    wrong(f"has not its pressure of {given:.9g} Pa")
                continue
            wanted = limited_wells.rate(p, well, t)
            sign = 1 if wanted >= 0 else -1
            limit = limited_wells.limits(p, well)[sign > 0]
            beyond = -np.inf if limit is None else sign * (pressure - limit)
            if limit is None and abs(q - wanted) > some_rate:
                wrong(f"does not bring {wanted:.9g} m^2/s")
            elif sign * q < -some_rate or sign * (q - wanted) > some_rate:
                wrong(f"brings more than 0 to {wanted:.9g} m^2/s")
            elif sign * (wanted - q) > some_rate and beyond < -some_pressure:
                wrong(f"brings less than {wanted:.9g} m^2/s within its limit of {limit:.9g} Pa")
            elif sign * q > some_rate and beyond > some_pressure:
                wrong(f"flows beyond its limit of {limit:.9g} Pa")
    return found


def cell_around(p, well, instant):
    """(its number, whether it is one of a fracture)."""
    place = np.array(limited_wells.place(p, well))
    if not well["in_fracture"]:
        corners = instant.matrix.points[instant.matrix.cells][:, :, :2]
        turns = [np.cross(corners[:, (i + 1) % 3] - corners[:, i], place - corners[:, i]) for i in range(3)]
        turn = np.sign(np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]))
        return int(np.argmax(np.min(np.array(turns) * turn, axis=0))), False
    ends = instant.fractures.points[instant.fractures.cells][:, :, :2]
    own = instant.fractures.cell_data["fracture"] == 0  # `main`
    distances = np.array([limited_wells.distance(place, a, b) if mine else np.inf for (a, b), mine in zip(ends, own)])
    return int(np.argmin(distances)), True


def at_places(p, instant):
    """Pressures in rock as wells see them: cells that share one have their mean at its place. A well has no pressure of single cells
    there, which may lie beyond its own by what they differ."""
    pressures = instant.cell("pore.pressure[Pa]").copy()
    for well in p.get("wells", {}).values():
        if not well["in_fracture"]:
            shares = well_shares.Rock(instant.matrix).shares(cell_around(p, well, instant)[0], np.array(limited_wells.place(p, well)))
            cells = list(shares)
            pressures[cells] = pressures[cells] @ np.array(list(shares.values()))
    return pressures


def aperture_before(p, instants, at):
    """Of fracture cells at the start of the step that ends at an instant, or None where this is not written."""
    if at == 0:
        return np.full(len(instants[0].fractures.cells), p["aperture"]) if instants[0].follows else None
    return instants[at - 1].on_fractures("conduit.aperture", "m") if instants[at].follows else None


def around(p, well, instants, at):
    """(pressures of the cells that share the rate of a well and their shares, Pa s/m^2 between them and the well), or None where
    shares have not been written."""
    instant, place, index = instants[at], np.array(limited_wells.place(p, well)), limited_wells.index(p, well)
    cell, in_fracture = cell_around(p, well, instant)
    if not in_fracture:
        pressures, shares = instant.cell("pore.pressure[Pa]"), well_shares.Rock(instant.matrix).shares(cell, place)
        return pressures[list(shares)], np.array(list(shares.values())), 1 / index
    before = aperture_before(p, instants, at)
    if before is None:
        return None
    fracture = well_shares.Fracture(instant.fractures, cell, place, p["viscosity"])
    pressures, shares = instant.on_fractures("conduit.pressure", "Pa"), fracture.shares(before)
    resistance = 1 / index if index is not None else fracture.rise(instant.on_fractures("conduit.aperture", "m"))
    return pressures[list(shares)], np.array(list(shares.values())), resistance


def exchange(p, instants, history):
    """Rates are those of the index, or of the fracture up to the centres of cells, and of the pressures of the cells that share them."""
    found = []
    some_rate, some_pressure = (PRECISION * size for size in largest(p, instants, history))
    times = np.asarray(history["time[s]"])
    for name, well in p["wells"].items():
        if limited_wells.index(p, well) is None and not well["in_fracture"]:
            continue  # it follows from the mesh
        for at, instant in enumerate(instants):
            row = int(np.argmin(abs(times - instant.time)))
            pressure, q = column(history, name, "pressure", "Pa")[row], column(history, name, "rate", "m^2/s")[row]
            is_known = around(p, well, instants, at)
            if is_known is None:
                continue
            pressures, shares, resistance = is_known
            there, drop = pressures @ shares, resistance * q
            if abs(pressure - drop - there) > some_pressure + PRECISION * abs(drop) + resistance * some_rate:
                found.append(f"well: {name} has {pressure:.9g} Pa beside {there:.9g} Pa at its point, with a drop of {drop:.3g} Pa at its rate, at t = {instant.time:.6g} s")
    return found


def injected(p, instants, history):
    """m^2 out of the wells at the end of each row of the history."""
    return np.cumsum(np.asarray(history["step[s]"]) * sum(column(history, name, "rate", "m^2/s") for name in p["wells"]))


def amount(p, instants, history):
    wanted, said = injected(p, instants, history), np.asarray(history["fluid_injected[m^2]"])
    size = np.cumsum(np.asarray(history["step[s]"]) * sum(np.abs(column(history, name, "rate", "m^2/s")) for name in p["wells"]))
    worst = int(np.argmax(abs(wanted - said) - PRECISION * size))
    if abs(wanted - said)[worst] > PRECISION * size[worst]:
        return [f"well: {said[worst]:.9g} m^2 are said to be injected, and rates bring {wanted[worst]:.9g} m^2"]
    return []


def sources(p, history, instant):
    """A function (start, stop, cells of fractures) -> m^2 that wells bring into these, into the rock for None, or into both for "all"; and
    the same without regard to signs."""
    ends, steps = np.asarray(history["time[s]"]), np.asarray(history["step[s]"])
    cells = {name: cell_around(p, well, instant)[0] for name, well in p["wells"].items() if well["in_fracture"]}

    def is_counted(name, own):
        if isinstance(own, str):
            return True
        return name not in cells if own is None else name in cells and own[cells[name]]

    def brought(start, stop, own):
        rows = (ends > start + 1e-9 * ends[-1]) & (ends <= stop + 1e-9 * ends[-1])
        amounts = [(steps * column(history, name, "rate", "m^2/s"))[rows] for name in p["wells"] if is_counted(name, own)]
        return sum(amount.sum() for amount in amounts), sum(np.abs(amount).sum() for amount in amounts)
    return brought


def failures(p, instants, history):
    return conditions(p, instants, history) + exchange(p, instants, history) + amount(p, instants, history)
