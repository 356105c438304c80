"""Pairs that have no answer, and say so: exit code 1 with the reason, and no step accepted that is not right."""

from dataclasses import dataclass

APART = "the iteration does not converge", "the iteration diverges"
# Features with which walls part, so that the fluid between them holds them alone.
OPENING = ("opening", "window", "settle pore conduit", "growth")


@dataclass(frozen=True)
class Reason:
    why: str       # the physics of it
    said: tuple    # what the message says, one of these
    remedy: str    # what it proposes


PLAIN = Reason("passes without stabilization: each multiplies errors of the pressure between parted walls by their compliance over that of the fluid",
               APART, "or give one of them 'stabilize: response' or 'fixed_stress'")
SUBSTEPS = Reason("the flow takes substeps while parted walls wait: in a substep their fracture has a given volume, and fluid that is hardly compressible has "
                  "no pressure for it", APART, "solve them in one 'solve'")
WITHOUT_FRICTION = Reason("walls that the settled flow has parted hold no shear at the start: they slip at once, as fast as inertia lets them",
                          ("is too long: slip at",), "")
PAIRS = {("settle pore conduit", "rate and state"): WITHOUT_FRICTION,
         **{("iterate", other): PLAIN for other in OPENING},
         **{(f"subcycle flow {waiting}", other): SUBSTEPS for waiting in ("held", "linear") for other in OPENING}}


def reason(names, failed):
    """Why a pair with these names has no answer; None where it should have one, or where the message does not say why."""
    known = PAIRS.get(tuple(names))
    if known is None or not failed.startswith("exit code 1") or not any(text in failed for text in known.said) or known.remedy not in failed:
        return None
    return known.why
