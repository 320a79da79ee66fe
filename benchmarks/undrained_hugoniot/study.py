"""Shock speed over particle speed in wet soil with 0 to 4 % of air. See README.md."""
import subprocess, sys
from pathlib import Path
sys.path.insert(0, str(Path(__file__).resolve().parents[1]))
import common

POROSITY = 0.4
PARTICLE_SPEEDS = [0.1, 1, 3, 10, 30, 100, 300]  # m/s


def curve(air, scratch):
    """(up, Us) from rest, in steps of the compression that are fine where the air closes."""
    points = []
    for strain in (air + 2e-4, air + 5e-3, air + 0.2):
        file = scratch.with_suffix(".csv")
        settings = [f"Materials/soil/Soil state/Saturation={1 - air / POROSITY!r}", f"Test/Strains={-strain!r}", "Test/Rows=2000"]
        subprocess.run([common.binary(), "material", study.folder.parents[1] / "prm/material_wet_soil.prm", "--output", file] +
                       [a for s in settings for a in ("--set", s)], check=True, stdout=subprocess.DEVNULL)
        lines = [line.split(",") for line in file.read_text().splitlines() if not line.startswith("#")]
        up, us = (next(i for i, name in enumerate(lines[0]) if name.startswith(n)) for n in ("up", "Us"))
        points += [(float(line[up]), float(line[us])) for line in lines[1:] if float(line[up]) > 0]
    return sorted(points)


def interpolated(points, x):
    for (x0, y0), (x1, y1) in zip(points, points[1:]):
        if x0 <= x <= x1:
            return y0 + (y1 - y0) * (x - x0) / (x1 - x0) if x1 > x0 else y0
    return float("nan")


study = common.Study(__file__)
scratch = common.scratch()
scratch.parent.mkdir(parents=True, exist_ok=True)
rows = []
for air in (0, 0.001, 0.01, 0.02, 0.04):
    points = curve(air, scratch)
    rows.append({"air [%]": 100 * air, **{f"up = {up:g} m/s": round(interpolated(points, up)) for up in PARTICLE_SPEEDS}})
table = common.markdown_table(rows)
print("\n" + table, flush=True)
if study.write:
    common.write_csv(study.folder / "results.csv", rows)
    common.report(study.name, f"""## Shocks in wet soil with a little air

Shock speed Us [m/s] by particle speed up, three phase mixture of porosity 40 %; undrained_hugoniot/README.md.

{table}""")
