"""Hard cases: what the program does with them, how far the step may be raised, and what it says beyond. See README.md."""
import csv, math, re, subprocess, sys
from pathlib import Path
sys.path.insert(0, str(Path(__file__).resolve().parents[1]))
import common
import numpy
import reference

study = common.Study(__file__)
ONE_POINT, FULL = "one-point hexahedron", "hexahedron"
steps = []  # rows of the table of steps


def series(run, name):
    return numpy.array(run.column("receivers-points.csv", name))


def numbers_of(run):
    """Every number that a run left behind."""
    for file in ("receivers-points.csv", "statistics.csv"):
        for values in run.table(file).values():
            yield from values


class Attempt:
    """A run that may fail: its exit code, and either its results or the message."""

    def __init__(self, scene, settings):
        self.code, self.run, self.message = 0, None, ""
        try:
            self.run = study.run(scene, {"Output/Statistics interval": 1, **settings}, repeat=1, timeout=300)
            if not all(map(math.isfinite, numbers_of(self.run))):
                self.message = "not a number, but exit code 0"
        except subprocess.TimeoutExpired:
            self.code, self.message = -1, "no end within 300 s"
        except RuntimeError as problem:
            self.code = int(re.search(r"exit code (-?\d+)", str(problem))[1])
            self.message = next((line for line in str(problem).splitlines() if line.startswith("t = ")), str(problem).splitlines()[-1])


def short(message):
    """What a message says without time, place and numbers."""
    for words in ("inverted", "not a number", "energy balance", "strain energy grew", "energy grew", "no end"):
        if words in message:
            return words
    return message


def largest_factor(scene, settings, error, entry, unit, factors):
    """The largest factor in a row from the first on with an error at most twice that of the automatic step, or 1 % more; what is beyond."""
    usual = error(Attempt(scene, settings).run)
    allowed = max(2. * abs(usual), abs(usual) + .01)

    def judge(factor):
        tried = Attempt(scene, {**settings, entry: f"{factor * unit:.9g}"})
        if tried.run is None or tried.message:
            return False, f"{tried.code}: {short(tried.message)}"
        found = abs(error(tried.run))
        return found <= allowed, f"0: error {common.text(found)}, energy {common.text(tried.run['energy_error'])}"

    good, bad, beyond = None, None, ""
    for factor in factors:
        fine, words = judge(factor)
        if fine:
            good = factor
        else:
            bad, beyond = factor, words
            break
    while good and bad and bad / good > 1.03:
        middle = math.sqrt(good * bad)
        fine, words = judge(middle)
        if fine:
            good = middle
        else:
            bad, beyond = middle, words
    alarm = ""
    if bad and beyond.startswith("0:"):  # wrong without a word: from where on does the program say so?
        for factor in [bad * 1.05 ** k for k in range(1, 30)]:
            if entry.endswith("Courant number") and factor * unit > 2:
                break
            fine, words = judge(factor)
            if not words.startswith("0:"):
                alarm = f"{common.text(factor)}: {words}"
                break
    return good, beyond, alarm


