"""Hard cases: errors, how far the step may be raised, and what the program says beyond. See README.md."""
import math, sys
from pathlib import Path
sys.path.insert(0, str(Path(__file__).resolve().parents[1]))
import common, reference
import numpy
from limits import Attempt, limits_of, series

study = common.Study(__file__)
ONE_POINT, FULL = "one-point hexahedron", "hexahedron"
steps = []


def case(name, scene, settings, error, known, search=True, **columns):
    """One row of the study: the automatic step, and unless quick how far the step may be raised. Returns the run, None if it failed."""
    tried = Attempt(study, scene, {**settings, "Output/Statistics interval": 1})
    if not tried.good:
        steps.append({"case": name, "exit": tried.code, "beyond": tried.said})
        print(f"  {name}: {tried.code}, {tried.said}", flush=True)
        return None
    run = tried.run
    study.add(name, run, error(run), known=known, cells=run["cells"], steps=run["steps"], energy_error=run["energy_error"], **columns)
    if search and not study.quick:
        steps.append({"case": name, "exit": 0, **limits_of(study, scene, settings, error, run)})
        print(f"    {steps[-1]}", flush=True)
    return run


def table(rows):
    text = common.markdown_table(rows, [c for c in common.columns_of(rows) if c not in ("core_seconds", "spread", "ranks")])
    print("\n" + text, flush=True)
    return text


# --- where dry and saturated sand meet ----------------------------------------------------------------------------------
def interface():
    for first, second, V, end in (("dry", "saturated", 100., 2.6e-3), ("saturated", "dry", 50., 1.2e-3)):
        p1, p2, u = reference.match(first, V)

        def error(run):
            v = [series(run, f"p{i}.velocity_x [m/s]")[-1] / u for i in (1, 2)]
            S = [-series(run, f"p{i}.stress_xx [Pa]")[-1] / p2 for i in (1, 2)]
            return max(abs(x - 1.) for x in v + S)

        case(f"{first} sand to {second} sand", "interface.prm",
             {f"Materials/{first}/Material id": 0, f"Materials/{second}/Material id": 1, "Constraints/x min/Amplitude": V, "End time": end},
             error, "impedance match: velocity and pressure on both sides")


# --- a plate of one cell in soil ----------------------------------------------------------------------------------------
def plate():
    impedance, mass, arrival = math.sqrt(1800. * 1.8e8), 7800. * .01, .5 / math.sqrt(1.8e8 / 1800.)

    def error(run):
        t, v = series(run, "t [s]"), series(run, "p2.velocity_x [m/s]")
        exact = numpy.array([reference.plate(s - arrival, 1e4, impedance, mass) for s in t])
        weight = numpy.gradient(t)
        return math.sqrt(((v - exact) ** 2 * weight).sum() / (exact ** 2 * weight).sum())

    case("plate in soil", "stiff_layer.prm", {}, error, "mass between two half-spaces, E_t of v")

    def yielding(run):  # at the end of the pulse's passage the plate moves with the soil in front of it
        return run["energy_error"]
    case("plate in soil that yields", "stiff_layer.prm", {"Loads/push/Amplitude": 5e6}, yielding, "energy")


# --- cells of bad shape ---------------------------------------------------------------------------------------------------
CLAY_PRESSURE = 1800. * (1500. + 1.8 * 200.) * 200.


