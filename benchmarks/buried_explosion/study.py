"""Gas at high pressure in a buried cavity in cap soil under its own weight: heave, spall, momentum, attenuation. See README.md."""
import math, sys
from pathlib import Path
sys.path.insert(0, str(Path(__file__).resolve().parents[1]))
import common
import numpy

study = common.Study(__file__)
SCENE = study.folder.parents[1] / "prm" / "buried_explosion.prm"
RADII = (.1, .15, .2, .3, .4, .5, .7, .9)  # of the receivers 'below' [m]
FAR = [i for i, r in enumerate(RADII) if r >= .2]
GAS, LAW, WATER = "Loads/gas/Initial pressure", "Materials/soil/Law", "Materials/soil/Soil state/Saturation"
POROSITY, GRAINS = .4, 2.65  # of all scenes; density of the grains over that of water


def wet(saturation):
    return {LAW: "undrained cap", WATER: saturation} if saturation else {}


SOILS = {"dry": 0, "wet, half of the pores": .5, "wet, 90 % of the pores": .9, "wet, 98 % of the pores": .98, "saturated": 1}
MESH = study.choose((2,), quick=(1,))[0]
STEP = .01
AXIS = numpy.arange(.3 + STEP / 2, 1., STEP)  # heights above the centre over the depth, where the soil may part
PARTED = 1e-4  # strain by which the tension cut-off has opened soil that counts as parted
A = .1  # radius of the cavity [m]
tables = {}


def add(table, **row):
    tables.setdefault(table, []).append(row)
    print("  " + table + ": " + ", ".join(f"{name} {common.text(value)}" for name, value in row.items()), flush=True)


# --- one run --------------------------------------------------------------------------------------------------------------
class Explosion:
    """One run and what it says about the ground."""

    def __init__(self, depth=1., refinement=MESH, **settings):
        space = settings.get("Dimension") == 3
        outer = max(2., 1.5 * depth)
        corner = lambda r, z: f"{r:.6g}, {r:.6g}, {z:.6g}" if space else f"{r:.6g}, {z:.6g}"
        self.depth, self.full = depth, 4 if space else 1  # the quarter
        run = self.run = study.run(SCENE, {
            "Mesh/Depth": depth, "Mesh/Outer distance": outer, "Mesh/Refinement": refinement, "Output/VTU interval": 0,
            "Receivers": "surface, below, axis, wall, far, layer, body",
            "Receivers/surface/Points": "; ".join(f"{r}, 0, {depth:.6g}" for r in (0, .25, .5, 1, 1.5)),
            "Receivers/axis/Points": "; ".join(f"0, 0, {depth * z:.6g}" for z in AXIS), "Receivers/axis/Quantities": "history",
            "Receivers/axis/Interval": 1e-3, "Receivers/below/Directions": "1, 0, 0; 0, 0, -1",
            "Receivers/layer/Corner": corner(0, .75 * depth), "Receivers/layer/Opposite corner": corner(.25 * depth, depth),
            "Receivers/body/Corner": corner(0, -outer), "Receivers/body/Opposite corner": corner(outer, depth),
            "Loads/weight/Acceleration": "0, 0, -9.81" if space else "0, -9.81", **settings}, repeat=1)
        surface, below, axis = ({name: numpy.array(values) for name, values in run.table(f"receivers-{file}.csv").items()}
                                for file in ("surface", "below", "axis"))
        t = surface["t [s]"]
        up = [surface[f"p{i}.velocity_z [m/s]"] for i in range(1, 6)]
        self.v = [float(v.max()) for v in up]  # at five distances from the axis
        self.uplift = [1e3 * float(surface[f"p{i}.displacement_z [m]"][-1]) for i in range(1, 6)]
        self.arrival = 1e3 * float(t[numpy.argmax(up[0] > .05 * up[0].max())])
        self.peaks = {}
        for d in (1, 2):  # sideways and downwards
            parts = [[below[name] for name in below if name.startswith(f"d{d}r{i + 1}.velocity")] for i in range(len(RADII))]
            self.peaks[d] = [float(numpy.sqrt(sum(part ** 2 for part in point)).max()) for point in parts]
        volume = run.column("statistics.csv", "gas: gas volume (full body) [m^3]")
        self.volume = volume[-1] / volume[0]
        self.spall(axis)
        self.momentum()

    def exponent(self, direction):
        return float(-numpy.polyfit(numpy.log([RADII[i] for i in FAR]), numpy.log([self.peaks[direction][i] for i in FAR]), 1)[0])

    def spall(self, axis):
        """The soil that the tension cut-off has opened above the charge, and the part of it that still opens in the last millisecond."""
        opened = numpy.array([axis[name] for name in axis if name.endswith("separation")])  # volume strain, point by point over time
        last = int(numpy.searchsorted(axis["t [s]"], axis["t [s]"][-1] - .9e-3)) - 1

        def below_surface(parts):
            """Thickness of the layer from the lowest of them on [m]."""
            return self.depth * float(1 - AXIS[numpy.argmax(parts)] + STEP / 2) if parts.any() else 0.

        self.parted = below_surface(opened[:, -1] > PARTED)
        self.opening = below_surface(opened[:, -1] - opened[:, last] > PARTED)
        self.opened = 1e3 * self.depth * STEP * float(opened[:, -1].sum())  # integral along the axis [mm]

    def momentum(self):
        """Impulses of the whole run through wall, outer boundary and weight, and the momentum that they must be [N s], of the full body."""
        wall, far, layer, body = (self.run.table(f"receivers-{name}.csv") for name in ("wall", "far", "layer", "body"))
        last = lambda table, name: next(values[-1] for column, values in table.items() if column.startswith(name))
        weight = -9.81 * last(body, "mass") * last(body, "t [s]")
        through_wall, through_far, found = last(wall, "impulse_z"), last(far, "impulse_z"), last(body, "momentum_z")
        self.balance = abs(through_wall + through_far + weight - found) / max(abs(weight), abs(through_far))
        self.impulse_on_wall, self.impulse_far = (last(table, "impulse per area") / 1e3 for table in (wall, far))
        self.up, self.far, self.weight = (1e-3 * self.full * value for value in (found, through_far, weight))
        self.layer_momentum = 1e-3 * self.full * last(layer, "momentum_z")
        self.layer_velocity = last(layer, "momentum_z") / last(layer, "mass")


