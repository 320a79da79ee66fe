"""Cavity that grows from nothing with a constant wall velocity: self-similar in x = r/t. Needs numpy and scipy.

Locking medium, rigid ahead of its front, q = Ya + Yb p: closed form. Compressible solid, p = K ln(rho/rho0): with w = x - v and S = p + 2q/3,

    momentum  S' = rho w v' - 2 q/x,     p' = K (v' + 2 v/x)/w,     elastic  Q' = 2 G (v' - v/x)/w,     plastic  q = Ya + Yb p

Q = q: Cauchy stress in the rate of the deviator; Q = q rho0/rho: Kirchhoff stress, as the laws with an equation of state have it. Integrated
inwards from the elastic front x = ce, where the linear wave of F = A tau^3 starts; A is such that v = x = V at the wall.

Run:  python3 reference.py          compares with an independent integration and with quadrature
"""
import math, sys
from dataclasses import dataclass
from pathlib import Path
sys.path.insert(0, str(Path(__file__).resolve().parents[1]))
import checks
import numpy
from scipy.integrate import quad, solve_ivp
from scipy.optimize import brentq


@dataclass
class Solid:
    K: float
    G: float
    rho0: float
    Ya: float
    Yb: float

    def __post_init__(self):
        self.M = self.K + 4 * self.G / 3
        self.ce = math.sqrt(self.M / self.rho0)


class Expansion:
    """Fields around a wall of velocity V: .at(x) gives v, S_r, S_t, rho; .wall the same at the wall; .boundary where yield begins [m/s]."""

    def __init__(self, solid, V, kirchhoff=True):
        self.solid, self.V, self.kirchhoff = solid, V, kirchhoff
        log_A = brentq(lambda a: self.integrate(math.exp(a))[-1] - V, *self.bracket(), xtol=1e-13, rtol=1e-14)
        self.elastic, self.plastic, self.boundary, _ = self.integrate(math.exp(log_A))
        self.wall = self.at(V)

    def bracket(self):
        """log A of wall velocities below and above V."""
        a = math.log(self.V * self.solid.ce ** 2 * 1e-6)
        while self.integrate(math.exp(a))[-1] > self.V:
            a -= 2
        while self.integrate(math.exp(a))[-1] < self.V:
            a += .5
        return a - 2.5, a

    def linear_wave(self, A, x):
        s, tau = self.solid, 1 - x / self.solid.ce
        both = tau ** 3 / x ** 3 + 3 * tau ** 2 / (s.ce * x ** 2)
        S_r = A * (6 * s.rho0 * tau / x + 4 * s.G * both)
        S_t = A * (6 * (s.M - 2 * s.G) * tau / (s.ce ** 2 * x) - 2 * s.G * both)
        return A * (3 * tau ** 2 / x ** 2 + 6 * tau / (s.ce * x)), (S_r + 2 * S_t) / 3, S_r - S_t

    def integrate(self, A):
        s = self.solid
        start = s.ce * (1 - 1e-4)

        def elastic(x, y):
            v, p, q = y
            w, rho = x - v, s.rho0 * math.exp(p / s.K)
            r, extra = (rho / s.rho0, q) if self.kirchhoff else (1., 0.)
            dv = ((2 * s.K - 4 * s.G * r / 3 + 4 * extra / 3) * v + 2 * q * w) / (x * (rho * w ** 2 - s.K - 4 * s.G * r / 3 - 2 * extra / 3))
            dp = s.K * (dv + 2 * v / x) / w
            return dv, dp, 2 * s.G * r * (dv - v / x) / w + extra * dp / s.K

        def plastic(x, y):
            v, p = y
            w, rho, q, Kp = x - v, s.rho0 * math.exp(p / s.K), s.Ya + s.Yb * p, s.K * (1 + 2 * s.Yb / 3)
            dv = 2 * (Kp * v + q * w) / (x * (rho * w ** 2 - Kp))
            return dv, s.K * (dv + 2 * v / x) / w

        def yields(x, y):
            return y[2] - s.Ya - s.Yb * y[1]

        def at_wall(x, y):
            return y[0] - x * (1 - 1e-9)  # w = 0 is singular
        yields.terminal = at_wall.terminal = True
        options = dict(method="DOP853", rtol=1e-11, dense_output=True)
        outer = solve_ivp(elastic, (start, 1e-6 * start), self.linear_wave(A, start), events=(yields, at_wall), atol=(1e-12, 1e-4, 1e-4), **options)
        if not outer.t_events[0].size:
            return outer, None, math.nan, outer.t[-1]
        inner = solve_ivp(plastic, (outer.t[-1], 1e-6 * start), outer.y[:2, -1], events=at_wall, atol=(1e-12, 1e-4), **options)
        return outer, inner, outer.t[-1], inner.t[-1]

    def at(self, x):
        x = numpy.asarray(x, float)
        s = self.solid
        v, p, q = self.elastic.sol(numpy.clip(x, self.elastic.t[-1], self.elastic.t[0]))
        if self.plastic is not None:
            inner = self.plastic.sol(numpy.clip(x, self.plastic.t[-1], self.plastic.t[0]))
            v, p = (numpy.where(x < self.boundary, a, b) for a, b in zip(inner, (v, p)))
            q = numpy.where(x < self.boundary, s.Ya + s.Yb * p, q)
        v, p, q = (numpy.where(x > self.elastic.t[0], 0., y) for y in (v, p, q))
        return v, p + 2 * q / 3, p - q / 3, s.rho0 * numpy.exp(p / s.K)


