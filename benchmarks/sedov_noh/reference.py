"""Strong shocks in an ideal gas: Sedov's blast, Noh's implosion, a piston (Saltzmann). Needs numpy and scipy.

Run:  python3 reference.py          compares with the values of an independent calculation
"""
import math, sys
from pathlib import Path
sys.path.insert(0, str(Path(__file__).resolve().parents[1]))
import checks
import numpy
from scipy.integrate import solve_ivp


class Sedov:
    """Spherical blast of the energy E in gas of rho0 without pressure, self-similar in l = r/R(t):

        R = (E t^2/(alpha rho0))^(1/5),   v = Rdot f,   rho = rho0 g,   p = rho0 Rdot^2 h
        (f - l) g' + g f' + 2 g f/l = 0,   g ((f - l) f' - 3f/2) + h' = 0,   (f - l) h' + gamma h (f' + 2f/l) - 3h = 0
        l = 1:   f = h = 2/(gamma + 1),   g = (gamma + 1)/(gamma - 1)
        alpha = 16 pi/25 int_0^1 (g f^2/2 + h/(gamma - 1)) l^2 dl
    """
    smallest = 1e-2  # within, p is constant and v straight to 1e-9

    def __init__(self, gamma):
        self.gamma = gamma

        def rates(l, y):
            f, g, h, _ = y
            df = (3 * h - 2 * gamma * h * f / l - 1.5 * g * f * (f - l)) / (gamma * h - g * (f - l) ** 2)
            return df, -g * (df + 2 * f / l) / (f - l), -g * ((f - l) * df - 1.5 * f), -(g * f ** 2 / 2 + h / (gamma - 1)) * l ** 2
        front = 2 / (gamma + 1), (gamma + 1) / (gamma - 1), 2 / (gamma + 1), 0.
        self.profile = solve_ivp(rates, (1, self.smallest), front, method="DOP853", rtol=1e-12, atol=1e-30, dense_output=True)
        inside = self.profile.y[2, -1] / (gamma - 1) * self.smallest ** 3 / 3
        self.alpha = 16 * math.pi / 25 * (self.profile.y[3, -1] + inside)

    def radius(self, t, E=1., rho0=1.):
        return (E * t ** 2 / (self.alpha * rho0)) ** .2

    def at(self, r, t, E=1., rho0=1.):
        """v, rho, p at the radii r [m]."""
        r = numpy.asarray(r, float)
        R = self.radius(t, E, rho0)
        speed, l = .4 * R / t, r / R
        f, g, h, _ = self.profile.sol(numpy.clip(l, self.smallest, 1))
        f, g = (numpy.where(l < self.smallest, y * (l / self.smallest) ** n, y) for y, n in ((f, 1), (g, 3 / (self.gamma - 1))))
        return tuple(numpy.where(l <= 1, y, rest) for y, rest in ((speed * f, 0.), (rho0 * g, rho0), (rho0 * speed ** 2 * h, 0.)))


class Noh:
    """Gas without pressure that runs with the speed 1 towards a plane, an axis or a centre (hoops = 0, 1, 2), rho0 = 1."""

    def __init__(self, gamma, hoops):
        self.gamma, self.hoops = gamma, hoops
        self.speed = (gamma - 1) / 2
        self.rho = ((gamma + 1) / (gamma - 1)) ** (hoops + 1)
        self.p = self.rho * (gamma - 1) / 2  # e = 1/2

    def at(self, r, t):
        r = numpy.asarray(r, float)
        behind = r < self.speed * t
        ahead = (1 + t / r) ** self.hoops
        return numpy.where(behind, 0., -1.), numpy.where(behind, self.rho, ahead), numpy.where(behind, self.p, 0.)


class GasPiston:
    """Piston of velocity V into gas of p0: the jump relations of the ideal gas; U per reference length."""

    def __init__(self, gamma, V, rho0=1., p0=0.):
        quarter = (gamma + 1) * V / 4
        self.U = quarter + math.sqrt(quarter ** 2 + gamma * p0 / rho0)
        self.p = p0 + rho0 * self.U * V
        self.rho = rho0 * self.U / (self.U - V)


if __name__ == "__main__":
    rows = []
    stated = {1.4: (.851071855, 1.03277747, .365463, {.99: (.817812, .899715, .978726), .9: (.205366, .507711, .821810),
                                                      .7: (.022102, .375832, .603618), .5: (.0017185, .365878, .428677)}),
              5 / 3: (.493590150, 1.15166642, .306195, {.99: (.888685, .925102, .980179), .9: (.356284, .544661, .820279),
                                                        .7: (.075612, .340226, .575806), .5: (.015311, .309769, .401267)})}
    for gamma, (alpha, factor, centre, places) in stated.items():
        blast = Sedov(gamma)
        name = f"Sedov {gamma:.4g}"
        rows += [(f"{name}: alpha", blast.alpha, alpha, 1e-8), (f"{name}: R of E = t = 1", blast.radius(1), factor, 1e-8)]
        v1, rho1, p1 = (float(y) for y in blast.at(blast.radius(.9), .9))
        rows.append((f"{name}: p at the centre over p1", float(blast.at(0., .9)[2]) / p1, centre, 2e-6))
        for l, (rho, p, v) in places.items():
            found = blast.at(l * blast.radius(.9), .9)
            rows += [(f"{name}: {n} at {l} R", float(y) / y1, s, 4e-5) for n, y, y1, s in zip(("v", "rho", "p"), found, (v1, rho1, p1), (v, rho, p))]
        f, g, h, _ = blast.profile.sol(.6)
        rows.append((f"{name}: first integral at 0.6 R", h, (gamma - 1) * g * f ** 2 * (.6 - f) / (2 * (gamma * f - .6)), 1e-7))
        # mass of the blast by quadrature: what was in the sphere
        l = (numpy.arange(200000) + .5) / 200000
        rows.append((f"{name}: mass in the sphere", float((blast.at(l * blast.radius(1.), 1.)[1] * l ** 2).sum() / len(l)), 1 / 3, 1e-6))
    for hoops, (rho, p) in enumerate(((4, 4 / 3), (16, 16 / 3), (64, 64 / 3))):
        noh = Noh(5 / 3, hoops)
        rows += [(f"Noh, {hoops} hoop directions: density", noh.rho, rho, 1e-14), ("pressure", noh.p, p, 1e-14), ("speed", noh.speed, 1 / 3, 1e-14)]
        ahead = (1 + 1 / noh.speed) ** hoops
        rows.append(("mass across the shock", noh.rho * noh.speed, ahead * (noh.speed + 1), 1e-14))
        rows.append(("momentum across the shock", noh.p, ahead * (noh.speed + 1), 1e-14))
    piston = GasPiston(5 / 3, 1., p0=2 / 3 * 1e-4)
    rows += [("piston: speed", piston.U, 1.3334167, 3e-8), ("piston: pressure", piston.p, 1.3334833, 3e-8),
             ("piston: density", piston.rho, 3.9992502, 3e-8)]
    checks.compare(rows)
