"""Scenes of the family space: what flows, from the written fields and the values of the scene; bounds of pressures; twins.

- What all wells and injections bring, what leaves through sides and prescribed pressures (history.csv) and what rock and fractures store
  (S dp and a c dp of the written pressures) add up to nothing in each step, and so does what fractures alone receive, store and pass on.
- A side with a flux lets through this flux times its area.
- Means, integrals and largest values that probes write are those of the written cells.
- Pressures (less the weight of fluid) lie between those given, but for MISSED of the differences around as in a plane; above where fluid is
  brought and below where it is drawn there is no bound. Strong anisotropy on any mesh has no maximum principle: it is counted only, and so
  are weights with two-point fluxes.
- A scene whose viscosity is another by 1e-9, one on two processes, or one that goes on from its middle has the figures of the first one.
"""

import re

import numpy as np

from . import check_pressure, space, twins, written

PRECISION = 1e-8
LAST_DIGITS = 1e-13
TOLERANCE = 1e-6     # of twins, as compare.py
ISOTROPIC = 10       # up to here a scene counts as one that has a maximum principle
LEFT_OUT = ("iterations[1]", "fluid_balance_error[m^3]", "step[s]")
PLACE = re.compile(r":\d+:\d+:|'\w+|\(-?[\d.e-]+, -?[\d.e-]+, ")  # in the file, of an object, or in space


def potential(p, centres, pressure):
    return pressure + (space.WEIGHT * centres[:, 2] if p["gravity"] else 0.0)


class Places:
    """Centres and sizes of cells, once for all instants."""

    def __init__(self, instant):
        self.rock, self.volume = instant.matrix.centres_and_sizes()
        self.fractures, self.area = instant.fractures.centres_and_sizes()


def column(history, name):
    return history[name] if name in history else 0.0


def rates(p):
    """m^3/s of all injections, of those into fractures, and without regard to their signs."""
    into_fractures = [rate for _, _, rate in p["injection"]]
    into_rock = [rate for _, rate in p["wells"]]
    return sum(into_fractures) + sum(into_rock), sum(into_fractures), sum(map(abs, into_fractures + into_rock))


def outflows(history, component):
    return {name.split(".")[1]: values for name, values in history.items() if name.startswith(component + ".") and name.endswith(".outflow[m^3/s]")}


def side_areas(p):
    length = p["high"] - p["low"]
    areas = {side: float(np.prod(length) / length[axis]) for side, (axis, _) in space.SIDES.items()}
    if p["part"]:
        areas["part"] = float(np.prod([b - a for a, b in p["part"]["spans"].values()]))
        areas[p["part"]["side"]] -= areas["part"]
    return areas


def sides(p, history):
    found, areas = [], side_areas(p)
    for side, (kind, value) in p["given"].items():
        if kind == "flux" and areas[side] > 1e-9 * max(areas.values()):
            wanted, got = value * areas[side], history[f"pore.{side}.outflow[m^3/s]"]
            if np.abs(got - wanted).max() > PRECISION * abs(wanted):
                found.append(f"flux: {got[-1]:.9g} instead of {wanted:.9g} m^3/s through the side {side}")
    for i, (_, _, rate) in enumerate(p["injection"]):
        if np.abs(history[f"conduit.i{i}.rate[m^3/s]"] - rate).max() > PRECISION * abs(rate):
            found.append(f"rate: of the injection {i} {history[f'conduit.i{i}.rate[m^3/s]'][-1]:.9g} instead of {rate:.9g} m^3/s")
    return found


