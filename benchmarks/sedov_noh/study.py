"""Sedov's blast, Noh's implosion and Saltzmann's piston in one to three dimensions. See README.md."""
import itertools, math, sys
from pathlib import Path
sys.path.insert(0, str(Path(__file__).resolve().parents[1]))
import common, profiles, tuning
import numpy
from reference import GasPiston, Noh, Sedov

study = common.Study(__file__)
# a gas has no stiffness that a control of stiffness could follow
ELEMENTS = {"Q1, one point": {**tuning.ELEMENTS["Q1, one point"], "Element/Hourglass control": "viscous", "Element/Hourglass coefficient": .15},
            "Q1, 2x2x2": tuning.ELEMENTS["Q1, 2x2x2"]}
VISCOSITIES = ("volumetric", "directional")
FORMS = {"radius": {"Dimension": 1, "Symmetry": "spherical"},
         "meridian plane": {"Dimension": 2, "Symmetry": "axisymmetric", "Constraints/Symmetry planes": "x min, y min"},
         "octant": {"Dimension": 3, "Symmetry": "none", "Constraints/Symmetry planes": "x min, y min, z min"}}
DIAGONAL = {"radius": "1, 0, 0", "meridian plane": "1, 0, 1", "octant": "1, 1, 1"}
LADDERS = {"radius": study.choose((100, 200, 400, 800), quick=(50, 100)), "meridian plane": study.choose((30, 60, 120), quick=(20,)),
           "octant": study.choose((16, 24, 32), quick=(12,))}
# cells of 2x2x2 points take minutes from here on; with the volumetric form the errors of their blasts do not fall
DEAR = {"volumetric": {"meridian plane": 120, "octant": 24}, "directional": {"meridian plane": 120, "octant": 32}}


def folds(run):
    """Whether cells turned inside out at corners."""
    return "folded at a corner" in (run.directory / "log.txt").read_text()
orders = []


def numerics(element, viscosity):
    return {**ELEMENTS[element], "Element/Bulk viscosity form": viscosity}


def mesh(form, size, cells):
    dim = FORMS[form]["Dimension"]
    return {"Mesh/Upper corner": ", ".join([str(size)] * dim), "Mesh/Cells": ", ".join([str(cells)] * dim)}


def both_lines(scene, receivers, form, cells, size, settings):
    """A run with receivers along an edge and along the diagonal, and its two profiles."""
    directions = ["1, 0, 0"] + ([DIAGONAL[form]] if form != "radius" else [])
    run = study.run(scene, {**FORMS[form], **mesh(form, size, cells), **settings,
                            **profiles.along(receivers, cells, size, interval=settings["End time"], direction="; ".join(directions))}, repeat=1)
    return run, [profiles.read(run, receivers, power=2, direction=number + 1) for number in range(len(directions))]


def blast(gamma, form, element, viscosity, cells):
    """The source is the cell at the origin; its energy is 1 J in the full sphere."""
    exact, size, end = Sedov(gamma), 1.2, .9
    h = size / cells
    volume = {"radius": 4 * math.pi / 3, "meridian plane": 2 * math.pi, "octant": 8}[form] * h ** 3  # of its images too
    inside = "x" if form == "radius" else ("max(x, y)" if form == "meridian plane" else "max(x, y, z)")
    run, lines = both_lines("blast.prm", "wall", form, cells, size, {
        **numerics(element, viscosity), "End time": end, "Materials/gas/Ratio of specific heats": gamma,
        "Initial conditions/Internal energy": f"({inside} < {h:.9g}) ? {1 / volume:.9g} : 0"})
    R = exact.radius(end)
    jump = 1 + ((gamma + 1) / (gamma - 1) - 1) / 2
    # the outermost place where the density is above the middle of the exact jump, or of its own largest value on coarse meshes
    fronts = [line.crossing(line.rho, min(jump, (1 + line.rho.max()) / 2), line.x) for line in lines]
    line = lines[0]
    away = line.X > .3  # the source keeps too much entropy on every mesh, and its surroundings fold in the plane and in space
    v, rho, p = exact.at(numpy.where(away, line.x, 1.), end)
    return study.add(f"Sedov {gamma:.3g}, {form}, {element}, {viscosity}", run, line.l1(line.rho, rho, away), cells=cells, v_L1=line.l1(line.v, v, away),
                     p_L1=line.l1(line.p, p, away), front=profiles.relative(fronts[0], R),
                     diagonal=profiles.relative(fronts[-1], R), folds=folds(run), energy_error=run["energy_error"])


