"""What pairs are made of. Each feature changes a draft; its kind says what its answer is compared with.

neutral   the answer of the scene without it, to the tolerance of solvers
scheme    the answer of the monolithic scheme, to the tolerance of iterations
time      the same answer for small steps: the difference falls with the step
half      the answer of steps half as long
rest      nothing moves
physics   the same answer in other frames: mirrored, and turned
"""

from dataclasses import dataclass
from typing import Callable

from . import base


@dataclass(frozen=True)
class Feature:
    name: str
    kind: str
    add: Callable


FEATURES = []


def feature(kind, name=None):
    def register(function):
        FEATURES.append(Feature(name or function.__name__, kind, function))
        return function
    return register


def setter(kind, name, path, value):
    """A feature that sets one value of a component or section."""
    @feature(kind, name)
    def add(draft, path=path, value=value):
        where = draft
        *outer, last = path.split(".")
        for part in outer:
            where = where[part] if isinstance(where, dict) else getattr(where, part)
        if isinstance(where, dict):
            where[last] = value
        else:
            setattr(where, last, value)
    return add


# How the run is made.
setter("neutral", "two processes", "processes", 2)


@feature("neutral", "restart")
def restart(draft):
    draft.restarted = True
    draft.meets = (base.STEP * base.STEPS / 2,)  # where the run is interrupted: an end cuts a step


for solver in ("umfpack", "mumps", "belos"):
    setter("neutral", solver, "more.solver", {"type": solver})
setter("neutral", "not condensed", "more.solver", {"condense": False})


@feature("neutral", "when")
def always(draft):
    draft.around.append(lambda steps: [{"when": "t > 0", "steps": steps}])


# Schemes.
@feature("scheme", "iterate")
def iterate(draft):
    draft.split = draft.split or "none"
    draft.iterate.setdefault("accelerate", {"anderson": 6})  # an opening fracture asks for it


setter("scheme", "fixed stress", "split", "fixed_stress")
setter("scheme", "response", "split", "response")
for accelerator, options in {"aitken": {"first": 0.5}, "anderson": 4, "constant": {"factor": 0.8}, "iqn_ils": {}, "iqn_imvj": {}}.items():
    @feature("scheme", accelerator)
    def accelerated(draft, accelerator=accelerator, options=options):
        draft.split = draft.split or "fixed_stress"
        draft.iterate["accelerate"] = {accelerator: options}


@feature("scheme", "jacobi")
def jacobi(draft):
    draft.split = draft.split or "fixed_stress"
    draft.iterate["order"] = "jacobi"
    # What a stabilization adds is what the others answer two passes later: errors fall by the square root of its share in the whole.
    draft.iterate["until"] = {"relative": 1e-11, "at_most": 400}


# Time.
setter("time", "sdirk2", "time.scheme", "sdirk2")


setter("time", "adaptive", "adapts", True)


@feature("half", "subcycle all")
def subcycle_all(draft):
    draft.around.append(lambda steps: [{"subcycle": {"count": 2, "steps": steps}}])


for group in ("flow", "mechanics", "heat"):
    for waiting in ("held", "linear"):
        @feature("time", f"subcycle {group} {waiting}")
        def subcycle(draft, group=group, waiting=waiting):
            if group == "heat":
                heat(draft)
            draft.substeps.add(group)
            draft.waiting = waiting
            draft.split = draft.split or "fixed_stress"
            draft.iterate.setdefault("accelerate", {"anderson": 6})


# The state at the start.
@feature("rest", "settle all")
def settle_all(draft):
    draft.driven = False
    draft.more["start"] = {"settle": [name for members in draft.groups.values() for name in members]}


for listed in (["pore"], ["pore", "conduit"], ["rock", "contact"], ["pore", "rock", "contact"], ["pore", "conduit", "rock", "contact"]):
    setter("physics", "settle " + " ".join(listed), "more.start", {"settle": listed})


# Discretizations and contact.
for flow in ("tpfa", "rt0", "ntpfa"):
    setter("physics", f"flow {flow}", "components.pore.type", f"matrix_flow/{flow}")
for order in ("first", "second"):
    @feature("physics", f"fem {order}")
    def fem(draft, order=order):
        draft.components["rock"].update(type="poromechanics/fem", order=order)
