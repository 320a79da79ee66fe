"""Reflection of a pulse at a change of one level, over the cells on the pulse. See README.md."""
import sys
from pathlib import Path
sys.path.insert(0, str(Path(__file__).resolve().parents[1]))
import common, tuning
import numpy

study = common.Study(__file__)
P_WAVE, PULSE = 349.825, .25


def velocity(element, cells, refined):
    """At the receiver over time, with the step that fine cells need; `cells` coarse ones on the pulse, `refined`: the half that is fine, or 'fine' or
    'coarse' for equal cells."""
    n, degree = int(2. / PULSE * cells), element["Element/Degree"]
    step, halves = .35 / n / P_WAVE / degree ** 2, 2 if refined == "fine" else 1
    settings = {**element, "Mesh/Cells": f"{halves * n}, {halves * 2}", "Mesh/Upper corner": f"2, {4. / n:.9g}", "Time stepping/Fixed step": step,
                "Receivers/points/Points": f"0.5, {1.9 / n:.9g}"}
    if refined in ("left", "right"):
        settings["Adaptivity/Refined boxes"] = f"0, 0; 1, {4. / n:.9g}" if refined == "left" else f"1, 0; 2, {4. / n:.9g}"
    else:
        settings["Adaptivity/Levels"] = 0
    run = study.run("strip.prm", settings, repeat=1)
    table = run.table("receivers-points.csv")
    return run, numpy.array(table["t [s]"]), numpy.array(table["p1.velocity_x [m/s]"])


for name, element in tuning.ELEMENTS.items():
    for cells in study.choose((2, 4, 8, 16, 32), quick=(8,)):
        if cells * element["Element/Degree"] > 64:
            continue
        for direction, jump, equal in (("into coarse cells", "left", "fine"), ("into fine cells", "right", "coarse")):
            run, t, v = velocity(element, cells, jump)
            _, t_equal, v_equal = velocity(element, cells, equal)
            late = t > 1.4 / P_WAVE
            back = numpy.abs(v - numpy.interp(t, t_equal, v_equal))[late].max() / numpy.abs(v).max()
            study.add(f"{name}, {direction}", run, back, cells_on_pulse=cells, nodes_on_pulse=cells * element["Element/Degree"])

orders = []
for series in dict.fromkeys(row["series"] for row in study.rows):
    rows = [row for row in study.rows if row["series"] == series and row["error"] > 1e-9]
    needed = [next((str(row["cells_on_pulse"]) for row in rows if row["error"] < part), "more") for part in (.03, .01, .003)]
    orders.append({"series": series, "order": float(-numpy.polyfit(numpy.log([r["cells_on_pulse"] for r in rows[-3:]]), numpy.log([r["error"] for r in rows[-3:]]), 1)[0])
                   if len(rows) > 2 else "", "cells for 3 %": needed[0], "1 %": needed[1], "0.3 %": needed[2]})
table = common.markdown_table(orders)
print("\n" + table, flush=True)
study.finish(f"""Largest velocity that comes back from a change of one level over that of the pulse, which is sin^6 of the cells' number long (error below):

{table}""", ylabel="part of the velocity that comes back")