def bad_cells():
    shapes = {"bricks": ("1, 0.2", "50, 10", 0), "distorted": ("1, 0.2", "50, 10", .3), "20 times as wide as long": ("1, 0.4", "100, 2", 0),
              "20 times as long as wide": ("1, 0.01", "50, 10", 0), "20 times as wide, distorted": ("1, 0.8", "100, 4", .3),
              "20 times as long, distorted": ("1, 0.01", "50, 10", .3), "10 times as long as wide": ("1, 0.02", "50, 10", 0)}
    rows = []

    def points(width, dimension, length=1.):
        across = [.13, .41, .77]
        places = [(x * length, a * width, b * width) for x in (.15, .233, .3, .41, .5) for a, b in zip(across, across[1:] + across[:1])]
        return len(places), "; ".join(", ".join(f"{c:.4g}" for c in p[:dimension]) for p in places)

    def measure(name, settings, element, dimension, n):
        def error(run):
            return max(abs(-series(run, f"p{i}.stress_xx [Pa]")[-1] / CLAY_PRESSURE - 1.) for i in range(1, n + 1))
        run = case(f"{name}, {dimension}-D, {element}", "cells.prm", {**settings, "Element/Type": element}, error, "Hugoniot: largest error of the plateau",
                   search=name == "distorted" and dimension == 2)
        if run:
            S = numpy.array([-series(run, f"p{i}.stress_xx [Pa]")[-1] for i in range(1, n + 1)]) / CLAY_PRESSURE
            v = max(abs(series(run, f"p{i}.velocity_{c} [m/s]")[-1]) for i in range(1, n + 1) for c in "yz"[:dimension - 1]) / 200.
            rows.append({"cells": name, "dimension": dimension, "element": element, "mean of the plateau": float(S.mean() - 1.),
                         "largest error of the plateau": float(abs(S - 1.).max()), "transverse over piston velocity": float(v),
                         "hourglass energy": run["hourglass_energy"] / (run["dissipation"] + run["artificial_dissipation"])})

    thin = []
    for ratio, b1, b2 in study.choose([(r, *b) for r in (10, 20, 40) for b in ((.06, 1.2), (0, 1.2), (.06, 0), (0, 0))], quick=[(20, .06, 1.2), (20, 0, 1.2)]):
        width = .2 / ratio
        n, places = points(width, 2)
        tried = Attempt(study, "cells.prm", {"Mesh/Upper corner": f"1, {width}", "Mesh/Cells": "50, 10", "Mesh/Distortion": 0, "End time": 2.5e-4,
                                             "Element/Type": ONE_POINT, "Constraints/x min/Amplitude": 20, "Element/Linear bulk viscosity": b1,
                                             "Element/Quadratic bulk viscosity": b2, "Receivers/points/Points": places})
        v = max(abs(series(tried.run, f"p{i}.velocity_y [m/s]")).max() for i in range(1, n + 1)) / 20. if tried.good else tried.said
        thin.append({"length over width": ratio, "b1": b1, "b2": b2, "largest transverse over piston velocity": v})
    for element in (ONE_POINT, FULL):
        for name, (corner, cells, distortion) in shapes.items():
            n, places = points(float(corner.split(",")[1]), 2)
            settings = {"Mesh/Upper corner": corner, "Mesh/Cells": cells, "Mesh/Distortion": distortion, "Receivers/points/Points": places}
            measure(name, settings, element, 2, n)
        for name, distortion in (("bricks", 0), ("distorted", .3)):
            n, places = points(.08, 3, .4)
            measure(name, {"Dimension": 3, "Symmetry": "none", "Mesh/Upper corner": "0.4, 0.08, 0.08", "Mesh/Cells": "20, 4, 4", "End time": 1.6e-4,
                           "Mesh/Distortion": distortion, "Constraints/Symmetry planes": "y min, y max, z min, z max",
                           "Receivers/points/Points": places}, element, 3, n)
    return table(rows) + "\n\nBricks along a weak wave (20 m/s), from rounding errors:\n\n" + table(thin)


# --- a cap of 10 kPa under 10 GPa -----------------------------------------------------------------------------------------
def small_cap():
    def error(run):
        """Of the jump relations, with the speed of the front between 0.2 and 0.3 m, and of the pressure behind it."""
        t, S = series(run, "t [s]"), [-series(run, f"p{i}.stress_xx [Pa]") for i in (1, 2, 3)]
        passed = [t[numpy.argmax(s > 5e9)] for s in S]
        U, v, rho = .1 / (passed[2] - passed[1]), series(run, "p1.velocity_x [m/s]")[-1], series(run, "p1.density [kg/m^3]")[-1]
        rho0 = series(run, "p4.density [kg/m^3]")[0]
        return max(abs(rho0 * U * v / S[0][-1] - 1), abs(rho0 * U / (U - v) / rho - 1), abs(S[0][-1] / 1e10 - 1))

    case("cap of 10 kPa under 10 GPa, moist", "small_cap.prm", {}, error, "jump relations and load")
    case("cap of 10 kPa under 10 GPa, Perzyna", "small_cap.prm",
         {"Materials/sand/Viscosity": "Perzyna", "Materials/sand/Fluidity eta": 1e4, "Materials/sand/Overstress scale f0": 1e5}, error,
         "jump relations and load")
    case("cap of 10 kPa under 10 GPa, wet", "small_cap_wet.prm", {}, error, "jump relations and load")


