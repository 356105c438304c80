"""The family `growing`: 2 to 6 fractures whose tips grow, and may join, in layered rock under its weight."""

import math

from . import physics

HOUR = 3600.0
SIDE = 2.0
UPDATES = ("after_step", "within_step", "repeat_step")  # of `grow`
ITERATED = 1e-8  # of iterated schemes: what residuals may be of their terms


def uniform_angle(rng):
    return rng.uniform(0, math.pi)


def distance_to_line(point, line):
    (x0, y0), (x1, y1) = line
    along = ((point[0] - x0) * (x1 - x0) + (point[1] - y0) * (y1 - y0)) / ((x1 - x0) ** 2 + (y1 - y0) ** 2)
    along = min(1.0, max(0.0, along))
    return math.hypot(point[0] - x0 - along * (x1 - x0), point[1] - y0 - along * (y1 - y0))


def are_apart(line, others, gap):
    """No end is closer to another fracture than the gap; fractures may cross."""
    return all(min([distance_to_line(end, other) for end in line] + [distance_to_line(end, line) for end in other]) > gap
               for other in others)


def lines(rng, size):
    found = []
    wanted = rng.randint(2, 6)
    for _ in range(400):
        x, y, half, angle = rng.uniform(0.6, 1.4), rng.uniform(0.6, 1.4), rng.uniform(0.08, 0.25), uniform_angle(rng)
        dx, dy = half * math.cos(angle), half * math.sin(angle)
        line = ((x - dx, y - dy), (x + dx, y + dy))
        if are_apart(line, found, 0.8 * size):
            found.append(line)
        if len(found) == wanted:
            break
    return {f"f{i}": line for i, line in enumerate(found)}


def layer(rng):
    """Across the box, at any height and inclination."""
    below, slope, thickness = rng.uniform(0.2, 1.4), rng.uniform(-0.25, 0.25), rng.uniform(0.15, 0.5)
    low = [below + 0.25, below + 0.25 + slope]
    thickness = min(thickness, SIDE - 0.02 - max(low))
    return [(0.0, low[0]), (SIDE, low[1]), (SIDE, low[1] + thickness), (0.0, low[0] + thickness)]


def source(rng, p):
    """[(rate (m^2/s), from, to)]: enough in all to open the fracture and to reach the toughness, or less, or more."""
    half = 0.5 * math.dist(*p["lines"]["f0"])
    modulus = physics.plane_strain_modulus(p)
    net = p["toughness"] / math.sqrt(math.pi * half)
    load = max(0.0, min(p["stress"], p["stress"] * p["ratio"]) - p["initial"])
    volume = 2 * math.pi * half**2 * net / modulus + 2 * half * p["aperture"] * p["compressibility"] * (load + net)
    volume *= math.exp(rng.uniform(math.log(0.3), math.log(4)))
    end = p["steps"] * HOUR
    kind = rng.choice(("steady", "late", "pause", "turned_back"))
    if kind == "steady":
        return [(volume / end, 0.0, end)]
    if kind == "late":
        return [(volume / (end - HOUR), HOUR, end)]
    if kind == "pause":
        return [(0.5 * volume / HOUR, 0.0, HOUR), (0.5 * volume / (end - 2 * HOUR), 2 * HOUR, end)]
    return [(volume / (end - HOUR), 0.0, end - HOUR), (-0.3 * volume / HOUR, end - HOUR, end)]


def draw(rng):
    logarithmic = lambda low, high: math.exp(rng.uniform(math.log(low), math.log(high)))
    sometimes = lambda value, share, draw: value if rng.random() < share else draw()
    size = rng.uniform(0.055, 0.08)
    young = logarithmic(5e9, 5e10)
    p = {"lines": lines(rng, size), "layer": layer(rng), "fracture_size": size, "cell_size": rng.uniform(0.3, 0.4),
         "growth": rng.uniform(0.3, 0.5), "youngs": (young, young * logarithmic(0.3, 3)),
         "poissons": (rng.uniform(0.1, 0.35), rng.uniform(0.1, 0.35)),
         "alpha": sometimes(0.0, 0.2, lambda: rng.uniform(0.2, 1)), "porosity": rng.uniform(0.01, 0.2),
         "compressibility": logarithmic(1e-10, 1e-9), "viscosity": logarithmic(1e-4, 2e-3),
         "permeabilities": [(logarithmic(1e-22, 1e-17), logarithmic(1, 100), rng.uniform(0, 180)) for _ in range(2)],
         "friction": rng.uniform(0.2, 1), "dilation": sometimes(0.0, 0.5, lambda: rng.uniform(0, 5)),
         "gravity": rng.random() < 0.4, "discretization": "tpfa" if rng.random() < 0.15 else "mpfa",
         "aperture": logarithmic(3e-5, 1e-3), "initial": sometimes(0.0, 0.4, lambda: logarithmic(1e5, 3e6)),
         "stress": logarithmic(2e6, 3e7), "ratio": logarithmic(0.4, 2.5), "open_side": rng.random() < 0.4,
         "toughness": logarithmic(3e5, 2e6), "length_rule": "fixed" if rng.random() < 0.3 else "to_rest",
         "scheme": rng.choices(("monolithic", "iterated", "subcycled"), (0.6, 0.2, 0.2))[0], "steps": rng.randint(3, 4)}
    # What the checks of the other families read: the stiffest rock, and the size of a fracture.
    p.update(young=max(p["youngs"]), poisson=max(p["poissons"]), width=SIDE, height=SIDE,
             length=math.dist(*p["lines"]["f0"]) / SIDE, storage=p["porosity"] * p["compressibility"])
    p["source"] = source(rng, p)
    return p


