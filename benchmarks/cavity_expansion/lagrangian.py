"""A second program for loaded spherical cavities at large strain: staggered Lagrangian scheme on a radius. Needs numpy.

It shares nothing with Arenite: velocities at nodes and half steps, stress in cells, forces from the power of each cell,

    power = -S_t Vdot - q V d_r,     d_r = (v_2 - v_1)/(r_2 - r_1),     Vdot = 4 pi (r_2^2 v_2 - r_1^2 v_1),     S = p + 2q/3 radial

with p = K1 mu + K2 mu^2 + K3 mu^3 (mu > 0), K1 mu (mu < 0), not below -T, and q = S_r - S_t from the logarithmic strains, returned to
|q| <= Ya + Yb p. `kirchhoff`: q rho0/rho has the constant modulus, as in the laws of Arenite; otherwise q itself.

Run:  python3 lagrangian.py         compares with nonlinear1.csv and nonlinear2.csv, which a third program computed with 7000 cells
"""
import csv, math, sys
from dataclasses import dataclass
from pathlib import Path
sys.path.insert(0, str(Path(__file__).resolve().parents[1]))
import checks
import numpy

FOLDER = Path(__file__).resolve().parent
RADII = (.1, .17, .24)  # receivers: the wall and two more [m]


@dataclass
class Case:
    K1: float = 80e6
    K2: float = 0.
    K3: float = 0.
    G: float = 40e6
    Ya: float = math.inf
    Yb: float = 0.
    T: float = math.inf
    rho0: float = 2000.
    a: float = .1
    b: float = 1.5
    end: float = 4e-3

    def load(self, t):
        raise NotImplementedError


class Stiffening(Case):
    """Rise in 0.3 ms with three continuous derivatives times exp(-1500 t), 4 MPa."""
    def load(self, t):
        x = min(1., t / 3e-4)
        return 4e6 * x ** 4 * (35 - 84 * x + 70 * x ** 2 - 20 * x ** 3) * math.exp(-1500 * t)


class Elastic(Case):
    """15 MPa sin^6(pi t/T), T = 1.5 ms."""
    def load(self, t):
        return 1.5e7 * math.sin(math.pi * t / 1.5e-3) ** 6 if t < 1.5e-3 else 0.


CASES = {"nonlinear1": Stiffening(K2=.8e9, K3=8e9, Ya=5e4, Yb=.9, T=5e4), "nonlinear2": Elastic()}


def run(case, cells, kirchhoff, courant=.4, linear=0., quadratic=1.):
    """t and u at the receivers, one row per step."""
    # cells that grow outwards with the radius: x of equal steps in r^(1/2)
    r = (math.sqrt(case.a) + (math.sqrt(case.b) - math.sqrt(case.a)) * numpy.linspace(0, 1, cells + 1)) ** 2
    R, v = r.copy(), numpy.zeros(cells + 1)
    mass = case.rho0 * 4 * math.pi / 3 * numpy.diff(r ** 3)
    nodes = numpy.zeros(cells + 1)  # row sums of linear functions
    h, left, right = numpy.diff(r), r[:-1], r[1:]
    first = case.rho0 * 4 * math.pi * h * (left ** 2 / 2 + left * h / 3 + h ** 2 / 12)
    nodes[:-1] += first
    nodes[1:] += mass - first
    Q = numpy.zeros(cells)  # the deviator as its rate has it
    p = q = bulk = numpy.zeros(cells)
    t, rows, dt_old = 0., [], 0.
    while t < case.end:
        h, volume = numpy.diff(r), 4 * math.pi / 3 * numpy.diff(r ** 3)
        rho = mass / volume
        mu = rho / case.rho0 - 1
        K = rho / case.rho0 * numpy.where(mu > 0, case.K1 + 2 * case.K2 * mu + 3 * case.K3 * mu ** 2, case.K1)
        c = numpy.sqrt((K + 4 / 3 * case.G) / rho)
        dt = courant * float((h / (c + 2 * abs(numpy.diff(v)))).min())
        dt = min(dt, 1.02 * dt_old if dt_old else dt)
        lateral = p - q / 3 + bulk
        shear = q * volume / h
        force = numpy.zeros(cells + 1)
        force[1:] += 4 * math.pi * r[1:] ** 2 * lateral + shear
        force[:-1] -= 4 * math.pi * r[:-1] ** 2 * lateral + shear
        force[0] += 4 * math.pi * r[0] ** 2 * case.load(t)
        v = v + force / nodes * (dt if not dt_old else (dt + dt_old) / 2) * (.5 if not dt_old else 1.)
        v[-1] = 0.
        middle = r + v * dt / 2
        rate = numpy.diff(v) / numpy.diff(middle)
        growth = numpy.log(numpy.diff((r + v * dt) ** 3) / numpy.diff(r ** 3))
        radial = rate * dt
        r = r + v * dt
        t += dt
        rho = mass / (4 * math.pi / 3 * numpy.diff(r ** 3))
        mu = rho / case.rho0 - 1
        p = numpy.maximum(numpy.where(mu > 0, mu * (case.K1 + mu * (case.K2 + mu * case.K3)), case.K1 * mu), -case.T)
        J = case.rho0 / rho if kirchhoff else 1.
        Q = Q + 2 * case.G * ((growth - radial) / 2 - radial)
        q = Q / J
        if math.isfinite(case.Ya):
            limit = numpy.maximum(0., case.Ya + case.Yb * p)
            q = numpy.clip(q, -limit, limit)
            Q = q * J
        D = numpy.minimum(0., numpy.diff(v))
        bulk = rho * (quadratic ** 2 * D ** 2 - linear * c * D)
        dt_old = dt
        rows.append((t, *(float(numpy.interp(x, R, r - R)) for x in RADII)))
    return numpy.array(rows)


def stored(name):
    with open(FOLDER / f"{name}.csv") as stream:
        return numpy.array([[float(x) for x in row] for row in list(csv.reader(stream))[1:]])


def distance(found, reference, column):
    """Relative L2 over time of the displacement in this column."""
    u = numpy.interp(reference[:, 0], found[:, 0], found[:, column])
    return float(numpy.sqrt(((u - reference[:, column]) ** 2).sum() / (reference[:, column] ** 2).sum()))


if __name__ == "__main__":
    rows = []
    for name, case in CASES.items():
        coarse, fine, law = run(case, 300, False), run(case, 600, False), run(case, 600, True)
        reference = stored(name)
        for column, radius in enumerate(RADII, 1):
            rows.append((f"{name}: u at {radius} m, 600 cells, to 7000 cells", distance(fine, reference, column), 0., 2e-4))
            print(f"   {name}: u at {radius} m: {distance(law, reference, column):.2e} for the law with Kirchhoff stress")
        rows.append((f"{name}: largest u at the wall [m]", float(fine[:, 1].max()), float(reference[:, 1].max()), 2e-4))
        rows.append((f"{name}: error at the wall, 300 cells over 600", distance(coarse, reference, 1) / distance(fine, reference, 1), 4., .1))
    checks.compare(rows)