def mass(p, instants, history, places):
    """The greatest part of what moved that is missing is told."""
    found = []
    prescribed = [column(history, f"conduit.p{i}.rate[m^3/s]") for i in range(len(p["prescribed"]))]
    from_rock, from_fractures = (list(outflows(history, component).values()) for component in ("pore", "conduit"))
    brought, into_fractures, without_sign = rates(p)
    before = (potential_of_start(p, places.rock), potential_of_start(p, places.fractures))
    for instant in instants:
        row = int(np.argmin(np.abs(history["time[s]"] - instant.time)))
        rock, fluid = instant.cell("pore.pressure[Pa]"), instant.on_fractures("conduit.pressure", "Pa")
        if instant.follows:
            step = history["step[s]"][row]
            at = lambda columns, row=row, step=step: np.array([step * values[row] for values in columns] + [0.0])
            in_rock = p["storage"] * places.volume * (rock - before[0])
            in_fractures = instant.on_fractures("conduit.aperture", "m") * p["compressibility"] * places.area * (fluid - before[1])
            walls = step * places.area * np.array([instant.fractures.cell_data[f"pore.wall_flux.{side}[m/s]"] for side in ("plus", "minus")])
            digits = LAST_DIGITS * (np.abs(walls).sum() + (p["storage"] * places.volume * np.abs(rock)).sum() +
                                    (instant.on_fractures("conduit.aperture", "m") * p["compressibility"] * places.area * np.abs(fluid)).sum())
            own = np.array([at(prescribed).sum() + step * into_fractures])
            for what, terms in (("all", [in_rock, in_fractures, at(from_rock), at(from_fractures), -at(prescribed), np.array([-step * brought])]),
                                ("the fractures", [in_fractures, walls.ravel(), at(from_fractures), -own])):
                error = sum(term.sum() for term in terms)
                size = sum(np.abs(term).sum() for term in terms) + (step * without_sign if what == "all" else 0.0)
                if abs(error) > PRECISION * size + digits:
                    found.append(f"mass: of {what} {error:.3g} of {size:.3g} m^3 is missing at t = {instant.time:.6g} s")
        before = (rock, fluid)
    if not p["prescribed"]:  # which the sums of the program leave out, and its error with them
        error = np.abs(history["fluid_balance_error[m^3]"]).max()
        size = sum(np.abs(values * history["step[s]"]).sum() for values in [*from_rock, *from_fractures]) + without_sign * history["time[s]"][-1]
        size = max(size, *(np.abs(history[f"fluid_{name}[m^3]"]).max() for name in ("stored", "injected", "outflow")))
        if error > PRECISION * size + LAST_DIGITS * (p["storage"] * places.volume * np.abs(before[0])).sum():
            found.append(f"mass: the program's balance is wrong by {error:.3g} of {size:.3g} m^3")
    return found


def potential_of_start(p, centres):
    return p["initial"] - (space.WEIGHT * centres[:, 2] if p["gravity"] else 0.0)


def probes(p, instants, history, places):
    """Of the last instant."""
    last = instants[-1]
    rock, fluid = last.cell("pore.pressure[Pa]"), last.on_fractures("conduit.pressure", "Pa")
    number = last.fractures.cell_data["fracture"].astype(int)
    first, final = number == 0, number == len(p["fractures"]) - 1
    found = []
    for name, wanted, size in (("of_rock[Pa*m^3]", places.volume @ rock, places.volume @ np.abs(rock)),
                               ("mean[Pa]", places.area[first] @ fluid[first] / places.area[first].sum(), np.abs(fluid[first]).max()),
                               ("most[Pa]", fluid[final].max(), np.abs(fluid[final]).max())):
        if abs(history[name][-1] - wanted) > 1e-9 * size:
            found.append(f"probe: {name} is {history[name][-1]:.12g} instead of {wanted:.12g}")
    return found


def given_pressures(p):
    return [value for kind, value in p["given"].values() if kind == "pressure"] + [value for _, _, value in p["prescribed"]] + \
        ([] if p["steady"] else [p["initial"]])


def bounds(p):
    """Of p + rho g z."""
    incoming = [rate for _, _, rate in p["injection"]] + [rate for _, rate in p["wells"]] + [-value for kind, value in p["given"].values() if kind == "flux"]
    given = given_pressures(p)
    return (-np.inf if any(rate < 0 for rate in incoming) else min(given)), (np.inf if any(rate > 0 for rate in incoming) else max(given))


