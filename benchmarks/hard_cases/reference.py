"""Known answers of the hard cases: impedance match of two soils, plate in soil, spall. `python3 reference.py` checks them."""
import math
import sys


def root(f, low, high):
    """Zero of a rising or falling function by bisection."""
    sign = f(low) > 0
    for _ in range(200):
        middle = .5 * (low + high)
        low, high = (middle, high) if (f(middle) > 0) == sign else (low, middle)
    return .5 * (low + high)


class DrySand:
    """p(rho) of first loading, linear between the rows of interface.prm."""
    ROWS = ((1674, 0), (1739.5, 4.577e6), (1873.8, 14.98e6), (1997, 29.151e6), (2143.8, 59.175e6), (2250, 98.098e6), (2380, 179.443e6),
            (2485, 289.443e6), (2585, 450.198e6), (2671.3, 650.66e6))
    rho0 = 1674.

    def density(self, p):
        for (a, pa), (b, pb) in zip(self.ROWS, self.ROWS[1:]):
            if p <= pb:
                return a + (b - a) * (p - pa) / (pb - pa)
        return math.nan


class SaturatedSand:
    """V(p) of water and grains, 'three phase mixture' at porosity 0.4."""
    PHASES = (.4, 2.2e9, 7.), (.6, 36.6e9, 3.)
    rho0 = .4 * 1000. + .6 * 2650.

    def density(self, p):
        return self.rho0 / sum(a * (1. + g * p / K) ** (-1. / g) for a, K, g in self.PHASES)

    def released(self, p_high, p_low, n=2000):
        """int dp/(rho c) by Simpson's rule."""
        h = (p_high - p_low) / n
        slope = lambda p: (1. / self.density(p - 1e3) - 1. / self.density(p + 1e3)) / 2e3  # - dv/dp
        return h / 3. * sum((1 if i in (0, n) else 4 if i % 2 else 2) * math.sqrt(slope(p_low + i * h)) for i in range(n + 1))


def jump(soil, p, p_ahead=0.):
    """Change of velocity in a shock from p_ahead to p."""
    return math.sqrt((p - p_ahead) * (1. / soil.density(p_ahead) - 1. / soil.density(p)))


def match(first, V):
    """Pressure behind a piston in the first soil; pressure and velocity of the interface with the other one."""
    dry, saturated = DrySand(), SaturatedSand()
    if first == "dry":
        p1 = root(lambda p: jump(dry, p) - V, 1e3, 6e8)
        p2 = root(lambda p: jump(saturated, p) - (V - jump(dry, p, p1)), p1 * (1 + 1e-12), 6.5e8)
        return p1, p2, jump(saturated, p2)
    p1 = root(lambda p: jump(saturated, p) - V, 1e3, 5e9)
    p2 = root(lambda p: jump(dry, p) - (V + saturated.released(p1, p)), 1e4, min(p1, 6.5e8))
    return p1, p2, jump(dry, p2)


def plate(t, pressure, impedance, mass):
    """Velocity behind a plate at the time t after the wave has come."""
    return pressure / impedance * (1. - math.exp(-2. * impedance * t / mass)) if t > 0 else 0.


if __name__ == "__main__":
    good = True
    for first, V in (("dry", 100.), ("saturated", 50.)):
        p1, p2, u = match(first, V)
        soil = {"dry": DrySand(), "saturated": SaturatedSand()}[first]
        U = p1 / (soil.rho0 * V)  # momentum; and with it mass:
        good &= abs(soil.rho0 * U / (U - V) / soil.density(p1) - 1.) < 1e-9
        print(f"{first}: {p1 / 1e6:.4f} MPa behind the piston, {p2 / 1e6:.4f} MPa and {u:.4f} m/s at the interface")
    soil, p = SaturatedSand(), 1e5  # a weak release has the impedance at rest; the modulus grows by 7 p
    impedance = math.sqrt(soil.rho0 / (.4 / 2.2e9 + .6 / 36.6e9))
    good &= abs(soil.released(p, 0.) * impedance / p - 1.) < 1e-3
    print("checked" if good else "the reference disagrees with itself")
    sys.exit(not good)