def explode(title, table, columns=None, **settings):
    """A run, and its rows in the tables of motion and of momentum."""
    case = Explosion(**settings)
    row = {"case": title, **(columns or {}), "cells": case.run["cells"], "v at 0": case.v[0], "v at 1 m": case.v[3], "arrival [ms]": case.arrival,
           "uplift at 0 [mm]": case.uplift[0], "uplift at 1 m [mm]": case.uplift[3], "volume ratio": case.volume, "parted [m]": case.parted,
           "still opening [m]": case.opening, "v of the layer": case.layer_velocity, "n sideways": case.exponent(1), "n down": case.exponent(2),
           "energy error": case.run["energy_error"]}
    add(table, **row)
    add("momentum", case=title, **{"on the wall [kPa s]": case.impulse_on_wall, "on the far field [kPa s]": case.impulse_far,
                                   "far field [kN s]": case.far, "weight [kN s]": case.weight, "momentum [kN s]": case.up,
                                   "of the layer [kN s]": case.layer_momentum, "v of the layer [m/s]": case.layer_velocity, "balance": case.balance})
    study.add(table, case.run, case.run["energy_error"], case=title)
    return case


# --- meshes -----------------------------------------------------------------------------------------------------------------
QUANTITIES = {"v at 0 [m/s]": lambda c: c.v[0], "v at 0.5 m [m/s]": lambda c: c.v[2], "v at 1 m [m/s]": lambda c: c.v[3],
              "uplift at 0 [mm]": lambda c: c.uplift[0], "uplift at 0.5 m [mm]": lambda c: c.uplift[2], "uplift at 1 m [mm]": lambda c: c.uplift[3],
              "arrival [ms]": lambda c: c.arrival, "volume ratio": lambda c: c.volume, "impulse on the wall [kPa s]": lambda c: c.impulse_on_wall,
              "parted layer [m]": lambda c: c.parted, "still opening [m]": lambda c: c.opening, "opened along the axis [mm]": lambda c: c.opened,
              "v of the layer [m/s]": lambda c: c.layer_velocity, "largest v at 5 a sideways [m/s]": lambda c: c.peaks[1][5],
              "n sideways": lambda c: c.exponent(1)}
TO_A_CELL = ("parted layer [m]", "still opening [m]")  # ends of cells: no order, no limit


