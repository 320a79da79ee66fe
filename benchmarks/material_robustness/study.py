"""Random updates of all laws, each checked against its equations. See README.md."""
import json, os, subprocess, sys
from pathlib import Path
sys.path.insert(0, str(Path(__file__).resolve().parents[1]))
import common

study = common.Study(__file__)
environment = dict(os.environ, OMP_NUM_THREADS="1")


def results(program, updates):
    """Exit code and results of one of the programs."""
    file = common.scratch().with_suffix(".json")
    file.parent.mkdir(exist_ok=True)
    run = subprocess.run([common.program(program), "--updates", str(updates), "--output", file], text=True, env=environment,
                         stdout=subprocess.DEVNULL)
    return run.returncode, json.loads(file.read_text())


def share(counts, sums):
    """Histogram as per cent."""
    total = sum(counts.values())
    return {f"up to {c}": f"{100 * counts.get(str(c), 0) / total:.3g} %" for c in sums}


def classes(rows, name):
    return sorted({int(c) for r in rows for c in r[name]})


of_equations = 1000000 if study.quick else 50000000  # about a quarter of them is plastic
of_examples = 100000 if study.quick else 10000000
failed_equations, sets = results("material_robustness", of_equations)
failed_laws, laws = results("material_robustness_laws", of_examples)

rows = [{"set": s["set"], "plastic": s["plastic"], "failed": s["failed"], "residual": s["worst_residual"],
         "lanes differ by": s["worst_lanes"], "mean iterations": s["mean_iterations"], "nested brackets": s["fallbacks"],
         "corners": s["corners"]} for s in sets]
passes = [{"set": s["set"], **share(s["iterations_up_to"], classes(sets, "iterations_up_to"))} for s in sets]
law_rows = [{"law": r["law"], "example": r["example"], "updates": r["updates"], "inelastic": r["inelastic"], "failed": r["failed"],
             "residual": r["residual"], "dissipation": r["dissipation"], "reported dissipation": r["reported_dissipation"],
             "history": r["history"], "corners": r["corners"]} for r in laws]
solving = [r for r in laws if set(r["passes_up_to"]) != {"0"}]
law_passes = [{"law": r["law"], "example": r["example"], **share(r["passes_up_to"], classes(solving, "passes_up_to"))} for r in solving]
dividing = [r for r in laws if set(r["parts_up_to"]) != {"1"}]
law_parts = [{"law": r["law"], "example": r["example"], **share(r["parts_up_to"], classes(dividing, "parts_up_to"))} for r in dividing]

n, failed = sum(s["plastic"] for s in sets), sum(s["failed"] for s in sets)
words = f"{n / 1e6:.1f} million plastic updates, {failed} failed; worst residual {max(s['worst_residual'] for s in sets):.1e}."
n, failed = sum(r["updates"] for r in laws), sum(r["failed"] for r in laws)
law_words = f"{n / 1e6:.1f} million updates, {failed} failed; worst residual {max(r['residual'] for r in laws):.1e}."
text = f"""Whole laws, {of_examples / 1e6:g} million random updates of each example of tests/data/laws, in lanes. {law_words}

{common.markdown_table(law_rows)}

Passes through the equations per batch of lanes whose step is not divided:

{common.markdown_table(law_passes)}

Parts of a step, per batch:

{common.markdown_table(law_parts)}

The return mapping of the viscoplastic cap alone, {of_equations / 1e6:g} million updates of which those that yield are counted. {words}

{common.markdown_table(rows)}

Passes through the residual per plastic update:

{common.markdown_table(passes)}"""
print("\n" + text, flush=True)
if study.write:
    common.write_csv(study.folder / "results.csv", law_rows + [{"law": "viscoplastic cap, return mapping", "example": r["set"], **r} for r in rows])
    common.report(study.name, f"## Robustness of the material update\n\n{text}")
sys.exit(failed_equations or failed_laws)
