"""Cost of a step with a law in a mesh, by element, dimension, law and kinematics. See README.md."""
import sys
from pathlib import Path
sys.path.insert(0, str(Path(__file__).resolve().parents[1]))
import common

study = common.Study(__file__)

# name -> type, degree, points per cell and nodes per cell in one direction
ELEMENTS = {"one-point": ("one-point hexahedron", 1, 0), "2 points a side": ("hexahedron", 1, 2), "degree 2": ("spectral element", 2, 3),
            "degree 4": ("spectral element", 4, 5)}
FORMS = {"plane wave": (1, "plane wave", 4096), "spherical": (1, "spherical", 4096), "plane strain": (2, "plane strain", 64),
         "axisymmetric": (2, "axisymmetric", 64), "space": (3, "none", 16)}
LAWS = {"fused elastic": ("block.prm", "small strain"), "elastic, finite strain": ("block.prm", "finite strain"),
        "cap, small strain": ("cap.prm", "small strain"), "cap, finite strain": ("cap.prm", "finite strain")}
STEPS = 100 if study.quick else 200

rows, per_cell = [], {}


def measure(form, element, law, cells=None, **more):
    """STEPS steps of a block of n^dimension cells; the run and n."""
    dimension, symmetry, cells_of_form = FORMS[form]
    kind, degree, points = ELEMENTS[element]
    scene, kinematics = LAWS[law]
    n = (cells or cells_of_form) // degree
    corner = (1 if symmetry in ("spherical", "axisymmetric") else 0,) + (0,) * (dimension - 1)
    step = 0.3 / n / degree**2 / 310.
    settings = {"Dimension": dimension, "Symmetry": symmetry, "Kinematics": kinematics, "Element/Type": kind,
                "Element/Degree": degree, "Mesh/Cells": ", ".join([str(n)] * dimension), "Mesh/Lower corner": ", ".join(map(str, corner)),
                "Mesh/Upper corner": ", ".join(str(c + 1) for c in corner), "Time stepping/Fixed step": step, "End time": STEPS * step}
    return study.run(scene, {**settings, **more.pop("settings", {})}, **more), n


for form, (dimension, symmetry, cells) in FORMS.items():
    for element, (kind, degree, points) in ELEMENTS.items():
        for law in LAWS:
            run, n = measure(form, element, law)
            ns = 1e9 * run.fastest / run["steps"]
            per_cell[form, element, law] = ns / n**dimension
            rows.append({"form": form, "element": element, "law": law, "ns per point": ns / (n * max(1, points))**dimension,
                         "ns per cell": per_cell[form, element, law],
                         "over fused": per_cell[form, element, law] / per_cell[form, element, "fused elastic"],
                         "energy error": run["energy_error"], "spread": run.spread})
            print("  " + ", ".join(f"{name} {common.text(value)}" for name, value in rows[-1].items()), flush=True)

parts = []
for form, cells in (("plane wave", 4096), ("axisymmetric", 64), ("space", 24)):
    for element in ELEMENTS:
        for ranks in (1, 2):
            run, n = measure(form, element, "cap, finite strain", cells, ranks=ranks, repeat=1, settings={"Output/Cost of parts": "true"})
            parts.append({"form": form, "element": element, "ranks": ranks,
                          **{f"{name} [%]": round(100 * run["parts"][name] / run["core_seconds"], 1) for name in
                             ("laws", "strain and nodal forces", "gather and scatter", "exchange", "loads", "step",
                              "receivers, ledgers and the rest")}})
            print("  " + ", ".join(f"{name} {common.text(value)}" for name, value in parts[-1].items()), flush=True)

table, shares = common.markdown_table(rows), common.markdown_table(parts)
gain = per_cell["space", "2 points a side", "cap, small strain"] / per_cell["space", "one-point", "cap, small strain"]
words = (f"Nanoseconds of the whole step on one core, fastest of {study.repeat} runs of {STEPS} steps. In space a cell of one point is {gain:.1f} times "
         "cheaper with the cap than one of 2x2x2 points.")
shares = f"""Where the time goes, cap at finite strain, in % of the time loop (measuring costs some of it). Two ranks share the machine's memory and
wait for each other in `exchange`:

{shares}"""
print(f"\n{table}\n\n{words}\n\n{shares}\n{study.disturbed}")
if study.write:
    common.write_csv(study.folder / "results.csv", rows)
    facts = ", ".join(f"{name.replace('deal_ii', 'deal.II')} {value}" for name, value in common.machine(study.last).items())
    common.report(study.name, f"## Cost of a law in a mesh\n\n{words}\n\n{table}\n\n{shares}\n\n*{facts}.* {study.disturbed}")
