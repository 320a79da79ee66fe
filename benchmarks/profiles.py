"""Profiles of waves along a line: what a study asks receivers for, what it reads back, and their errors.

    settings = profiles.along(cells, upper=0.15, interval=9e-6)        # receivers at the middle of every cell of a line along x
    run      = study.run("plates.prm", {**settings, ...})
    profile  = profiles.read(run)                                      # profile.X, .x, .v, .S, .p, .rho at the last row
    error    = profile.l1(profile.v, exact_v)                          # relative, weighted with the volume
"""
import math
import numpy

NAME = "profile"


def along(cells, upper, lower=0., interval=None, parts=1, quantities="displacement, velocity, stress, density"):
    """Settings of receivers in the middle of `parts` parts of each of the equal cells, at the name 'profile'."""
    places = lower + (numpy.arange(cells * parts) + .5) * (upper - lower) / (cells * parts)
    settings = {f"Receivers/{NAME}/Directions": "1, 0, 0", f"Receivers/{NAME}/Radii": ", ".join(f"{x:.9g}" for x in places),
                f"Receivers/{NAME}/Quantities": quantities}
    if interval:
        settings[f"Receivers/{NAME}/Interval"] = interval
    return settings


class Profile:
    """Columns over the points. S axial and L lateral stress and p in compression [Pa]; X places in the reference, x at present [m]."""

    def __init__(self, time, X, u, v, stresses, rho, hoops):
        self.time, self.X, self.u, self.v, self.rho = time, X, u, v, rho
        self.x = X + u
        self.S, self.L = -stresses[0], -stresses[1]
        self.p = -sum(stresses) / 3
        self.hoops = hoops

    def volumes(self):
        """Present volumes of the parts, but for a constant factor: between the middles of neighbours, walls as far as they are known."""
        middles = (self.x[1:] + self.x[:-1]) / 2
        ends = numpy.concatenate([[max(0., 1.5 * self.x[0] - .5 * self.x[1]) if self.hoops else 1.5 * self.x[0] - .5 * self.x[1]],
                                  middles, [1.5 * self.x[-1] - .5 * self.x[-2]]])
        return numpy.diff(ends ** (self.hoops + 1))

    def l1(self, computed, exact, where=None):
        """sum |computed - exact| dV / sum |exact| dV"""
        weight = self.volumes() if where is None else self.volumes() * where
        return float((numpy.abs(computed - exact) * weight).sum() / (numpy.abs(exact) * weight).sum())

    def mean(self, values, low, high):
        """Mean of the values between two places of the reference: the plateau of a wave."""
        inside = (self.X > low) & (self.X < high)
        return float(values[inside].mean()) if inside.any() else math.nan

    def crossing(self, values, level, places=None):
        """The outermost place, of the reference or of `places`, where the values pass the level."""
        places = self.X if places is None else places
        above = values >= level
        if not above.any() or above[-1]:
            return math.nan
        i = int(numpy.nonzero(above)[0][-1])
        return float(places[i] + (values[i] - level) / (values[i] - values[i + 1]) * (places[i + 1] - places[i]))


def read(run, row=-1, rest=None, hoops=0):
    """The profile of one row; hoops: 0 plane, 1 axisymmetric along r, 2 spherical. rest: density of points without a column of it."""
    table = run.table(f"receivers-{NAME}.csv")
    places = run.directory / f"receivers-{NAME}-points.csv"
    with open(places) as stream:
        points = [line.split(",") for line in stream.read().splitlines()[1:]]
    names, X = [p[0].strip() for p in points], numpy.array([float(p[1]) for p in points])
    letters = {0: "xyz", 1: "rtz", 2: "rtp"}[hoops]

    def column(quantity):
        return numpy.array([table[f"{name}.{quantity}"][row] for name in names])

    stresses = [column(f"stress_{c}{c} [Pa]") for c in letters]
    rho = column("density [kg/m^3]") if f"{names[0]}.density [kg/m^3]" in table else rest
    return Profile(table["t [s]"][row], X, column(f"displacement_{letters[0]} [m]"), column(f"velocity_{letters[0]} [m/s]"),
                   stresses, rho, hoops)


def order(cells, errors):
    """Slope of log(error) over log(1/cells) by least squares: the observed order."""
    return float(-numpy.polyfit(numpy.log(cells), numpy.log(errors), 1)[0]) if len(cells) > 1 else math.nan


def relative(computed, exact):
    return computed / exact - 1
