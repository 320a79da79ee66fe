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
ONE_POINT, Q2 = tuning.ELEMENTS["Q1, one point"], tuning.ELEMENTS["Q2"]
FORMS = {1: {"Dimension": 1, "Symmetry": "spherical"}, 2: {"Dimension": 2, "Symmetry": "axisymmetric"}, 3: {"Dimension": 3, "Symmetry": "none"}}
POINTS = 400  # of a profile


# Each problem: (form, size of the initial mesh, settings of the adaptation, ranks) -> run, error
def pulse(form, refinement, adaptive, ranks):
    """Elastic pulse from a cavity against the exact solution; E_t of u at four radii."""
    run = study.run(here.parents[1] / "prm" / "following_the_front.prm",
                    {**FORMS[form], **Q2, "Mesh/Refinement": refinement, "Output/VTU interval": 0, "Adaptivity/Levels": 0, **adaptive}, ranks, repeat=1)
    return run, run["errors"]["array.displacement.E_t"]


def soil(form, cells, adaptive, ranks):
    """Two waves behind a piston, in space along a brick; error of v."""
    V = KINKED.waves(20e6)[-1].up
    waves = KINKED.behind_piston(V)
    end = .8 / waves[0].U
    run = study.run(here.parent / "compacting_soil" / "soil.prm", {
        **ONE_POINT, **profiles.line(form, 1., cells, across=cells // 25), "Constraints/x min/Amplitude": V, "End time": end, **adaptive,
        **profiles.along("points", POINTS, 1., interval=end)}, ranks, repeat=1)
    line = profiles.read(run, "points")
    exact = numpy.array([KINKED.at(waves, X, line.time) for X in line.X]).T
    return run, line.l1(line.v, exact[0])


BLAST = Sedov(1.4)


def blast(form, cells, adaptive, ranks):
    """All energy in the cell at the origin of the finest mesh; error of rho in what began beyond 0.3 m. In the plane and in space cells fold around
    the source, with equal cells too (sedov_noh): nothing to compare."""
    size, end = 1.2, .9
    h = size / (cells * 2 ** int(adaptive.get("Adaptivity/Levels", 0)))
    if adaptive:
        adaptive = {**adaptive, "Adaptivity/Refined boxes": "0; 0.3"}
    run = study.run(here.parent / "sedov_noh" / "blast.prm", {
        **FORMS[form], **ONE_POINT, "Mesh/Upper corner": size, "Mesh/Cells": cells, "End time": end,
        "Initial conditions/Internal energy": f"(x < {h:.9g}) ? {3 / (4 * math.pi * h ** 3):.9g} : 0", **adaptive,
        **profiles.along("wall", POINTS, size, interval=end)}, ranks, repeat=1)
    line = profiles.read(run, "wall", power=2)
    return run, line.l1(line.rho, BLAST.at(line.x, end)[1], line.X > .3)


def signals(run):
    """Radial displacement at the three receivers on the same times."""
    table = run.table("receivers-array.csv")
    t = numpy.array(table["t [s]"])
    wanted = numpy.linspace(0., 2e-3, 101)
    result = []
    for point in ("d1r1", "d1r2", "d1r3"):
        parts = [numpy.array(values) for name, values in table.items() if name.startswith(f"{point}.displacement")]
        result.append(numpy.interp(wanted, t, numpy.sqrt(sum(part ** 2 for part in parts))))
    return numpy.array(result)


CAP = here / "cap_cavity.prm"
REFERENCE = signals(study.run(CAP, {**FORMS[1], "Mesh/Refinement": study.choose([6], quick=[3])[0]}, repeat=1))


def cap(form, refinement, adaptive, ranks):
    """Cap soil around a cavity against many equal cells on the radius; displacements over time at three radii, each relative to its own size."""
    run = study.run(CAP, {**FORMS[form], "Mesh/Refinement": refinement, **adaptive}, ranks, repeat=1)
    found = signals(run)
    return run, math.sqrt(numpy.mean([((f - r) ** 2).sum() / (r ** 2).sum() for f, r in zip(found, REFERENCE)]))


SHOCK = {"Adaptivity/Indicator": "shock front, velocity jump"}
FOOT = {**SHOCK, "Adaptivity/Refine above": .012, "Adaptivity/Coarsen below": .004, "Adaptivity/Layers behind": 4}  # the precursor has a tenth of the pressure
CAVITY = {"Adaptivity/Indicator": "velocity jump, stress gradient", "Adaptivity/Refine above": .1, "Adaptivity/Coarsen below": .02}
WAVE = {"Adaptivity/Refine above": .1, "Adaptivity/Coarsen below": .03}
CASES = {  # name -> problem, form, indicators, equal meshes, (size, levels) of adaptive meshes
    "elastic pulse, radius": (pulse, 1, WAVE, (1, 2, 3, 4, 5, 6), ((1, 2), (1, 4), (2, 3))),
    "elastic pulse, meridian plane": (pulse, 2, WAVE, (1, 2, 3, 4, 5), ((1, 2), (1, 3), (2, 2))),
    "elastic pulse, octant": (pulse, 3, WAVE, (1, 2, 3, 4), ((1, 1), (1, 2), (1, 3))),
    "soil, plane wave": (soil, 1, FOOT, (100, 200, 400, 800, 1600), ((50, 3), (100, 3), (100, 4))),
    "soil, brick": (soil, 3, FOOT, (100, 200, 400, 800), ((25, 2), (25, 3), (50, 3), (100, 3))),
    "blast, radius": (blast, 1, SHOCK, (100, 200, 400, 800), ((50, 2), (50, 3), (50, 4))),
    "cap cavity, radius": (cap, 1, CAVITY, (1, 2, 3, 4), ((1, 2), (1, 3), (1, 4))),
    "cap cavity, meridian plane": (cap, 2, CAVITY, (1, 2, 3, 4), ((1, 1), (1, 2), (1, 3))),
    "cap cavity, octant": (cap, 3, CAVITY, (1, 2, 3), ((1, 1), (1, 2)))}
TWO_RANKS = {"elastic pulse, octant": (3, (1, 2)), "soil, brick": (200, (25, 3)), "cap cavity, octant": (3, (1, 2))}  # equal, adaptive
QUICK = {"cap cavity, radius": ((1, 2), ((1, 1),)), "soil, plane wave": ((100,), ((50, 1),)), "elastic pulse, radius": ((2,), ((1, 1),)), "blast, radius": ((100,), ((50, 1),))}
summary = []
for name, (problem, form, indicators, ladder, meshes) in CASES.items():
    if study.quick:
        if name not in QUICK:
            continue
        ladder, meshes = QUICK[name]
    rows = {}

    def measure(kind, size, levels=0, layers=0, ranks=1):
        run, error = problem(form, size, {"Adaptivity/Levels": levels, "Adaptivity/Buffer layers": layers, **indicators} if levels else {}, ranks)
        row = study.add(f"{name}, {kind}", run, error, size=size, levels=levels, layers=layers, end_cells=run["cells"],
                        adapting=run["adaptation_core_seconds"] / run.core_seconds, memory_mb=run["total_memory_mb"], energy_error=run["energy_error"])
        rows.setdefault((kind, ranks), []).append(row)

    for size in ladder:
        measure("equal cells", size)
    for size, levels in meshes:
        for layers in study.choose((16,) if size * 2 ** levels >= 800 and form == 3 else (4, 8, 16), quick=(8,)):
            measure("adaptive", size, levels, layers)
    if name in TWO_RANKS:
        equal, (size, levels) = TWO_RANKS[name]
        measure("equal cells", equal, ranks=2)
        measure("adaptive", size, levels, 16, ranks=2)
    for target in sorted({row["error"] for row in rows["equal cells", 1]}):
        best = {kind: tuning.cheapest(rows[kind, 1], 1.02 * target) for kind in ("equal cells", "adaptive")}
        if all(best.values()):
            summary.append({"case": name, "error": target, "equal cells [core-s]": best["equal cells"]["core_seconds"],
                            "adaptive [core-s]": best["adaptive"]["core_seconds"], "of that adapting": best["adaptive"]["adapting"],
                            "gain": best["equal cells"]["core_seconds"] / best["adaptive"]["core_seconds"]})

table = common.markdown_table(summary)
print("\n" + table, flush=True)
study.finish(f"""Core-seconds of the cheapest mesh that is at most 2 % worse than equal cells of the error in the first column:

{table}

size: refinements of the initial mesh, or its cells along one side; levels: on top of it; layers: of the buffer; end_cells: at the end of the run;
adapting: part of the time loop.""", ylabel="relative error")
