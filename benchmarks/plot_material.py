#!/usr/bin/python3
"""Draw results of `arenite material`: paths in the q-p plane with the yield surface, stress against strain, pressure against density.

    benchmarks/plot_material.py output/material_oedometer.csv ... [-o figure.svg] [--labels "1 1/s, 1000 1/s"]

The yield surface of a viscoplastic cap is drawn from <result>_used.prm beside the first result, at rest and at the end.
"""
import argparse, csv, math, re, sys
from pathlib import Path

try:
    import matplotlib
    matplotlib.use("Agg")
    import matplotlib.pyplot as plt
except ImportError:
    sys.exit("the figures need matplotlib (Debian: apt-get install python3-matplotlib)")


def columns(file):
    """Name of a column with its unit -> list of numbers."""
    with open(file, newline="") as stream:
        lines = [line for line in csv.reader(stream) if line and not line[0].startswith("#")]
    return {name: [float(line[i]) for line in lines[1:]] for i, name in enumerate(lines[0])}


def without_unit(name):
    return name.split(" [")[0].strip()


def table(file):
    """Column name without unit -> list of numbers."""
    return {without_unit(name): numbers for name, numbers in columns(file).items()}


def entries(file):
    """Entry -> text, of all 'set Entry = text' lines."""
    found = re.findall(r"^\s*set\s+(.*?)\s*=\s*(.*?)\s*$", Path(file).read_text(), re.MULTILINE) if Path(file).exists() else []
    return dict(found)


class CapSurface:
    """The surface of include/arenite/materials/cap_surface.h."""

    def __init__(self, values):
        number = {name: float(text) for name, text in values.items() if re.fullmatch(r"[-+0-9.eE]+", text)}
        self.alpha, self.gamma = number["Failure alpha"], number["Failure gamma"]
        self.beta, self.theta = number["Failure beta"], number["Failure theta"]
        self.R, self.T, self.X0 = number["Cap axis ratio R"], number["Tension limit T"], number["Initial cap position X0"]
        F0, slope = self.failure(0.)
        n = F0 - 2 * slope * self.T
        self.C, self.B, self.r = slope * self.T**2 / n, math.sqrt(F0) * (F0 - slope * self.T) / math.sqrt(n), self.T / math.sqrt(F0 * n)
        self.F0, self.slope = F0, slope
        self.X_min = self.cap(0.)[0]

    def failure(self, I1):
        z = self.gamma * math.exp(-self.beta * I1)
        return self.alpha - z + self.theta * I1, self.beta * z + self.theta

    def cap(self, xi):
        """X, L, M, b, R of a junction."""
        if xi < 0:
            X = self.X_min + xi
            R = X / math.sqrt(self.F0**2 + 2 * X * self.F0 * self.slope)
            return X, 0., R**2 * self.F0 * self.slope, math.sqrt(self.F0**2 + (R * self.F0 * self.slope)**2), R
        F, slope = self.failure(xi)
        h = self.R * slope
        c = math.sqrt(1 + h * h)
        return xi + self.R * F * (h + c), xi, xi + self.R * F * h, F * c, self.R

    def junction(self, X):
        if X <= self.X_min:
            return X - self.X_min
        low, high = 0., X
        for _ in range(200):
            middle = .5 * (low + high)
            low, high = (low, middle) if self.cap(middle)[0] > X else (middle, high)
        return .5 * (low + high)

    def curve(self, xi, points=200):
        """p and q along the surface."""
        X, L, M, b, R = self.cap(xi)
        I1, j = [], []
        for i in range(points + 1):  # tension cut-off
            x = -self.T + self.T * (i / points)**2
            I1.append(x)
            j.append(math.sqrt(max(0., self.B**2 - ((x - self.C) / self.r)**2)))
        for i in range(1, points + 1):
            I1.append(L * i / points)
            j.append(self.failure(I1[-1])[0])
        for i in range(1, points + 1):
            x = X - (X - L) * (1 - i / points)**2
            I1.append(x)
            j.append(math.sqrt(max(0., b**2 - ((x - M) / R)**2)))
        return [x / 3e6 for x in I1], [math.sqrt(3) * y / 1e6 for y in j]


def driven(result):
    """The strain that varies most, with its stress."""
    spread = {k: max(result["eps" + k]) - min(result["eps" + k]) for k in ("11", "22", "33", "12", "13", "23")}
    return max(spread, key=spread.get)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("results", nargs="+", type=Path)
    parser.add_argument("-o", "--output", type=Path)
    parser.add_argument("--labels", default="", help="separated by commas")
    arguments = parser.parse_args()
    labels = [label.strip() for label in arguments.labels.split(",")] if arguments.labels else [f.stem for f in arguments.results]
    output = arguments.output or arguments.results[0].with_suffix(".svg")

    plt.rcParams["svg.fonttype"] = "none"
    plt.rcParams["svg.hashsalt"] = "arenite"
    figure, (plane, stress, volume) = plt.subplots(1, 3, figsize=(12, 3.8), constrained_layout=True)
    results = [table(file) for file in arguments.results]
    for result, label in zip(results, labels):
        k = driven(result)
        line, = plane.plot([p / 1e6 for p in result["p"]], [q / 1e6 for q in result["q"]], lw=1.3, label=label)
        stress.plot([-100 * e for e in result["eps" + k]], [-s / 1e6 for s in result["sigma" + k]], lw=1.3, label=label)
        volume.plot(result["density"], [p / 1e6 for p in result["p"]], lw=1.3, label=label)
    used = arguments.results[0].with_name(arguments.results[0].stem + "_used.prm")
    values = entries(used)
    if "Cap axis ratio R" in values and "cap junction" in results[0]:
        surface = CapSurface(values)
        plane.plot(*surface.curve(surface.junction(surface.X0)), color="0.6", lw=1, ls="--", label="surface at rest")
        plane.plot(*surface.curve(results[0]["cap junction"][-1]), color="0.4", lw=1, label="at the end")
    k = driven(results[0])
    plane.set(xlabel="p [MPa]", ylabel="q [MPa]")
    stress.set(xlabel=f"-eps{k} [%]", ylabel=f"-sigma{k} [MPa]")
    volume.set(xlabel="density [kg/m³]", ylabel="p [MPa]")
    for axes in (plane, stress, volume):
        axes.grid(alpha=.3)
    plane.legend(fontsize=8)
    figure.savefig(output, metadata={"Date": None} if output.suffix == ".svg" else None)
    print(output)


if __name__ == "__main__":
    main()
