"""How far the step may be raised in cap soil, what the numbers depend on, and the finest mesh that runs here. See README.md."""
import math, re, sys
from pathlib import Path
sys.path.insert(0, str(Path(__file__).resolve().parents[1]))
import common, profiles
from limits import COURANT, Attempt, Search
import numpy

study = common.Study(__file__)
PRM = study.folder.parents[1] / "prm"
SOILS = ("dry", "wet", "saturated")
A = .1  # radius of the cavity [m]
HALF, USUAL = .45, .9  # Courant numbers: what a changed step is compared with, and the default
LADDER = [USUAL, 1.1, 1.3, 1.6, 2.]  # the entry ends at 2
OFF, LOST = .1, .01  # changes of a result and of the energy error that an unstable step exceeds; what the step costs otherwise has columns of its own
ETA, B1, B2 = "Materials/soil/Fluidity eta", "Element/Linear bulk viscosity", "Element/Quadratic bulk viscosity"
CONTROL, COEFFICIENT = "Element/Hourglass control", "Element/Hourglass coefficient"
tables = {}


# --- one run --------------------------------------------------------------------------------------------------------------
class Numbers:
    """Mean displacement of the wall over a, largest velocity at 2 a, energy error and shares of the hourglass control and of the bulk viscosity."""

    def __init__(self, run):
        self.run = run
        file = "receivers-array.csv" if (run.directory / "receivers-array.csv").is_file() else "receivers-below.csv"
        array = {name: numpy.array(values) for name, values in run.table(file).items()}
        size = lambda point, quantity: numpy.sqrt(sum(values ** 2 for name, values in array.items() if name.startswith(f"{point}.{quantity}_")))
        ledger = run.table("statistics.csv")
        column = lambda begin: next((values[-1] for name, values in ledger.items() if name.startswith(begin)), 0.)
        volume = next((values for name, values in ledger.items() if "gas volume" in name), None)
        self.wall = float((volume[-1] / volume[0]) ** (1 / 3) - 1 if volume else size("d1r1", "displacement")[-1] / A)
        self.v = float(size("d1r3", "velocity").max())
        self.energy_error = run["energy_error"]
        all_work = sum(column(name) for name in ("kinetic", "strain", "hourglass", "dissipated by the law", "dissipated by bulk"))
        self.viscosity = float(100 * column("dissipated by bulk") / all_work)
        log = (run.directory / "log.txt").read_text()
        share = re.search(r"Hourglass .* J, (\S+) % of", log)
        self.hourglass = float(share[1]) if share else 0.
        self.warned = ", ".join(words for words, sign in (("hourglass", "Too much"), ("folded", "folded at a corner")) if sign in log)

    def parts(self, other):
        """What has changed, each in units of what is allowed."""
        return {"u(a)": (profiles.relative(self.wall, other.wall), OFF), "v at 2a": (profiles.relative(self.v, other.v), OFF),
                "energy error": (self.energy_error - other.energy_error, LOST)}

    def change(self, other):
        return max(abs(value) / limit for value, limit in self.parts(other).values())

    def words(self, other):
        name, (value, _) = max(self.parts(other).items(), key=lambda part: abs(part[1][0]) / part[1][1])
        return f"{name} off by {common.text(100 * value)} %"


def add(table, **row):
    tables.setdefault(table, []).append(row)
    print("  " + table + ": " + ", ".join(f"{name} {common.text(value)}" for name, value in row.items()), flush=True)