def implosion(hoops, form, element, viscosity, cells):
    exact, end = Noh(5 / 3, hoops), .6
    radius = {"radius": "x", "meridian plane": "sqrt(x^2+y^2)", "octant": "sqrt(x^2+y^2+z^2)"}[form]
    velocity = "; ".join(f"-{x}/({radius}+1e-30)" for x in "xyz"[:FORMS[form]["Dimension"]])
    settings = {**numerics(element, viscosity), "End time": end, "Initial conditions/gas/Velocity": velocity}
    if hoops == 0:
        settings["Symmetry"] = "plane wave"
    if hoops == 1:  # a slice of the cylinder
        settings.update({"Dimension": 2, "Symmetry": "axisymmetric", "Mesh/Upper corner": f"1, {1 / cells}", "Mesh/Cells": f"{cells}, 1",
                         "Constraints/Symmetry planes": "x min, y min, y max", "Initial conditions/gas/Velocity": "-1; 0"})
    run, lines = both_lines("implosion.prm", "inside", form, cells, 1, settings)
    line = lines[0]
    line.power = hoops
    v, rho, p = exact.at(line.x, end)
    near = line.x < .4
    fronts = [one.crossing(one.p, exact.p / 2, one.x) for one in lines]
    plateau = (line.x > .06) & (line.x < .16)
    name = ("plane", "cylinder", "sphere")[hoops]
    return study.add(f"Noh {name}, {form}, {element}, {viscosity}", run, line.l1(line.rho, rho, near), cells=cells, v_L1=line.l1(line.v, v, near),
                     p_L1=line.l1(line.p, p, near), front=fronts[0] - .2, diagonal=fronts[-1] - .2,
                     plateau_rho=profiles.relative(line.rho[plateau].mean(), exact.rho), wall_rho=line.rho[0] / exact.rho - 1,
                     folds=folds(run), energy_error=run["energy_error"])


def piston(element, viscosity, skewed, cells=100):
    """Receivers along three lines of the mesh; the exact state is the same on all."""
    exact, end = GasPiston(5 / 3, 1., p0=2 / 3 * 1e-4), .6
    settings = {**numerics(element, viscosity), "Mesh/Cells": f"{cells}, {cells // 10}",
                "Receivers/line/Quantities": "displacement, velocity, stress, density", "Receivers/line/Interval": end,
                "Receivers/line/Points": "; ".join(f"{x:.6g}, {y}, 0" for y in (.013, .051, .087) for x in numpy.linspace(.02, .98, 193))}
    if not skewed:
        settings["Mesh/Map"] = "x; y"
    run = study.run("saltzmann.prm", settings, repeat=1)
    table = run.table("receivers-line.csv")
    names = [name.split(".")[0] for name in table if name.endswith("velocity_x [m/s]")]
    get = lambda quantity: numpy.array([table[f"{name}.{quantity}"][-1] for name in names]).reshape(3, -1)
    X = numpy.linspace(.02, .98, 193)
    rho, v, across = get("density [kg/m^3]"), get("velocity_x [m/s]"), get("velocity_y [m/s]")
    fronts = [X[numpy.nonzero(line > .5)[0][-1]] for line in v]
    plateau = (X > .2 * exact.U * end) & (X < .8 * exact.U * end)
    return study.add(f"Saltzmann, {element}, {viscosity}, {'skewed' if skewed else 'straight'}", run, abs(rho[:, plateau] / exact.rho - 1).mean(),
                     cells=cells, plateau_rho=profiles.relative(rho[:, plateau].mean(), exact.rho),
                     plateau_p=profiles.relative(-get("stress_xx [Pa]")[:, plateau].mean(), exact.p - 2 / 3 * 1e-4),
                     front=sum(fronts) / 3 - exact.U * end, fronts_apart=max(fronts) - min(fronts), largest_v_y=abs(across).max(),
                     energy_error=run["energy_error"])


def converge(name, rows, ladder):
    orders.append({"case": name, **{f"order of {n}": profiles.order(ladder, [row[key] for row in rows])
                                    for n, key in (("rho", "error"), ("v", "v_L1"), ("p", "p_L1"))}})


for element, viscosity in itertools.product(ELEMENTS, VISCOSITIES):
    for form, ladder in LADDERS.items():
        ladder = [cells for cells in ladder if element != "Q1, 2x2x2" or cells < DEAR[viscosity].get(form, math.inf)]
        for gamma in study.choose((1.4, 5 / 3), quick=(1.4,)):
            converge(f"Sedov {gamma:.3g}, {form}, {element}, {viscosity}",
                     [blast(gamma, form, element, viscosity, cells) for cells in ladder], ladder)
        for hoops in ((0, 1, 2) if form == "radius" else (2,)):
            name = ("plane", "cylinder", "sphere")[hoops]
            converge(f"Noh {name}, {form}, {element}, {viscosity}",
                     [implosion(hoops, form, element, viscosity, cells) for cells in ladder], ladder)
    for skewed in (False, True):
        piston(element, viscosity, skewed)

table = common.markdown_table([row for row in orders if not math.isnan(row["order of rho"])])
print("\n" + table, flush=True)
study.finish(f"""Orders of the L1 errors over the volume:

{table}

`front`: of the shock, relative for Sedov and in m for the others; `diagonal`: the same along the diagonal. `wall_rho`: density at the wall
over the exact one, less 1.""", ylabel="L1 error of rho")