def meshes():
    for soil, refinements in study.choose((("dry", (1, 2, 3, 4)), ("saturated", (1, 2, 3))), quick=(("dry", (0, 1)),)):
        cases = [Explosion(refinement=r, **wet(SOILS[soil])) for r in refinements]
        for case in cases:
            study.add(f"meshes, {soil}", case.run, case.run["energy_error"], case=f"{case.run['cells']} cells")
        for name, of in QUANTITIES.items():
            values = [of(case) for case in cases]
            row = {"soil": soil, "quantity": name, **{f"on {case.run['cells']}": f"{value:.4g}" for case, value in zip(cases, values)}}
            if name in TO_A_CELL:
                row["order"] = "known to a cell"
            elif len(values) > 2:
                order, limit, bar = common.richardson(values)
                row.update({"order": order, "limit": f"{limit:.4g}", "bar [%]": 100 * bar / abs(limit)})
            add(f"meshes, {soil}", **row)


# --- attenuation --------------------------------------------------------------------------------------------------------------
DEEP = (.2, .5, 1., 2., 4., 8.)  # ends of the ranges of the exponents [m]
LARGE = {"dry": 0, "wet": .5, "nearly saturated": .98, "saturated": 1}
CHARGE = "C-4, 11 GPa"


def deep(soil, source, settings):
    """Exponents of the largest velocity on the radius, over distances with a factor of 2 or 2.5."""
    run = study.run("deep_charge.prm" if source.startswith(CHARGE) else "deep_gas.prm", {**settings, **wet(LARGE[soil])}, repeat=1)
    table = run.table("receivers-array.csv")
    places = [float(line.split(",")[1]) for line in (run.directory / "receivers-array-points.csv").read_text().splitlines()[1:]]
    peaks = {r: max(abs(v) for v in table[f"d1r{i + 1}.velocity_r [m/s]"]) for i, r in enumerate(places)}
    n = lambda a, b: -math.log(peaks[b] / peaks[a]) / math.log(b / a)
    energy = run.column("statistics.csv", "gas: gas energy (full body) [J]")[0]
    law_from = .4 * (energy / 9.0e9 * 1601) ** (1 / 3)  # [m]; mass of C-4 with the same energy: 9 GJ and 1601 kg per cubic metre
    add("attenuation", soil=soil, source=source, **{"law from [a]": law_from / A, "v at 2 a [m/s]": peaks[.2], "v at 10 a [m/s]": peaks[1.]},
        **{f"{a / A:g} to {b / A:g} a": n(a, b) for a, b in zip(DEEP, DEEP[1:])}, **{"5 to 40 a": n(.5, 4.)}, energy_error=run["energy_error"])
    return peaks


SOURCES = {"100 MPa": {GAS: 1e8}, "1 GPa": {GAS: 1e9}, CHARGE: {}}


def attenuation():
    curves = {(soil, source): deep(soil, source, settings) for soil in study.choose(LARGE, quick=("wet",)) for source, settings in SOURCES.items()}
    finer = {"Mesh/Radial layers": 400}
    for soil, source, settings in study.choose((
            ("dry", "100 MPa, 400 layers", {GAS: 1e8, **finer}), ("wet", f"{CHARGE}, 400 layers", finer),
            ("dry", "1 GPa, gamma = 3", {GAS: 1e9, "Loads/gas/Ratio of specific heats": 3}),
            ("dry", "1 GPa, eta = 3200 1/s", {GAS: 1e9, "Materials/soil/Fluidity eta": 3200}),
            ("dry", "1 GPa, theta = 0.3", {GAS: 1e9, "Materials/soil/Failure theta": .3})), quick=()):
        deep(soil, source, settings)
    return curves


def figure(curves):
    """Largest velocity over distance in radii, colour by soil, line by source; slopes of the empirical laws."""
    drawing, axes = common.plt.subplots(figsize=(6.4, 4.8))
    colours = dict(zip(LARGE, ("tab:orange", "tab:green", "tab:purple", "tab:blue")))
    lines = dict(zip(SOURCES, ("o:", "s--", "^-")))
    for (soil, source), peaks in curves.items():
        axes.loglog([r / A for r in peaks], list(peaks.values()), lines[source], color=colours[soil], markersize=3, linewidth=1)
    for soil, colour in colours.items():
        axes.plot([], [], "-", color=colour, label=soil)
    for source, line in lines.items():
        axes.plot([], [], "k" + line, markersize=3, linewidth=1, label=source)
    for n in (1.5, 2.4, 2.75):  # saturated clay, saturated sandy clay, dry sand
        axes.loglog([10, 60], [400, 400 * 6 ** -n], "k-", linewidth=.6)
        axes.text(62, 400 * 6 ** -n, f"{n:g}", fontsize=7, va="center")
    axes.text(10, 440, "slopes of MSB B02-301", fontsize=7)
    axes.set(xlabel="r/a", ylabel="largest velocity [m/s]")
    axes.grid(True, which="major", linewidth=.3)
    axes.legend(fontsize=7, loc="lower left")
    drawing.savefig(study.folder / "attenuation.svg", bbox_inches="tight", metadata={"Date": None})
    common.plt.close(drawing)


