"""Estimates for Taylor's bar, perfectly plastic, against a rigid wall. Standard library alone.

    Wilkins and Guinan (no moving front, a lower bound):  L = L0 exp(-rho V^2/(2 Y))
    Hawkyard: with the strain e of the foot from rho v^2/(2 Y) = ln(1/(1 - e)) - e, the rigid length l and the plastic length h follow
              dl/dv = rho l v/(e Y),   dh/dv = -rho l v (1 - e)/(e Y)  from V to rest;  L = l + h,  area of the foot over A0: 1/(1 - e)

Run:  python3 reference.py          compares with stated lengths
"""
import math, sys
from dataclasses import dataclass
from pathlib import Path
sys.path.insert(0, str(Path(__file__).resolve().parents[1]))
import checks


@dataclass
class Bar:
    length: float
    radius: float
    rho: float
    V: float
    Y: float

    def wilkins_guinan(self):
        return self.length * math.exp(-self.rho * self.V ** 2 / (2 * self.Y))

    def strain(self, v):
        """e of the foot, by bisection."""
        target, low, high = self.rho * v ** 2 / (2 * self.Y), 0., 1 - 1e-12
        for _ in range(100):
            e = (low + high) / 2
            low, high = (e, high) if -math.log(1 - e) - e < target else (low, e)
        return e

    def hawkyard(self, steps=4000):
        """Rigid and plastic length at rest, and the area of the foot over the first one; midpoint rule in v."""
        l, h, dv = self.length, 0., self.V / steps
        for i in range(steps):
            v = self.V - (i + .5) * dv
            e = self.strain(v)
            thin = l * math.exp(-self.rho * v * dv / (e * self.Y))
            h += (l - thin) * (1 - e)
            l = thin
        return l, h, 1 / (1 - self.strain(self.V))


COPPER = Bar(.0324, .0032, 8930, 227, 400e6)
CASES = {"copper": COPPER, "copper, 450 MPa": Bar(.0324, .0032, 8930, 227, 450e6), "OFHC copper": Bar(.0254, .00381, 8960, 190, 300e6),
         "steel": Bar(.0254, .00381, 7850, 250, 800e6)}

if __name__ == "__main__":
    rows = []
    for (name, bar), (wilkins, total, l, h, foot) in zip(CASES.items(), ((18.23, 20.27, 8.80, 11.47, 3.68), (19.43, 21.30, 9.62, 11.68, 3.37),
                                                                        (14.82, 16.34, 7.25, 9.09, 3.50), (18.69, 19.62, 10.33, 9.29, 2.46))):
        found = bar.hawkyard()
        rows += [(f"{name}: Wilkins-Guinan [mm]", 1e3 * bar.wilkins_guinan(), wilkins, 1e-3),
                 ("Hawkyard, total [mm]", 1e3 * (found[0] + found[1]), total, 1e-3), ("rigid [mm]", 1e3 * found[0], l, 2e-3),
                 ("plastic [mm]", 1e3 * found[1], h, 2e-3), ("foot over first area", found[2], foot, 2e-3)]
    checks.compare(rows)
