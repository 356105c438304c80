"""The schemes that a scene may be solved with, for `tools/stress --scheme`."""

UNTIL = 1e-10  # as the residuals of Newton's method: what the checks of answers rest on
MONOLITHIC = "monolithic"
ITERATED = {"fixed_stress": "", "accelerated": "accelerate: {anderson: 5}, "}
SCHEMES = (MONOLITHIC, *ITERATED)


def schedule(scheme):
    if scheme == MONOLITHIC:
        return "schedule: [{solve: [pore, rock, conduit, contact]}]"
    return (f"schedule: [{{iterate: {{until: {{relative: {UNTIL:g}, at_most: 100}}, {ITERATED[scheme]}steps: "
            "[{solve: [pore, conduit], stabilize: fixed_stress}, {solve: [rock, contact]}]}}]")
