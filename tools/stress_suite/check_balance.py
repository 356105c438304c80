"""Mass and momentum from the written fields.

Momentum: for a body at rest the integral of a stress component over its volume follows from the forces on its sides
(the mean stress theorem). Rollers at x = 0 and y = 0 drop out, forces on the two walls of a fracture cancel.
Mass: what a fracture stores in a step is what was injected less what left through its walls. The same for the matrix
where it does not depend on the rock and its sides are closed. The program's own balance must close, too.
"""

import numpy as np

from . import check_pressure, heat, physics, pressed, schemes

PRECISION = 1e-8
# Newton's method ends when the residual of each cell is below this part of the largest flow between two cells, or below
# the round-off of the pressures from which flows are computed.
RESIDUAL = 1e-10
ROUND_OFF = 64 * 2.2e-16
LAST_DIGIT = 2.2e-16  # of a number in double precision


def cell_areas(grid):
    corners = grid.points[grid.cells]
    a, b = corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]
    return 0.5 * np.abs(a[:, 0] * b[:, 1] - a[:, 1] * b[:, 0])


def momentum(p, instants):
    if p["sides"] != "stress":
        return []
    if heat.is_in(p) and p["order"] == "flow first" and p["expansion"] > 0:
        return []  # the rock was in equilibrium with the temperatures of the step before, which are not written
    found = []
    for instant in instants:
        area = cell_areas(instant.matrix)
        stress = instant.cell("rock.stress[Pa]")
        mean = area @ stress[:, :2] / (p["width"] * p["height"])
        wanted = physics.stresses(p, instant.time)
        pressure = instant.cell("pore.pressure[Pa]")
        size = max(np.abs(wanted).max(), np.abs(stress).max(), p["alpha"] * np.abs(pressure - p["initial"]).max(),
                   np.abs(instant.on_fractures("rock.wall_traction", "Pa")).max())
        for axis in (0, 1):
            error = abs(mean[axis] - wanted[axis])
            if error > PRECISION * size:
                found.append(f"momentum: the mean stress along {'xy'[axis]} is {mean[axis]:.9g} instead of "
                             f"{wanted[axis]:.9g} Pa at t = {instant.time:.6g} s")
    return found


def warmed(p, instant, before):
    """K, by which rock and fractures have been warmed since the instant before (None: the start)."""
    rock, fractures = instant.cell("heat.temperature[K]"), instant.on_fractures("water.temperature", "K")
    if before is None:
        return rock - p["temperature"], fractures - heat.of_fractures(p)
    return rock - before.cell("heat.temperature[K]"), fractures - before.on_fractures("water.temperature", "K")


def expanded(p, instant, before):
    """m^2 of fluid in each cell of the rock, and m in fractures, that warming has made of the fluid that was there."""
    if not pressed.is_in(p):
        return 0.0, 0.0
    in_rock, in_fractures = warmed(p, instant, before)
    return cell_areas(instant.matrix) * pressed.of_rock(p) * in_rock, instant.on_fractures("conduit.aperture", "m") * pressed.of_fractures(p) * in_fractures


def injected(p, start, stop):
    """m^2 in all fractures named main between two times, by the closed form of the scene's two wells."""
    half, rate = 0.5 * physics.end(p), physics.rate(p)
    def until(t):
        first = rate * min(t, half)
        return first - (rate * max(0.0, t - half) if p["well"] == "inject_extract" else 0.0)
    return until(stop) - until(start)


def networks(instant):
    """For every fracture cell the number of the first fracture of those that it is joined with."""
    grid, fracture = instant.fractures, instant.fractures.cell_data["fracture"].astype(int)
    joined = fracture.copy()
    at = {}
    for cell, corners in enumerate(grid.cells):
        for corner in corners:
            at.setdefault(tuple(np.round(grid.points[corner], 12)), set()).add(fracture[cell])
    for _ in np.unique(fracture):
        for numbers in at.values():
            those = np.isin(fracture, list(numbers))
            joined[np.isin(joined, joined[those])] = joined[those].min()
    return joined


def compressed(p, before, aperture, change):
    """m, for each metre of a fracture: what it stores beside its opening, from the apertures and the change of pressure in a step.
    Fluid of the density exp(c p): int a c dp where aperture and pressure rise or fall together, else what leaves rho a as it is
    where nothing enters."""
    rise = p["compressibility"] * change
    with np.errstate(invalid="ignore", divide="ignore"):
        mean_of_density = np.where(rise == 0, 1.0, np.expm1(rise) / rise)
    held = (np.exp(rise) * aperture - before) / mean_of_density - (aperture - before)
    return np.where((aperture - before) * rise > 0, rise * (aperture + before) / 2, held)


