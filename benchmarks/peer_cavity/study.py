"""The cheapest settings for 1 % and 0.1 % on the cavity problem of other codes. See README.md."""
import math, sys
from pathlib import Path
sys.path.insert(0, str(Path(__file__).resolve().parents[1]))
import common, tuning

# Measured on the same kind of machine, one core, output off; errors on the axis and on the diagonal, processor time of the whole
# program. SPECFEM3D: axis only.
PEERS = [
    ("OpenRadioss, one-point hexahedra (HEPH)", 2160, .0391, .0557, .14),
    ("OpenRadioss, one-point hexahedra (HEPH)", 17280, .0095, .0157, 3.6),
    ("OpenRadioss, one-point hexahedra (HEPH)", 138240, .00236, .0042, 65.5),
    ("OpenRadioss, 2x2x2 hexahedra", 17280, .0101, .0165, 11.6),
    ("CalculiX 2.20, explicit C3D8 (1 MPa, large strain)", 2160, .0253, .048, 4.6),
    ("CalculiX 2.20, explicit C3D8 (1 MPa, large strain)", 17280, .0125, .0103, 54.6),
    ("SPECFEM3D 4.1.1, degree 4, single precision (point source, full cube, axis)", 4096, .061, .061, 3.2),
    ("SPECFEM3D 4.1.1, degree 4, single precision (point source, full cube, axis)", 13824, .019, .019, 18.9),
    ("SPECFEM3D 4.1.1, degree 4, single precision (point source, full cube, axis)", 32768, .0071, .0071, 72.),
]
SETS = ("axis", "diagonal", "generic")

# element: {outer radius: [(refinement, radial layers of the coarse mesh)]}
MESHES = {
    "Q4": {.32: [(0, 2), (0, 3), (0, 4), (0, 6), (1, 2), (1, 3)], 1.: [(0, 6), (0, 8), (0, 12), (1, 5), (1, 6), (1, 8)]},
    "Q3": {.32: [(0, 3), (0, 4), (0, 5), (1, 2), (1, 3), (1, 4), (1, 5)],
           1.: [(0, 10), (0, 12), (1, 8), (1, 10), (1, 14), (1, 18)]},
    "Q2": {.32: [(1, 2), (1, 3), (1, 4), (2, 2), (2, 3), (2, 4)], 1.: [(1, 8), (1, 12), (2, 8), (2, 14), (3, 9)]},
    "Q1, one point": {.32: [(2, 3), (3, 2), (3, 3), (3, 4), (4, 3), (5, 3)], 1.: [(3, 8), (3, 12), (3, 16), (4, 12)]},
    "Q1, 2x2x2": {.32: [(2, 3), (3, 2), (3, 3), (3, 4), (4, 3)], 1.: [(3, 8), (3, 12), (3, 16)]},
}
# spacing of the layers and Courant number; cells that grow with r cannot carry the wave to 1 m
VARIANTS = {.32: [("geometric", .95), ("uniform", .95), ("uniform", .6)], 1.: [("uniform", .95), ("uniform", .6)]}
QUICK = {"Q4": {.32: [(0, 2), (1, 2)]}, "Q3": {.32: [(0, 3), (1, 4)]}, "Q1, one point": {.32: [(3, 3)]}}

study = common.Study(__file__)


def measure(element, outer, refinement, layers, spacing, courant, repeat):
    settings = dict(tuning.ELEMENTS[element], **{"Mesh/Outer radius": outer, "Mesh/Refinement": refinement,
                                                 "Mesh/Radial layers": layers, "Mesh/Radial spacing": spacing,
                                                 "Time stepping/Courant number": courant})
    with tuning.ProcessorTime() as whole:
        run = study.run("cavity.prm", settings, repeat=repeat)
    errors = {name: run.errors[f"{name}.displacement.E_t"] for name in SETS}
    return {"element": element, "outer_radius": outer, "refinement": refinement, "layers": layers, "spacing": spacing,
            "courant": courant, "cells": run["cells"], "dofs": run["dofs"],
            "steps": run["steps"], **errors, "error": max(errors.values()),
            "core_seconds": run.core_seconds, "setup": run["setup_core_seconds"], "process": whole.seconds / repeat,
            "spread": run.spread}