class Case:
    """A scene with the settings that make it small, and the file of its receivers."""

    def __init__(self, name, scene, settings, receivers):
        self.name, self.scene, self.settings, self.receivers = name, PRM / scene, settings, receivers

    def numbers(self, settings):
        """Numbers of a run, or the words with which it ended."""
        tried = Attempt(study, self.scene, {**self.settings, **settings}, self.receivers)
        return Numbers(tried.run) if tried.good else f"{tried.code}: {tried.said}"

    def largest_step(self, settings, found):
        """Columns of the largest Courant number that keeps the result, and what the default step changes."""
        half = self.numbers({**(settings or {}), COURANT: HALF})
        if isinstance(half, str):
            return {"largest Courant number": "none", "beyond": half}
        changes = {} if isinstance(found, str) else {"u(a) by the step": profiles.relative(found.wall, half.wall), "v by the step": profiles.relative(found.v, half.v)}
        ladder = study.choose(LADDER, quick=LADDER[:2])
        search = Search(study, self.scene, {**self.settings, **(settings or {})}, lambda run: Numbers(run).change(half), 1., COURANT, 1.,
                        ladder, lambda run: Numbers(run).words(half), self.receivers)
        return {**changes, "largest Courant number": round(search.good, 2) if search.good else "none", "beyond": search.beyond or f"nothing up to {ladder[-1]:g}"}

    def row(self, table, usual, settings=None, search=True, **columns):
        """A row: the numbers with the default step, changes against those of the unchanged scene, and the largest step."""
        found = usual if settings is None else self.numbers(settings)
        row = {"case": self.name, **columns}
        if isinstance(found, str):
            row["ended with"] = found
        else:
            row.update({"u(a)/a": found.wall, "v at 2a [m/s]": found.v, "energy error": found.energy_error, "hourglass [%]": found.hourglass,
                        "viscosity [%]": found.viscosity, "warned of": found.warned, "steps": found.run["steps"]})
            if settings is not None and not isinstance(usual, str):
                row.update({"u(a) changed by": profiles.relative(found.wall, usual.wall), "v changed by": profiles.relative(found.v, usual.v)})
        add(table, **row, **(self.largest_step(settings, found) if search and not (study.quick and settings) else {}))


# --- the scenes -------------------------------------------------------------------------------------------------------------
PLANE, SPACE = {"Dimension": 2, "Symmetry": "axisymmetric"}, {"Dimension": 3, "Symmetry": "none"}
NEAR = {"Mesh/Outer radius": .4, "End time": 5e-4, "Receivers/array/Radii": "0.1, 0.15, 0.2, 0.3", "Receivers/array/Directions": "1, 0.7, 0.4"}
FORMS = {"radius": {"Mesh/Radial layers": 64}, "plane": {**PLANE, "Mesh/Radial layers": 8, "Mesh/Refinement": 2},
         "octant": {**SPACE, "Mesh/Radial layers": 8, "Mesh/Refinement": 1}}


def cavity(soil, form, peak=1e8):
    """As in benchmarks/cap_cavity: ten times the peak, twice the impulse."""
    decay = 1e3 * 5 ** math.log10(peak / 1e6)
    load = {"Loads/cavity pressure/Amplitude": peak, "Loads/cavity pressure/Decay rate": f"{decay:.9g}", "Loads/cavity pressure/Rise time": f"{.5 / decay:.9g}",
            "Receivers/array/Interval": f"{min(2e-6, .125 / decay):.3g}"}
    return Case(f"{soil}, {form}, {peak / 1e6:g} MPa", f"cap_cavity_{soil}.prm", {**NEAR, **load, **FORMS[form]}, "receivers-array.csv")


def explosion():
    return Case("explosion, plane", "buried_explosion.prm", {"Mesh/Refinement": 1, "Output/VTU interval": 0, "Receivers/below/Directions": "1, 0, 0"},
                "receivers-below.csv")


# --- the map, and what moves it -----------------------------------------------------------------------------------------------
def courant():
    cases = [cavity(soil, form) for soil in SOILS for form in FORMS]
    cases += [cavity("dry", "radius", 1e6), cavity("dry", "radius", 1e10), cavity("dry", "plane", 1e10), cavity("saturated", "plane", 1e10), explosion()]
    for case in study.choose(cases, quick=cases[:1]):
        case.row("map", case.numbers({}))


def viscosity():
    for case in study.choose([cavity("dry", "plane"), cavity("saturated", "plane"), explosion()], quick=[cavity("dry", "plane")]):
        usual = case.numbers({})
        for b1, b2 in study.choose(((0, 0), (.2, 1.2), (.6, 2), (2, 4)), quick=((0, 0), (.6, 2))):
            case.row("viscosity", usual, {B1: b1, B2: b2}, b1=b1, b2=b2)