def fracture_mass(p, instants, main, brought=None):
    """`main`: the number of the fracture that has the wells; or `brought`, a function (start, stop, cells) -> m^2 that wells
    bring into these cells, and without regard to their sign: two may exchange any multiple of what a fracture stores, and a rate has its
    last digit."""
    found = []
    before = earlier = None
    for instant in instants:
        ends = instant.fractures.points[instant.fractures.cells]
        length = np.linalg.norm(ends[:, 1] - ends[:, 0], axis=1)
        aperture, pressure = instant.on_fractures("conduit.aperture", "m"), instant.on_fractures("conduit.pressure", "Pa")
        if before is None:
            before = (0.0, np.full(len(length), p["aperture"]), np.full(len(length), p["initial"]))
        if instant.follows:
            step = instant.time - before[0]
            walls = instant.fractures.cell_data
            plus, minus = (step * length * walls[f"pore.wall_flux.{side}[m/s]"] for side in ("plus", "minus"))
            out = plus + minus
            opened = length * (aperture - before[1])
            compression = length * (compressed(p, before[1], aperture, pressure - before[2]) - expanded(p, instant, earlier)[1])
            fracture = networks(instant)
            for number in np.unique(fracture):
                own = fracture == number
                if brought:
                    source, through = brought(before[0], instant.time, own)
                else:
                    source, through = injected(p, before[0], instant.time) if number == main else 0.0, 0.0
                error = opened[own].sum() + compression[own].sum() + out[own].sum() - source
                # Much may enter through one wall and leave through the other. A row of the program's balances holds where its residual is
                # the round-off of the fluid in the fullest cell: at rest, fluxes stay that are less than that.
                volume = length * np.abs(aperture) * (1 + p["compressibility"] * np.abs(pressure))
                digits = 100e-15 * (volume + np.abs(plus) + np.abs(minus))[own].sum() + ROUND_OFF * volume.max() * own.sum() + LAST_DIGIT * through
                size = max(np.abs(opened).max(), np.abs(compression).max(), np.abs(out).max(), abs(source))
                if abs(error) > PRECISION * size + digits:
                    found.append(f"mass: fracture {number} is wrong by {error:.3g} of {size:.3g} m^2 "
                                 f"at t = {instant.time:.6g} s")
        before, earlier = (instant.time, aperture, pressure), instant
    return found


def viscosity(p):
    return heat.least_viscosity(p) if heat.is_in(p) else p["viscosity"]


def conductances(instant):
    """A cell of area A with edges e lets sum e^2/(2 A) times the mobility through: 3.5 for an equilateral triangle, and more
    the flatter it is."""
    corners = instant.matrix.points[instant.matrix.cells]
    return sum(((corners[:, i] - corners[:, i - 1]) ** 2).sum(1) for i in range(3)) / (2 * cell_areas(instant.matrix))


def flows(p, instant):
    """(the largest flow between two cells, the one of the whole pressure into nothing), in m^2/s."""
    conductance, pressure = conductances(instant), instant.cell("pore.pressure[Pa]")
    pairs = check_pressure.neighbours(instant)
    drop = np.abs(pressure[pairs[:, 0]] - pressure[pairs[:, 1]])
    flow = (conductance[pairs].max(1) * drop).max()
    level = (conductance * np.abs(pressure)).max()
    mobility = p["permeability"] / viscosity(p)
    return flow * mobility, level * mobility


def allowed_flow(p, instant):
    """m^2 that all cells together may be wrong by in a step."""
    flow, level = flows(p, instant)
    return (RESIDUAL * flow + ROUND_OFF * level) * physics.time_step(p) * len(instant.matrix.cells)


