"""Scenes of the family faults: rock in space with two to eight fractures in frictional contact, unlike one another, with or without fluid."""

import math

import numpy as np

from . import physics, space, space_fractures
from .draws import choose, log_uniform, sometimes

AXES = {"xx": (0, 0), "yy": (1, 1), "zz": (2, 2), "xy": (0, 1), "yz": (1, 2), "xz": (0, 2)}
HELD = ("left", "front", "bottom")          # rollers where stresses are given
LOADED = {"right": 0, "back": 1, "top": 2}  # axis
WITHIN = ("polygon", "rectangle", "disc", "ellipse")  # shapes that leave the rock in one piece
TWINS = ("none", "disturbed", "processes", "restart")
DISTURBED = 1e-9
CLOSED = 0.4  # of the aperture, at most, by the closure of walls


def walls(rng, names, load):
    """What differs from fracture to fracture."""
    return {name: {"friction": sometimes(rng, 0.0, 0.08, lambda: rng.uniform(0.05, 1.2)), "dilation": sometimes(rng, 0.0, 0.3, lambda: rng.uniform(0, 15)),
                   "cohesion": sometimes(rng, 0.0, 0.6, lambda: load * log_uniform(rng, 1e-3, 0.3)), "aperture": log_uniform(rng, 1e-4, 1e-2),
                   "transmissivity": log_uniform(rng, 1e-18, 1e-8)} for name in names}


def strain(rng, load, young):
    """Of a body whose sides are displaced: shortening, and shear about no axis."""
    shear = np.array([[rng.uniform(-1, 1) for _ in range(3)] for _ in range(3)])
    return load / young * (0.5 * (shear + shear.T) - np.diag([rng.uniform(0.2, 1) for _ in range(3)]))


def draw(rng):
    size = log_uniform(rng, 1, 1000)
    sides = np.array([float(f"{size * log_uniform(rng, 0.5, 2):.3g}") for _ in range(3)])
    low, high = np.zeros(3), sides
    load, young = log_uniform(rng, 1e6, 1e8), log_uniform(rng, 1e9, 1e11)
    loading = choose(rng, stress=0.65, displaced=0.35)
    order = choose(rng, first=0.75, second=0.25)
    count = round(log_uniform(rng, 2, 8.4))
    target = log_uniform(rng, 100, 400) / (4 if order == "second" else 1) / max(1, count / 3)  # fractures make cells smaller
    fractures = space_fractures.draw(rng, low, high, count, shapes=WITHIN if loading == "stress" else None)
    names = list(fractures)
    has_fluid = rng.random() < 0.6
    p = {"low": low, "high": high, "width": float(max(sides)), "edge": (16 * float(np.prod(sides)) / target) ** (1 / 3), "fractures": fractures,
         "growth": rng.uniform(0.4, 1.0), "finer": rng.uniform(0.7, 1.0), "young": young, "poisson": rng.uniform(0, 0.45), "order": order,
         "loading": loading, "load": load, "stresses": [load * log_uniform(rng, 0.2, 1) for _ in range(3)], "strain": strain(rng, load, young),
         "history": choose(rng, constant=0.35, ramp=0.25, reversal=0.2, cycle=0.2), "walls": walls(rng, names, load),
         "closure": choose(rng, hard=0.5, linear=0.25, barton_bandis=0.25), "closed": sorted(rng.sample(names, rng.randint(1, len(names)))),
         "contact": choose(rng, coulomb=0.75, augmented_lagrangian=0.25), "fluid": has_fluid, "steps": rng.randint(2, 4),
         "alpha": sometimes(rng, 0.0, 0.2, lambda: rng.uniform(0, 1)), "permeability": log_uniform(rng, 1e-20, 1e-12), "viscosity": log_uniform(rng, 1e-4, 1e-2),
         "storage": log_uniform(rng, 1e-12, 1e-9), "compressibility": log_uniform(rng, 1e-11, 3e-9), "relative_step": log_uniform(rng, 1e-4, 1e3),
         "initial": sometimes(rng, 0.0, 0.5, lambda: load * rng.uniform(0.05, 0.3)), "side": sometimes(rng, None, 0.4, lambda: load * rng.uniform(0, 0.4)),
         "injected": (rng.choice(names), sometimes(rng, 0.0, 0.3, lambda: rng.choice((-1, 1, 1)) * log_uniform(rng, 1e-3, 0.3))),
         "law": choose(rng, constant=0.5, cubic=0.5), "in_turn": rng.random() < 0.2, "condense": rng.random() < 0.85}
    p["closed"] = p["closed"] if p["closure"] != "hard" else []
    p["stiffness"] = {name: load / (CLOSED * p["walls"][name]["aperture"]) * log_uniform(rng, 1, 100) for name in names}
    twin = rng.choices(TWINS, (0.55, 0.2, 0.1, 0.15))[0]
    p["twin"] = twin
    return p