# Look around with one run each, then measure what may be the best.
rows = []
for element, meshes in (QUICK if study.quick else MESHES).items():
    for outer, list_of_meshes in meshes.items():
        tried = []
        for refinement, layers in list_of_meshes:
            for spacing, courant in VARIANTS[outer]:
                if courant > .9 or not (study.quick or "Q1" in element):
                    tried.append(measure(element, outer, refinement, layers, spacing, courant, 1))
        for row in tried if study.quick else tuning.front(tried):
            key = [row[name] for name in ("element", "outer_radius", "refinement", "layers", "spacing", "courant")]
            rows.append(row if study.repeat == 1 or row["core_seconds"] > 2 else measure(*key, study.repeat))
            print("  " + ", ".join(f"{name} {common.text(value)}" for name, value in rows[-1].items()), flush=True)

best, missing = [], []
for target in (.01, .001):
    for outer in sorted({row["outer_radius"] for row in rows}):
        for element in MESHES:
            row = tuning.cheapest([r for r in rows if r["element"] == element and r["outer_radius"] == outer], target)
            if row:
                best.append({"goal": f"{100 * target:g} %", **row})
            elif not study.quick:
                missing.append(f"{element} with b = {outer:g} m to {100 * target:g} %")
peers = [{"code": c, "elements": n, "axis": x, "diagonal": d, "error": max(x, d), "core_seconds": t} for c, n, x, d, t in PEERS]


def extrapolate(target):
    """The fastest peer of second order at this error, and its seconds: from its nearest run with error ~ h^2, time ~ h^-4."""
    nearest = {}
    for p in sorted(peers, key=lambda p: -abs(math.log(p["error"] / target))):
        if "SPECFEM" not in p["code"]:
            nearest[p["code"]] = p["core_seconds"] * (p["error"] / target) ** 2
    return min(nearest.items(), key=lambda pair: pair[1])


titles = {"outer_radius": "b [m]", "core_seconds": "time loop [core-s]", "setup": "set-up [core-s]",
          "process": "whole process [core-s]"}
columns = ["goal", "element", "outer_radius", "refinement", "layers", "spacing", "courant", "cells", "dofs", "steps", *SETS,
           "core_seconds", "setup", "process"]
table = common.markdown_table(best, columns, titles)
print("\n" + table + "\n\n" + common.markdown_table(peers), flush=True)

if study.write:
    goals = []
    for target, limit in ((.01, .1), (.001, 2.)):
        for outer, words in ((.32, "behind the receivers"), (1., "at 1 m")):
            row = tuning.cheapest([r for r in rows if r["outer_radius"] == outer], target)
            if row:
                code, seconds = extrapolate(target)
                goals.append(
                    f"- **{100 * target:g} % with the boundary {words}**: {row['element']}, {row['cells']} cells, error "
                    f"{100 * row['error']:.2g} %, time loop {row['core_seconds']:.2g} core-seconds (goal {limit:g}: "
                    f"{'met' if row['core_seconds'] < limit else 'missed'}), whole process {row['process']:.2g}; {code}, "
                    f"carried to this error by its second order: about {seconds:.2g}.")
    common.write_csv(study.folder / "results.csv", rows)
    series = {}
    for element in MESHES:
        for outer in (.32, 1.):
            points = tuning.front([r for r in rows if r["element"] == element and r["outer_radius"] == outer])
            series[f"{element}, b = {outer:g} m"] = [(r["core_seconds"], r["error"]) for r in points]
    for peer in peers:
        series.setdefault(peer["code"].split(",")[0], []).append((peer["core_seconds"], peer["error"]))
    common.figure(study.folder / "error_versus_time.svg", {k: v for k, v in series.items() if v},
                  ylabel="relative L2 error of u(0.3 m), worst direction")
    facts = ", ".join(f"{k.replace('deal_ii', 'deal.II')} {v}" for k, v in common.machine(study.last).items())
    common.report(study.name, f"""## Peer cavity

Relative L2 error in time of the displacement at r = 0.3 m, on an axis, on diagonals and in generic directions; `error` of a goal
is the worst of them. Cheapest settings found for each element:

{table}

{"Not reached with the meshes tried: " + "; ".join(missing) + "." if missing else ""}

""" + "\n".join(goals) + f"""

Other codes, measured on the same kind of machine (one core, processor time of the whole program; their domain ends at
1 m, SPECFEM3D has a point source, no symmetry planes, and its error is that on the axis):

{common.markdown_table(peers)}

The time loop of the best runs is shorter than the start of the process (0.3 to 0.5 s for loading the libraries and MPI), so the
column 'whole process' is the fair comparison at 1 %.

![error versus core-seconds](peer_cavity/error_versus_time.svg)

*{facts}. Times are medians of {study.repeat}.* {study.disturbed}""")
