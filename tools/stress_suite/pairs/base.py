"""The scene that features are added to: rock with two unlike fractures, loaded, injected into, drained at one side."""

STEPS, STEP = 4, 500.0  # number and s
RATE = 2e-6             # m^2/s into the fracture main
STATE_CHANGE = 0.1      # of friction of rate and state, which limits steps


class Draft:
    """A scene that is being put together: its sections, and what its schedule consists of."""

    def __init__(self, frame):
        self.frame = frame
        f = frame
        self.scale = 1.0           # of loads and rates
        self.groups = {"flow": ["pore", "conduit"], "mechanics": ["rock", "contact"]}
        self.split = None          # how flow is stabilized; None: everything in one solve
        self.iterate = {}          # further keys of iterate
        self.substeps = set()      # groups that are solved in two substeps
        self.waiting = "held"
        self.around = []           # functions that put steps around all others
        self.adapts = False        # steps grow to twice the first one
        self.driven = True         # fluid is injected
        self.mirrors = True        # the mesh is the same in all frames
        self.processes, self.restarted, self.meets = 1, False, ()  # meets: times that steps end at, s
        self.geometry = {"box": {"x": [0, f.box[0]], "y": [0, f.box[1]]},
                         "fractures": {"main": {"points": [f.point(2, 3), f.point(6, 3)]},
                                       "other": {"points": [f.point(7, 1), f.point(7, 4)]}}}
        self.mesh = {"kind": "structured", "shape": "quadrilaterals", "cells": list(f.cells)}
        self.materials = {"young_modulus": "10 GPa", "poisson_ratio": 0.2, "biot_coefficient": 0.8, "porosity": 0.1,
                          "permeability": f.expression("(1e-16*(1 + 0.1*X + 0.05*Y)) m^2"), "viscosity": "1 mPa*s",
                          "fluid_compressibility": "4e-10 1/Pa"}
        self.components = {
            "pore": {"type": "matrix_flow/mpfa", "initial_pressure": "1 MPa", "boundary": {f.side("right"): {"pressure": "1 MPa"}}},
            "rock": {"type": "poromechanics/mpsa", "boundary": {
                f.side("bottom"): {"displacement": [0, 0]}, f.side("right"): {"normal_stress": "-12 MPa"},
                f.side("left"): {f.axis("displacement_x"): 0},
                f.side("top"): {"traction": [f"{part!r} MPa" for part in f.vector(3.0, -8.0)]}}},
            "conduit": {"type": "fracture_flow/tpfa", "initial_aperture": {"fractures": {"main": "1 mm", "other": "0.4 mm"}},
                        "initial_pressure": "1 MPa", "injection": {"well": {"fracture": "main", "rate": RATE}}},
            "contact": {"type": "contact/coulomb", "friction": {"fractures": {"main": 0.3, "other": 0.35}}, "dilation_angle": "2 deg"}}
        self.couplers = [{"type": "biot", "between": ["pore", "rock"]}, {"type": "wall_exchange", "between": ["pore", "conduit"]},
                         {"type": "wall_traction", "between": ["rock", "contact", "conduit"]},
                         {"type": "aperture", "between": ["contact", "conduit"]}]
        self.time = {"end": STEPS * STEP, "step": STEP}
        self.probes = {"p_rock": {"of": "pore.pressure", "at": f.point(4.5, 5.5)}, "p_far": {"of": "pore.pressure", "at": f.point(7.5, 1.5)},
                       "p_main": {"of": "conduit.pressure", "at": f.point(2.5, 3)}, "p_other": {"of": "conduit.pressure", "at": f.point(7, 2.5)},
                       "aperture": {"of": "conduit.aperture", "at": f.point(4.5, 3)}, "slip": {"of": "contact.jump", "at": f.point(4.5, 3)},
                       "traction": {"of": "contact.traction", "at": f.point(3.5, 3)}}
        self.more = {}             # further sections

    def steps(self):
        groups = {name: list(members) for name, members in self.groups.items()}
        if self.split is None and not self.substeps:
            steps = [{"solve": [name for members in groups.values() for name in members]}]
        else:
            steps = []
            for name, members in groups.items():
                solve = {"solve": members}
                if name == "flow" and self.split not in (None, "none"):
                    solve["stabilize"] = self.split
                steps.append({"subcycle": {"count": 2, "waiting": self.waiting, "steps": [solve]}} if name in self.substeps else solve)
            steps = [{"iterate": {"until": {"relative": 1e-11, "at_most": 200}, "fallback": "none", **self.iterate, "steps": steps}}]
        for wrap in self.around:
            steps = wrap(steps)
        return steps

    def times(self):
        times = {key: f"{value!r} s" if key in ("end", "step") else value for key, value in self.time.items()}
        return {**times, "adaptive": {"largest": f"{2 * self.time['step']!r} s"}} if self.adapts else times

    def scene(self):
        """The scene as a map that JSON, and so YAML, can hold."""
        components = {name: dict(options) for name, options in self.components.items()}
        injection = components["conduit"].get("injection", {}).get("well")
        if injection and not isinstance(injection["rate"], dict):
            components["conduit"]["injection"] = {"well": {**injection, "rate": f"{injection['rate'] * self.scale!r} m^2/s"}}
        couplers = [dict(options) for options in self.couplers]
        for advection in (options for options in couplers if options["type"].endswith("_advection")):
            of_well = advection.pop("injected")
            injected = dict(of_well) if self.driven else {}
            if "wells" in components:  # whose fluid carries heat or a tracer, too
                advection["between"] = [*advection["between"], "wells"]
                injected["feed"] = {"temperature": "320 K"} if "temperature" in of_well["well"] else {"concentration": "2 kg/m^3"}
            if injected:
                advection["injected"] = injected
        if not self.driven:
            components["conduit"].pop("injection", None)
        return {"name": "pair", "geometry": self.geometry, "mesh": self.mesh, "materials": self.materials, "components": components,
                "couplers": couplers, "schedule": self.steps(),
                "time": self.times(),
                "output": {"probes": self.probes, **({"times": [f"{time!r} s" for time in self.meets]} if self.meets else {})}, **self.more}
