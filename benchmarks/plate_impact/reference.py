"""Plate impact of Mie-Grueneisen solids: impedance match and release, from the jump relations. Standard library alone.

    p = p_H(chi) (1 - Gamma0 chi/2) + rho0 Gamma0 e,   p_H = rho0 c0^2 chi/(1 - s chi)^2 (chi > 0), rho0 c0^2 chi (chi <= 0)
    chi = 1 - rho0/rho, rho Gamma = rho0 Gamma0

Run:  python3 reference.py          compares with the values that an independent Lagrangian program found
"""
import math, sys
from dataclasses import dataclass, replace
from pathlib import Path
sys.path.insert(0, str(Path(__file__).resolve().parents[1]))
import checks


@dataclass
class Solid:
    rho0: float  # kg/m^3
    c0: float    # m/s
    s: float
    Gamma0: float
    plain_expansion: bool = False  # p = rho0 c0^2 chi + rho0 Gamma0 e for chi < 0, without the factor 1 - Gamma0 chi/2

    def hugoniot(self, up):
        """Behind a shock into the solid at rest: speed per reference length, pressure, density, energy per mass."""
        speed = self.c0 + self.s * up
        return speed, self.rho0 * speed * up, self.rho0 * speed / (speed - up), up ** 2 / 2

    def reference_curve(self, chi):
        """p_H and dp_H/dchi."""
        modulus = self.rho0 * self.c0 ** 2
        if chi <= 0:
            return modulus * chi, modulus
        return modulus * chi / (1 - self.s * chi) ** 2, modulus * (1 + self.s * chi) / (1 - self.s * chi) ** 3

    def pressure(self, chi, e):
        return self.reference_curve(chi)[0] * (1 - self.Gamma0 * chi / 2) + self.rho0 * self.Gamma0 * e

    def isentropic_slope(self, chi, p):
        """dp/dchi at constant entropy, de = p dchi/rho0; its root over rho0 is the wave speed per reference length."""
        curve, slope = self.reference_curve(chi)
        if chi < 0 and self.plain_expansion:
            return slope + self.Gamma0 * p
        return slope * (1 - self.Gamma0 * chi / 2) - self.Gamma0 * curve / 2 + self.Gamma0 * p

    def released(self, up, steps=4000):
        """Velocity and density of a free surface behind the shock: dv = dp/sqrt(rho0 dp/dchi) down to p = 0, Runge-Kutta."""
        _, p, rho, _ = self.hugoniot(up)
        chi, v, h = 1 - self.rho0 / rho, up, -p / steps

        def rates(chi, p):
            slope = self.isentropic_slope(chi, p)
            return 1 / slope, -1 / math.sqrt(self.rho0 * slope)
        for _ in range(steps):
            a = rates(chi, p)
            b = rates(chi + h / 2 * a[0], p + h / 2)
            c = rates(chi + h / 2 * b[0], p + h / 2)
            d = rates(chi + h * c[0], p + h)
            chi, v = (y + h / 6 * (ka + 2 * kb + 2 * kc + kd) for y, ka, kb, kc, kd in zip((chi, v), a, b, c, d))
            p += h
        return v, self.rho0 / (1 - chi)


def match(flyer, target, V):
    """Velocity of the interface: rho_t (c_t + s_t u) u = rho_f (c_f + s_f w) w, w = V - u. A quadratic of one admissible root."""
    a = target.rho0 * target.s - flyer.rho0 * flyer.s
    b = target.rho0 * target.c0 + flyer.rho0 * flyer.c0 + 2 * flyer.rho0 * flyer.s * V
    c = -flyer.rho0 * (flyer.c0 + flyer.s * V) * V
    return 2 * -c / (b + math.sqrt(b ** 2 - 4 * a * c))  # without a difference of close numbers, also for a = 0


SOIL = Solid(1800, 1500, 1.8, 1.2)        # a stiff clay, as in the other examples of the law
ALUMINIUM = Solid(2683, 5349, 1.338, 2.)  # 6061: rho0, c0, s from impact tables; Gamma0 assumed
CASES = {"identical": (SOIL, SOIL, 800.), "different": (ALUMINIUM, SOIL, 800.)}  # flyer, target, velocity [m/s]

if __name__ == "__main__":
    up = match(SOIL, SOIL, 800.)
    speed, p, rho, e = SOIL.hugoniot(up)
    surface, _ = SOIL.released(up)
    chi = 1 - SOIL.rho0 / rho
    u = match(ALUMINIUM, SOIL, 800.)
    checks.compare([
        ("identical plates: interface [m/s]", up, 400, 1e-14),
        ("shock velocity [m/s]", speed, 2220, 1e-14),
        ("pressure [Pa]", p, 1.5984e9, 1e-14),
        ("density [kg/m^3]", rho, 2195.604, 3e-7),
        ("energy [J/kg]", e, 80e3, 1e-14),
        ("the law on its Hugoniot [Pa]", SOIL.pressure(chi, e), p, 1e-14),
        ("free surface after the release, plain expansion [m/s]", replace(SOIL, plain_expansion=True).released(up)[0], 800.665, 6e-7),
        ("free surface with half the steps [m/s]", SOIL.released(up, 2000)[0], surface, 1e-6),
        ("different plates: both pressures agree", ALUMINIUM.hugoniot(800 - u)[1], SOIL.hugoniot(u)[1], 1e-13),
    ])