# --- spall ------------------------------------------------------------------------------------------------------------------
def spall():
    n = 200
    middles = "; ".join(f"{(i + .5) / n:.6g}" for i in range(n)) + "; 1"
    rows = []
    for name, expression, impulse, end in (("pulse shorter than the layer", "(t < 1e-3) ? 1 : 0", 1e3, 6e-3),
                                           ("pulse longer than the layer", "(t < 5e-3) ? 1 : 0", 5e3, 12e-3),
                                           ("spall that is hit again", "(t < 1e-3) ? 1 : ((t > 4e-3 && t < 5e-3) ? 3 : 0)", 4e3, 14e-3)):
        def error(run):
            return 1800. * float(numpy.mean([series(run, f"p{i}.velocity_x [m/s]")[-1] for i in range(1, n + 1)])) / impulse - 1.

        for soil, scene in (("tears", "spall.prm"), ("compacts and tears", "spall_cap.prm")):
            settings = {"Loads/push/Expression": expression, "End time": end, "Receivers/points/Points": middles,
                        "Receivers/points/Quantities": "velocity, stress, density", "Receivers/points/Interval": 2e-5}
            run = case(f"{name}, {soil}", scene, settings, error, "momentum of the load")
            if run:
                surface = series(run, f"p{n + 1}.velocity_x [m/s]")
                S = numpy.array([-series(run, f"p{i}.stress_xx [Pa]") for i in range(1, n + 1)])
                rho = numpy.array([series(run, f"p{i}.density [kg/m^3]")[-1] for i in range(1, n + 1)])
                rows.append({"pulse": name, "soil": soil, "surface, of 2 P/(rho c)": float(surface.max() / (2e6 / math.sqrt(1800 * 1.8e8))),
                             "largest tension [kPa]": float(-S.min() / 1e3), "open cells at the end": int((rho < .999 * 1800).sum()),
                             "widest gap from the surface [m]": float(1. - (rho.argmin() + .5) / n), "smallest density": float(rho.min())})
    return table(rows)


# --- from elastic to rate independent -----------------------------------------------------------------------------------
ELASTIC_STRESS = 11.9265295e6  # M ln(1/J) = rho0 V^2/(1 - J), M = 191.5333 MPa, V = 20 m/s


def fluidity():
    def difference(run, other):
        t, a = series(run, "t [s]"), series(run, "p2.stress_xx [Pa]")
        b = numpy.interp(t, series(other, "t [s]"), series(other, "p2.stress_xx [Pa]"))
        return float(numpy.linalg.norm(a - b) / numpy.linalg.norm(b))

    entry, dt = "Materials/sand/Fluidity eta", 2.5e-5
    elastic, plastic = (study.run("fluidity.prm", s, repeat=1) for s in ({entry: 0}, {"Materials/sand/Viscosity": "none"}))
    rows = []
    for power in study.choose(range(-12, 13, 2), quick=(-12, 0, 12)):
        tried = Attempt(study, "fluidity.prm", {entry: 10. ** power / dt})
        row = {"eta dt": f"1e{power}", "exit": tried.code, "said": tried.said}
        if tried.run:
            row.update({"to elastic": difference(tried.run, elastic), "to rate independent": difference(tried.run, plastic), "steps": tried.run["steps"],
                        "energy error": tried.run["energy_error"]})
        rows.append(row)
    behind = lambda run: float(numpy.mean([-series(run, f"p{i}.stress_xx [Pa]")[-1] for i in (1, 2, 3)]))
    for power, stress, name in ((-12, ELASTIC_STRESS, "elastic wave"), (0, behind(study.run("fluidity.prm", {entry: 1. / dt}, repeat=1)), "its own automatic step"),
                                (12, behind(plastic), "rate-independent run")):
        case(f"fluidity, eta dt = 1e{power}", "fluidity.prm", {entry: 10. ** power / dt}, lambda run: behind(run) / stress - 1., f"{name}, stress behind the wave")
    return table(rows)


