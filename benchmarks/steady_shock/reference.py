"""Steady front in a viscoplastic cap solid in uniaxial strain, as a system of ordinary equations. Needs numpy and scipy.

Everything depends on xi = X - U t. Momentum is exact in both kinematics, because the first Piola stress P_xX is sigma_xx in uniaxial strain:

    v = v_a + U (J_a - J),     sigma_xx = sigma_a - rho0 U^2 (J_a - J)            (J = 1 + eps in small strain)

Following the particle, with the viscoplastic rate D = eta <f/f0>^N df/dsigma, S = K tr D + 2 G dev D_xx and M = K + 4G/3:

    finite strain   dJ/dt = S/(M/J - rho0 U^2)     dI1/dt = -3 K (Jdot/J - tr D)      dk/dt = <-tr D>
    small strain    dJ/dt = S/(M - rho0 U^2)       dI1/dt = -3 K (Jdot - tr D)

The front starts at the yield state of the elastic precursor, or, where rho0 U^2 is above the elastic chord, behind an elastic jump.
Surface (tension positive, I1 = -tr sigma, j = sqrt(J2)): j - Fe(I1) below L, the cap's ellipse between L and X(k) above (doc/theory.md).

Run:  python3 reference.py          compares with the end states and widths of an independent integration
"""
import math, sys
from dataclasses import dataclass
from pathlib import Path
sys.path.insert(0, str(Path(__file__).resolve().parents[1]))
import checks
import numpy
from scipy.integrate import solve_ivp
from scipy.optimize import brentq


@dataclass
class Cap:
    K: float = 106.4e6
    G: float = 63.85e6
    rho0: float = 1800.
    alpha: float = 64.2e3
    gamma: float = 5.89e3
    beta: float = .34283e-6
    theta: float = .18257
    R: float = 5.
    D: float = .00952e-6
    W: float = .2142
    X0: float = 1e6
    eta: float = 50.
    f0: float = 1e5
    N: float = 1.

    @property
    def M(self):
        return self.K + 4 * self.G / 3

    @property
    def relaxation_time(self):
        return self.f0 / (self.eta * (9 * self.K / self.R ** 2 + self.G))

    def failure(self, I1):
        """Fe and its slope."""
        decay = self.gamma * math.exp(-self.beta * I1)
        return self.alpha - decay + self.theta * I1, self.beta * decay + self.theta

    def cap_position(self, k):
        return self.X0 + (1 / (1 - k / self.W) - 1) / self.D

    def corner(self, X):
        """L, where the cap meets the failure surface: X = L + R Fe(L) (h + sqrt(1 + h^2)), h = R Fe'(L)."""
        def excess(L):
            Fe, slope = self.failure(L)
            h = self.R * slope
            return L + self.R * Fe * (h + math.hypot(1, h)) - X
        return brentq(excess, 0, X, xtol=1e-9 * X, rtol=1e-14)

    def surface(self, I1, j, k):
        """f and its slopes over I1 and j; no tension here."""
        X = self.cap_position(k)
        L = self.corner(X)
        Fe, slope = self.failure(L if I1 >= L else I1)
        if I1 < L:
            return j - Fe, -slope, 1.
        h = self.R * slope
        M, b = L + self.R * Fe * h, Fe * math.hypot(1, h)
        Q = math.hypot(j, (I1 - M) / self.R)
        return Q - b, (I1 - M) / (self.R ** 2 * Q), j / Q