for kind in ("augmented_lagrangian", "penalty"):
    setter("physics", kind, "components.contact.type", f"contact/{kind}")
setter("physics", "linear closure", "components.contact.closure", {"law": "linear", "stiffness": "5e10 Pa/m"})
setter("physics", "barton_bandis", "components.contact.closure", {"law": "barton_bandis", "stiffness": "2e10 Pa/m", "largest": "0.3 mm"})
setter("physics", "cohesion", "components.contact.cohesion", "0.5 MPa")


@feature("physics", "weakening")
def weakening(draft):
    draft.components["contact"].update(cohesion="0.5 MPa", weakening={"distance": "5 mm", "friction": 0.28})


@feature("physics", "rate and state")
def rate_and_state(draft):
    f = draft.frame  # the walls creep from the start, under the stress of the rock
    draft.components["rock"]["initial_stress"] = {f.axes["x"] * 2: "-12 MPa", f.axes["y"] * 2: "-8 MPa"}
    draft.components["contact"]["rate_and_state"] = {"a": 0.015, "b": 0.01, "distance": "0.1 mm", "reference_rate": "1e-6 m/s",
                                                     "initial_slip_rate": "1e-9 m/s", "state_change": base.STATE_CHANGE}


setter("physics", "opening", "components.conduit.injection", {"well": {"fracture": "main", "rate": 8e-6}})


# Laws of flow.
setter("physics", "rough walls", "components.conduit.law", {"type": "rough", "roughness": "0.2 mm"})
setter("physics", "inertia", "components.conduit.law", {"inertia": "1e4 1/m"})
setter("physics", "cavitation", "components.conduit.cavitation", "0.1 MPa")
setter("physics", "compressible fluid", "materials.fluid_compressibility", "4e-9 1/Pa")
setter("physics", "window", "components.conduit.injection", {"well": {"fracture": "main", "rate": {"value": "1e-5 m^2/s", "from": "500 s", "to": "1500 s"}}})
setter("physics", "prescribed", "components.conduit.prescribed", {"tap": {"fracture": "other", "pressure": "1.5 MPa"}})


@feature("physics", "anisotropic")
def anisotropic(draft):
    f = draft.frame
    draft.materials["permeability"] = {f.axes["x"] * 2: "3e-16 m^2", f.axes["y"] * 2: "1e-16 m^2"}


@feature("physics", "viscosity in time")
def viscosity_in_time(draft):
    draft.materials["viscosity"] = "(1e-3*(1 + 2e-4*t)) Pa*s"


@feature("physics", "compressibility in time")
def compressibility_in_time(draft):
    draft.materials["fluid_compressibility"] = "(4e-10*(1 + 2e-4*t)) 1/Pa"


@feature("physics", "crossing")
def crossing(draft):
    f = draft.frame
    draft.geometry["fractures"]["cross"] = {"points": [f.point(4, 1), f.point(4, 5)]}
    draft.components["conduit"]["initial_aperture"]["fractures"]["cross"] = "0.1 mm"
    draft.components["contact"]["friction"]["fractures"]["cross"] = 0.2


def unlike_crossing(draft):
    """A conductor across a barrier, both of given transmissivity."""
    crossing(draft)
    draft.components["conduit"]["law"] = {"type": "constant", "transmissivity": {"fractures": {"main": "8e-11 m^3", "other": "5e-12 m^3",
                                                                                             "cross": "1e-20 m^3"}}}


@feature("physics", "unlike crossing")
def barrier_across(draft):
    unlike_crossing(draft)


@feature("physics", "crossing through")
def barrier_is_passed(draft):
    unlike_crossing(draft)
    draft.components["conduit"]["crossings"] = {"middle": {"between": ["main", "cross"], "through": "main"}}


@feature("physics", "gravity")
def gravity(draft):
    draft.materials["gravity"] = [f"{g!r} m/s^2" for g in draft.frame.vector(3.0, -9.0)]
    draft.materials["rock_density"] = "2500 kg/m^3"


@feature("physics", "wells")
def wells(draft):
    f = draft.frame
    draft.groups["flow"].append("wells")
    draft.components["wells"] = {"type": "wells/limited", "wells": {
        "feed": {"fracture": "other", "at": f.point(7, 2.3), "rate": "2e-6 m^2/s", "highest_pressure": "3 MPa"},
        "drain": {"at": f.point(2.2, 5.4), "rate": "-1e-7 m^2/s", "lowest_pressure": "0.5 MPa"}}}
    draft.couplers.append({"type": "well_exchange", "between": ["wells", "pore", "conduit"]})


