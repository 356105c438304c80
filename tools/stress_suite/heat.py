"""Scenes of the family heat: those of `separate` with heat in rock and fractures, and what it does to rock and fluid."""

import math

from . import draws, physics, pressed

ORDERS = {"together": "- solve: [pore, rock, conduit, contact, heat, water]",
          "flow first": "- solve: [pore, rock, conduit, contact]\n  - solve: [heat, water]",
          "heat first": "- solve: [heat, water]\n  - solve: [pore, rock, conduit, contact]"}


def draw(rng):
    def kelvin():
        return rng.uniform(280, 600)
    return {
        "conduction": draws.choose(rng, mpfa=0.7, tpfa=0.3),
        "conductivity": draws.log_uniform(rng, 1e-2, 10),
        "heat_capacity": draws.log_uniform(rng, 1e5, 1e7),
        "fluid_heat_capacity": draws.log_uniform(rng, 1e4, 1e7),
        "fracture_conductivity": draws.log_uniform(rng, 1e-3, 10),
        "conductance": draws.sometimes(rng, None, 0.6, lambda: draws.sometimes(rng, 0.0, 0.2, lambda: draws.log_uniform(rng, 1e-3, 1e5))),
        "expansion": draws.sometimes(rng, 0.0, 0.3, lambda: draws.log_uniform(rng, 1e-7, 3e-5)),
        "temperature": kelvin(), "fracture_temperature": kelvin() if rng.random() < 0.3 else None,
        "side_temperatures": {"right": kelvin(), "left": kelvin()}, "injected_temperature": kelvin(),
        "heat_sides": draws.choose(rng, none=0.35, right=0.3, across=0.35),
        "viscosity_law": draws.choose(rng, none=0.5, water=0.25, exponential=0.25),
        "decay": draws.log_uniform(rng, 1e-3, 3e-2),
        "order": draws.choose(rng, **{"together": 0.5, "flow first": 0.3, "heat first": 0.2}),
        "clock": draws.choose(rng, flow=0.5, heat=0.5),  # whose diffusion time steps are measured by
    }


# Stress beside the end of a fracture of length L, over that on the sides: sqrt(a / (2 r)) for a = L/2 in a cell of L/20.
CONCENTRATION = math.sqrt(10)


def pressed_out(p):
    """The part of a volume of rock that is fluid which loads, pressures and heat of the scene can press out of it."""
    loads = [physics.stresses(p, physics.end(p) * i / 8) for i in range(9)] if p["sides"] == "stress" else [(p["stress"], p["stress"])]
    stress = CONCENTRATION * max(0.5 * (abs(x) + abs(y)) for x, y in loads)
    warmed = max(given(p)) - min(given(p))
    stress += 3 * physics.bulk_modulus(p) * p["expansion"] * warmed
    pressures = [p["initial"], *([p["initial"]] if p["boundary"] != "none" else []), *([p["boundary_pressure"]] if p["boundary"] == "across" else [])]
    pressure = max(pressures) - min(pressures) + stress
    pressing = 2 * pressed.of_rock(p) * warmed + p["storage"] * pressed.pressures(p, given(p))
    return pressing + p["alpha"] * (stress + p["alpha"] * pressure) / physics.in_plane_modulus(p) + p["storage"] * (max(pressures) - min(pressures))


def is_in(p):
    return p["family"] == "heat" or pressed.is_in(p)


def with_fluid(p):
    """The parameters with a heat capacity of the rock that can be one: it includes the fluid in the pores, (rho c) >= porosity c_f, so
    it is at least that of the fluid that the scene can press out. Below that a cell would lose more heat capacity than it has, and
    the run ends with a message."""
    return {**p, "heat_capacity": max(p["heat_capacity"], p["fluid_heat_capacity"] * pressed_out(p))}


def of_fractures(p):
    """K, at the start."""
    return p["temperature"] if p["fracture_temperature"] is None else p["fracture_temperature"]


def sides(p):
    """{side: K}"""
    return {side: p["side_temperatures"][side] for side in {"none": (), "right": ("right",), "across": ("left", "right")}[p["heat_sides"]]}


def given(p):
    """All temperatures that there are in a scene, K."""
    injected = [p["injected_temperature"]] if p["well"] in ("inject", "inject_extract") else []
    return [p["temperature"], of_fractures(p), *sides(p).values(), *injected]


def least_viscosity(p):
    """Pa s, of the fluid at the temperatures of the scene; of the law for water as the reference states it."""
    if p["viscosity_law"] == "water":
        return 2.414e-5 * 10 ** (247.8 / (max(given(p)) - 140))
    return p["viscosity"] * (math.exp(-p["decay"] * (max(given(p)) - p["temperature"])) if p["viscosity_law"] == "exponential" else 1)


def components(p):
    lines = ["  heat:", f"    type: matrix_heat/{p['conduction']}", f"    conductivity: {p['conductivity']!r} W/(m*K)",
             f"    heat_capacity: {p['heat_capacity']!r} J/(m^3*K)", f"    initial_temperature: {p['temperature']!r} K"]
    if sides(p):
        lines += ["    boundary:", *(f"      {side}: {{temperature: {value!r} K}}" for side, value in sides(p).items())]
    return lines + ["  water:", "    type: fracture_heat/tpfa", f"    aperture: {p['aperture']!r} m",
                    f"    conductivity: {p['fracture_conductivity']!r} W/(m*K)",
                    f"    heat_capacity: {p['fluid_heat_capacity']!r} J/(m^3*K)", f"    initial_temperature: {of_fractures(p)!r} K"]


def couplers(p):
    injected = f", injected: {{first: {{temperature: {p['injected_temperature']!r} K}}}}" if p["well"] in ("inject", "inject_extract") else ""
    conductance = "" if p["conductance"] is None else f", conductance: {p['conductance']!r} W/(m^2*K)"
    lines = [f"  - {{type: heat_advection, between: [pore, conduit, heat, water], fluid_heat_capacity: {p['fluid_heat_capacity']!r} J/(m^3*K){injected}}}",
             f"  - {{type: heat_exchange, between: [heat, water]{conductance}}}"]
    if p["expansion"] > 0:
        lines.append(f"  - {{type: thermal_stress, between: [heat, rock], expansion: {p['expansion']!r} 1/K}}")
    if p["viscosity_law"] == "water":
        lines.append("  - {type: thermal_viscosity, between: [pore, conduit, heat, water], law: water}")
    if p["viscosity_law"] == "exponential":
        lines.append(f"  - {{type: thermal_viscosity, between: [pore, conduit, heat, water], law: exponential, reference_viscosity: "
                     f"{p['viscosity']!r} Pa*s, reference_temperature: {p['temperature']!r} K, decay: {p['decay']!r} 1/K}}")
    return lines


def schedule(p):
    return "schedule:\n  " + ORDERS[p["order"]]


def describe(p):
    return (f"{p['conduction']}, lambda = {p['conductivity']:.0e}, expansion = {p['expansion']:.0e}, T = {min(given(p)):.0f} to {max(given(p)):.0f} K, "
            f"viscosity: {p['viscosity_law']}, {p['order']}, steps of {p['clock']}, ")