CONTROLS = {**{f"{control} {c:g}": {CONTROL: control, COEFFICIENT: c} for control, c in (("stiffness", .01), ("stiffness", .05), ("stiffness", .2),
                                                                                              ("viscous", .01), ("viscous", .2))},
            "full hexahedron": {"Element/Type": "hexahedron"}}


def hourglass():
    """The weak controls do not limit the step: no search."""
    cases = [cavity("dry", "plane"), cavity("dry", "plane", 1e10), cavity("dry", "octant"), cavity("saturated", "octant"), cavity("wet", "octant"), explosion()]
    for case in study.choose(cases, quick=cases[1:2]):
        usual = case.numbers({})
        for name in study.choose(CONTROLS, quick=["stiffness 0.05", "full hexahedron"]):
            case.row("hourglass", usual, CONTROLS[name], not case.name.startswith("wet") and not name.endswith("0.01"), control=name)


def fluidity():
    case = cavity("dry", "plane")
    usual = case.numbers({})
    if isinstance(usual, str):
        return
    dt = 5e-4 / usual.run["steps"]  # mean step of the unchanged scene
    for power in study.choose((-10, -6, -5, -4, -3, -2, -1, 0, 3, 10), quick=(-6,)):
        case.row("fluidity", usual, {ETA: f"{10. ** power / dt:.9g}"}, **{"eta dt": f"1e{power}", "eta [1/s]": 10. ** power / dt})
    case.row("fluidity", usual, {"Materials/soil/Viscosity": "none"}, **{"eta dt": "rate independent", "eta [1/s]": ""})


# --- the finest mesh ------------------------------------------------------------------------------------------------------------
LEFT = 8e9  # for all other programs of this machine while the largest mesh is run [bytes]
STEPS = 20  # of a large mesh


def memory_of_the_machine(kind="MemTotal"):
    """Bytes."""
    return 1024 * int(re.search(kind + r":\s*(\d+) kB", Path("/proc/meminfo").read_text())[1])


def bytes_used(run):
    return 2 ** 20 * run["total_memory_mb"]


def finest():
    """What one cell costs: bytes from two large meshes, time and steps from a whole run; and what follows from it."""
    most, day = .8 * memory_of_the_machine(), 86400.
    forms = (("octant", "dry", 3, (3, 4, 5)), ("octant", "saturated", 3, (3, 4)), ("plane", "dry", 4, (6, 7)))
    for form, soil, usual, large in study.choose(forms, quick=(("octant", "dry", 1, (1, 2)),)):
        case, power = cavity(soil, form), 3 if form == "octant" else 2
        layers = lambda refinement: 8 * 2 ** refinement
        whole = study.run(case.scene, {**case.settings, "Mesh/Refinement": usual}, repeat=1)
        steps = whole["steps"] / layers(usual)  # of one layer: the step falls with the size of the cells
        time = whole.core_seconds / whole["cells"] / whole["steps"]
        runs = [study.run(case.scene, {**case.settings, "Mesh/Refinement": r, "End time": STEPS * 5e-4 / steps / layers(r)}, repeat=1) for r in large]
        cells, memory = [run["cells"] for run in runs], [bytes_used(run) for run in runs]
        bytes_of_a_cell = (memory[-1] - memory[-2]) / (cells[-1] - cells[-2])
        of_a_layer = whole["cells"] / layers(usual) ** power  # cells = this times layers to the power
        fit = (((most - memory[-1]) / bytes_of_a_cell + cells[-1]) / of_a_layer) ** (1 / power)
        in_a_day = (day / (time * of_a_layer * steps)) ** (1 / (power + 1))
        add("finest", soil=soil, form=form, **{
            "largest mesh run": cells[-1], "its memory [MB]": memory[-1] / 1e6, "its set-up [core-s]": runs[-1]["setup_core_seconds"], "bytes/cell": bytes_of_a_cell,
            "whole run on": whole["cells"], "ns/cell and step": 1e9 * time, "steps/layer": steps, "layers that fit": int(fit),
            "million cells": of_a_layer * fit ** power / 1e6, "days for them": time * of_a_layer * steps * fit ** (power + 1) / day,
            "layers in a day": int(in_a_day), "million cells in a day": of_a_layer * in_a_day ** power / 1e6})
        if not study.quick and form == "octant" and soil == "dry":
            largest(case, lambda n: memory[-1] + bytes_of_a_cell * (n - cells[-1]), time, steps)