@dataclass
class Locking:
    """Rigid and weightless-strength ahead, incompressible at rho_locked behind the front: z = front over cavity."""
    rho0: float
    rho_locked: float
    Ya: float
    Yb: float

    def __post_init__(self):
        self.z = (1 - self.rho0 / self.rho_locked) ** (-1 / 3)
        self.k, self.m = 2 * self.Yb / (1 + 2 * self.Yb / 3), 2 * self.Ya / (1 + 2 * self.Yb / 3)

    def wall_stress(self, V):
        z, k, m = self.z, self.k, self.m
        front, inertia = self.rho0 * V ** 2 / z, self.rho_locked * V ** 2
        if k == 0:
            return front + m * math.log(z) + inertia * (2 * (1 - 1 / z) - (1 - z ** -4) / 2)
        return z ** k * (front + m / k) - m / k + inertia * (2 * (z ** (k - 1) - 1) / (k - 1) - 2 * (z ** (k - 4) - 1) / (k - 4))

    def wall_stress_by_quadrature(self, V):
        """dS/dr = -rho (v_t + v v_r) - (m + k S)/r with v = V a^2/r^2, a = V t: S r^k at the wall, r in units of a."""
        acceleration = lambda r: V ** 2 * (2 / r ** 2 - 2 / r ** 5)
        whole = quad(lambda r: (self.rho_locked * acceleration(r) + self.m / r) * r ** self.k, 1, self.z, epsabs=0, epsrel=1e-13)[0]
        return self.rho0 * V ** 2 / self.z * self.z ** self.k + whole


SOLIDS = {"Mises": Solid(160e9, 80e9, 7850, 1e9, 0), "Drucker-Prager": Solid(100e6, 60e6, 1800, 1e5, .6)}
LOCKING = Locking(1600, 1900, 1e5, .6)
# solid, V: S, p at the wall, boundary, density at the wall; Cauchy stress in the rate of the deviator
STATED = [("Mises", 50, 3.7481513e9, 3.0814846e9, 230.5587, 8002.651), ("Mises", 200, 4.0954482e9, 3.4287816e9, 911.3494, 8020.040),
          ("Mises", 400, 5.1767248e9, 4.5100581e9, 1756.4095, 8074.423), ("Drucker-Prager", 5, 1.4796386e6, 1.0092657e6, 43.16870, 1818.2588),
          ("Drucker-Prager", 20, 3.3993740e6, 2.3805052e6, 145.2481, 1843.3632), ("Drucker-Prager", 50, 1.1458706e7, 8.1371710e6, 233.8043, 1952.5933)]

if __name__ == "__main__":
    rows = []
    for name, V, S, p, boundary, rho in STATED:
        found = Expansion(SOLIDS[name], V, kirchhoff=False)
        v, S_r, S_t, density = (float(y) for y in found.wall)
        rows += [(f"{name}, {V} m/s: S at the wall", S_r, S, 1e-6), ("p at the wall", (S_r + 2 * S_t) / 3, p, 1e-6),
                 ("yield boundary", found.boundary, boundary, 1e-6), ("density at the wall", density, rho, 1e-6), ("v at the wall", v, V, 1e-6)]
    for V, S in ((20, 1.1834927e6), (50, 6.7891548e6), (100, 26.809377e6), (300, 240.35841e6)):
        rows += [(f"locking, {V} m/s", LOCKING.wall_stress(V), S, 5e-8), ("by quadrature", LOCKING.wall_stress_by_quadrature(V), S, 5e-8)]
    rows.append(("locking: front over cavity", LOCKING.z, 1.8501664, 3e-8))
    rows += [("locking without strength, 100 m/s", Locking(1600, 1900, 0, 0).wall_stress(100), 17.419915e6, 5e-8),
             ("locking without cohesion, 100 m/s", Locking(1600, 1900, 0, .6).wall_stress(100), 26.693629e6, 5e-8)]
    checks.compare(rows)
