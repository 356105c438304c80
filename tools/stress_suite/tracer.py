"""Scenes of the family tracer: those of `separate` with a dissolved tracer in rock and fractures; half of them have heat that presses, too."""

from . import draws, heat, physics, pressed


def draw(rng):
    def concentration():
        return draws.sometimes(rng, 0.0, 0.2, lambda: draws.log_uniform(rng, 1e-6, 1e3))
    drawn = {**heat.draw(rng), **pressed.draw(rng)}
    drawn.update({
        "order": "together",  # of heat
        "diffused": draws.choose(rng, mpfa=0.5, tpfa=0.5),
        "diffusion": draws.log_uniform(rng, 1e-13, 1e-6), "fracture_diffusion": draws.log_uniform(rng, 1e-10, 1e-5),
        "retardation": draws.sometimes(rng, 1.0, 0.4, lambda: draws.log_uniform(rng, 1, 100)),
        "fracture_retardation": draws.sometimes(rng, 1.0, 0.5, lambda: draws.log_uniform(rng, 1, 100)),
        "decays": draws.sometimes(rng, 0.0, 0.6, lambda: draws.log_uniform(rng, 1e-3, 10)),  # in the run
        "tracer_conductance": draws.sometimes(rng, None, 0.6, lambda: draws.sometimes(rng, 0.0, 0.2, lambda: draws.log_uniform(rng, 1e-12, 1e-3))),
        "dispersivity": draws.sometimes(rng, 0.0, 0.6, lambda: draws.log_uniform(rng, 1e-2, 1)),  # of a cell on the fracture
        "concentration": concentration(), "fracture_concentration": concentration() if rng.random() < 0.5 else None,
        "side_concentrations": {"right": concentration(), "left": concentration()}, "injected_concentration": concentration(),
        "tracer_sides": draws.choose(rng, none=0.35, right=0.3, across=0.35),
        "advected": draws.choose(rng, limited=0.6, upwind=0.4),
        "tracer_order": draws.choose(rng, **{"together": 0.3, "flow first": 0.35, "tracer first": 0.15, "substeps": 0.2}),
    })
    is_uniform = rng.random() < 0.3
    if is_uniform:  # all that there is and all that enters has one concentration, which stays
        one = draws.log_uniform(rng, 1e-6, 1e3)
        drawn.update({"concentration": one, "fracture_concentration": None, "side_concentrations": {"right": one, "left": one}, "injected_concentration": one,
                      "tracer_sides": "across", "decays": 0.0})
    drawn["uniform"] = is_uniform
    if drawn["pressed"] and drawn["heat_sides"] == "none":
        drawn["heat_sides"] = "right"
    if not drawn["pressed"]:
        drawn.update({"expansion": 0.0, "viscosity_law": "none", "clock": "flow"})
    return drawn


def with_pores(p):
    """The parameters with pores that hold what the scene can press out of them: where more fluid leaves than the balance of the tracer has, the
    run ends with a message."""
    p = heat.with_fluid(pressed.can_be_stored(p))
    return {**p, "retardation": max(p["retardation"], heat.pressed_out(p) / p["porosity"])}


def of_fractures(p):
    """kg/m^3, at the start."""
    return p["concentration"] if p["fracture_concentration"] is None else p["fracture_concentration"]


def sides(p):
    """{side: kg/m^3}"""
    return {side: p["side_concentrations"][side] for side in {"none": (), "right": ("right",), "across": ("left", "right")}[p["tracer_sides"]]}


def given(p):
    """All concentrations that there are in a scene, kg/m^3; fluid of which nothing is told has none."""
    injected = [p["injected_concentration"]] if p["well"] in ("inject", "inject_extract") else []
    return [p["concentration"], of_fractures(p), *sides(p).values(), *injected, *([] if p["uniform"] else [0.0])]


def rate_of_decay(p):
    """1/s"""
    return p["decays"] / physics.end(p)


def components(p):
    decay = f"    decay: {rate_of_decay(p)!r} 1/s"
    lines = heat.components(p) if p["pressed"] else []
    lines += ["  salt:", f"    type: matrix_transport/{p['diffused']}", f"    porosity: {p['porosity']!r}", f"    diffusion: {p['diffusion']!r} m^2/s",
              f"    retardation: {p['retardation']!r}", decay, f"    initial_concentration: {p['concentration']!r} kg/m^3"]
    if sides(p):
        lines += ["    boundary:", *(f"      {side}: {{concentration: {value!r} kg/m^3}}" for side, value in sides(p).items())]
    return lines + ["  brine:", "    type: fracture_transport/tpfa", f"    aperture: {p['aperture']!r} m", f"    diffusion: {p['fracture_diffusion']!r} m^2/s",
                    f"    retardation: {p['fracture_retardation']!r}", decay, f"    initial_concentration: {of_fractures(p)!r} kg/m^3"]


def couplers(p):
    injected = f", injected: {{first: {{concentration: {p['injected_concentration']!r} kg/m^3}}}}" if p["well"] in ("inject", "inject_extract") else ""
    conductance = "" if p["tracer_conductance"] is None else f", conductance: {p['tracer_conductance']!r} m/s"
    size = physics.length(p) / p["cells"]
    spread = f", longitudinal_dispersivity: {p['dispersivity'] * size!r} m, transverse_dispersivity: {0.1 * p['dispersivity'] * size!r} m" if p["dispersivity"] else ""
    return [*(heat.couplers(p) + pressed.couplers(p) if p["pressed"] else []),
            f"  - {{type: tracer_advection, between: [pore, conduit, salt, brine], scheme: {p['advected']}{spread}{injected}}}",
            f"  - {{type: tracer_exchange, between: [salt, brine]{conductance}}}"]


def schedule(p):
    flow, tracer = "pore, rock, conduit, contact" + (", heat, water" if p["pressed"] else ""), "salt, brine"
    steps = {"together": [f"solve: [{flow}, {tracer}]"], "flow first": [f"solve: [{flow}]", f"solve: [{tracer}]"],
             "tracer first": [f"solve: [{tracer}]", f"solve: [{flow}]"],
             "substeps": [f"solve: [{flow}]", f"subcycle: {{count: 3, steps: [{{solve: [{tracer}]}}]}}"]}[p["tracer_order"]]
    return "schedule:" + "".join(f"\n  - {step}" for step in steps)


def describe(p):
    pressing = f"pressed by {p['fluid_expansion']:.0e}/K, {heat.describe(p)}" if p["pressed"] else ""
    return (f"{p['advected']}, {p['diffused']}, D = {p['diffusion']:.0e}, {'uniform, ' if p['uniform'] else ''}c = {min(given(p)):.2g} to {max(given(p)):.2g}, "
            f"tracer: {p['tracer_order']}, {pressing}")
