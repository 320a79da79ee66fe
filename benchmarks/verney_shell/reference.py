"""Verney's shell: velocity that an incompressible, perfectly plastic shell needs to come to rest at a chosen radius. Standard library alone.

    v = -u0 (Ri/r)^2 at t = 0:  2 pi rho u0^2 Ri^4 (1/Ri - 1/Ro) = (8 pi Y/3) [Ro^3 ln Ro - Ri^3 ln Ri - ro^3 ln ro + ri^3 ln ri],
    ro^3 - ri^3 = Ro^3 - Ri^3

Run:  python3 reference.py          compares with stated velocities, and the plastic work with its integral
"""
import math, sys
from dataclasses import dataclass
from pathlib import Path
sys.path.insert(0, str(Path(__file__).resolve().parents[1]))
import checks


@dataclass
class Shell:
    Ri: float
    Ro: float
    rho: float
    Y: float

    def outer(self, ri):
        return (self.Ro ** 3 - self.Ri ** 3 + ri ** 3) ** (1 / 3)

    def work(self, ri):
        """Plastic work from rest to the inner radius ri [J]; every point is sheared monotonically, q = Y."""
        term = lambda r: r ** 3 * math.log(r)
        return 8 * math.pi * self.Y / 3 * (term(self.Ro) - term(self.Ri) - term(self.outer(ri)) + term(ri))

    def velocity(self, ri):
        return math.sqrt(self.work(ri) / (2 * math.pi * self.rho * self.Ri ** 4 * (1 / self.Ri - 1 / self.Ro)))

    def work_by_integral(self, ri, n=20000):
        """Y times the equivalent plastic strain 2 |ln(r/R)| of each layer, midpoint rule."""
        h, whole = (self.Ro - self.Ri) / n, 0.
        for i in range(n):
            R = self.Ri + (i + .5) * h
            r = (R ** 3 - self.Ri ** 3 + ri ** 3) ** (1 / 3)
            whole += 4 * math.pi * R ** 2 * h * self.Y * 2 * abs(math.log(r / R))
        return whole


BERYLLIUM = Shell(.08, .10, 1845, 330e6)  # like beryllium; recalled values, not a published problem
METAL = Shell(.05, .06, 2700, 300e6)

if __name__ == "__main__":
    rows = []
    for ri, u0, ro, energy in ((.05, 545.1447, .0849481, .352777e6), (.04, 619.7871, .0820313, .455996e6), (.03, 675.0365, .0801559, .540917e6)):
        rows += [(f"ri = {ri}: u0", BERYLLIUM.velocity(ri), u0, 2e-7), ("ro", BERYLLIUM.outer(ri), ro, 1e-6),
                 ("plastic work [J]", BERYLLIUM.work(ri), energy, 2e-6), ("by its integral", BERYLLIUM.work_by_integral(ri), BERYLLIUM.work(ri), 1e-7)]
    rows += [("second shell: u0", METAL.velocity(.03), 445.0691, 2e-7), ("ro", METAL.outer(.03), .0490487, 1e-6)]
    checks.compare(rows)