def matrix_mass(p, instants, brought=None):
    """`brought`: a function (start, stop, None) -> m^2 that wells bring into the rock, and without regard to their sign."""
    if p["alpha"] > 0 or p["boundary"] != "none":
        return []
    found = []
    before, earlier = (0.0, p["initial"]), None
    for instant in instants:
        area, pressure = cell_areas(instant.matrix), instant.cell("pore.pressure[Pa]")
        if instant.follows:
            ends = instant.fractures.points[instant.fractures.cells]
            length = np.linalg.norm(ends[:, 1] - ends[:, 0], axis=1)
            walls = instant.fractures.cell_data
            received = (instant.time - before[0]) * length * (walls["pore.wall_flux.plus[m/s]"] +
                                                              walls["pore.wall_flux.minus[m/s]"])
            stored = p["storage"] * area * (pressure - before[1]) - expanded(p, instant, earlier)[0]
            source, through = brought(before[0], instant.time, None) if brought else (0.0, 0.0)
            error = stored.sum() - received.sum() - source
            size = max(np.abs(stored).max(), np.abs(received).max(), abs(source))
            digits = 1e-13 * (p["storage"] * area * np.abs(pressure)).sum() + LAST_DIGIT * through
            if abs(error) > PRECISION * size + digits + allowed_flow(p, instant):
                found.append(f"mass: the matrix is wrong by {error:.3g} of {size:.3g} m^2 at t = {instant.time:.6g} s")
        before, earlier = (instant.time, pressure), instant
    return found


def left_by_passes(p, instants):
    """m^2 that passes may leave in fractures that are solved apart: they end when the balances of all cells together hold to 100 times
    their tolerance, against what the cells take up in the step, S |dp| + alpha |d eps_v|. What they leave in rock is counted in the next
    step."""
    if p.get("solved", schemes.MONOLITHIC) != schemes.RESPONSE:
        return 0.0
    pressure_before, mean_before, taken_up = p["initial"], 0.0, 0.0
    for instant in instants:
        area, pressure = cell_areas(instant.matrix), instant.cell("pore.pressure[Pa]")
        mean, change = instant.cell("rock.stress[Pa]")[:, :2].mean(1), pressure - pressure_before
        volume = (mean - mean_before + p["alpha"] * change) / physics.in_plane_modulus(p)
        taken_up += (area * (p["storage"] * np.abs(change) + p["alpha"] * np.abs(volume))).sum()
        pressure_before, mean_before = pressure, mean
    return 100 * schemes.UNTIL * taken_up


def cumulative_balance(p, instants, history, brought=None):
    """The error of the program's cumulative balance against what moved in one cell in the largest step, or against round-off of
    the fluid in the rock and fractures, and what the residuals of flow allow, and passes of a split."""
    error = np.abs(history["fluid_balance_error[m^2]"]).max()
    size = np.abs(history["fluid_stored[m^2]"]).max() + np.abs(history["fluid_injected[m^2]"]).max() + \
        np.abs(history["fluid_outflow[m^2]"]).max()
    before = p["initial"]
    bulk = physics.bulk_modulus(p)
    digits = left_by_passes(p, instants) + (LAST_DIGIT * brought(0.0, physics.end(p), "all")[1] if brought else 0.0)
    for instant in instants:
        aperture, in_fracture = instant.on_fractures("conduit.aperture", "m"), instant.on_fractures("conduit.pressure", "Pa")
        length = np.linalg.norm(np.diff(instant.fractures.points[instant.fractures.cells], axis=1)[:, 0], axis=1)
        area, pressure = cell_areas(instant.matrix), instant.cell("pore.pressure[Pa]")
        stress = instant.cell("rock.stress[Pa]")
        volume = (np.abs(stress[:, :2]).sum(1) + p["alpha"] * np.abs(pressure - p["initial"])) / (2 * bulk)
        size = max(size, (area * (p["storage"] * np.abs(pressure - before) + p["alpha"] * volume)).max())
        before = pressure
        digits += 1e-15 * ((length * np.abs(aperture) * (1 + p["compressibility"] * np.abs(in_fracture))).sum() +
                           (p["storage"] * area * np.abs(pressure)).sum()) + allowed_flow(p, instant)
    if error > PRECISION * size * len(history["time[s]"]) + digits:
        return [f"mass: the cumulative balance is wrong by {error:.3g} of {size:.3g} m^2 (allowed {digits:.2g})"]
    return []


def relative_error_of_balance(history):
    """Of the largest of the three sums; 0 where the run writes no error, since a pressure is prescribed in a fracture."""
    unit = "m^3" if "fluid_stored[m^3]" in history else "m^2"  # in space, and in a plane
    if f"fluid_balance_error[{unit}]" not in history:
        return 0.0
    sums = [np.abs(history[f"fluid_{name}[{unit}]"]).max() for name in ("stored", "injected", "outflow")]
    return float(np.abs(history[f"fluid_balance_error[{unit}]"]).max() / max(*sums, 1e-300))


def failures(p, instants, history, main, brought=None):
    return momentum(p, instants) + fracture_mass(p, instants, main, brought) + matrix_mass(p, instants, brought) + \
        cumulative_balance(p, instants, history, brought)
