"""How well does `arenite check` know what an adaptive run will cost? Three levels in space. See README.md."""
import re, subprocess, sys
from pathlib import Path
here = Path(__file__).resolve().parent
sys.path.insert(0, str(here.parent))
import common

study = common.Study(__file__)
PRM = here.parents[1] / "prm"
SPACE = {"Dimension": 3, "Symmetry": "none", "Mesh/Sector": "octant", "Output/VTU interval": 0}
CAVITY = {**SPACE, "Mesh/Radial layers": 10, "Mesh/Refinement": 1, "Mesh/Refine geometry": "true",
          "Adaptivity/Indicator": "velocity jump, stress gradient", "Adaptivity/Refine above": .1, "Adaptivity/Coarsen below": .05}
LEVELS = study.choose((3,), quick=(2,))[0]
CASES = {  # name -> scene, settings, ranks
    "dry sand, 100 MPa": (PRM / "cap_cavity_dry.prm", CAVITY, 2),
    "saturated sand, 100 MPa": (PRM / "cap_cavity_saturated.prm", {**CAVITY, "End time": 1e-3}, 2),
    "elastic pulse": (PRM / "following_the_front.prm", {**SPACE, "Mesh/Refinement": 1, "Adaptivity/Refine above": .1, "Adaptivity/Coarsen below": .03}, 1),
    "two waves along a brick": (here.parent / "compacting_soil" / "soil.prm", {
        "Dimension": 3, "Symmetry": "none", "Mesh/Upper corner": "1, 0.04, 0.04", "Mesh/Cells": "25, 1, 1", "End time": 2.25e-3,
        "Element/Type": "one-point hexahedron", "Constraints/Symmetry planes": "y min, y max, z min, z max", "Adaptivity/Buffer layers": 16,
        "Adaptivity/Indicator": "shock front, velocity jump", "Adaptivity/Refine above": .04, "Adaptivity/Coarsen below": .01}, 1)}
if study.quick:
    CASES = {name: CASES[name] for name in ("elastic pulse",)}

FORECAST = re.compile(r"Forecast +about (\S+) core-seconds .*?, (\d+) MB of memory, at most (\d+) cells: from trials of up to (\d+) .*?\((\S+) core-seconds\)")


def forecast(scene, settings, ranks):
    """What `check` says: time [core-s], memory [MB], cells, levels and time [core-s] of the trials."""
    arguments = ["check", scene] + [word for name, value in settings.items() for word in ("--set", f"{name}={value}")]
    done = subprocess.run(common.command(arguments, ranks), stdin=subprocess.DEVNULL, capture_output=True, text=True)
    found = FORECAST.search(done.stdout)
    if not found:
        common.stop(f"no forecast for {scene.name}:\n" + done.stdout + done.stderr)
    return [float(number) for number in found.groups()]


summary = []
for name, (scene, settings, ranks) in CASES.items():
    settings = {**settings, "Adaptivity/Levels": LEVELS}
    expected = dict(zip(("seconds", "memory", "cells", "levels", "trials"), forecast(scene, settings, ranks)))
    run = study.run(scene, settings, ranks, repeat=1)
    study.add(name, run, abs(expected["seconds"] / run.core_seconds - 1.), cells=run["most_cells"], steps=run["steps"],
              adapting=run["adaptation_core_seconds"] / run.core_seconds, memory_mb=run["total_memory_mb"], energy_error=run["energy_error"])
    summary.append({"scene": name, "time [core-s]": run.core_seconds, "forecast": expected["seconds"], "off": expected["seconds"] / run.core_seconds - 1.,
                    "memory [MB]": run["total_memory_mb"], "forecast ": expected["memory"], "off ": expected["memory"] / run["total_memory_mb"] - 1.,
                    "cells": run["most_cells"], "forecast  ": expected["cells"], "trials [core-s]": expected["trials"]})

table = common.markdown_table(summary)
print("\n" + table, flush=True)
study.finish(f"""Time of the time loop, memory of all processes and the most cells at a time, and what `arenite check` said beforehand, from trials with up to two levels:

{table}

error: of the forecast of the time.""", ylabel="error of the forecast")
