"""Waves behind a piston in a soil with a compaction curve: shocks of the upper concave envelope. Standard library alone.

p(eps), eps = 1 - rho0/rho, through rows (density, pressure), straight in density between them. From rest to the final state take the upper
concave envelope of p over eps: every chord is a discontinuity of speed U = sqrt(dp/(rho0 deps)) per reference length, which raises the
velocity by dp/(rho0 U). Between rows p is convex in eps, so that the corners of the envelope are rows.

Run:  python3 reference.py          compares with stated waves, and the sand with its published table
"""
import math, sys
from dataclasses import dataclass
from pathlib import Path
sys.path.insert(0, str(Path(__file__).resolve().parents[1]))
import checks


@dataclass
class Wave:
    """One discontinuity: speed per reference length, and the state behind it."""
    U: float
    up: float
    p: float
    rho: float


class Soil:
    def __init__(self, rows):
        self.rows, self.rho0 = rows, rows[0][0]

    def density(self, p):
        for (r0, p0), (r1, p1) in zip(self.rows, self.rows[1:]):
            if p <= p1:
                return r0 + (p - p0) / (p1 - p0) * (r1 - r0)
        raise ValueError(f"{p} Pa is beyond the compaction curve")

    def waves(self, p_end):
        """The discontinuities to a final pressure, the fastest first."""
        strain = lambda rho: 1 - self.rho0 / rho
        points = [(strain(rho), p) for rho, p in self.rows if p < p_end] + [(strain(self.density(p_end)), p_end)]
        hull = []
        for point in points:  # keep what lies on the upper side
            while len(hull) > 1 and (hull[-1][1] - hull[-2][1]) * (point[0] - hull[-2][0]) <= \
                    (point[1] - hull[-2][1]) * (hull[-1][0] - hull[-2][0]):
                hull.pop()
            hull.append(point)
        waves, up = [], 0.
        for (e0, p0), (e1, p1) in zip(hull, hull[1:]):
            U = math.sqrt((p1 - p0) / (self.rho0 * (e1 - e0)))
            up += (p1 - p0) / (self.rho0 * U)
            waves.append(Wave(U, up, p1, self.rho0 / (1 - e1)))
        return waves

    def behind_piston(self, V):
        """The waves of a piston of velocity V, by bisection of the final pressure."""
        low, high = 0., self.rows[-1][1]
        for _ in range(200):
            middle = (low + high) / 2
            low, high = (middle, high) if self.waves(middle)[-1].up < V else (low, middle)
        return self.waves(high)

    def at(self, waves, X, t):
        """v, p, rho of the reference place X."""
        state = (0., 0., self.rho0)
        for wave in waves:
            if X < wave.U * t:
                state = (wave.up, wave.p, wave.rho)
        return state


KINKED = Soil([(1600., 0.), (1616., 2e6), (1920., 1e7), (3200., 1.61e9)])
# Sjobo sand, Laine and Sandvik (2001): density kg/m^3, pressure Pa
SAND = Soil([(1674, 0.), (1739.5, 4.577e6), (1873.8, 14.98e6), (1997, 29.151e6), (2143.8, 59.175e6), (2250, 98.098e6), (2380, 179.443e6),
             (2485, 289.443e6), (2585, 450.198e6), (2671.3, 650.66e6)])
# their table: density, pressure [MPa], piston [m/s], shock [m/s]; and their results with AUTODYN: density, pressure, shock
PUBLISHED = [(1739.5, 4.577, 10.15, 269.47, 1739, 4.57, 270), (1873.8, 14.98, 30.89, 289.70, 1874, 15.0, 290),
             (1997, 29.15, 53.07, 328.12, 1997, 29.1, 328), (2143.8, 59.18, 88.01, 401.63, 2144, 59.2, 402),
             (2250, 98.10, 122.48, 478.45, 2250, 98.1, 479), (2380, 179.4, 178.32, 601.13, 2381, 179.3, 601),
             (2485, 289.4, 237.55, 727.87, 2487, 288.9, 727), (2585, 450.2, 307.86, 873.56, 2590, 448.0, 869),
             (2671.3, 650.7, 380.94, 1020.35, 2671, 650.4, 1019)]
FINAL = {"one wave": 1e6, "precursor, slow shock": 5e6, "precursor, fast shock": 20e6, "overdriven": 200e6}

if __name__ == "__main__":
    rows = []
    for p, stated in ((1e6, [(354.436, None, None)]), (5e6, [(355.317, 3.51799, None), (169.524, 14.5783, 1730)]),
                      (20e6, [(355.317, 3.51799, None), (264.980, 45.9740, 1928)]), (200e6, [(740.762, 168.745, 2072)])):
        waves = KINKED.waves(p)
        rows.append((f"waves at {p:g} Pa", len(waves), len(stated), 0))
        for wave, (U, up, rho) in zip(waves, stated):
            rows.append((f"{p:g} Pa: speed", wave.U, U, checks.digits(U, 6)))
            if up:
                rows.append((f"{p:g} Pa: velocity", wave.up, up, checks.digits(up, 6)))
            if rho:
                rows.append((f"{p:g} Pa: density", wave.rho, rho, 1e-12))
        rows.append((f"{p:g} Pa from its piston", KINKED.behind_piston(waves[-1].up)[-1].p, p, 1e-12))
    for rho, p, up, Us, *_ in PUBLISHED:
        waves = SAND.behind_piston(up)
        rows += [(f"sand, {up} m/s: waves", len(waves), 1, 0), (f"sand, {up} m/s: shock velocity", waves[-1].U, Us, 1e-4),
                 (f"sand, {up} m/s: pressure", waves[-1].p, p * 1e6, 5e-4), (f"sand, {up} m/s: density", waves[-1].rho, rho, 5e-5)]
    checks.compare(rows)
