"""One scene in three, two and one dimensions: error against core-seconds, and what each form saves. See README.md."""
import sys
from pathlib import Path
sys.path.insert(0, str(Path(__file__).resolve().parents[1]))
import common, tuning

OCTANT = {"Dimension": 3, "Symmetry": "none"}
PLANE = {"Dimension": 2, "Symmetry": "axisymmetric"}
RADIUS = {"Dimension": 1, "Symmetry": "spherical"}
SPHERES = {"octant": OCTANT, "meridian plane": PLANE, "radius": RADIUS}

# cavity: element -> form -> refinements
LADDERS = {"Q4": {"octant": (0, 1, 2, 3), "meridian plane": (0, 1, 2, 3, 4), "radius": (0, 1, 2, 3, 4, 5)},
           "Q1, 2x2x2": {"octant": (2, 3, 4), "meridian plane": (2, 3, 4, 5, 6), "radius": (2, 3, 4, 5, 6, 7, 8)}}
QUICK = {"Q4": {"octant": (1,), "meridian plane": (1, 2), "radius": (1, 2)}}
SAME_MESH = {"Q4": 2, "Q1, 2x2x2": 4}  # the refinement that is compared in the table

# other scenes: file, receivers -> form -> settings
BAR = {"brick": OCTANT,
       "strip": {"Dimension": 2, "Symmetry": "plane strain", "Mesh/Upper corner": "1, 0.2", "Mesh/Cells": "20, 4",
                 "Constraints/Symmetry planes": "y min, y max"},
       "line": {"Dimension": 1, "Symmetry": "plane wave", "Mesh/Upper corner": 1, "Mesh/Cells": 20,
                "Constraints/Symmetry planes": "auto"}}
BALL = {"octant": OCTANT, "meridian plane": {**PLANE, "Mesh/Refinement": 3}, "radius": {**RADIUS, "Mesh/Refinement": 4}}
SCENES = {"plane wave, Q4": ("bar.prm", "generic", BAR),
          "breathing ball, Q4": ("ball.prm", "generic", BALL),
          "buried cavity, Q4": ("buried.prm", "surface", {"quarter": OCTANT, "meridian plane": PLANE})}

study = common.Study(__file__)
savings = []


def measure(file, settings):
    """A run with the fastest of its repetitions for its time: loops of milliseconds lose whole slices to other programs."""
    whole = settings["Dimension"] == 3
    finest = whole and settings.get("Mesh/Refinement", 0) == 3  # long, and little disturbed in proportion
    run = study.run(file, settings, repeat=1 if study.quick or finest else study.repeat * (1 if whole else 3))
    run.spread = run.core_seconds / run.fastest - 1  # of the median
    run.core_seconds = run.fastest
    return run


def save(scene, form, run, error):
    """A row of the table of savings; the first form of a scene is what the others are compared with."""
    whole = next((row for row in savings if row["scene"] == scene), None)
    factor = lambda x: round(x) if x >= 10 else x
    row = {"scene": scene, "form": form, "cells": run["cells"], "unknowns": run["dofs"], "steps": run["steps"],
           "time loop [core-s]": run.core_seconds, "set-up [core-s]": run["setup_core_seconds"],
           "memory [MB]": round(run["peak_memory_mb"]), "E_t of u": error}
    row["less time"] = factor(whole["time loop [core-s]"] / run.core_seconds) if whole else 1
    row["fewer unknowns"] = factor(whole["unknowns"] / run["dofs"]) if whole else 1
    savings.append(row)


for element, forms in (QUICK if study.quick else LADDERS).items():
    for form, refinements in forms.items():
        for refinement in refinements:
            settings = {**SPHERES[form], **tuning.ELEMENTS[element], "Mesh/Refinement": refinement}
            run = measure("../spherical_cavity/P1.prm", settings)
            error = run.errors["generic.displacement.E_t"]
            study.add(f"{element}, {form}", run, error, refinement=refinement, cells=run["cells"], dofs=run["dofs"],
                      steps=run["steps"], stress=run.errors["generic.stress.E_t"], memory=run["peak_memory_mb"])
            if refinement == (1 if study.quick else SAME_MESH[element]):
                save(f"cavity, {element}", form, run, error)
for scene, (file, receivers, forms) in SCENES.items():
    for form, settings in forms.items():
        quick = {"Mesh/Refinement": 0} if study.quick and scene.startswith("buried") else {}
        run = measure(file, {**settings, **quick})
        error = run.errors[f"{receivers}.displacement.E_t"]
        study.add(f"{scene}, {form}", run, error, cells=run["cells"], dofs=run["dofs"], steps=run["steps"],
                  memory=run["peak_memory_mb"])
        save(scene, form, run, error)

table = common.markdown_table(savings, titles={"E_t of u": "E_t of u"})
print("\n" + table, flush=True)
if study.write:
    common.write_csv(study.folder / "results.csv", study.rows)
    ladders = {name: points for name, points in study.series.items() if name.startswith("Q") and len(points) > 1}
    common.figure(study.folder / "error_versus_time.svg", ladders, ylabel="E_t of the displacement",
                  title="Cavity P1 in three forms")
    facts = ", ".join(f"{k.replace('deal_ii', 'deal.II')} {v}" for k, v in common.machine(study.last).items())
    common.report(study.name, f"""## Fewer dimensions: what a form saves

Scenes that exist in more than one form. Element, coarse mesh and refinement are the same in each, but for the ball, whose plane and
radius are refined further, to comparable errors. 'less time' and 'fewer unknowns' are factors against the first form of a scene;
a process holds most of its memory before it has a mesh.

{table}

Error and time of the cavity (P1 of spherical_cavity), one curve per element and form:

![error versus core-seconds](fewer_dimensions/error_versus_time.svg)

*{facts}. Times are the least of {study.repeat} runs in three dimensions (finest octant: one) and of {3 * study.repeat} in fewer.* {study.disturbed}""")
