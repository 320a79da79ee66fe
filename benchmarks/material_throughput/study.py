"""Nanoseconds per update of the material laws, one by one and in lanes. See README.md."""
import json, os, subprocess, sys
from pathlib import Path
sys.path.insert(0, str(Path(__file__).resolve().parents[1]))
import common

study = common.Study(__file__)
program = common.program("material_throughput")

file = common.scratch().with_suffix(".json")
file.parent.mkdir(exist_ok=True)
subprocess.run([program, "--repetitions", "3" if study.quick else "25", "--output", file], check=True,
               env=dict(os.environ, OMP_NUM_THREADS="1"))
rows = [{"law": r["law"], "workload": r["workload"], "plastic [%]": 100 * r["plastic"], "one by one [ns]": r["scalar_ns"],
         f"in {r['lanes']} lanes [ns]": r["lanes_ns"], "gain": r["scalar_ns"] / r["lanes_ns"]} for r in json.loads(file.read_text())]
print("\n" + common.markdown_table(rows), flush=True)
if study.write:
    common.write_csv(study.folder / "results.csv", rows)
    facts = ", ".join(f"{name} {value}" for name, value in common.machine().items())
    common.report(study.name, f"""## Speed of the material laws

Nanoseconds per update of one point on one core; workloads in material_throughput/README.md.

{common.markdown_table(rows)}

*{facts}.* {study.disturbed}""")