class SteadyFront:
    """Front of the speed U (per reference length) into the solid at rest; .end, .V, .width() and the profile over xi."""

    def __init__(self, cap, U, finite=True):
        self.cap, self.U, self.finite = cap, U, finite
        self.stiffness = cap.rho0 * U ** 2
        self.overdriven = finite and self.stiffness > cap.M
        if self.overdriven:
            J = brentq(lambda J: -cap.M * math.log(J) - self.stiffness * (1 - J), 1e-3, 1 - 1e-6)
            self.ahead, state = (1., 0., 0.), (J, -3 * cap.K * math.log(J), 0.)  # J, sigma, v upstream; J, I1, k behind the jump
        else:
            strain = self.yield_strain()
            J = math.exp(-strain) if finite else 1 - strain
            self.ahead = J, -cap.M * strain, cap.M * strain / (cap.rho0 * math.sqrt(cap.M / cap.rho0))
            I1 = 3 * cap.K * strain
            # along the direction that grows: the ratios of the rates just outside of the surface
            trace, S = self.flow(J, I1, 0., 1.)
            dJ = -1e-6 * (1 - J)
            stretch = 1 / J if finite else 1.
            tangent = cap.M * stretch - self.stiffness
            state = J + dJ, I1 - 3 * cap.K * (stretch - trace * tangent / S) * dJ, max(0., -trace * tangent / S * dJ)

        def rates(t, y):
            J, I1, k = y
            f = self.overstress(J, I1, k)
            trace, S = self.flow(J, I1, k, (max(0., f) / cap.f0) ** cap.N * cap.eta)
            stretch = 1 / J if finite else 1.
            dJ = S / (cap.M * stretch - self.stiffness)
            return dJ, -3 * cap.K * (stretch * dJ - trace), max(0., -trace)

        def settled(t, y):  # rates are slow in the toe of the front too
            return abs(rates(t, y)[0]) * cap.relaxation_time - 1e-9 if y[0] < J_start - .05 else 1.
        settled.terminal = True
        J_start, end = state[0], 1e6 * cap.relaxation_time
        self.solution = solve_ivp(rates, (0, end), state, method="LSODA", rtol=1e-10, atol=(1e-13, 1e-4, 1e-13), events=settled)
        self.t, (self.J, self.I1, self.k) = self.solution.t, self.solution.y
        J_a, sigma_a, v_a = self.ahead
        self.v = v_a + U * (J_a - self.J)
        self.sigma = sigma_a - self.stiffness * (J_a - self.J)
        self.lateral = -(self.I1 + self.sigma) / 2
        self.X = numpy.array([cap.cap_position(k) for k in self.k])
        self.xi = -U * self.t
        self.xi = self.xi - numpy.interp((v_a + self.v[-1]) / 2, self.v, self.xi)  # 0 in the middle of the rise
        self.V = float(self.v[-1])

    def yield_strain(self):
        cap = self.cap
        return brentq(lambda e: cap.surface(3 * cap.K * e, 2 / math.sqrt(3) * cap.G * e, 0.)[0], 1e-6, .1, xtol=1e-16)

    def deviator(self, J, I1):
        """s_xx on the line of momentum."""
        J_a, sigma_a, _ = self.ahead
        return sigma_a - self.stiffness * (J_a - J) + I1 / 3

    def overstress(self, J, I1, k):
        return self.cap.surface(I1, math.sqrt(.75) * abs(self.deviator(J, I1)), k)[0]

    def flow(self, J, I1, k, rate):
        """tr D and S = K tr D + 2 G dev D_xx at this rate eta <f/f0>^N."""
        cap, s = self.cap, self.deviator(J, I1)
        j = math.sqrt(.75) * abs(s)
        _, f_I, f_j = cap.surface(I1, j, k)
        trace = -3 * rate * f_I
        return trace, cap.K * trace + 2 * cap.G * rate * f_j * s / (2 * j)

    def width(self):
        """Distance between 10 and 90 % of the rise of v."""
        low = self.ahead[2]
        places = [numpy.interp(low + part * (self.V - low), self.v, self.xi) for part in (.1, .9)]
        return float(places[0] - places[1])

    def at(self, xi):
        """v and sigma_xx at distances ahead of the middle of the front."""
        order = numpy.argsort(self.xi)
        ahead = numpy.asarray(xi) > self.xi[0]
        return tuple(numpy.where(ahead, rest, numpy.interp(xi, self.xi[order], values[order]))
                     for values, rest in ((self.v, self.ahead[2]), (self.sigma, self.ahead[1])))


CASES = {"A": dict(eta=50., N=1., U=254.44, finite=True), "B": dict(eta=50., N=1., U=247.91, finite=False),
         "C": dict(eta=50., N=1.5, U=260.96, finite=True), "D": dict(eta=200., N=1., U=335.99, finite=True)}
# V, J, sigma_xx, sigma_lateral, X, k at the end, width
STATED = {"A": (73.1356, .71297034, -33556297, -20650233, 9.9766e7, .103802, 56.10e-3),
          "B": (138.14691, .44320929, -61712710, -36012366, 1.90514e8, .137814, 55.88e-3),
          "C": (83.45523, .6805608, -39256513, -23784197, 1.17918e8, .112830, 8.98e-3),
          "D": (213.32257, .3650925, -129013650, -68823431, 4.31697e8, .172202, 3.07e-3)}


def front(case):
    return SteadyFront(Cap(eta=CASES[case]["eta"], N=CASES[case]["N"]), CASES[case]["U"], CASES[case]["finite"])


if __name__ == "__main__":
    rows = []
    cap = Cap()
    yielding = front("A")
    rows += [("wave speed [m/s]", math.sqrt(cap.M / cap.rho0), 326.2015, 2e-7), ("strain at yield", yielding.yield_strain(), .001442416, 5e-7),
             ("stress at yield [Pa]", yielding.ahead[1], -276270.8, 5e-7), ("velocity at yield [m/s]", yielding.ahead[2], .4705183, 5e-7)]
    for case, stated in STATED.items():
        steady = yielding if case == "A" else front(case)
        found = steady.V, steady.J[-1], steady.sigma[-1], steady.lateral[-1], steady.X[-1], steady.k[-1], steady.width()
        for name, value, number, tolerance in zip(("V", "J", "sigma_xx", "sigma lateral", "X", "k", "width"), found, stated,
                                                  (1e-5, 1e-5, 1e-5, 1e-5, 5e-5, 1e-5, 5e-3)):
            rows.append((f"{case}: {name}", float(value), number, tolerance))
        f = steady.overstress(steady.J[-1], steady.I1[-1], steady.k[-1])
        rows.append((f"{case}: overstress left at the end over f0", f / steady.cap.f0, 0., 1e-3))
    checks.compare(rows)
