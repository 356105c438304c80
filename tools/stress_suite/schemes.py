"""The schemes that a scene may be solved with, for `tools/stress --scheme`."""

UNTIL = 1e-10  # as the residuals of Newton's method: what the checks of answers rest on
MONOLITHIC = "monolithic"
ITERATED = {"fixed_stress": "", "accelerated": "accelerate: {anderson: 5}, "}
RESPONSE = "response"  # fractures apart from rock, with the Schur complement of waiting unknowns
SCHEMES = (MONOLITHIC, *ITERATED, RESPONSE)


def schedule(scheme, with_flow=""):
    """`with_flow`: names of components that are solved with the flow, after a comma."""
    most = 150 if scheme == RESPONSE else 100  # passes: fixed stress without acceleration leaves up to 0.8 of an error in each
    if scheme == MONOLITHIC:
        return f"schedule: [{{solve: [pore, rock, conduit, contact{with_flow}]}}]"
    steps = ("{solve: pore, stabilize: fixed_stress}, {solve: rock}, {solve: [conduit, contact], stabilize: response}" if scheme == RESPONSE else
             f"{{solve: [pore, conduit{with_flow}], stabilize: fixed_stress}}, {{solve: [rock, contact]}}")
    return f"schedule: [{{iterate: {{until: {{relative: {UNTIL:g}, at_most: {most}}}, {ITERATED.get(scheme, '')}steps: [{steps}]}}}}]"
