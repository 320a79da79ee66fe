"""Plate impact: impedance match, front speeds, release at a free surface, per element and in one to three dimensions. See README.md."""
import sys
from pathlib import Path
sys.path.insert(0, str(Path(__file__).resolve().parents[1]))
import common, profiles, tuning
import numpy
from reference import CASES, match

study = common.Study(__file__)
FLYER, LENGTH = .05, .15  # m
ELEMENTS = {name: tuning.ELEMENTS[name] for name in ("Q1, one point", "Q1, 2x2x2", "Q2")}
SOLIDS = ("Density", "rho0"), ("Sound speed", "c0"), ("Hugoniot slope", "s"), ("Grueneisen parameter", "Gamma0")


def plates(flyer, target, V):
    settings = {"Initial conditions/flyer/Velocity": V}
    for block, solid in (("flyer", flyer), ("target", target)):
        settings.update({f"Materials/{block}/{entry}": getattr(solid, name) for entry, name in SOLIDS})
    return settings


def waves(flyer, target, V):
    u = match(flyer, target, V)
    return u, target.hugoniot(u), flyer.hugoniot(V - u)


def exact(flyer, target, V, X, time):
    """v, p, rho of the points X before a shock reaches a free surface."""
    u, ahead, behind = waves(flyer, target, V)
    v, p, rho = (numpy.zeros_like(X) for _ in range(3))
    in_flyer = X < FLYER
    v[in_flyer], rho[:] = V, numpy.where(in_flyer, flyer.rho0, target.rho0)
    for (speed, pressure, density, _), shocked in ((behind, in_flyer & (X > FLYER - behind[0] * time)),
                                                   (ahead, ~in_flyer & (X < FLYER + ahead[0] * time))):
        v[shocked], p[shocked], rho[shocked] = u, pressure, density
    return v, p, rho


def measure(case, element, cells, dimension=1, viscosity=(.06, 1.2), steps=None):
    flyer, target, V = CASES[case]
    degree = ELEMENTS[element]["Element/Degree"]
    settings = {**plates(flyer, target, V), **ELEMENTS[element], **profiles.line(dimension, LENGTH, cells // degree),
                "Initial conditions/flyer/Velocity": "; ".join([f"{V}"] + ["0"] * (dimension - 1)),
                "Element/Linear bulk viscosity": viscosity[0], "Element/Quadratic bulk viscosity": viscosity[1]}
    u, (speed, pressure, density, _), behind = waves(flyer, target, V)
    end = .8 * FLYER / behind[0]  # both shocks are still inside of the plates
    settings.update(profiles.equal_steps(end, steps))
    run = study.run("plates.prm", {**settings, "End time": end,
                                   **profiles.along("surface", cells // degree, LENGTH, interval=end / 2, parts=degree)}, repeat=1)
    half, late = profiles.read(run, "surface", row=-2), profiles.read(run, "surface")
    v, p, rho = exact(flyer, target, V, late.X, late.time)
    front = [one.crossing(numpy.where(one.X > FLYER, one.p, 2 * pressure), pressure / 2) for one in (half, late)]
    plateau = FLYER + .2 * speed * end, FLYER + .7 * speed * end
    l1 = {name: late.l1(getattr(late, name), value) for name, value in (("v", v), ("p", p), ("rho", rho))}
    released = ""
    if case == "identical":  # the reflected release of the other pair arrives earlier
        far = study.run("plates.prm", settings, repeat=1)
        surface = far.table("receivers-surface.csv")
        released = profiles.relative(surface["p3.velocity_x [m/s]"][-1], target.released(u)[0])
    return study.add(f"{case}, {element}" + profiles.form(dimension, steps), run, l1["v"], cells=cells,
                     viscosity=f"{viscosity[0]:g}, {viscosity[1]:g}", p_L1=l1["p"], rho_L1=l1["rho"],
                     plateau_p=profiles.relative(late.mean(late.p, *plateau), pressure),
                     plateau_v=profiles.relative(late.mean(late.v, *plateau), u),
                     plateau_rho=profiles.relative(late.mean(late.rho, *plateau), density),
                     speed=profiles.relative((front[1] - front[0]) / (late.time - half.time), speed), released=released,
                     steps=run["steps"], energy_error=run["energy_error"])


orders, coarse = [], {}
ladder = study.choose((150, 300, 600, 1200), quick=(150, 300))
for case in CASES:
    for element in ELEMENTS:
        rows = [measure(case, element, cells) for cells in ladder]
        coarse[case, element] = rows[0]
        orders.append({"case": case, "element": element,
                       **{f"order of {name}": profiles.order(ladder, [row[key] for row in rows])
                          for name, key in (("v", "error"), ("p", "p_L1"), ("rho", "rho_L1"))}})
for viscosity in study.choose(((0., 1.2), (.06, 1.2), (.3, 2.)), quick=()):
    measure("identical", "Q1, one point", 300, viscosity=viscosity)
for element in ELEMENTS:
    profiles.line_and_brick(lambda dimension, steps: measure("identical", element, ladder[0], dimension, steps=steps),
                            coarse["identical", element], (1, 2, 3))

table = common.markdown_table(orders)
print("\n" + table, flush=True)
study.finish(f"""Orders of the L1 errors over the present volume (cells: those of degree 2 are counted twice):

{table}

`plateau`: relative errors between 0.2 and 0.7 of the target's shock. `speed`: of that shock per reference length, between half of the time
and its end, when the shock of the flyer is at 0.8 of its thickness. `released`: velocity of the free surface after its release.
`off_1_D`: of the error to that of the same cells and steps in one dimension.""", ylabel="L1 error of v")
