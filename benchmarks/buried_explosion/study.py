"""Gas at high pressure in a buried cavity in cap soil under its own weight: heave, spall, attenuation. See README.md."""
import math, sys
from pathlib import Path
sys.path.insert(0, str(Path(__file__).resolve().parents[1]))
import common
import numpy

study = common.Study(__file__)
SCENE = study.folder.parents[1] / "prm" / "buried_explosion.prm"
RADII = (.1, .15, .2, .3, .4, .5, .7, .9)  # of the receivers 'below' [m]
FAR = [i for i, r in enumerate(RADII) if r >= .2]
LAW, WATER = "Materials/soil/Law", "Materials/soil/Soil state/Saturation"
SOILS = {"dry": {}, "wet, half of the pores": {LAW: "undrained cap", WATER: .5}, "wet, 90 % of the pores": {LAW: "undrained cap", WATER: .9},
         "saturated": {LAW: "undrained cap", WATER: 1}}
MESH = study.choose((2,), quick=(1,))[0]
AXIS = numpy.arange(.3, 1., .05)  # above the cavity [m], where the soil may part
tables = {}


def explode(title, table, depth=1., refinement=MESH, **settings):
    """One run and what it says about the ground."""
    across = "0, 0" if settings.get("Dimension") == 3 else "0"
    place = [f"0, 0, {depth * z:.6g}" for z in AXIS]
    run = study.run(SCENE, {"Mesh/Depth": depth, "Mesh/Outer distance": max(2., 1.5 * depth), "Mesh/Refinement": refinement, "Output/VTU interval": 0,
                            "Receivers/surface/Points": "; ".join(f"{r}, 0, {depth:.6g}" for r in (0, .25, .5, 1, 1.5)),
                            "Receivers": "surface, below, axis", "Receivers/axis/Points": "; ".join(place), "Receivers/axis/Quantities": "history",
                            "Receivers/axis/Interval": 1e-3, "Receivers/below/Directions": "1, 0, 0; 0, 0, -1", "Loads/weight/Acceleration": f"{across}, -9.81", **settings}, repeat=1)
    surface, below, axis = (run.table(f"receivers-{name}.csv") for name in ("surface", "below", "axis"))
    column = lambda table, name: numpy.array(table[name])
    up = [column(surface, f"p{i}.velocity_z [m/s]") for i in range(1, 6)]
    t = column(surface, "t [s]")
    peaks = {}
    for d in (1, 2):  # sideways and downwards
        parts = [[column(below, name) for name in below if name.startswith(f"d{d}r{i + 1}.velocity")] for i in range(len(RADII))]
        peaks[d] = [float(numpy.sqrt(sum(part ** 2 for part in point)).max()) for point in parts]
    n = {d: float(-numpy.polyfit(numpy.log([RADII[i] for i in FAR]), numpy.log([peaks[d][i] for i in FAR]), 1)[0]) for d in (1, 2)}
    apart = [z for z, name in zip(AXIS, [name for name in axis if "separation" in name]) if axis[name][-1] > 1e-4]
    volume = run.column("statistics.csv", "gas: gas volume (full body) [m^3]")
    row = {"case": title, "cells": run["cells"], "surface_v": float(up[0].max()), "v_at_1_m": float(up[3].max()),
           "arrival_ms": 1e3 * float(t[numpy.argmax(up[0] > .05 * up[0].max())]), "uplift_mm": 1e3 * surface["p1.displacement_z [m]"][-1],
           "volume_ratio": volume[-1] / volume[0], "n_sideways": n[1], "n_down": n[2],
           "parted_from": min(apart) * depth if apart else "nowhere", "energy_error": run["energy_error"]}
    tables.setdefault(table, []).append(row)
    study.add(table, run, run["energy_error"], **{name: value for name, value in row.items() if name != "energy_error"})
    return row, peaks[1]


curves = {}
for refinement in study.choose((1, 2, 3), quick=(1,)):
    explode(f"refinement {refinement}", "meshes, dry", refinement=refinement)
for soil, settings in SOILS.items():
    if study.quick and soil != "dry":
        continue
    row, peaks = explode(soil, "soils", **settings)
    curves[soil] = list(zip(RADII, peaks))
for depth in study.choose((.5, 1., 2.), quick=()):
    explode(f"dry, depth {depth:g} m", "depths", depth=depth)
for depth in study.choose((.5, 2.), quick=()):
    explode(f"saturated, depth {depth:g} m", "depths", depth=depth, **SOILS["saturated"])
if not study.quick:
    for name, form in {"meridian plane": {}, "quarter in space": {"Dimension": 3, "Symmetry": "none"}}.items():
        explode(name, "forms, refinement 1", refinement=1, **form)

words = []
for name, rows in tables.items():
    words.append(f"*{name.capitalize()}*\n\n{common.markdown_table(rows)}")
    print("\n" + words[-1], flush=True)
if study.write:
    common.figure(study.folder / "attenuation.svg", curves, xlabel="distance from the centre [m]", ylabel="peak velocity, sideways [m/s]")
study.finish("\n\n".join(words) + """

![peak velocity over distance](buried_explosion/attenuation.svg)

surface_v, v_at_1_m: largest upward velocity of the ground above the charge and 1 m beside it [m/s]; uplift at the end, 10 ms; volume_ratio: of the cavity at the
end; n: exponent of the peak velocity from 2 to 9 radii; parted_from: lowest height above the centre [m] where the tension cut-off has opened the soil on the
axis by more than 1e-4. The error below is that of the energy.""", ylabel="energy error")
