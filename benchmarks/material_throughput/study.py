"""Nanoseconds per update of the material laws, one by one and in lanes. See README.md."""
import json, os, subprocess, sys
from pathlib import Path
sys.path.insert(0, str(Path(__file__).resolve().parents[1]))
import common

study = common.Study(__file__)
program = common.program("material_throughput")

file = common.scratch().with_suffix(".json")
file.parent.mkdir(exist_ok=True)
subprocess.run([program, "--repetitions", "3" if study.quick else "100", "--output", file], check=True,
               env=dict(os.environ, OMP_NUM_THREADS="1"))
results = json.loads(file.read_text())
traffic = min(r["lanes_ns"] for r in results if r["law"] == "traffic of the arrays")
rows = [{"law": r["law"], "workload": r["workload"], "plastic [%]": 100 * r["plastic"], "one by one [ns]": r["scalar_ns"],
         f"in {r['lanes']} lanes [ns]": r["lanes_ns"], "gain": r["scalar_ns"] / r["lanes_ns"], "over traffic": r["lanes_ns"] / traffic,
         "passes alone": r["passes"], "in lanes": r["lanes_passes"], "waiting [%]": 100 * r["waiting"]} for r in results]
print("\n" + common.markdown_table(rows), flush=True)
if study.write:
    common.write_csv(study.folder / "results.csv", rows)
    facts = ", ".join(f"{name} {value}" for name, value in common.machine().items())
    common.report(study.name, f"""## Speed of the material laws

Nanoseconds per update of one point on one core; workloads in material_throughput/README.md.

{common.markdown_table(rows)}

*{facts}.* {study.disturbed}""")
