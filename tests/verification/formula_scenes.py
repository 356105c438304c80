"""What tests of formulas of rock share: words put into scenes, and one scene with all that acts on rock, its fluid and a fracture."""

FRACTURED = """
geometry:
  box: {x: [-5 m, 5 m], y: [-5 m, 5 m]}
  fractures: {cut: {points: [[-1.3 m, -0.6 m], [1.2 m, 0.7 m]]}}
mesh: {size: SIZES m}
materials: {young_modulus: "YOUNG", poisson_ratio: 0.2, biot_coefficient: 0.8}
components:
  pore:
    type: matrix_flow/mpfa
    permeability: "PERMEABILITY"
    viscosity: 1 mPa*s
    porosity: "POROSITY"
    fluid_compressibility: COMPRESSIBILITY 1/Pa
    boundary: {left: {pressure: "0.2 MPa"}, right: {pressure: 0 MPa}}
    WELLS
  rock:
    type: ROCK
    initial_stress: {xx: -12 MPa, yy: -9 MPa, xy: 1 MPa}
    boundary: {left: {displacement: [0 m, 0 m]}, right: {displacement: [0 m, 0 m]}, bottom: {displacement: [0 m, 0 m]}, top: {displacement: [0 m, 0 m]}}
  conduit:
    type: fracture_flow/tpfa
    viscosity: 1 mPa*s
    fluid_compressibility: 4e-10 1/Pa
    initial_aperture: 0.2 mm
    injection: {well: {at: [-1 m, -0.4 m], rate: "(RATE) m^2/s"}}
  contact: {type: contact/coulomb, friction: 0.6, closure: {law: linear, stiffness: 100 GPa/m}}
couplers:
  - {type: biot, between: [pore, rock]}
  - {type: wall_exchange, between: [pore, conduit]}
  - {type: wall_traction, between: [rock, contact, conduit]}
  - {type: aperture, between: [contact, conduit]}
schedule: [{solve: [pore, rock, conduit, contact]}]
time: {end: 600 s, step: 200 s}
output: {every: 600 s, probes: {p: {of: pore.pressure, at: [1 m, 2 m]}, peak: {of: conduit.pressure, take: largest}, u: {of: rock.displacement, at: [0.3 m, 1.1 m]}}}
"""
WELL = "wells: {w: {at: [2.3 m, -2.1 m], rate: 2e-7 m^2/s}}"


def put(text, **values):
    """The text with each of these words replaced by its value."""
    for name, value in values.items():
        text = text.replace(name, str(value))
    return text


def fractured(sizes, rate="3e-6", **words):
    """Rock, its fluid and a fracture that is injected into. `sizes`: of cells in the rock, and on the fracture, m; `words`: of FRACTURED."""
    usual = {"YOUNG": "10 GPa", "PERMEABILITY": "1e-15 m^2", "POROSITY": "0.1", "COMPRESSIBILITY": "4e-10", "WELLS": WELL, "ROCK": "poromechanics/mpsa"}
    return put(FRACTURED, SIZES="{} m, fracture_size: {}".format(*sizes), RATE=rate, **{**usual, **words})