def largest(case, bytes_of, time, steps_of_a_layer):
    """The largest octant that the free memory takes, for some steps, against what was expected of it."""
    refinement, across = 6, 64
    allowed = memory_of_the_machine("MemAvailable") - LEFT
    cells_of = lambda coarse: coarse * 3 * across ** 2 * 2 ** refinement  # three patches
    coarse = 1
    while bytes_of(cells_of(coarse + 1)) < allowed:
        coarse += 1
    layers = coarse * 2 ** refinement
    run = study.run(case.scene, {**case.settings, "Mesh/Radial layers": coarse, "Mesh/Refinement": refinement,
                                 "End time": STEPS * 5e-4 / steps_of_a_layer / layers}, repeat=1)
    found = run.core_seconds / run["cells"] / run["steps"]
    expected = bytes_of(run["cells"])
    add("largest", **{"memory allowed [GB]": allowed / 1e9, "layers": layers, "cells across": 2 * across, "cells": run["cells"], "steps": run["steps"],
                      "expected memory [GB]": expected / 1e9, "memory [GB]": bytes_used(run) / 1e9, "off by": profiles.relative(bytes_used(run), expected),
                      "set-up [core-s]": run["setup_core_seconds"], "time loop [core-s]": run.core_seconds, "ns/cell and step": 1e9 * found,
                      "expected ns": 1e9 * time, "energy error": run["energy_error"],
                      "days for the whole run": found * run["cells"] * steps_of_a_layer * layers / 86400})


courant()
viscosity()
hourglass()
fluidity()
finest()

WORDS = {
    "map": f"Largest Courant number (default {USUAL}, at most 2), within 3 %, with which u(a) and the largest velocity at 2 a stay within {100 * OFF:g} % and the energy "
           f"error within {100 * LOST:g} % of those at {HALF}; 'beyond': exit code and what happens at most 3 % above it. 'by the step': relative change from {HALF} "
           f"to {USUAL}. The other columns: default step.",
    "viscosity": "Bulk viscosity:", "hourglass": "Hourglass control (these scenes: viscous 0.05). hourglass: work on the patterns in percent of the energy of the soil:",
    "fluidity": "Fluidity eta of Perzyna's law, dry sand in the plane, 100 MPa (the scene has eta = 200 1/s); dt: mean step of the unchanged scene:",
    "finest": f"The finest mesh of the cavity to 4 a over 0.5 ms on one core, with 80 % of the memory of this machine ({memory_of_the_machine() / 1e9:.0f} GB), and within one day. "
              "Bytes of a cell: difference of the two largest meshes, each run for some 20 steps; time and steps: of a whole run on fewer cells; steps grow with the "
              "layers:",
    "largest": f"The largest octant in dry sand that the free memory takes, all but {LEFT / 1e9:g} GB, run for some steps on one core, against what the "
               "smaller ones let expect:"}
shown = {name: common.markdown_table(rows) for name, rows in tables.items()}
print("\n" + "\n\n".join(shown.values()), flush=True)
if study.write:
    common.write_csv(study.folder / "results.csv", [{"table": name, **row} for name, rows in tables.items() for row in rows])
    facts = ", ".join(f"{name.replace('deal_ii', 'deal.II')} {value}" for name, value in common.machine(study.last).items())
    body = "\n\n".join(f"{WORDS[name]}\n\n{table}" for name, table in shown.items())
    common.report(study.name, f"## Stability map\n\n{body}\n\n*{facts}.* {study.disturbed}")