def add(case, scene, settings, error, known, steps_too=True):
    """One row: the automatic step, then the largest Courant number and the largest fixed step."""
    tried = Attempt(scene, settings)
    if tried.run is None:
        steps.append({"case": case, "exit": tried.code, "said": short(tried.message)})
        print("  ", case, tried.message, flush=True)
        return None
    run = tried.run
    found = error(run)
    study.add(case, run, found, known=known, cells=run["cells"], steps=run["steps"], energy_error=run["energy_error"],
              exit=0, problem=tried.message)
    if steps_too and not study.quick:
        courant = largest_factor(scene, settings, error, "Time stepping/Courant number", 1.,
                                 [.9, 1., 1.1, 1.2, 1.3, 1.4, 1.5, 1.6, 1.7, 1.8, 1.9, 2.])
        dt = numpy.array(run.column("statistics.csv", "dt [s]"))
        smallest = dt[len(dt) // 20:-1].min() / .9  # after the start with short steps
        fixed = largest_factor(scene, settings, error, "Time stepping/Fixed step", smallest,
                               [.5 * 1.15 ** k for k in range(25)])
        row = {"case": case, "Courant number": courant[0], "beyond": courant[1], "alarm from": courant[2],
               "smallest limit [s]": float(smallest), "fixed step over it": fixed[0], "beyond it": fixed[1], "alarm from ": fixed[2]}
        steps.append(row)
        print("  ", row, flush=True)
    return run


# --- 1 saturated beside dry ----------------------------------------------------------------------------------------------
def interface_case(first, V, strength):
    p1, p2, u = reference.match(first, V)
    order = ("dry", "saturated") if first == "dry" else ("saturated", "dry")
    settings = {f"Materials/{name}/Material id": i for i, name in enumerate(order)}
    settings.update({"Constraints/x min/Amplitude": V, "End time": 2.55e-3 if first == "dry" else 1.1e-3})

    def error(run):
        """Largest of the relative errors of pressure and velocity on both sides of the interface."""
        v = [series(run, f"p{i}.velocity_x [m/s]")[-1] for i in (1, 2)]
        S = [-series(run, f"p{i}.stress_xx [Pa]")[-1] for i in (1, 2)]
        return max(max(abs(x / u - 1) for x in v), max(abs(x / p2 - 1) for x in S))

    return add(f"interface, {order[0]} to {order[1]}", "interface.prm", settings, error, "impedance match")


for first, V in (("dry", 100.), ("saturated", 50.)):
    interface_case(first, V, "none")


# --- 2 a plate of one cell ----------------------------------------------------------------------------------------------
def plate_error(pressure):
    def error(run):
        Z, m, arrival = 1800. * math.sqrt(1.8e8 / 1800.), 7800. * .01, .5 / math.sqrt(1.8e8 / 1800.)
        t, v = series(run, "t [s]"), series(run, "p2.velocity_x [m/s]")
        exact = numpy.array([reference.plate(s - arrival, pressure, Z, m) for s in t])
        weight = numpy.gradient(t) * (t > arrival)
        return float(math.sqrt(((v - exact) ** 2 * weight).sum() / (exact ** 2 * weight).sum()))
    return error


add("stiff plate in soil", "stiff_layer.prm", {}, plate_error(1e4), "mass between two soils")


# --- 3 bad cells --------------------------------------------------------------------------------------------------------
P_CELLS = 1800. * (1500. + 1.8 * 200.) * 200.
GRID = "; ".join(f"{x:.3g}, {y:.3g}" for x in (.15, .233, .3, .41, .5) for y in (.03, .1, .17))


def cells_error(run):
    n = sum(1 for name in run.table("receivers-points.csv") if name.endswith("velocity_x [m/s]"))
    S = [-series(run, f"p{i}.stress_xx [Pa]")[-1] for i in range(1, n + 1)]
    return max(abs(x / P_CELLS - 1) for x in S)


def transverse(run):
    names = [n for n in run.table("receivers-points.csv") if "velocity_y" in n or "velocity_z" in n]
    return max(max(abs(v) for v in run.column("receivers-points.csv", n)) for n in names) / 200.


side = []
MESHES = {"bricks": {"Mesh/Cells": "50, 10", "Mesh/Distortion": 0}, "distorted": {"Mesh/Cells": "50, 10", "Mesh/Distortion": .3},
          "20 times as wide as long": {"Mesh/Cells": "100, 1", "Mesh/Distortion": 0},
          "20 times as long as wide": {"Mesh/Cells": "50, 200", "Mesh/Distortion": 0, "Mesh/Upper corner": "1, 0.2"},
          "20:1 and distorted": {"Mesh/Cells": "100, 3", "Mesh/Upper corner": "1, 0.6", "Mesh/Distortion": .2}}
BRICK = {"Dimension": 3, "Symmetry": "none", "Mesh/Upper corner": "0.4, 0.08, 0.08", "Mesh/Cells": "20, 4, 4", "End time": 1.6e-4,
         "Constraints/Symmetry planes": "y min, y max, z min, z max",
         "Receivers/points/Points": "0.061, 0.03, 0.05; 0.093, 0.01, 0.02; 0.12, 0.05, 0.06; 0.16, 0.04, 0.033; 0.2, 0.06, 0.02"}
for element in (ONE_POINT, FULL):
    for mesh, settings in MESHES.items():
        where = GRID if "0.6" not in settings.get("Mesh/Upper corner", "") else "; ".join(f"{x:.3g}, {y:.3g}" for x in (.15, .233, .3, .41, .5) for y in (.1, .3, .5))
        run = add(f"{mesh}, 2-D, {element}", "cells.prm", {**settings, "Element/Type": element, "Receivers/points/Points": where}, cells_error,
                  "Hugoniot")
        if run:
            side.append({"mesh": mesh, "dimension": 2, "element": element, "largest transverse velocity/piston": transverse(run),
                         "largest error of the plateau": cells_error(run), "hourglass energy/total": run["hourglass_energy"] / run["energy"] if "energy" in run.values else ""})
    for distortion in (0, .3):
        run = add(f"{'distorted' if distortion else 'bricks'}, 3-D, {element}", "cells.prm", {**BRICK, "Element/Type": element, "Mesh/Distortion": distortion},
                  cells_error, "Hugoniot")
        if run:
            side.append({"mesh": "distorted" if distortion else "bricks", "dimension": 3, "element": element,
                         "largest transverse velocity/piston": transverse(run), "largest error of the plateau": cells_error(run)})


# --- 5 a small cap under 10 GPa ---------------------------------------------------------------------------------------------
def cap_error(run):
    """Jump relations of the shock between two receivers: speed from the passage of 1 GPa."""
    t = series(run, "t [s]")
    S = [-series(run, f"p{i}.stress_xx [Pa]") for i in (1, 2, 3)]
    passed = [float(numpy.interp(5e9, s[:1 + int(s.argmax())], t[:1 + int(s.argmax())])) for s in S[:3]]
    U = .1 / (passed[2] - passed[1])
    v, rho = series(run, "p1.velocity_x [m/s]")[-1], series(run, "p1.density [kg/m^3]")[-1]
    return max(abs(1800. * U * v / S[0][-1] - 1), abs(1800. * U / (U - v) / rho - 1), abs(S[0][-1] / 1e10 - 1))


UNDRAINED = {"Law": "undrained cap", "Density": "", }
add("cap of 10 kPa under 10 GPa", "small_cap.prm", {}, cap_error, "jump relations")


# --- 6 spall --------------------------------------------------------------------------------------------------------------
C, P, LENGTH = math.sqrt(1.8e8 / 1800.), 1e6, 1.
MIDDLES = "; ".join(f"{(i + .5) / 200:.6g}" for i in range(200))


def momentum_error(impulse):
    def error(run):
        v = [series(run, f"p{i}.velocity_x [m/s]")[-1] for i in range(1, 201)]
        return 1800. * LENGTH * float(numpy.mean(v)) / impulse - 1.
    return error


PULSES = {"pulse of 0.3 layers": ("(t < 1e-3) ? 1 : 0", 1e3, 6e-3), "pulse of 1.6 layers": ("(t < 5e-3) ? 1 : 0", 5e3, 12e-3),
          "spall, hit again": ("(t < 1e-3) ? 1 : ((t > 4e-3 && t < 5e-3) ? 3 : 0)", 4e3, 16e-3)}
SOILS = {"tears": {}, "cap": {}}
for name, (expression, impulse, end) in PULSES.items():
    add(name, "spall.prm", {"Loads/push/Expression": expression, "End time": end, "Receivers/points/Points": MIDDLES},
        momentum_error(impulse), "momentum")

# --- 7 fluidity -------------------------------------------------------------------------------------------------------------
def compare(run, other):
    a, b = series(run, "p2.stress_xx [Pa]"), series(other, "p2.stress_xx [Pa]")
    on = numpy.interp(series(run, "t [s]"), series(other, "t [s]"), b)
    return float(numpy.linalg.norm(a - on) / numpy.linalg.norm(on))


fluidity = []
elastic = study.run("fluidity.prm", {"Materials/sand/Fluidity eta": 0}, repeat=1)
plastic = study.run("fluidity.prm", {"Materials/sand/Viscosity": "none"}, repeat=1)
for power in study.choose(range(-12, 13, 2), quick=(-12, 0, 12)):
    eta = 10. ** power / 2.5e-5
    tried = Attempt("fluidity.prm", {"Materials/sand/Fluidity eta": eta})
    row = {"eta dt": f"1e{power}", "exit": tried.code}
    if tried.run:
        row.update({"to elastic": compare(tried.run, elastic), "to rate independent": compare(tried.run, plastic), "steps": tried.run["steps"],
                    "energy error": tried.run["energy_error"], "core-seconds": tried.run.core_seconds})
    fluidity.append({**row, "problem": tried.message})
    print("  ", fluidity[-1], flush=True)
for power in (-12, 0, 12):
    near = elastic if power < 0 else plastic
    eta = 10. ** power / 2.5e-5
    add(f"fluidity, eta dt = 1e{power}", "fluidity.prm", {"Materials/sand/Fluidity eta": eta},
        lambda run, near=near: compare(run, near), "elastic" if power < 0 else "rate independent")

# --- 8 ringing kept by hysteresis ----------------------------------------------------------------------------------------------
locking = []
WALL = "p1.displacement_r [m]"


def wall(settings):
    tried = Attempt("locking.prm", settings)
    return tried, (series(tried.run, WALL)[-1] if tried.run else math.nan)


best = wall({"Mesh/Radial layers": study.choose((4800,), quick=(600,))[0], "Element/Linear bulk viscosity": .6, "Element/Quadratic bulk viscosity": 2})
finer = [wall({"Mesh/Radial layers": n, "Element/Linear bulk viscosity": .6, "Element/Quadratic bulk viscosity": 2})[1] for n in study.choose((1200, 2400), quick=())]
limit = 2 * best[1] - finer[-1] if finer else best[1]  # first order
for b1, b2, expansion, courant in ((.06, 1.2, "false", .9), (.06, 1.2, "false", .3), (.06, 1.2, "true", .9), (.06, 2, "false", .9), (.2, 1.2, "false", .9),
                                   (.6, 1.2, "false", .9), (.6, 1.2, "true", .9), (.6, 2, "false", .9), (.6, 2, "true", .9), (1, 2, "false", .9)):
    row = {"b1": b1, "b2": b2, "in expansion": expansion, "Courant": courant}
    for layers in study.choose((300, 600, 1200, 2400), quick=(150,)):
        tried, u = wall({"Mesh/Radial layers": layers, "Element/Linear bulk viscosity": b1, "Element/Quadratic bulk viscosity": b2,
                         "Element/Bulk viscosity in expansion": expansion, "Time stepping/Courant number": courant})
        row[f"u(a) at {layers} [mm]"] = f"{1e3 * u:.3f}"
        row["energy error"] = tried.run["energy_error"] if tried.run else tried.message
    locking.append(row)
    print("  ", row, flush=True)
print(f"   u(a) extrapolated {limit:.6g} m, finest {best[1]:.6g}, {finer}", flush=True)
add("locking cavity, b1 0.6, b2 2", "locking.prm", {"Element/Linear bulk viscosity": .6, "Element/Quadratic bulk viscosity": 2},
    lambda run: series(run, WALL)[-1] / limit - 1., "finer meshes")
add("locking cavity, b1 0.06, b2 1.2", "locking.prm", {}, lambda run: series(run, WALL)[-1] / limit - 1., "finer meshes")

# --- 9 a bar that rings ---------------------------------------------------------------------------------------------------------
drift = []
LAWS = {"elastic": {}, "linear elastic (hypoelastic)": {"Law": "linear elastic"},
        "elastic-plastic": {"Strength": "mises", "Yield stress": 5e5}}
for name, settings in LAWS.items():
    for end in study.choose((1.5, 15), quick=(.15,)):
        tried = Attempt("ringing.prm", {**{f"Materials/bar/{k}": v for k, v in settings.items()}, "End time": end, "Output/Statistics interval": 1000})
        if not tried.run:
            drift.append({"bar": name, "problem": tried.message})
            continue
        table = tried.run.table("statistics.csv")
        column = lambda word: numpy.array(next(v for k, v in table.items() if k.startswith(word)))
        total = column("kinetic") + column("strain") + column("dissipated by the law") + column("hypoelastic")
        half = len(total) // 2
        drift.append({"bar": name, "steps": tried.run["steps"], "energy error": tried.run["energy_error"],
                      "kinetic + strain at the end/start": float((column("kinetic") + column("strain"))[-1] / (column("kinetic") + column("strain"))[0]),
                      "drift over the second half": float((total[-1] - total[half]) / total[0]), "core-seconds": tried.run.core_seconds})
        print("  ", drift[-1], flush=True)

tables = [common.markdown_table(t) for t in (steps, side, fluidity, locking, drift)]
print("\n" + "\n\n".join(tables), flush=True)
