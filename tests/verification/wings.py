"""The wings of section 5.2 of the paper (configs/paper/wing_cracks.yaml), grown within steps, and taken over by the mesh from a quarter
of a cell on. What tests of growth share."""

from scene_runs import ROOT

SCENE = ROOT / "configs/paper/wing_cracks.yaml"
# Steps and sizes of the paper, and fronts to the default tolerance; the scene costs least for its error with others.
VALUES_OF_PAPER = ("time.step=1 h", "mesh.size=0.1 m", "mesh.growth=0.2", "components.tips.size=0.5 m", "components.tips.growth={increment: 10 mm, front_tolerance: null}")
TAKEN_OVER = 0.25 * 20e-3  # m: the length of a wing that the mesh follows
COUPLERS = """
couplers:
  - {type: biot,          between: [pore, rock]}
  - {type: wall_exchange, between: [pore, conduit]}
  - {type: wall_traction, between: [rock, contact, conduit]}
  - {type: aperture,      between: [contact, conduit]}
  - {type: two_level,     between: [rock, conduit, tips], propagation_threshold: 0.25}
"""
WITHIN_STEPS = COUPLERS + """
schedule:
  - solve: [pore, rock, conduit, contact]
  - grow: tips
    settle: [rock, contact]
    update: within_step
"""
