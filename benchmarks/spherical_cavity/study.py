"""Orders of convergence for loads of different smoothness, against the regularity law; Lysmer boundary for comparison. See README.md."""
import sys
from pathlib import Path
sys.path.insert(0, str(Path(__file__).resolve().parents[1]))
import common, tuning

study = common.Study(__file__)
SMOOTHNESS = {"P1": 3, "P2": 3, "P3": 5, "P4": -1, "P5": -1}  # continuous derivatives k of p(t); -1: a jump
REFINEMENTS = {1: (2, 3, 4, 5), 2: (1, 2, 3, 4), 3: (1, 2, 3), 4: (0, 1, 2)}
QUICK = {1: (2, 3), 4: (0, 1)}
NAMES = {1: "Q1, 2x2x2", 2: "Q2", 3: "Q3", 4: "Q4"}


def law(degree, k):
    """Expected orders of displacement and stress: front of width h^(2p/(2p+1)), README.md."""
    front = 2 * degree / (2 * degree + 1)
    return min(degree + 1, (k + 2.5) * front), min(degree, (k + 1.5) * front)


def courant(degree, k, level):
    """A step that keeps the error in time below that in space: dt ~ h^((p+1)/2) where full order is expected."""
    if k < 0 or degree == 1:
        return .6
    if k > degree or degree < 4:
        return {2: .6, 3: .8, 4: .5}[degree] * 2. ** (-level * (degree - 1) / 2)
    return (.8, .6, .4, .2, .1)[level] # short fronts: the error in space stays above that in time with less


orders = []
for case in ("P3", "P5") if study.quick else SMOOTHNESS:
    k = SMOOTHNESS[case]
    for degree, refinements in (QUICK if study.quick else REFINEMENTS).items():
        if degree == 4 and 0 < k < 5 and not study.quick:
            refinements += (3,) # short fronts need a finer mesh before the order shows
        ladder = []
        for level, refinement in enumerate(refinements):
            settings = dict(tuning.ELEMENTS[NAMES[degree]], **{"Mesh/Refinement": refinement,
                            "Time stepping/Courant number": courant(degree, k, level)})
            # the orders need no repetitions, and the finest runs are long
            run = study.run(f"{case}.prm", settings, repeat=1, timeout=600)
            e = run.errors
            ladder.append(study.add(f"{case}, {NAMES[degree]}", run, e["generic.displacement.E_t"], refinement=refinement,
                                    courant=settings["Time stepping/Courant number"], dofs=run["dofs"], steps=run["steps"],
                                    edges=e["edges.displacement.E_t"], stress=e["generic.stress.E_t"],
                                    velocity=e["generic.velocity.E_t"], E_x=e["volume.displacement.E_x"],
                                    energy=run["energy_error"], cells_per_length=2. ** refinement))
        u, s = law(degree, k)
        rate = lambda rows, y: -common.rate(rows, "cells_per_length", y)
        orders.append({"case": case, "element": NAMES[degree], "k": k, "finest E_t of u": ladder[-1]["error"],
                       "order before": rate(ladder[:-1], "error") if len(ladder) > 2 else "", "order": rate(ladder, "error"),
                       "law": u, "finest E_t of stress": ladder[-1]["stress"], "order of stress": rate(ladder, "stress"),
                       "law of stress": s, "finest E_x of u": ladder[-1]["E_x"], "order of E_x": rate(ladder, "E_x")})

# Lysmer boundary and the exact one with layers of the same thickness
boundaries = []
for condition, outer, layers in (("spherical", .3, 3), ("Lysmer", .3, 3), ("Lysmer", .5, 6), ("Lysmer", 1., 13), ("Lysmer", 2., 28)):
    if study.quick and outer > .3:
        break
    run = study.run("P1.prm", {"Mesh/Outer radius": outer, "Mesh/Radial layers": layers, "Mesh/Refinement": 1,
                               "Mesh/Radial spacing": "uniform",
                               "Loads/far field/Condition": condition})
    boundaries.append({"condition": condition, "b [m]": outer, "cells": run["cells"],
                       "E_t of u": run.errors["generic.displacement.E_t"], "core-seconds": run.core_seconds})
print("\n" + common.markdown_table(orders) + "\n\n" + common.markdown_table(boundaries), flush=True)

if study.write:
    common.write_csv(study.folder / "results.csv", [{n: v for n, v in r.items() if n != "cells_per_length"} for r in study.rows])
    for case in ("P3", "P5"):
        series = {name.split(", ", 1)[1]: points for name, points in study.series.items() if name.startswith(case)}
        common.figure(study.folder / f"error_versus_time_{case}.svg", series, ylabel="E_t of the displacement",
                      title={"P3": "P3: smooth pulse", "P5": "P5: step"}[case])
    near = sum(abs(o["order"] - o["law"]) < .25 or o["order"] > o["law"] for o in orders)
    facts = ", ".join(f"{k.replace('deal_ii', 'deal.II')} {v}" for k, v in common.machine(study.last).items())
    common.report(study.name, f"""## Spherical cavity: orders of convergence

Five loads of smoothness k (continuous derivatives; -1: jump), errors E_t over generic receivers from r = a to 2.5 a and E_x at the
end, b = 3 a with the exact boundary. Orders are those of the two finest pairs of meshes. The law limits what any mesh of cells
without regard to the front can reach; {near} of {len(orders)} orders of the displacement are at\nmost 0.25 below it (P2 has the shortest front and is not in the range of its orders yet).

{common.markdown_table(orders)}

The boundary: Lysmer dashpots at growing distance against the exact condition for spherical waves at 3 a (P1, Q4).

{common.markdown_table(boundaries)}

![P3](spherical_cavity/error_versus_time_P3.svg)
![P5](spherical_cavity/error_versus_time_P5.svg)

*{facts}. One run each.* {study.disturbed}""")