# --- the study ----------------------------------------------------------------------------------------------------------------
meshes()
for soil, saturation in study.choose(SOILS.items(), quick=list(SOILS.items())[:1]):
    explode(soil, "soils", {"water content [%]": 100 * saturation * POROSITY / (1 - POROSITY) / GRAINS, "air [%]": 100 * POROSITY * (1 - saturation)},
            **wet(saturation))
for soil in study.choose(("dry", "wet, half of the pores", "saturated"), quick=()):
    for depth in (.5, 2.):
        explode(f"{soil}, {depth:g} m", "depths", depth=depth, **wet(SOILS[soil]))
for soil, pressures in study.choose({"dry": (1e8, 1e9, 1e10), "wet, half of the pores": (1e9,), "saturated": (1e9,)}.items(), quick=()):
    for p in pressures:
        explode(f"{soil}, {p / 1e6:g} MPa", "sources", depth=3., **wet(SOILS[soil]), **{GAS: p})
if not study.quick:
    for name, form in {"meridian plane": {}, "quarter in space": {"Dimension": 3, "Symmetry": "none"}}.items():
        explode(name, "forms", refinement=1, **form)
curves = attenuation()

WORDS = {
    "meshes, dry": "The dry scene on meshes with half the cell size each; order, limit and error bar from the last three as in `arenite converge`. The layer: soil above "
                   "the lowest place on the axis that the tension cut-off has opened by more than 1e-4 (parted), and that still opens in the last millisecond, both to a cell, "
                   "0.1 m on the coarsest mesh; its velocity is momentum over mass of the box above 0.75 m and within 0.25 m of the axis:",
    "meshes, saturated": "The same in saturated sand:",
    "soils": "Water in the pores (porosity 40 %), and air:",
    "depths": "Depth of the charge; 1 m is in the table before. The box of the layer grows with the depth:",
    "sources": "Stronger gas, 3 m deep:",
    "forms": "Meridian plane and quarter in space, refinement 1:",
    "momentum": "Receivers of surfaces and boxes over 10 ms, of the full body: impulse per area (of the undeformed boundary) on the wall and on the far field, upward "
                "impulse of far field and weight, upward momentum of the whole body and of the box 'layer'. balance: what wall, far field and weight miss of the momentum, "
                "over the largest of them:",
    "attenuation": "Exponents n of the largest velocity on the radius around a charge deep in the ground, and in one from 5 to 40 a. 'law from': where the empirical law "
                   "begins, 0.4 m/kg^(1/3) of C-4 of the same energy. Empirical: 2.75 dry sand, 3.1 loose dry sand, 2.5 wet sandy clay, 2.4 saturated sandy clay with less than "
                   "1 % of air, 1.5 saturated clay. The sand: dry, half of the pores wet (20 % of air), 98 % (0.8 %), saturated:"}
words = "\n\n".join(f"{text}\n\n{common.markdown_table(tables[name])}" for name, text in WORDS.items() if name in tables)
print("\n" + words, flush=True)
if study.write:
    figure(curves)
study.finish(words + """

![largest velocity over distance](buried_explosion/attenuation.svg)

v at 0, at 1 m: largest upward velocity of the ground above the charge and 1 m beside it [m/s]; uplift: at the end, 10 ms; volume ratio: of the cavity
at the end; parted, still opening, v of the layer: as above; n: exponent of the largest velocity from 2 to 9 radii. The error below is that of the energy.""", ylabel="energy error")
if study.write:
    tables["largest velocity [m/s]"] = [{"soil": soil, "source": source, **{f"at {r:g} m": v for r, v in peaks.items()}} for (soil, source), peaks in curves.items()]
    tables["cost"] = study.rows
    common.write_csv(study.folder / "results.csv", [{"table": name, **row} for name, rows in tables.items() for row in rows])
