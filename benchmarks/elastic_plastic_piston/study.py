"""Elastic-plastic piston: zones of loading, release and reverse yield for Mises and Drucker-Prager. See README.md."""
import math, sys
from pathlib import Path
sys.path.insert(0, str(Path(__file__).resolve().parents[1]))
import common, profiles, tuning
import numpy
from reference import CASES

study = common.Study(__file__)
SCALE = 1e-3  # strains of 2e-5: the law, in logarithmic strain, is the linear one of the reference up to that
VISCOSITIES = {"0.06, compression only": (.06, 1.2, "false"), "0.06": (.06, 1.2, "true"), "0.1": (.1, 1.2, "true"),
               "0.3, compression only": (.3, 1.2, "false"), "0.3": (.3, 1.2, "true")}
ELEMENTS = {name: tuning.ELEMENTS[name] for name in ("Q1, one point", "Q1, 2x2x2", "Q2")}


def law(piston):
    block = "Materials/solid/"
    settings = {block + "Density": piston.rho, block + "Bulk modulus": piston.K, block + "Shear modulus": piston.G}
    if piston.Yb == 0:
        return {**settings, block + "Strength": "mises", block + "Yield stress": piston.Ya}
    # q <= Ya + Yb p as sqrt(J2) <= k + 3 alpha p
    return {**settings, block + "Strength": "drucker prager", block + "Cohesion": piston.Ya / math.sqrt(3),
            block + "Friction slope": piston.Yb / (3 * math.sqrt(3))}


def measure(case, element, viscosity, cells, kinematics="small strain", dimension=1, steps=None):
    piston = CASES[case].scaled(SCALE)
    end = piston.time_of_profile()
    length = 1.25 * piston.ce * end
    linear, quadratic, expansion = VISCOSITIES[viscosity]
    settings = {**law(piston), **ELEMENTS[element], "Kinematics": kinematics, **profiles.line(dimension, length, cells), "End time": end,
                **profiles.equal_steps(end, steps),
                "Loads/push/Amplitude": piston.loaded.S, "Loads/push/Expression": f"(t < {piston.t1}) ? 1 : 0",
                "Element/Linear bulk viscosity": linear, "Element/Quadratic bulk viscosity": quadratic,
                "Element/Bulk viscosity in expansion": expansion,
                **profiles.along("zones", cells, length, interval=end, quantities="displacement, velocity, stress")}
    scene = "piston.prm" if piston.Yb == 0 else "friction.prm"
    run = study.run(scene, settings, repeat=1)
    profile = profiles.read(run, "zones", rest=piston.rho)
    zones = [piston.at(x, end) for x in profile.X]
    fronts = (0., *piston.fronts(end), length)

    def plateau(i, values):  # the middle of zone i
        low, high = fronts[i], fronts[i + 1]
        return profile.mean(values, low + .3 * (high - low), low + .7 * (high - low))

    S, v = profile.S, profile.v
    reverse, released, loaded, yielding, _ = piston.zones()
    return study.add(f"{case}, {element}, {viscosity}" + (", finite strain" if kinematics != "small strain" else "") +
                     profiles.form(dimension, steps), run,
                     profile.l1(v, numpy.array([zone.v for zone in zones])), cells=cells,
                     S_L1=profile.l1(S, numpy.array([zone.S for zone in zones])),
                     S_H=profiles.relative(plateau(3, S), yielding.S), S1=profiles.relative(plateau(2, S), loaded.S),
                     v1=profiles.relative(plateau(2, v), loaded.v), S2=profiles.relative(plateau(1, S), released.S),
                     v2=profiles.relative(plateau(1, v), released.v), v3=profiles.relative(plateau(0, v), reverse.v),
                     p3=profiles.relative(plateau(0, profile.p), reverse.p), steps=run["steps"],
                     energy_error=run["energy_error"])


orders = []
ladder = study.choose((500, 1000, 2000, 4000, 8000), quick=(250, 500))


def converge(case, element, viscosity):
    rows = [measure(case, element, viscosity, cells) for cells in ladder]
    orders.append({"case": case, "element": element, "linear viscosity": viscosity,
                   "order of v": profiles.order(ladder, [row["error"] for row in rows]),
                   "order of S": profiles.order(ladder, [row["S_L1"] for row in rows]),
                   **{f"{name} on {cells} cells": row[name] for name in ("S2", "v2", "v3")
                      for cells, row in zip((ladder[0], ladder[-1]), (rows[0], rows[-1]))}})
    return rows


for case in CASES:
    for viscosity in study.choose(VISCOSITIES, quick=("0.06, compression only", "0.3")):
        rows = converge(case, "Q1, one point", viscosity)
    for element in study.choose(list(ELEMENTS)[1:], quick=("Q1, 2x2x2",)):
        converge(case, element, "0.3")
    measure(case, "Q1, one point", "0.3", ladder[-1], "finite strain")
    profiles.line_and_brick(lambda dimension, steps: measure(case, "Q1, one point", viscosity, ladder[0], dimension=dimension, steps=steps), rows[0])

table = common.markdown_table(orders)
print("\n" + table, flush=True)
study.finish(f"""Orders of the L1 errors, and relative errors of the released states on the coarsest and finest mesh:

{table}

Columns S_H to p3: relative errors in the middle of the zones (H at yield, 1 loaded, 2 released, 3 after reverse yield). The viscosity is the
linear coefficient; the quadratic one is 1.2. off_1_D: of the error to that of the same cells and steps in one dimension.""", ylabel="L1 error of v")
