"""Writes the scene of drawn parameters: YAML, and a mesh file where the scene has one."""

import math

from . import buoyancy, faults, fractures, growing, heat, limited_wells, physics, schemes, space, swaps, tracer, twisted_mesh


def box_and_mesh(p):
    segments = fractures.segments(p)
    lines = [f"    {name}: {{points: [[{a[0]!r}, {a[1]!r}], [{b[0]!r}, {b[1]!r}]]}}" for name, (a, b) in segments.items()]
    size = physics.length(p) / p["cells"]
    coarse = max(size, min(p["width"], p["height"]) / p["coarse"])
    return list(segments), "\n".join([
        "geometry:", f"  box: {{x: [0, {p['width']!r}], y: [0, {p['height']!r}]}}", "  fractures:", *lines, "",
        f"mesh: {{size: {coarse!r}, fracture_size: {size!r}, growth: {p['growth']!r}}}"])


def rock_sides(p):
    factor = physics.load_expression(p)
    if p["sides"] == "shear_box":
        # Strains that make about the wanted stresses.
        down = -p["stress"] / p["young"] * p["height"]
        across = down * p["shear"]
        return [f"      bottom: {{displacement_x: 0, displacement_y: 0}}",
                f"      top: {{displacement_x: \"({across!r}*{factor}) m\", displacement_y: {down!r}}}"]
    return ["      left: {displacement_x: 0}", "      bottom: {displacement_y: 0}",
            f"      right: {{normal_stress: \"({-p['stress'] * p['ratio']!r}*{factor}) Pa\"}}",
            f"      top: {{normal_stress: {-p['stress']!r} Pa}}"]


def flow_sides(p):
    if p["boundary"] == "none":
        return []
    lines = ["    boundary:", f"      right: {{pressure: {p['initial']!r} Pa}}"]
    if p["boundary"] == "across":
        lines.append(f"      left: {{pressure: {p['boundary_pressure']!r} Pa}}")
    return lines


def wells(p):
    if p["well"] == "none":
        return []
    half, rate = 0.5 * physics.end(p), physics.rate(p)
    lines = ["    injection:", f"      first: {{fracture: main, rate: {{value: {rate!r} m^2/s, from: 0, to: {half!r} s}}}}"]
    if p["well"] == "inject_extract":
        lines.append(f"      second: {{fracture: main, rate: {{value: {-rate!r} m^2/s, from: {half!r} s, to: {2 * half!r} s}}}}")
    return lines


IN_SPACE = {"space": space, "faults": faults}
MORE = {"heat": heat, "wells": limited_wells, "tracer": tracer}  # components and couplers of families


def write(p, folder):
    """folder/scene.yaml; returns its path."""
    folder.mkdir(parents=True, exist_ok=True)
    if p["family"] == "growing":
        return growing.write(p, folder / "scene.yaml")
    if p["family"] in IN_SPACE:
        return IN_SPACE[p["family"]].write(p, folder / "scene.yaml")
    if p["mesh"] == "twisted":
        twisted_mesh.write(p, folder / "mesh.msh")
        shape = "geometry: {file: mesh.msh}"
    else:
        _, shape = box_and_mesh(p)
    step, more = physics.time_step(p), MORE.get(p["family"])
    lines = [f"# tools/stress{physics.family_option(p)} --seed {p['seed']} --only {p['number']}", f"name: stress_{p['number']}", "", shape, "",
             "materials:", f"  young_modulus: {p['young']!r} Pa", f"  poisson_ratio: {p['poisson']!r}",
             f"  biot_coefficient: {p['alpha']!r}", f"  permeability: {p['permeability']!r} m^2",
             f"  viscosity: {p['viscosity']!r} Pa*s", f"  fluid_compressibility: {p['compressibility']!r} 1/Pa",
             f"  friction: {p['friction']!r}", f"  dilation_angle: {math.radians(p['dilation'])!r} rad", "",
             "components:", "  pore:", f"    type: matrix_flow/{p['discretization']}", f"    storage: {p['storage']!r} 1/Pa",
             f"    initial_pressure: {p['initial']!r} Pa", *flow_sides(p), *buoyancy.of_flow(p),
             "  rock:", *swaps.rock(p), "    boundary:", *rock_sides(p),
             "  conduit:", "    type: fracture_flow/tpfa", f"    initial_aperture: {p['aperture']!r} m",
             f"    initial_pressure: {p['initial']!r} Pa", *buoyancy.of_flow(p), *wells(p),
             f"  contact: {{type: contact/{swaps.contact(p)}}}", *(more.components(p) if more else []), "",
             "couplers:", "  - {type: biot, between: [pore, rock]}", "  - {type: wall_exchange, between: [pore, conduit]}",
             "  - {type: wall_traction, between: [rock, contact, conduit]}",
             "  - {type: aperture, between: [contact, conduit]}", *(more.couplers(p) if more else []), *buoyancy.couplers(p), "",
             more.schedule(p) if more in (heat, tracer) else schemes.schedule(p["solved"], ", wells" if more else ""), "",
             f"time: {{end: {physics.end(p)!r} s, step: {step!r} s}}", f"output: {{every: {step!r} s}}", ""]
    path = folder / "scene.yaml"
    path.write_text("\n".join(lines))
    return path
