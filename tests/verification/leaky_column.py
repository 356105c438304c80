"""A column whose sides may leak, for tests of such sides."""

KINDS = ("tpfa", "mpfa", "rt0", "ntpfa")
K, MU, LENGTH, HEIGHT = 2e-3, 0.5, 3.0, 0.7  # m^2, Pa s, m

COLUMN = f"""
name: column
geometry: {{box: {{x: [0 m, {LENGTH} m], y: [0 m, {HEIGHT} m]}}}}
mesh: {{kind: structured, shape: quadrilaterals, cells: [CELLS, 2]}}
components:
  pore:
    type: matrix_flow/KIND
    permeability: {K} m^2
    viscosity: {MU} Pa*s
    storage: STORAGE 1/Pa
    initial_pressure: INITIAL Pa
    boundary: {{BOUNDARY}}
schedule: [{{solve: pore}}]
time: {{end: 1 s, step: STEP}}
output: {{fields: false, probes: {{p: {{of: pore.pressure, take: mean}}}}}}
"""


def column(kind, boundary, cells=7, storage=0.0, initial=0.0, step="1 s"):
    text = COLUMN
    for name, value in (("KIND", kind), ("BOUNDARY", boundary), ("CELLS", cells), ("STORAGE", storage), ("INITIAL", initial), ("STEP", step)):
        text = text.replace(name, str(value))
    return text
