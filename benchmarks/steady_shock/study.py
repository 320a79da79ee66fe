"""Steady fronts in a viscoplastic cap solid: speed, profile and end state against the ordinary equations. See README.md."""
import math, sys
from pathlib import Path
sys.path.insert(0, str(Path(__file__).resolve().parents[1]))
import common, profiles, tuning
import numpy
from reference import CASES, front

study = common.Study(__file__)
TRAVEL = study.choose((30,), quick=(12,))[0]  # widths of the front
SUBSTEP = .02  # of the law; the usual 0.5 is a row of its own
ELEMENTS = {name: tuning.ELEMENTS[name] for name in ("Q1, one point", "Q1, 2x2x2", "Q2")}


def measure(case, element, per_width, travel=TRAVEL, viscosity=(0, 0), substep=SUBSTEP, dimension=1, steps=None):
    """The front between half of the way and its end, on cells of width/per_width."""
    steady, data = front(case), CASES[case]
    width, cap, degree = steady.width(), steady.cap, ELEMENTS[element]["Element/Degree"]
    ramp = 2 * width / data["U"]
    end = travel * width / data["U"] + ramp
    fastest = max(math.sqrt(cap.M / cap.rho0), data["U"])
    length = fastest * end * 1.02
    cells = round(length / width * per_width / degree)
    run = study.run("front.prm", {
        **ELEMENTS[element], "Kinematics": "finite strain" if data["finite"] else "small strain", **profiles.line(dimension, length, cells),
        "End time": end, **profiles.equal_steps(end, steps), "Materials/soil/Fluidity eta": cap.eta, "Materials/soil/Overstress exponent N": cap.N,
        "Materials/soil/Substep size": substep, "Element/Linear bulk viscosity": viscosity[0], "Element/Quadratic bulk viscosity": viscosity[1],
        "Constraints/x min/Amplitude": steady.V, "Constraints/x min/Rise time": ramp,
        **profiles.along("points", cells, length, parts=degree, interval=end / 2, quantities="displacement, velocity, stress")}, repeat=1)
    half, late = (profiles.read(run, "points", row=row, rest=cap.rho0) for row in (-2, -1))
    middle = (steady.ahead[2] + steady.V) / 2
    places = [one.crossing(one.v, middle) for one in (half, late)]
    xi = late.X - places[1]
    window = abs(xi) < 3 * width
    v, sigma = steady.at(xi)
    off = abs(late.v - v)[window] / steady.V
    plateau = (xi < -3 * width) & (xi > -8 * width)
    return study.add(f"{case}, {element}" + (f", viscosity {viscosity[0]:g}, {viscosity[1]:g}" if any(viscosity) else "") +
                     (f", substep {substep:g}" if substep != SUBSTEP else "") + profiles.form(dimension, steps), run,
                     float(off.mean()), per_width=per_width, cells=cells,
                     speed=profiles.relative((places[1] - places[0]) / (late.time - half.time), data["U"]), v_max=float(off.max()),
                     sigma_max=float((abs(late.S + sigma)[window]).max() / abs(steady.sigma[-1])),
                     end_sigma=profiles.relative(-late.S[plateau].mean(), steady.sigma[-1]),
                     end_lateral=profiles.relative(-(1.5 * late.p - .5 * late.S)[plateau].mean(), steady.lateral[-1]),
                     steps=run["steps"], energy_error=run["energy_error"])


orders = []
for case in study.choose(CASES, quick=("A", "B")):
    for element in study.choose(ELEMENTS, quick=("Q1, one point",)):
        ladder = study.choose((5, 10, 20, 40), quick=(5, 10))
        rows = [measure(case, element, n) for n in ladder]
        if element == "Q1, one point":
            profiles.line_and_brick(lambda dimension, steps: measure(case, element, ladder[0], dimension=dimension, steps=steps), rows[0])
        orders.append({"case": case, "element": element, "order of v": profiles.order(ladder, [row["error"] for row in rows]),
                       **{f"{name} on {n} cells": row[key] for name, key in (("mean v", "error"), ("speed", "speed"), ("end sigma", "end_sigma"))
                          for n, row in ((ladder[0], rows[0]), (ladder[-1], rows[-1]))}})
for viscosity in study.choose(((.06, 1.2),), quick=()):
    for case in CASES:
        measure(case, "Q1, one point", 20, viscosity=viscosity)
for substep in study.choose((.5, .1), quick=(.5,)):
    for case in study.choose(CASES, quick=("A",)):
        for per_width in study.choose((10, 20, 40), quick=(10,)):
            measure(case, "Q1, one point", per_width, substep=substep)

table = common.markdown_table(orders)
print("\n" + table, flush=True)
study.finish(f"""Substep size {SUBSTEP} of the law, where nothing else is said. Cells (degree x cells) per width of the front,
between 10 and 90 % of its rise; {TRAVEL} widths of travel:

{table}

error: mean of |v - v_exact|/V within three widths of the aligned middle; v_max, sigma_max: the largest differences there. speed: per
reference length, over the second half of the way. end: behind the front. off_1_D: of the error to that of the same cells and
steps in one dimension.""", ylabel="mean error of v over V")