def injected(p, start, stop):
    """m^2 between two times (s)."""
    return sum(rate * max(0.0, min(stop, last) - max(start, first)) for rate, first, last in p["source"])


def describe(p):
    return (f"{len(p['lines'])} fractures, {p['scheme']}, {p['discretization']}, E = {p['youngs'][0]:.0e} and {p['youngs'][1]:.0e}, "
            f"k = {p['permeabilities'][0][0]:.0e}, alpha = {p['alpha']:.2f}, dilation = {p['dilation']:.1f} deg, "
            f"a = {p['aperture']:.0e} m, {'gravity, ' if p['gravity'] else ''}{len(p['source'])} rates, {p['length_rule']}")


def schedule(p):
    all_at_once = "{solve: [pore, rock, conduit, contact]}"
    if p["scheme"] == "iterated":
        solve = (f"{{iterate: {{until: {{relative: {ITERATED:g}, at_most: 60}}, accelerate: {{anderson: 5}}, steps: [{{solve: [pore, conduit], stabilize: fixed_stress}}, "
                 "{solve: [rock, contact]}]}}")
    elif p["scheme"] == "subcycled":
        solve = f"{{subcycle: {{count: 2, steps: [{all_at_once}]}}}}"
    else:
        solve = all_at_once
    update = f", update: {p['update']}"
    return ["schedule:", f"  - {solve}", f"  - {{grow: tips, settle: [rock, contact]{update}}}"]


def write(p, path):
    corners = lambda points: "[" + ", ".join(f"[{x:.9g}, {y:.9g}]" for x, y in points) + "]"
    tensor = lambda k: f"{{along: {k[0]!r} m^2, across: {k[0] / k[1]!r} m^2, angle: {k[2]!r} deg}}"
    by_region = lambda values, unit="": f"{{regions: {{layer: {values[1]!r}{unit}, default: {values[0]!r}{unit}}}}}"
    rates = ", ".join(f"{{value: {rate!r} m^2/s, from: {first!r} s, to: {last!r} s}}" for rate, first, last in p["source"])
    whole = p["length_rule"] == "fixed" and p["update"] != "within_step"  # which finds lengths itself
    growth = f"{{increment: {0.8 * p['fracture_size']:.6g}{', length: fixed' if whole else ''}}}"
    boundary = f", boundary: {{left: {{pressure: {p['initial']!r} Pa}}}}" if p["open_side"] else ""
    text = [f"name: growing_{p['number']}", "geometry:", f"  box: {{x: [0, {SIDE}], y: [0, {SIDE}]}}", "  fractures:",
            *(f"    {name}: {{points: {corners(line)}}}" for name, line in p["lines"].items()),
            f"  regions: {{layer: {{polygon: {corners(p['layer'])}}}}}",
            f"mesh: {{size: {p['cell_size']!r}, fracture_size: {p['fracture_size']!r}, growth: {p['growth']!r}}}",
            "materials:", f"  young_modulus: {by_region(p['youngs'], ' Pa')}", f"  poisson_ratio: {by_region(p['poissons'])}",
            f"  biot_coefficient: {p['alpha']!r}", f"  porosity: {p['porosity']!r}",
            f"  fluid_compressibility: {p['compressibility']!r} 1/Pa",
            f"  permeability: {{regions: {{layer: {tensor(p['permeabilities'][1])}, default: {tensor(p['permeabilities'][0])}}}}}",
            f"  viscosity: {p['viscosity']!r} Pa*s", f"  friction: {p['friction']!r}", f"  dilation_angle: {p['dilation']!r} deg",
            *(["  gravity: [0, -9.81 m/s^2]", "  rock_density: 2500 kg/m^3"] if p["gravity"] else []),
            "components:",
            f"  pore: {{type: matrix_flow/{p['discretization']}, initial_pressure: {p['initial']!r} Pa{boundary}}}",
            "  rock:", "    type: poromechanics/mpsa",
            "    boundary: {left: {displacement_x: 0}, bottom: {displacement_y: 0}, "
            f"right: {{normal_stress: {-p['stress'] * p['ratio']!r} Pa}}, top: {{normal_stress: {-p['stress']!r} Pa}}}}",
            f"  conduit: {{type: fracture_flow/tpfa, initial_aperture: {p['aperture']!r} m, initial_pressure: {p['initial']!r} Pa, "
            f"injection: {{w: {{fracture: f0, rate: [{rates}]}}}}}}",
            "  contact: {type: contact/coulomb}",
            f"  tips: {{type: fine_fracture/quarter_point, size: {6 * p['fracture_size']:.6g}, toughness: {p['toughness']!r} Pa*m^0.5, "
            f"growth: {growth}}}",
            "couplers:", "  - {type: biot, between: [pore, rock]}", "  - {type: wall_exchange, between: [pore, conduit]}",
            "  - {type: wall_traction, between: [rock, contact, conduit]}", "  - {type: aperture, between: [contact, conduit]}",
            f"  - {{type: two_level, between: [rock, conduit, tips]{', propagation_threshold: 0.25' if p['update'] == 'within_step' else ''}}}",
            *schedule(p),
            f"time: {{end: {p['steps'] * HOUR!r} s, step: {HOUR!r} s}}", f"output: {{every: {HOUR!r} s}}", ""]
    path.write_text("\n".join(text))
    return path