def describe(p):
    shapes = ", ".join(sorted({fracture["shape"] for fracture in p["fractures"].values()}))
    return (f"{len(p['fractures'])} fractures ({shapes}), {p['order']}, {p['loading']}, {p['history']}, nu = {p['poisson']:.2f}, {p['contact']}, closure: {p['closure']} "
            f"of {len(p['closed'])}, {'fluid, ' if p['fluid'] else ''}{'in turn, ' if p['in_turn'] else ''}"
            f"{'' if p['condense'] else 'not condensed, '}twin: {p['twin']}")


def step(p):
    return p["relative_step"] * physics.diffusion_time(p) if p["fluid"] else 1.0


def factor(p, t):
    """By which all loads are multiplied; reversals and cycles stay in compression."""
    part = t / (p["steps"] * step(p))
    return {"constant": 1.0, "ramp": 0.2 + 0.8 * part, "reversal": 1 - 0.8 * part, "cycle": 0.6 + 0.4 * math.cos(4 * math.pi * part)}[p["history"]]


def factor_text(p):
    part = f"(t/{p['steps'] * step(p)!r}/s)"
    return {"constant": "1", "ramp": f"(0.2 + 0.8*{part})", "reversal": f"(1 - 0.8*{part})", "cycle": f"(0.6 + 0.4*cos(4*{math.pi!r}*{part}))"}[p["history"]]


def stress_of(p, axis, t):
    """On the loaded sides, Pa: one of the three changes in time."""
    return -p["stresses"][axis] * (factor(p, t) if axis == 0 else 1.0)


def closure(p, name):
    """(m by Pa of pressure) of the walls of a fracture."""
    if name not in p["closed"]:
        return lambda pressure: 0 * pressure
    stiffness, largest = p["stiffness"][name], CLOSED * p["walls"][name]["aperture"]
    if p["closure"] == "linear":
        return lambda pressure: pressure / stiffness
    return lambda pressure: np.where(pressure > 0, pressure * largest / (stiffness * largest + np.maximum(pressure, 0)), pressure / stiffness)


def contacts(p):
    """{name of the contact: its fractures}: one for those with hard walls, and one for each with a closure of its own."""
    hard = [name for name in p["fractures"] if name not in p["closed"]]
    return {**({"contact": hard} if hard else {}), **{f"contact_{name}": [name] for name in p["closed"]}}


def rock(p):
    lines = ["  rock:", "    type: poromechanics/fem", f"    order: {p['order']}", f"    young_modulus: {p['young']!r} Pa", f"    poisson_ratio: {p['poisson']!r}", "    boundary:"]
    if p["loading"] == "stress":
        lines += [f"      {side}: {{displacement_normal: 0 m}}" for side in HELD]
        return lines + [f"      {side}: {{normal_stress: \"({-p['stresses'][axis]!r}*{factor_text(p) if axis == 0 else 1}) Pa\"}}" for side, axis in LOADED.items()]
    rows = [" + ".join(f"({float(entry)!r})*{axis}/m" for entry, axis in zip(row, "xyz")) for row in p["strain"]]
    displaced = "[" + ", ".join(f'"(({row})*{factor_text(p)}) m"' for row in rows) + "]"
    return lines + [f"      {side}: {{displacement: {displaced}}}" for side in space.SIDES]


def by_fracture(p, what, unit="", of=lambda value: value):
    return "{fractures: {" + ", ".join(f"{name}: {of(walls[what])!r}{unit}" for name, walls in p["walls"].items()) + "}}"


