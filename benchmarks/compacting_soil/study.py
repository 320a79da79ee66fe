"""Compacting soil behind a piston: one and two waves by the concave envelope; a published pipe of sand. See README.md."""
import sys
from pathlib import Path
sys.path.insert(0, str(Path(__file__).resolve().parents[1]))
import common, profiles, tuning
import numpy
from reference import FINAL, KINKED, PUBLISHED, SAND

study = common.Study(__file__)
LENGTH = 1.  # m
VISCOSITIES = (.06, 1.2, "false"), (.06, 1.2, "true"), (.06, 4, "false"), (.3, 1.2, "false"), (.6, 2, "false"), (1, 2, "false")
ELEMENTS = {name: tuning.ELEMENTS[name] for name in ("Q1, one point", "Q1, 2x2x2")}


def measure(scene, soil, V, element, cells, viscosity=VISCOSITIES[4], dimension=1, steps=None,
            quantities="displacement, velocity, stress, density"):
    """A run until the fastest wave has come to 0.8 m: the run, its waves, profiles at half of the time and at the end."""
    waves = soil.behind_piston(V)
    end = .8 * LENGTH / waves[0].U
    run = study.run(scene, {**tuning.ELEMENTS[element], **profiles.line(dimension, LENGTH, cells // tuning.ELEMENTS[element]["Element/Degree"]),
                            "Constraints/x min/Amplitude": V, "End time": end, **profiles.equal_steps(end, steps),
                            "Element/Linear bulk viscosity": viscosity[0], "Element/Quadratic bulk viscosity": viscosity[1],
                            "Element/Bulk viscosity in expansion": viscosity[2],
                            **profiles.along("points", cells, LENGTH, interval=end / 2, quantities=quantities)}, repeat=1)
    return run, waves, profiles.read(run, "points", row=-2), profiles.read(run, "points")


def judge(soil, waves, half, late):
    """Errors of the profile, and of plateau and speed of each wave."""
    exact = numpy.array([soil.at(waves, X, late.time) for X in late.X]).T
    columns = {f"{name}_L1": late.l1(values, state) for name, values, state in zip(("v", "p", "rho"), (late.v, late.p, late.rho), exact)}
    for i, wave in enumerate(waves, 1):
        ahead = waves[i - 2].p if i > 1 else 0.
        behind = waves[i].U if i < len(waves) else 0.
        low, high = behind * late.time, wave.U * late.time
        plateau = low + .3 * (high - low), low + .7 * (high - low)
        fronts = [one.crossing(one.p, (ahead + wave.p) / 2) for one in (half, late)]
        columns.update({f"p{i}": profiles.relative(late.mean(late.p, *plateau), wave.p),
                        f"v{i}": profiles.relative(late.mean(late.v, *plateau), wave.up),
                        f"rho{i}": profiles.relative(late.mean(late.rho, *plateau), wave.rho),
                        f"U{i}": profiles.relative((fronts[1] - fronts[0]) / (late.time - half.time), wave.U)})
    return columns


def row(case, element, cells, dimension=1, steps=None):
    run, waves, half, late = measure("soil.prm", KINKED, KINKED.waves(FINAL[case])[-1].up, element, cells, dimension=dimension, steps=steps)
    columns = judge(KINKED, waves, half, late)
    return study.add(f"{case}, {element}" + profiles.form(dimension, steps), run, columns.pop("v_L1"), cells=cells, **columns,
                     steps=run["steps"], energy_error=run["energy_error"])


orders = []
ladder = study.choose((200, 400, 800, 1600), quick=(100, 200))
for case in FINAL:
    for element in ELEMENTS:
        rows = [row(case, element, cells) for cells in ladder]
        if element == "Q1, one point":
            profiles.line_and_brick(lambda dimension, steps: row(case, element, ladder[0], dimension, steps), rows[0])
        orders.append({"case": case, "element": element, **{f"order of {name}": profiles.order(ladder, [row[key] for row in rows])
                                                            for name, key in (("v", "error"), ("p", "p_L1"), ("rho", "rho_L1"))}})

ratchet = []
for case, scene, soil, V in (("kinked, 20 MPa", "soil.prm", KINKED, KINKED.waves(20e6)[-1].up),
                             ("kinked, 200 MPa", "soil.prm", KINKED, KINKED.waves(200e6)[-1].up),
                             ("sand, 98 MPa", "sand.prm", SAND, 122.48)):
    for viscosity in VISCOSITIES:
        for cells in study.choose((400, 1600), quick=(200,)):
            run, waves, half, late = measure(scene, soil, V, "Q1, one point", cells, viscosity)
            columns, last = judge(soil, waves, half, late), len(waves)
            ratchet.append({"case": case, "linear": viscosity[0], "quadratic": viscosity[1], "in expansion": viscosity[2], "cells": cells,
                            **{f"{name} behind": columns[f"{name}{last}"] for name in ("p", "rho")}, "speed": columns[f"U{last}"],
                            **{f"L1 of {name}": columns[f"{name}_L1"] for name in ("v", "p", "rho")}})

pipe = []
for rho, p, V, Us, *autodyn in study.choose(PUBLISHED, quick=PUBLISHED[4:5]):
    run, (wave,), half, late = measure("sand.prm", SAND, V, "Q1, one point", study.choose((500,), quick=(200,))[0])
    front = [one.crossing(one.p, wave.p / 2) for one in (half, late)]
    speed = (front[1] - front[0]) / (late.time - half.time)
    plateau = .2 * wave.U * late.time, .8 * wave.U * late.time
    found = [late.mean(late.rho, *plateau), late.mean(late.p, *plateau) / 1e6, speed]
    pipe.append({"piston [m/s]": V, **{f"{name}": value for name, value in zip(("rho", "p [MPa]", "Us"), found)},
                 **{f"{name} to the jump relations": profiles.relative(value, exact)
                    for name, value, exact in zip(("rho", "p", "Us"), found, (wave.rho, wave.p / 1e6, wave.U))},
                 **{f"AUTODYN {name}": value for name, value in zip(("rho", "p", "Us"), autodyn)}})

overshoot = []
for case, p in (("kinked, 20 MPa", 20e6), ("kinked, 200 MPa", 200e6)):
    for element in tuning.ELEMENTS:
        for viscosity in (VISCOSITIES[4], VISCOSITIES[0]):
            for cells in study.choose((400, 1600), quick=(240,)):
                run, waves, half, late = measure("soil.prm", KINKED, KINKED.waves(p)[-1].up, element, cells, viscosity,
                                                 quantities="displacement, velocity, stress, history")
                wave, table = waves[-1], run.table("receivers-points.csv")
                kept = numpy.array([column[-1] for name, column in table.items() if name.endswith("largest density")])
                behind = kept[(late.X > .1 * wave.U * late.time) & (late.X < .8 * wave.U * late.time)] / wave.rho - 1
                overshoot.append({"case": case, "element": element, "linear": viscosity[0], "quadratic": viscosity[1], "cells x degree": cells,
                                  "kept too much, mean": behind.mean(), "largest": behind.max(),
                                  "rho behind": profiles.relative(late.mean(late.rho, .1 * wave.U * late.time, .8 * wave.U * late.time), wave.rho)})

tables = [common.markdown_table(rows) for rows in (orders, pipe, ratchet, overshoot)]
print("\n" + "\n\n".join(tables), flush=True)
study.finish(f"""Orders of the L1 errors over the present volume, linear and quadratic viscosity {VISCOSITIES[4][0]} and {VISCOSITIES[4][1]}:

{tables[0]}

Pipe of Sjobo sand, {'500 cells' if not study.quick else 'few cells'}; the published calculation had 2000:

{tables[1]}

What the bulk viscosity does to the states behind the last wave, relative to the exact ones:

{tables[2]}

Largest density that the points behind the last wave keep, over the exact one, less 1:

{tables[3]}

Columns p1, v1, rho1, U1: relative errors of plateau and speed of the first wave; p2 to U2 of the second. off_1_D: of the
error to that of the same cells and steps in one dimension.""", ylabel="L1 error of v")
