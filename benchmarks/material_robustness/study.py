"""Random updates of the cap model, each checked against its equations. See README.md."""
import json, os, subprocess, sys
from pathlib import Path
sys.path.insert(0, str(Path(__file__).resolve().parents[1]))
import common

study = common.Study(__file__)
program = common.program("material_robustness")

updates = 1000000 if study.quick else 50000000  # about a quarter of them is plastic
file = common.scratch().with_suffix(".json")
file.parent.mkdir(exist_ok=True)
run = subprocess.run([program, "--updates", str(updates), "--output", file], text=True, env=dict(os.environ, OMP_NUM_THREADS="1"))
sets = json.loads(file.read_text())
classes = sorted({int(c) for s in sets for c in s["iterations_up_to"]})
rows = [{"set": s["set"], "plastic": s["plastic"], "failed": s["failed"], "worst residual": s["worst_residual"],
         "lanes differ by": s["worst_lanes"], "mean iterations": s["mean_iterations"], "nested brackets": s["fallbacks"],
         "corners": s["corners"]} for s in sets]
histogram = [{"set": s["set"], **{f"up to {c}": f"{100 * s['iterations_up_to'].get(str(c), 0) / s['plastic']:.3g} %" for c in classes}}
             for s in sets]
total, failed = sum(s["plastic"] for s in sets), sum(s["failed"] for s in sets)
words = f"{total / 1e6:.1f} million plastic updates, {failed} failed; worst residual {max(s['worst_residual'] for s in sets):.1e}."
print("\n" + common.markdown_table(rows) + "\n\n" + common.markdown_table(histogram) + "\n\n" + words, flush=True)
if study.write:
    common.write_csv(study.folder / "results.csv", rows)
    common.report(study.name, f"""## Robustness of the material update

Random updates of the viscoplastic cap, {updates / 1e6:g} million of which those that yield are counted. {words}

{common.markdown_table(rows)}

Passes through the residual per plastic update:

{common.markdown_table(histogram)}""")
sys.exit(run.returncode)
