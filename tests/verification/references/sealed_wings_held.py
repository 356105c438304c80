#!/usr/bin/python3
"""sealed_wings_held.py: the first kink of scene 45 if contact on the fracture does not answer to it, in two ways.

held    the fracture keeps the tractions that it has without wings, as on a fine level whose coarse level does not know the kink yet
closed  the fracture slips, but cannot open beside the kink
"""
import math

import numpy as np

import sealed_wings
from sealed_wings import FRICTION, HALF, TOUGHNESS


def held(length, direction):
    """Pressure at which K_I = K_IC, and K_II there."""
    far = sealed_wings.scene("45").far

    def factors(pressure):
        wings = sealed_wings.scene("45")
        on_fracture = far(wings.turn)
        drop = (on_fracture.imag + FRICTION * (on_fracture.real + pressure)) / (1 + FRICTION * wings.dilation)
        kept = complex(on_fracture.real - wings.dilation * drop, on_fracture.imag - drop)
        # All open, so that its jump is free, and loaded by what makes its tractions these.
        wings.far = lambda turn: far(turn) - kept - pressure if abs(turn - wings.turn) < 1e-12 else far(turn)
        state = wings.solve(wings.kink + length * direction, HALF)
        return np.array([state.opening_factor @ [1, pressure], state.shear_factor @ [1, pressure]])

    a, b = factors(8.0), factors(9.0)
    share = (TOUGHNESS - a[0]) / (b[0] - a[0])
    return 8 + share, (a + share * (b - a))[1]


def closed(length, direction):
    wings = sealed_wings.scene("45")
    state = wings.solve(wings.kink + length * direction, HALF * 1e-6)
    return state.pressure, state.shear


def kink(model, length):
    """Pressure and direction in degrees with K_II = 0."""
    a, b = -26.0, -25.0
    fa = model(length, np.exp(1j * math.radians(a)))[1]
    for _ in range(20):
        pressure, fb = model(length, np.exp(1j * math.radians(b)))
        if abs(fb) < 1e-8:
            break
        a, b, fa = b, b - fb * (b - a) / (fb - fa), fb
    return pressure, b


if __name__ == "__main__":
    for length in (0.5e-3, 1e-3, 2e-3, 5e-3):
        print(f"{length * 1e3:g} mm:", *(f"{model.__name__} {pressure:.3f} MPa {direction - 45:.2f} degrees;" for model in (held, closed)
                                     for pressure, direction in [kink(model, length)]))
