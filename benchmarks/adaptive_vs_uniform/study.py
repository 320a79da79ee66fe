"""Does it pay to let the mesh follow the front? Error over core-seconds, equal cells against adaptive ones. See README.md."""
import math, sys
from pathlib import Path
here = Path(__file__).resolve().parent
sys.path[:0] = [str(here.parent), str(here.parent / "compacting_soil")]
import common, profiles, tuning
import numpy
from reference import KINKED
sys.path.insert(0, str(here.parent / "sedov_noh"))
del sys.modules["reference"]
from reference import Sedov

study = common.Study(__file__)
ELEMENT = tuning.ELEMENTS["Q1, one point"]
POINTS = 400  # of the profile


def soil(form, cells, adaptive):
    """Two waves behind a piston; error of v."""
    V = KINKED.waves(20e6)[-1].up
    waves = KINKED.behind_piston(V)
    end = .8 / waves[0].U
    run = study.run(here.parent / "compacting_soil" / "soil.prm", {
        **ELEMENT, **profiles.line(form, 1., cells), "Constraints/x min/Amplitude": V, "End time": end, **adaptive,
        **profiles.along("points", POINTS, 1., interval=end)}, repeat=1)
    line = profiles.read(run, "points")
    exact = numpy.array([KINKED.at(waves, X, line.time) for X in line.X]).T
    return run, line.l1(line.v, exact[0])


BLAST = Sedov(1.4)
FORMS = {1: {"Dimension": 1, "Symmetry": "spherical"},
         2: {"Dimension": 2, "Symmetry": "axisymmetric", "Constraints/Symmetry planes": "x min, y min"},
         3: {"Dimension": 3, "Symmetry": "none", "Constraints/Symmetry planes": "x min, y min, z min"}}


def blast(form, cells, adaptive):
    """All energy in the cell at the origin of the finest mesh; error of rho beyond 0.1 m."""
    size, end = 1.2, .9
    finest = cells * 2 ** int(adaptive.get("Adaptivity/Levels", 0))
    h = size / finest
    volume = {1: 4 * math.pi / 3, 2: 2 * math.pi, 3: 8}[form] * h ** 3
    inside = {1: "x", 2: "max(x, y)", 3: "max(x, y, z)"}[form]
    if adaptive:
        corner = ", ".join([f"{2.5 * h:.6g}"] * form)
        adaptive = {**adaptive, "Adaptivity/Refined boxes": f"{', '.join(['0'] * form)}; {corner}"}
    run = study.run(here.parent / "sedov_noh" / "blast.prm", {
        **FORMS[form], **ELEMENT, "Mesh/Upper corner": ", ".join([str(size)] * form), "Mesh/Cells": ", ".join([str(cells)] * form),
        "End time": end, "Initial conditions/Internal energy": f"({inside} < {h:.9g}) ? {1 / volume:.9g} : 0", **adaptive,
        **profiles.along("wall", POINTS, size, interval=end)}, repeat=1)
    line = profiles.read(run, "wall", power=2)
    return run, line.l1(line.rho, BLAST.at(line.x, end)[1], line.x > .1)


CASES = {  # name -> problem, form, equal cells, (cells, levels) of adaptive meshes
    "soil, plane wave": (soil, 1, study.choose((100, 200, 400, 800, 1600, 3200), quick=(100, 200)),
                         study.choose(((100, 1), (100, 2), (100, 3), (100, 4), (200, 4)), quick=((50, 2),))),
    "blast, radius": (blast, 1, study.choose((100, 200, 400, 800, 1600), quick=(100, 200)),
                      study.choose(((50, 2), (50, 3), (50, 4), (100, 4)), quick=((50, 2),))),
    "blast, meridian plane": (blast, 2, study.choose((30, 60, 120, 240), quick=(30,)),
                              study.choose(((15, 2), (15, 3), (15, 4), (30, 2), (30, 3)), quick=((15, 1),))),
    "blast, octant": (blast, 3, study.choose((16, 32, 64), quick=(12,)), study.choose(((8, 2), (8, 3), (16, 1), (16, 2)), quick=((6, 1),)))}
summary = []
for name, (problem, form, ladder, meshes) in CASES.items():
    rows = {"equal cells": [], "adaptive": []}
    for cells in ladder:
        run, error = problem(form, cells, {})
        rows["equal cells"].append(study.add(f"{name}, equal cells", run, error, cells=cells, levels=0, layers=0, end_cells=run["cells"],
                                             energy_error=run["energy_error"], momentum_error=run["momentum_error"]))
    for cells, levels in meshes:
        for layers in study.choose((3, 6, 12), quick=(4,)):
            run, error = problem(form, cells, {"Adaptivity/Levels": levels, "Adaptivity/Indicator": "shock front, velocity jump",
                                               "Adaptivity/Buffer layers": layers})
            rows["adaptive"].append(study.add(f"{name}, adaptive", run, error, cells=cells, levels=levels, layers=layers,
                                              end_cells=run["cells"], energy_error=run["energy_error"],
                                              momentum_error=run["momentum_error"]))
    for target in sorted({row["error"] for row in rows["equal cells"]}):
        best = {kind: tuning.cheapest(list_, 1.02 * target) for kind, list_ in rows.items()}
        if all(best.values()):
            summary.append({"case": name, "error": target, "equal cells [core-s]": best["equal cells"]["core_seconds"],
                            "adaptive [core-s]": best["adaptive"]["core_seconds"],
                            "gain": best["equal cells"]["core_seconds"] / best["adaptive"]["core_seconds"]})

table = common.markdown_table(summary)
print("\n" + table, flush=True)
study.finish(f"""Core-seconds of the cheapest mesh that is at most 2 % worse than equal cells of the error in the first column:

{table}

cells: of the initial mesh along one side; levels: on top of it; layers: of the buffer; end_cells: at the end of the run.""", ylabel="L1 error of v or rho")
