"""Elastic-plastic waves behind a piston: loading, release, reverse yield. Standard library alone.

Small strain, |q| <= Ya + Yb p without dilatancy, p = K eps, q = S_axial - S_lateral, compression positive:

    ce^2 = (K + 4G/3)/rho,  cp^2 = K (1 + 2Yb/3)/rho,  cm^2 = K (1 - 2Yb/3)/rho  (reverse yield)

Run:  python3 reference.py          compares with the values of an independent calculation, and each state with the law
"""
import math, sys
from dataclasses import dataclass
from pathlib import Path
sys.path.insert(0, str(Path(__file__).resolve().parents[1]))
import checks


@dataclass
class Zone:
    """A constant state [Pa, m/s, -]: axial stress, velocity, strain, p, q, all compression positive."""
    S: float
    v: float
    eps: float
    p: float
    q: float


@dataclass
class Piston:
    K: float
    G: float
    rho: float
    Ya: float
    Yb: float
    V: float   # velocity of the loaded end [m/s]
    t1: float  # its traction is taken away [s]

    def __post_init__(self):
        K, G, rho, Ya, Yb, V = self.K, self.G, self.rho, self.Ya, self.Yb, self.V
        M = K + 4 * G / 3
        self.ce, self.cp, self.cm = math.sqrt(M / rho), math.sqrt(K * (1 + 2 * Yb / 3) / rho), math.sqrt(K * (1 - 2 * Yb / 3) / rho)
        eps = Ya / (2 * G - Yb * K)
        self.yielding = Zone(M * eps, M * eps / (rho * self.ce), eps, K * eps, 2 * G * eps)
        S, v = self.yielding.S + rho * self.cp * (V - self.yielding.v), V
        eps += (V - self.yielding.v) / self.cp
        self.loaded = Zone(S, v, eps, K * eps, Ya + Yb * K * eps)
        self.elastic_end = 2 * self.loaded.q / (2 * G + Yb * K)  # strain that is given back until q = -(Ya + Yb p)
        part = min(1., S / (M * self.elastic_end))
        eps -= part * self.elastic_end
        self.unloaded = Zone(S - M * part * self.elastic_end, V - M * part * self.elastic_end / (rho * self.ce), eps, K * eps,
                             self.loaded.q - 2 * G * part * self.elastic_end)
        S, v = self.unloaded.S, self.unloaded.v
        eps -= S / (rho * self.cm ** 2)
        self.reversed = Zone(0., v - S / (rho * self.cm), eps, K * eps, -(Ya + Yb * K * eps)) if part == 1. else self.unloaded
        self.t_end = self.t1 * self.ce / (self.ce - self.cp)  # the elastic release meets the plastic front
        self.x_end = self.ce * (self.t_end - self.t1)
        self.at_rest = Zone(0., 0., 0., 0., 0.)

    def fronts(self, t):
        """Places of the four waves [m], from the loaded end outwards; those of the release only after t1."""
        late = max(0., t - self.t1)
        return self.cm * late, self.ce * late, self.cp * t, self.ce * t

    def zones(self):
        return self.reversed, self.unloaded, self.loaded, self.yielding, self.at_rest

    def at(self, x, t):
        assert t < self.t_end
        return self.zones()[sum(x > front for front in self.fronts(t))]

    def scaled(self, factor):
        """The same problem with `factor` times its stresses, velocities and strains; the times stay."""
        return Piston(self.K, self.G, self.rho, factor * self.Ya, self.Yb, factor * self.V, self.t1)

    def time_of_profile(self):
        return (self.t1 + self.t_end) / 2


CASES = {"Mises": Piston(160e9, 80e9, 7850, 1e9, 0, 120, 1e-5),
         "Drucker-Prager": Piston(100e6, 60e6, 1800, 1e5, .6, 10, 1e-3)}

STATED = {  # ce, cp, cm; S_H, v_H; S1; S2, v2; v3, eps3, p3; t*, x*
    "Mises": (5828.4025, 4514.6612, 4514.6612, 1.6666667e9, 36.427516, 4.6284831e9, 1.2951497e9, 47.144968, 10.600205, .0041666667,
              6.6666667e8, 44.36492e-6, .20029257),
    "Drucker-Prager": (316.22777, 278.88668, 182.57419, 3e5, .52704628, 5.0553850e6, 579340.72, 2.1363917, .37351404, .0011111111,
                       1.1111111e5, 8.468627e-3, 2.3617872)}

if __name__ == "__main__":
    rows = []
    for name, piston in CASES.items():
        H, one, two, three = piston.yielding, piston.loaded, piston.unloaded, piston.reversed
        computed = (piston.ce, piston.cp, piston.cm, H.S, H.v, one.S, two.S, two.v, three.v, three.eps, three.p, piston.t_end,
                    piston.x_end)
        names = "ce cp cm S_H v_H S1 S2 v2 v3 eps3 p3 t* x*".split()
        rows += [(f"{name}, {n}", c, s, checks.digits(s, 7)) for n, c, s in zip(names, computed, STATED[name])]
        for label, zone in zip(("reverse yield", "released", "loaded", "at yield"), piston.zones()):
            limit = piston.Ya + piston.Yb * zone.p
            rows.append((f"{name}, {label}: |q| on the yield surface", abs(zone.q), limit, 1e-12))
            rows.append((f"{name}, {label}: S = p + 2q/3", zone.p + 2 * zone.q / 3, zone.S, 1e-12 if zone.S else 1e-6 * one.S))
        for a, b, c in ((piston.at_rest, H, piston.ce), (H, one, piston.cp), (one, two, -piston.ce), (two, three, -piston.cm)):
            rows.append((f"{name}: momentum across a front", b.S - a.S, piston.rho * abs(c) * (b.v - a.v), 1e-12))
            rows.append((f"{name}: mass across a front", b.v - a.v, abs(c) * (b.eps - a.eps), 1e-12))
    checks.compare(rows)
