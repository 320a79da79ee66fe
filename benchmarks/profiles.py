"""Profiles of waves along a line: what a study asks receivers for, what it reads back, and their errors.

    settings = profiles.along("surface", cells, upper=0.15, interval=9e-6)   # the receivers 'surface' to the middle of every cell along x
    run      = study.run("plates.prm", {**settings, ...})
    profile  = profiles.read(run, "surface")                                 # profile.X, .x, .v, .S, .p, .rho at the last row
    error    = profile.l1(profile.v, exact_v)                          # relative, weighted with the volume
"""
import math
import numpy


def line(dimension, length, cells, across=2):
    """Settings of a plane wave along x: a box of `cells`, in two and three dimensions a strip or a brick with square cells and sides that slide."""
    if dimension == 1:
        return {"Mesh/Upper corner": length, "Mesh/Cells": cells}
    sides = "yz"[:dimension - 1]
    width = f"{across * length / cells:.12g}"
    return {"Dimension": dimension, "Symmetry": {2: "plane strain", 3: "none"}[dimension],
            "Mesh/Upper corner": ", ".join([f"{length:.12g}"] + [width] * len(sides)),
            "Mesh/Cells": ", ".join([str(cells)] + [str(across)] * len(sides)),
            "Constraints/Symmetry planes": ", ".join(f"{a} {end}" for a in sides for end in ("min", "max"))}


def octant(layers, refinement):
    """Settings of a scene in a spherical shell: an octant of that many layers, with 2^(refinement + 1) cells along the quarter circle."""
    if layers % 2 ** refinement:
        raise ValueError(f"{layers} layers cannot be halved {refinement} times")
    return {"Dimension": 3, "Symmetry": "none", "Mesh/Radial layers": layers // 2 ** refinement, "Mesh/Refinement": refinement}


def along(name, cells, upper, lower=0., interval=None, parts=1, quantities="displacement, velocity, stress, density", direction="1, 0, 0"):
    """Settings that move the receivers `name` of a scene to the middle of `parts` parts of each of the equal cells."""
    places = lower + (numpy.arange(cells * parts) + .5) * (upper - lower) / (cells * parts)
    return at(name, places, interval, quantities, direction)


def at(name, places, interval=None, quantities="displacement, velocity, stress, density", direction="1, 0, 0"):
    """The same at given distances from the origin."""
    settings = {f"Receivers/{name}/Points": "", f"Receivers/{name}/Directions": direction,
                f"Receivers/{name}/Radii": ", ".join(f"{x:.9g}" for x in places), f"Receivers/{name}/Quantities": quantities}
    if interval:
        settings[f"Receivers/{name}/Interval"] = interval
    return settings


class Profile:
    """Columns over the points. S axial stress and p in compression [Pa]; X distances in the reference, x at present [m]. Volumes grow with
    x^power: 0 along a line, 1 from an axis, 2 from a point."""

    def __init__(self, time, X, u, v, S, p, rho, power):
        self.time, self.X, self.u, self.v, self.S, self.p, self.rho, self.power = time, X, u, v, S, p, rho, power
        self.x = X + u
        self.q = 1.5 * (S - p)  # axial less lateral stress, where the lateral ones are equal

    def volumes(self):
        """Present volumes of the parts, but for a constant factor, between the middles of neighbours."""
        ends = numpy.concatenate([[1.5 * self.x[0] - .5 * self.x[1]], (self.x[1:] + self.x[:-1]) / 2,
                                  [1.5 * self.x[-1] - .5 * self.x[-2]]])
        if self.power:
            ends = numpy.maximum(ends, 0.)
        return numpy.diff(ends ** (self.power + 1))

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


def read(run, name, row=-1, rest=None, power=0, direction=None):
    """The profile of one row. rest: density of points without a column of it. direction: number of that of the points, from 1; by default all are of one."""
    table = run.table(f"receivers-{name}.csv")
    with open(run.directory / f"receivers-{name}-points.csv") as stream:
        points = [line.split(",") for line in stream.read().splitlines()[1:]]
    points = [point for point in points if direction is None or point[0].strip().startswith(f"d{direction}r")]
    names, places = [p[0].strip() for p in points], numpy.array([[float(x) for x in p[1:4]] for p in points])
    X = numpy.sqrt((places ** 2).sum(axis=1))
    space = [c for c in "xyzr" if f"{names[0]}.velocity_{c} [m/s]" in table]
    if space[-1] == "r":  # a radius, or a meridian plane with z second
        space = ["r"] + (["z"] if "z" in space else [])
    n = places[-1] / X[-1]  # in the coordinates of the mesh

    def column(quantity):
        return numpy.array([table[f"{name}.{quantity}"][row] for name in names])

    def along_line(quantity, unit):
        return sum(n_i * column(f"{quantity}_{c} [{unit}]") for n_i, c in zip(n, space))

    def stress(a, b):
        for pair in (a + b, b + a):
            if f"{names[0]}.stress_{pair} [Pa]" in table:
                return column(f"stress_{pair} [Pa]")
        return numpy.zeros(len(names))  # vanishes in this form

    S = -sum(n_i * n_j * stress(a, b) for n_i, a in zip(n, space) for n_j, b in zip(n, space))
    p = -sum(stress(c, c) for c in "xyzrtp") / 3
    rho = column("density [kg/m^3]") if f"{names[0]}.density [kg/m^3]" in table else rest
    return Profile(table["t [s]"][row], X, along_line("displacement", "m"), along_line("velocity", "m/s"), S, p, rho, power)


def order(cells, errors):
    """Slope of log(error) over log(1/cells) by least squares: the observed order."""
    return float(-numpy.polyfit(numpy.log(cells), numpy.log(errors), 1)[0]) if len(cells) > 1 else math.nan


def relative(computed, exact):
    return computed / exact - 1


def line_and_brick(measure, row, dimensions=(1, 3)):
    """The cells of `row`, a line, in several dimensions: the same numbers, if the steps are the same. They are a sixth of those of the row, which
    all forms can take. measure(dimension, steps) adds a row."""
    rows = [measure(dimension, 6 * row["steps"]) for dimension in dimensions]
    for dimension, other in zip(dimensions[1:], rows[1:]):
        other["off_1_D"] = relative(other["error"], rows[0]["error"])
        print(f"  error in {dimension}-D over that in 1-D: 1 {other['off_1_D']:+.1e}", flush=True)


def equal_steps(end, steps):
    """Settings of so many steps; none for the scene's own."""
    return {"Time stepping/Fixed step": f"{end / steps:.15g}"} if steps else {}


def form(dimension, steps):
    """What the name of a row says about these."""
    return (", equal steps" if steps else "") + (f", {dimension}-D" if dimension > 1 else "")
