"""Error against core-seconds for every element, uniform and adaptive meshes, near and far boundary. See README.md."""
import re, sys
from pathlib import Path
sys.path.insert(0, str(Path(__file__).resolve().parents[1]))
import common, tuning

study = common.Study(__file__)
SCENES = {"near": ["cavity.prm"], "far": ["cavity.prm", "far.prm"]}
GOALS = (.01, .003, .001, .0003, .0001)

# element: (refinement, radial layers of the coarse mesh)
UNIFORM = {
    "near": {"Q4": [(0, 2), (0, 3), (0, 4), (0, 6), (1, 2), (1, 3), (1, 4), (2, 2)],
             "Q3": [(0, 3), (0, 5), (1, 2), (1, 3), (1, 5), (2, 3)],
             "Q2": [(1, 2), (1, 4), (2, 2), (2, 3), (2, 5), (3, 3)],
             "Q1, one point": [(2, 3), (3, 2), (3, 4), (4, 2), (4, 3)],
             "Q1, 2x2x2": [(2, 3), (3, 2), (3, 4), (4, 2)]},
    "far": {"Q4": [(0, 7), (0, 10), (0, 14), (0, 20), (1, 7), (1, 10), (1, 14), (2, 7)],
            "Q3": [(0, 10), (0, 14), (0, 20), (1, 7), (1, 10), (1, 14), (2, 10)],
            "Q2": [(1, 14), (1, 20), (2, 7), (2, 14), (3, 7)],
            "Q1, one point": [(2, 20), (3, 7), (3, 14), (4, 7)],
            "Q1, 2x2x2": [(2, 20), (3, 7), (3, 14), (4, 7)]},
}
# (refinement, layers, levels, buffer layers, refine above)
ADAPTIVE = {
    "near": {"Q4": [(0, 2, 1, 2, .2), (1, 2, 1, 2, .2)], "Q3": [(1, 2, 1, 2, .2)], "Q2": [(1, 2, 1, 4, .2)],
             "Q1, one point": [(2, 2, 1, 4, .2)]},
    "far": {"Q4": [(0, 7, 1, 2, .2), (0, 14, 1, 2, .2), (0, 7, 2, 2, .2), (1, 7, 1, 2, .2), (1, 7, 1, 4, .2),
                   (1, 7, 1, 2, .5)],
            "Q3": [(0, 14, 1, 2, .2), (1, 7, 1, 2, .2)], "Q2": [(1, 7, 1, 4, .2), (2, 7, 1, 4, .2)],
            "Q1, one point": [(2, 7, 1, 4, .2)]},
}
OUTER = {"near": [.26, .3], "far": [.8]}
if study.quick:
    UNIFORM = {"near": {"Q4": [(0, 2), (1, 2)], "Q1, one point": [(3, 2)]}, "far": {"Q4": [(0, 10), (1, 7)]}}
    ADAPTIVE = {"near": {"Q4": [(0, 2, 1, 2, .2)]}, "far": {"Q4": [(0, 7, 1, 2, .2)]}}
    OUTER = {"near": [.3], "far": [.8]}


def measure(scene, element, settings, repeat):
    run = study.run(SCENES[scene], dict(tuning.ELEMENTS[element], **settings), repeat=repeat, timeout=120)
    adapted = re.search(r"Adapted\s+(\d+) times in (\S+)", (run.directory / "log.txt").read_text())
    row = {"scene": scene, "element": element, "mesh": "adaptive" if settings.get("Adaptivity/Levels") else "uniform",
           "refinement": settings["Mesh/Refinement"], "levels": settings.get("Adaptivity/Levels", 0),
           "layers": settings["Mesh/Radial layers"], "spacing": settings["Mesh/Radial spacing"],
           "outer_radius": settings["Mesh/Outer radius"], "courant": settings["Time stepping/Courant number"],
           "buffer": settings.get("Adaptivity/Buffer layers", 0), "refine_above": settings.get("Adaptivity/Refine above", 0),
           "steps": run["steps"], "dof_steps": 1e6 * run["mdofs_per_core_second"] * run.core_seconds,
           "error": run.errors["array.displacement.E_t"], "error_x": run.errors["volume.displacement.E_x"],
           "core_seconds": run.core_seconds, "setup": run["setup_core_seconds"],
           "adaptations": int(adapted[1]) if adapted else 0,
           "adaptation_share": float(adapted[2]) / run.core_seconds if adapted else 0., "spread": run.spread}
    print("  " + ", ".join(f"{name} {common.text(value)}" for name, value in row.items()), flush=True)
    return row


def look_around(scene, element, list_of_settings):
    """One run each; the front again with all repetitions."""
    tried = []
    for settings in list_of_settings:
        try:
            tried.append((measure(scene, element, settings, 1), settings))
        except (RuntimeError, common.subprocess.TimeoutExpired) as error:
            failed.append(f"{scene}, {element}, {settings}")
            print(f"  failed: {failed[-1]}: {str(error)[-200:]}", flush=True)
    all_rows.extend(row for row, _ in tried)
    best = tuning.front([row for row, _ in tried])
    if study.repeat == 1:
        return best
    return [measure(scene, element, settings, study.repeat if row["core_seconds"] < 3 else 1)
            for row, settings in tried if any(row is b for b in best)]


