"""Cracks of straight panels in an infinite elastic plane (plane strain), by densities of edge dislocations.

D = u(left) - u(right) is the jump across the crack, left and right as seen along it, in the frame of the panel: D_t along, D_n
across (opening is positive). The unknown is b = -(E'/4) dD/ds, so a straight crack has the tractions
sigma_nn = (1/pi) PV int b_n(t)/(x - t) dt and sigma_nt the same of b_t (tension positive), and near a tip
b = K/sqrt(2 pi r): b_n gives K_I, b_t gives K_II.

On a panel b is a polynomial in x (Legendre), on the panel at a tip a polynomial in x over the square root of the distance
to the tip. Stresses of both are closed forms: Legendre functions of the second kind in the potentials of Muskhelishvili.
"""
import functools

import numpy as np

gauss = functools.lru_cache(None)(np.polynomial.legendre.leggauss)

FAR = ((6.0, 12), (2.0, 40))  # beyond this ellipse (sum of the half-axes), so many Gauss points


def legendre_q(z, count):
    """Q_n(z) and Q_n'(z), n < count, for complex z beside [-1, 1], where they jump. Shape (count, len(z))."""
    z = np.asarray(z, complex)
    q, dq = np.empty((count, z.size), complex), np.empty((count, z.size), complex)
    root = np.sqrt(z - 1) * np.sqrt(z + 1)
    ellipse = np.abs(z + root)
    left = np.ones(z.size, bool)
    for limit, points in FAR:
        at = left & (ellipse > limit)
        left &= ~at
        if not at.any():
            continue
        x, weight = gauss(points)
        p = np.polynomial.legendre.legvander(x, count - 1).T * weight / 2
        inverse = 1 / (z[at][:, None] - x)
        q[:, at] = p @ inverse.T
        dq[:, at] = -(p @ (inverse**2).T)
    if left.any():
        near = z[left]
        q[:, left], dq[:, left] = _recursion(near, 0.5 * np.log((near + 1) / (near - 1)), count)
    return q, dq


def legendre_q_on_cut(x, count):
    """The principal values for -1 < x < 1."""
    q, dq = _recursion(x, 0.5 * np.log((1 + x) / (1 - x)), count)
    return q, dq


def _recursion(z, first, count):
    q = np.empty((count,) + z.shape, first.dtype)
    dq = np.empty_like(q)
    q[0], dq[0] = first, 1 / (1 - z**2)
    if count > 1:
        q[1], dq[1] = z * first - 1, first + z / (1 - z**2)
    for n in range(1, count - 1):
        q[n + 1] = ((2 * n + 1) * z * q[n] - n * q[n - 1]) / (n + 1)
        dq[n + 1] = dq[n - 1] + (2 * n + 1) * q[n]
    return q, dq


class Panel:
    """A straight piece from `start` to `end` (complex), with `order` coefficients of b_t and as many of b_n."""

    def __init__(self, start, end, order, tip=False):
        self.start, self.end, self.order, self.tip = start, end, order, tip
        self.half = abs(end - start) / 2
        self.center = (start + end) / 2
        self.turn = (end - start) / abs(end - start)
        self.gauss = self.points(order + 3)

    def points(self, count):
        """Gauss points on [-1, 1] and their weights; at a tip those of the root of the distance to it."""
        if not self.tip:
            return gauss(count)
        u, weight = gauss(count)
        u = (1 - u) / 2
        return 1 - 2 * u**2, 2 * u * weight

    def place(self, x):
        return self.center + self.half * self.turn * x

    def integrals(self, z, on_panel):
        """int f_n/(z-t) dt and int f_n/(z-t)^2 dt of the functions of the panel at local z. On the panel the second is not needed."""
        if not self.tip:
            q, dq = legendre_q_on_cut(z.real, self.order) if on_panel else legendre_q(z, self.order)
            return 2 * q, -2 * dq
        w = np.sqrt((1 - z) / 2)  # t = 1 - 2 u^2: even polynomials in u
        q, dq = legendre_q_on_cut(w.real, 2 * self.order) if on_panel else legendre_q(w, 2 * self.order)
        q, dq = q[::2], dq[::2]
        return -np.sqrt(2) * q / w, -np.sqrt(2) / (4 * w**2) * (dq - q / w)

    def tractions(self, z, turn, on_panel=False):
        """sigma_nn + i sigma_nt at z on lines along `turn` from unit coefficients of b_t and b_n. Shapes (points, order) each."""
        local = (z - self.center) / (self.half * self.turn)
        first, second = self.integrals(local, on_panel)
        rotation = (turn / self.turn) ** 2

        def of(a):  # potentials with the strength a
            phi = a * first
            rest = 0 if on_panel else (np.conj(local) - local) * second
            return 2 * phi.real + rotation * (np.conj(a) * first - a * (rest + first))

        return of(-0.5j / np.pi).T, of(0.5 / np.pi).T

    def jump_integrals(self, x):
        """int_x^1 f_n of the functions, times the half length: what the panel adds to (E'/4) D at local x. Shape (points, order)."""
        if not self.tip:
            values = np.polynomial.legendre.legvander(x, self.order)
            result = np.empty((len(x), self.order))
            result[:, 0] = 1 - x
            for n in range(1, self.order):  # int_x^1 P_n = (P_{n-1} - P_{n+1})/(2n+1)
                result[:, n] = (values[:, n - 1] - values[:, n + 1]) / (2 * n + 1)
            return self.half * result
        u = np.sqrt((1 - x) / 2)
        values = np.polynomial.legendre.legvander(u, 2 * self.order - 1)
        result = np.empty((len(x), self.order))
        result[:, 0] = u
        for k in range(1, self.order):
            n = 2 * k
            result[:, k] = (values[:, n + 1] - values[:, n - 1]) / (2 * n + 1)  # int_0^u P_n
        return self.half * 2 * np.sqrt(2) * result

    def factor(self):
        """K = factor @ coefficients."""
        p = np.polynomial.legendre.legvander(np.zeros(1), 2 * self.order - 2)[0, ::2]
        return np.sqrt(2 * np.pi * self.half) * p