def of_contacts(p):
    lines = []
    for name, fractures in contacts(p).items():
        lines += [f"  {name}:", f"    type: contact/{p['contact']}", f"    fractures: [{', '.join(fractures)}]", f"    friction: {by_fracture(p, 'friction')}",
                  f"    cohesion: {by_fracture(p, 'cohesion', ' Pa')}", f"    dilation_angle: {by_fracture(p, 'dilation', ' rad', math.radians)}"]
        if name != "contact":
            largest = f", largest: {CLOSED * p['walls'][fractures[0]]['aperture']!r} m" if p["closure"] == "barton_bandis" else ""
            lines.append(f"    closure: {{law: {p['closure']}, stiffness: {p['stiffness'][fractures[0]]!r} Pa/m{largest}}}")
    return lines


def flow(p):
    lines = ["  pore:", "    type: matrix_flow/mpfa", f"    permeability: {p['permeability']!r} m^2", f"    storage: {p['storage']!r} 1/Pa", f"    initial_pressure: {p['initial']!r} Pa"]
    if p["side"] is not None:
        lines.append(f"    boundary: {{right: {{pressure: {p['initial']!r} Pa}}, left: {{pressure: {p['side']!r} Pa}}}}")
    lines += ["  conduit:", "    type: fracture_flow/mfd", f"    initial_aperture: {by_fracture(p, 'aperture', ' m')}", f"    initial_pressure: {p['initial']!r} Pa"]
    if p["law"] == "constant":
        lines += ["    transmissivity: constant", f"    transmissivity_value: {by_fracture(p, 'transmissivity', ' m^3')}"]
    name, volume = p["injected"]
    if volume:
        rate = volume * p["walls"][name]["aperture"] * size_of(p) ** 2 / (p["steps"] * step(p))
        lines.append(f"    injection: {{well: {{fracture: {name}, rate: {rate!r} m^3/s}}}}")
    return lines


def size_of(p):
    """Of fractures, roughly, m."""
    return 0.5 * float(min(p["high"] - p["low"]))


def schedule(p):
    mechanics = ", ".join(["rock", *contacts(p)])
    if not p["fluid"]:
        return f"schedule: [{{solve: [{mechanics}]}}]"
    if p["in_turn"]:
        return (f"schedule: [{{iterate: {{until: {{relative: 1e-10, at_most: 60}}, accelerate: {{anderson: 5}}, "
                f"steps: [{{solve: [pore, conduit], stabilize: fixed_stress}}, {{solve: [{mechanics}]}}]}}}}]")
    return f"schedule: [{{solve: [pore, conduit, {mechanics}]}}]"


def write(p, path):
    names = ", ".join(contacts(p))
    couplers = ["  - {type: biot, between: [pore, rock]}", "  - {type: wall_exchange, between: [pore, conduit]}", f"  - {{type: wall_traction, between: [rock, {names}, conduit]}}",
                f"  - {{type: aperture, between: [{names}, conduit]}}"] if p["fluid"] else [f"  - {{type: wall_traction, between: [rock, {names}]}}"]
    box = ", ".join(f"{axis}: [{float(a)!r} m, {float(b)!r} m]" for axis, a, b in zip("xyz", p["low"], p["high"]))
    text = [f"# tools/stress --family faults --seed {p['seed']} --only {p['number']}", f"name: faults_{p['number']}", "geometry:", f"  box: {{{box}}}", "  fractures:",
            *(f"    {name}: {{{fracture['text']}}}" for name, fracture in p["fractures"].items()),
            f"mesh: {{size: {p['edge']!r} m, fracture_size: {p['edge'] * p['finer']!r} m, growth: {p['growth']!r}, gap_edges: 0}}",
            *(["materials:", f"  viscosity: {p['viscosity']!r} Pa*s", f"  fluid_compressibility: {p['compressibility']!r} 1/Pa", f"  biot_coefficient: {p['alpha']!r}"] if p["fluid"] else []),
            "components:", *rock(p), *of_contacts(p), *(flow(p) if p["fluid"] else []), "couplers:", *couplers, schedule(p),
            *([] if p["condense"] else ["solver: {condense: false}"]),
            f"time: {{end: {p['steps'] * step(p)!r} s, step: {step(p)!r} s}}", f"output: {{every: {step(p)!r} s, fields: true}}", ""]
    path.write_text("\n".join(text))
    return path