def has_maximum_principle(p):
    return p["anisotropy"] <= ISOTROPIC and not (p["gravity"] and "tpfa" in (p["flow"], p["along"]))


def overshoot(p, instants, places):
    """(failures, the largest part of the range of what is given that a pressure is beyond it by)."""
    found, largest = [], 0.0
    low, high = bounds(p)
    given = given_pressures(p)
    if not np.isfinite([low, high]).any():
        return found, None
    for instant in instants:
        rock = potential(p, places.rock, instant.cell("pore.pressure[Pa]"))
        fluid = potential(p, places.fractures, instant.on_fractures("conduit.pressure", "Pa"))
        size = max(np.abs(rock).max(), np.abs(fluid).max(), max(map(abs, given)))
        size += space.WEIGHT * np.abs(places.rock[:, 2]).max() if p["gravity"] else 0.0
        spread = max(max(given), rock.max(), fluid.max()) - min(min(given), rock.min(), fluid.min())
        if spread < 1e-7 * size:
            continue  # at rest, but for round-off
        for values, around in zip((rock, fluid), check_pressure.differences_around(instant, rock, fluid)):
            slack = 1e-8 * size + check_pressure.MISSED * np.maximum(around, rock.max() - rock.min())
            for side, over in ((f"above {high:.6g}", values - high), (f"below {low:.6g}", low - values)):
                largest = max(largest, float(over.max() - 1e-8 * size) / spread)
                worst = int(np.argmax(over - slack))
                if (over - slack)[worst] > 0 and has_maximum_principle(p):
                    found.append(f"pressure: {values[worst]:.6g} Pa {side} at t = {instant.time:.6g} s")
    return found, largest


def failures(p, instants, history):
    if not instants:
        return ["end: no fields"]
    places = Places(instants[0])
    return sides(p, history) + mass(p, instants, history, places) + probes(p, instants, history, places) + overshoot(p, instants, places)[0]


def refusal(stderr):
    """What a refusal fails to say: a place, and its reason in brackets."""
    told = " ".join(stderr.split())
    if "error:" not in told:
        return ["refusal: without an error"]
    error = told[told.index("error:"):]
    return [] if PLACE.search(error) and re.search(r" \(\w", error) else [f"refusal: without a place or a reason: {error[:200]}"]


def differences(one, other, tolerance=TOLERANCE):
    """Of two tables of one scene; a column is compared with its largest value, or a millionth of those of its unit."""
    if len(one["time[s]"]) != len(other["time[s]"]):
        return [f"{len(other['time[s]'])} steps instead of {len(one['time[s]'])}"]
    tables = {name: values for name, values in one.items() if name not in LEFT_OUT and not isinstance(values, list)}
    largest = {}
    for name, values in tables.items():
        unit = name[name.rindex("["):]
        largest[unit] = max(largest.get(unit, 0.0), np.abs(values).max())
    # Sums of what enters and leaves may be round-off of the parts.
    largest["[m^3]"] = max(largest.get("[m^3]", 0.0), largest.get("[m^3/s]", 0.0) * np.max(one["step[s]"]))
    found = []
    for name, values in tables.items():
        worst, size = np.abs(values - other[name]).max(), max(np.abs(values).max(), 1e-6 * largest[name[name.rindex("["):]])
        if worst > tolerance * size or (tolerance == 0 and worst > 0):
            found.append(f"{name} differs by {worst / max(size, 1e-300):.2g}")
    return found


def twin(program, p, scene, folder, limit):
    """Runs the scene's twin, and compares it with history.csv of the run in folder/results."""
    alone = written.history(folder / "results")
    place = folder / "twin"
    disturbed = f"materials.viscosity={p['viscosity'] * (1 + space.DISTURBED)!r} Pa*s"
    bad = twins.failures(program, scene, place, limit, p["twin"], disturbed, p["step"] * (p["steps"] // 2))
    if not bad:
        bad = differences(alone, written.history(place), twins.tolerance(p["twin"], TOLERANCE))
    return [f"twin ({p['twin']}): {text}" for text in bad]