@feature("physics", "heat")
def heat(draft):
    if "heat" in draft.components:
        return
    f = draft.frame
    draft.groups["heat"] = ["heat", "water"]
    draft.materials.update(heat_capacity="2.5e6 J/(m^3*K)", fluid_heat_capacity="4.2e6 J/(m^3*K)")
    draft.components["heat"] = {"type": "matrix_heat/mpfa", "conductivity": "30 W/(m*K)", "initial_temperature": "350 K",
                                "boundary": {f.side("right"): {"temperature": "350 K"}}}
    draft.components["water"] = {"type": "fracture_heat/tpfa", "aperture": {"fractures": {"main": "1 mm", "other": "0.4 mm", "default": "0.1 mm"}},
                                 "conductivity": "0.6 W/(m*K)", "heat_capacity": "4.2e6 J/(m^3*K)", "initial_temperature": "350 K"}
    draft.couplers += [{"type": "heat_advection", "between": ["pore", "conduit", "heat", "water"], "injected": {"well": {"temperature": "300 K"}}},
                       {"type": "heat_exchange", "between": ["heat", "water"]}]
    draft.probes["T_rock"] = {"of": "heat.temperature", "at": f.point(4.5, 4.5)}
    draft.probes["T_main"] = {"of": "water.temperature", "at": f.point(5.5, 3)}


@feature("physics", "tracer")
def tracer(draft):
    f = draft.frame
    draft.groups["tracer"] = ["salt", "brine"]
    draft.components["salt"] = {"type": "matrix_transport/mpfa", "porosity": 0.1, "diffusion": "1e-6 m^2/s", "retardation": 2, "decay": "1e-5 1/s",
                                "initial_concentration": "1 kg/m^3", "boundary": {f.side("right"): {"concentration": "1 kg/m^3"}}}
    draft.components["brine"] = {"type": "fracture_transport/tpfa", "aperture": {"fractures": {"main": "1 mm", "other": "0.4 mm", "default": "0.1 mm"}},
                                 "diffusion": "1e-8 m^2/s", "initial_concentration": "1 kg/m^3"}
    draft.couplers += [{"type": "tracer_advection", "between": ["pore", "conduit", "salt", "brine"], "injected": {"well": {"concentration": "3 kg/m^3"}}},
                       {"type": "tracer_exchange", "between": ["salt", "brine"]}]
    draft.probes["c_rock"] = {"of": "salt.concentration", "at": f.point(4.5, 4.5)}
    draft.probes["c_main"] = {"of": "brine.concentration", "at": f.point(5.5, 3)}


@feature("physics", "thermal stress")
def thermal_stress(draft):
    heat(draft)
    draft.couplers.append({"type": "thermal_stress", "between": ["heat", "rock"], "expansion": "1e-5 1/K"})


@feature("physics", "thermal viscosity")
def thermal_viscosity(draft):
    heat(draft)
    draft.couplers.append({"type": "thermal_viscosity", "between": ["pore", "conduit", "heat", "water"], "law": "water"})


@feature("physics", "buoyancy")
def buoyancy(draft):
    heat(draft)
    draft.materials["gravity"] = [f"{g!r} m/s^2" for g in draft.frame.vector(3.0, -9.0)]
    draft.couplers.append({"type": "buoyancy", "between": ["pore", "conduit", "heat", "water"], "fluid_expansion": "5e-4 1/K",
                           "reference_temperature": "350 K"})


@feature("physics", "growth")
def growth(draft):
    draft.mirrors = False
    draft.mesh = {"size": "1.5 m", "fracture_size": "0.4 m", "growth": 0.3}
    draft.components["tips"] = {"type": "fine_fracture/quarter_point", "toughness": "0.6 MPa*m^0.5", "size": "1 m", "growth": {"increment": "0.3 m"}}
    draft.couplers.append({"type": "two_level", "between": ["rock", "conduit", "tips"], "propagation_threshold": 0.25})
    draft.around.append(lambda steps: [*steps, {"grow": "tips", "settle": ["rock", "contact"]}])