# --- ringing that hysteresis keeps ----------------------------------------------------------------------------------------
def locking():
    def settings(layers, b1, b2, expansion="false", courant=.9):
        coarse = 300 if layers >= 300 else 150
        return {"Mesh/Radial layers": coarse, "Mesh/Refinement": round(math.log2(layers / coarse)),
                "Element/Linear bulk viscosity": b1, "Element/Quadratic bulk viscosity": b2,
                "Element/Bulk viscosity in expansion": expansion, "Time stepping/Courant number": courant}

    def wall(run):
        return series(run, "p1.displacement_r [m]")[-1]

    def moved(*choice):
        tried = Attempt(study, "locking.prm", settings(*choice))
        return wall(tried.run) if tried.run else math.nan

    ladder = study.choose((300, 600, 1200, 2400), quick=(150, 300))
    reference_wall = moved(study.choose((4800,), quick=(300,))[0], .6, 2, "true")
    rows, curves = [], {}
    for choice in study.choose(((.06, 1.2), (.06, 1.2, "true"), (.06, 2), (.06, 2, "true"), (.2, 1.2), (.2, 1.2, "true"), (.6, 1.2), (.6, 1.2, "true"), (.6, 2),
                                (.6, 2, "true"), (1, 2), (1, 2, "true"), (.06, 1.2, "false", .3), (.6, 2, "false", .3)), quick=((.06, 1.2), (.6, 2, "true"))):
        b1, b2, expansion, courant = choice + ("false", .9)[len(choice) - 2:]
        walls = {n: moved(n, b1, b2, expansion, courant) for n in ladder}
        rows.append({"b1": b1, "b2": b2, "in expansion": expansion, "Courant number": courant, **{f"{n} cells": u / reference_wall - 1. for n, u in walls.items()}})
        if courant == .9:
            curves[f"b1 = {b1:g}, b2 = {b2:g}" + (", in expansion" if expansion == "true" else "")] = [(n, 1e3 * u) for n, u in walls.items()]
        print(f"    {rows[-1]}", flush=True)
    for choice in ((.06, 1.2), (.6, 2, "true")):
        case(f"locking soil, b1 = {choice[0]}, b2 = {choice[1]}" + (", in expansion" if len(choice) > 2 else ""), "locking.prm", settings(600, *choice),
             lambda run: wall(run) / reference_wall - 1., "wall on 4800 cells")
    if study.write:
        common.figure(study.folder / "locking.svg", curves, xlabel="cells", ylabel="wall of the cavity [mm]", title="What hysteresis keeps of the ringing",
                      loglog=False)
    return f"Wall at {1e3 * reference_wall:.4g} mm with 4800 cells, b1 = 0.6, b2 = 2, in expansion; the others relative to it:\n\n" + table(rows)


# --- a bar that rings -----------------------------------------------------------------------------------------------------
def ringing():
    rows = []
    for name, scene, law in (("elastic", "ringing.prm", {}), ("hypoelastic", "ringing_hypoelastic.prm", {}),
                             ("elastic-plastic", "ringing.prm", {"Materials/bar/Strength": "mises", "Materials/bar/Yield stress": 5e5}),
                             ("cap", "ringing_cap.prm", {})):
        for end in study.choose((1.5, 15), quick=(.15,)):
            tried = Attempt(study, scene, {**law, "End time": end, "Output/Statistics interval": 50})
            row = {"bar": name, "exit": tried.code, "said": tried.said}
            if tried.run:
                columns = tried.run.table("statistics.csv")
                kinetic, strain, plastic, volume = (numpy.array(next(v for k, v in columns.items() if k.startswith(word)))
                                                    for word in ("kinetic", "strain", "dissipated by the law", "hypoelastic"))
                total, n = kinetic + strain + plastic + volume, len(kinetic) // 10
                row.update({"steps": tried.run["steps"], "energy error": tried.run["energy_error"],
                            "kinetic and stored, last tenth": float((kinetic + strain)[-n:].mean() / total[0]),
                            "drift of all": float(total[-n:].mean() / total[:n].mean() - 1.)})
            rows.append(row)
            print(f"    {row}", flush=True)
    return table(rows)


if __name__ == "__main__":
    interface()
    plate()
    cells = bad_cells()
    small_cap()
    spalls, viscous, locked, rung = spall(), fluidity(), locking(), ringing()
    cases, limits = table(study.rows), table(steps)
    if study.write:
        columns = [c for c in common.columns_of(study.rows) if c not in ("core_seconds", "spread")]  # errors are what is asked here
        common.write_csv(study.folder / "results.csv", study.rows, columns)
        facts = ", ".join(f"{name.replace('deal_ii', 'deal.II')} {value}" for name, value in common.machine(study.last).items())
        common.report(study.name, f"""## Hard cases

With the automatic step, errors against what is known:

{cases}

How far the step may be raised before the error is above 1.1 times that of the automatic step plus 1 %: the largest Courant number up to 2
and the largest fixed step over the smallest stable step of the automatic run, both within 3 %; what happens just beyond, exit code first:

{limits}

Bad cells, behind the shock:

{cells}

Spall:

{spalls}

Fluidity times step, against the elastic and the rate-independent run (differences of the stress over time at one place):

{viscous}

Locking soil. {locked}

![wall against cells](hard_cases/locking.svg)

A bar that rings:

{rung}

*{facts}.*""")