rows, all_rows, failed = [], [], []
for scene in SCENES:
    for element, meshes in UNIFORM[scene].items():
        rows += look_around(scene, element, [
            {"Mesh/Refinement": r, "Mesh/Radial layers": n, "Mesh/Radial spacing": "uniform", "Mesh/Outer radius": b,
             "Time stepping/Courant number": courant}
            for r, n in meshes for b in OUTER[scene] for courant in ((.95,) if study.quick or "Q1" in element else (.95, .5))])
    for element, meshes in ADAPTIVE[scene].items():
        rows += look_around(scene, element, [
            {"Mesh/Refinement": r, "Mesh/Radial layers": n, "Mesh/Radial spacing": "uniform",
             "Mesh/Outer radius": OUTER[scene][-1], "Time stepping/Courant number": .95, "Adaptivity/Levels": levels,
             "Adaptivity/Buffer layers": buffer, "Adaptivity/Refine above": above, "Adaptivity/Coarsen below": above / 4}
            for r, n, levels, buffer, above in meshes])

# The adaptive run beside the uniform mesh of its finest cells, and beside the best uniform run of the same error.
pairs = []
for row in rows:
    if row["mesh"] == "adaptive":
        same = [r for r in all_rows if r["mesh"] == "uniform" and r["courant"] == .95 and
                all(r[k] == row[k] for k in ("scene", "element", "outer_radius"))]
        fine = next((r for r in same if r["layers"] == row["layers"] and r["refinement"] == row["refinement"] + row["levels"]), None)
        tuned = tuning.cheapest([r for r in rows if r["scene"] == row["scene"] and r["mesh"] == "uniform"], row["error"])
        kernel = row["core_seconds"] * (1 - row["adaptation_share"])
        pairs.append({"scene": row["scene"], "element": row["element"], "refinement": f"{row['refinement']} + {row['levels']}",
                      "layers": row["layers"], "buffer": row["buffer"], "refine_above": row["refine_above"],
                      "error": row["error"], "core_seconds": row["core_seconds"], "adaptations": row["adaptations"],
                      "adapting": 100 * row["adaptation_share"],
                      "steps_per_adaptation": row["core_seconds"] * row["adaptation_share"] / max(row["adaptations"], 1)
                      / (kernel / row["steps"]),
                      "part_of_fine": 100 * row["dof_steps"] / fine["dof_steps"] if fine else "",
                      "error_of_fine": fine["error"] if fine else "", "seconds_of_fine": fine["core_seconds"] if fine else "",
                      "tuned": tuned["core_seconds"] if tuned else ""})
winners = []
for scene in SCENES:
    for goal in GOALS:
        row = tuning.cheapest([r for r in rows if r["scene"] == scene], goal)
        adaptive = tuning.cheapest([r for r in rows if r["scene"] == scene and r["mesh"] == "adaptive"], goal)
        if row:
            winners.append({"scene": scene, "goal": f"{100 * goal:g} %", **{k: row[k] for k in (
                "element", "mesh", "refinement", "layers", "outer_radius", "courant", "steps", "error", "core_seconds")},
                "best adaptive": f"{adaptive['element']}, {adaptive['core_seconds']:.3g}" if adaptive else "-",
                **{e: common.text(t["core_seconds"]) if (t := tuning.cheapest([r for r in rows if r["scene"] == scene and
                   r["element"] == e and r["mesh"] == "uniform"], goal)) else "-" for e in tuning.ELEMENTS}})
titles = {"outer_radius": "b [m]", "core_seconds": "core-seconds", "adapting": "adapting [% of time]",
          "steps_per_adaptation": "steps that an adaptation costs", "part_of_fine": "dofs x steps [% of uniform fine]",
          "error_of_fine": "error, uniform fine", "seconds_of_fine": "core-seconds, uniform fine",
          "tuned": "core-seconds, tuned uniform of any element"}
table, comparison = common.markdown_table(winners, titles=titles), common.markdown_table(pairs, titles=titles)
print("\n" + table + "\n\n" + comparison + "\n\nfailed: " + ("; ".join(failed) or "none"), flush=True)

if study.write:
    common.write_csv(study.folder / "results.csv", rows)
    for scene in SCENES:
        series = {}
        for row in rows:
            if row["scene"] == scene:
                series.setdefault(row["element"] + (", adaptive" if row["mesh"] == "adaptive" else ""), []).append(
                    (row["core_seconds"], row["error"]))
        common.figure(study.folder / f"error_versus_time_{scene}.svg", series, ylabel="E_t of the displacement",
                      title={"near": "boundary at 3 a or nearer", "far": "boundary at 8 a"}[scene])
    beaten = [p for p in pairs if p["tuned"] != "" and p["core_seconds"] < p["tuned"]]
    verdict = (f"{len(beaten)} of {len(pairs)} adaptive runs beat the best uniform run of their error."
               if beaten else "No adaptive run beats the best uniform run of its error.")
    facts = ", ".join(f"{k.replace('deal_ii', 'deal.II')} {v}" for k, v in common.machine(study.last).items())
    common.report(study.name, f"""## Speed against error: elements, and adaptivity

Cavity with a C3 pressure step; E_t of the displacement at generic receivers, near (r = a to 2.5 a, b <= 3 a) and far (r = 4 a to
7 a, b = 8 a). The cheapest run below each error, and the core-seconds of the best uniform run of every element:

{table}

Adaptive runs. {verdict} The gain is bounded by 'dofs x steps'; the cost is an adaptation, in steps of the same mesh:

{comparison}

{"Runs that ended with an error: " + "; ".join(failed) + "." if failed else ""}

![near](cavity_speed_against_error/error_versus_time_near.svg)
![far](cavity_speed_against_error/error_versus_time_far.svg)

*{facts}. Times are medians of {study.repeat}.* {study.disturbed}""")
