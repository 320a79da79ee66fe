"""A cavity under 1 MPa to 10 GPa in dry, wet and saturated viscoplastic cap soil. See README.md."""
import csv, math, re, subprocess, sys
from pathlib import Path
sys.path.insert(0, str(Path(__file__).resolve().parents[1]))
import common, profiles
import numpy

study = common.Study(__file__)
PRM = study.folder.parents[1] / "prm"
A = .1  # radius of the cavity [m]
RADII = (.1, .15, .2, .3, .4, .5, .7, 1.)  # of the receivers [m]; 0.2 and 0.4 are nodes of the mesh
SOILS = ("dry", "wet", "saturated")
LAYERS = study.choose((320,), quick=(80,))[0]
SOIL = "Materials/soil"
WATER = f"{SOIL}/Soil state/Saturation"
# Density [kg/m^3] and pressure [MPa] of a sand that begins at 1674 kg/m^3: Laine and Sandvik (2001)
SAND = ((1739.5, 4.577), (1873.8, 14.98), (1997, 29.151), (2143.8, 59.175), (2250, 98.098), (2380, 179.443), (2485, 289.443), (2585, 450.198))
tables = {}


# --- one run ------------------------------------------------------------------------------------------------------------
def decay(peak):
    return 1e3 * 5 ** math.log10(peak / 1e6)  # ten times the peak, twice the impulse


def rise(peak):
    return .5 / decay(peak)


def impulse(peak):
    """Integral of the pressure over time [Pa s]; the rise is the polynomial of a C3 step."""
    x = numpy.linspace(0, 1, 2001)
    p = x ** 4 * (35 - 84 * x + 70 * x ** 2 - 20 * x ** 3) * numpy.exp(-decay(peak) * rise(peak) * x)
    return peak * (numpy.trapz(p, x) * rise(peak) + math.exp(-decay(peak) * rise(peak)) / decay(peak))


def load(peak):
    return {"Loads/cavity pressure/Amplitude": peak, "Loads/cavity pressure/Decay rate": f"{decay(peak):.12g}",
            "Loads/cavity pressure/Rise time": f"{rise(peak):.12g}", "Receivers/array/Interval": f"{min(2e-6, rise(peak) / 4):.3g}"}


class Cavity:
    """What one run says; failed runs have no numbers but a reason."""

    def __init__(self, scene, settings=None, peak=1e8, layers=LAYERS):
        finer = {"Mesh/Radial layers": 640, "Mesh/Refinement": 1} if layers == 1280 else {"Mesh/Radial layers": layers}
        settings = {**finer, **load(peak), **(settings or {})}
        self.peak, self.failed = peak, ""
        try:
            self.run = study.run(PRM / f"cap_cavity_{scene}.prm" if scene in SOILS else f"{scene}.prm", settings, repeat=1)
        except RuntimeError as problem:
            self.failed = re.search(r"exit code \d+", str(problem))[0]
            return
        self.table = {name: numpy.array(values) for name, values in self.run.table("receivers-array.csv").items()}
        self.t = self.table["t [s]"]
        late = self.t > .75 * self.t[-1]
        self.wall = float(self.column(0, "displacement", "m")[late].mean() / A)
        self.v = [float(self.column(i, "velocity", "m/s").max()) for i in range(len(RADII))]
        self.S = [float(-self.column(i, "stress", "Pa").min()) for i in range(len(RADII))]
        self.energy_error = self.run["energy_error"]

    def column(self, i, quantity, unit):
        """At receiver i, along the radius; the plane and the octant have their receivers on x."""
        for direction in ("rr", "xx") if quantity == "stress" else ("r", "x"):
            if (name := f"d1r{i + 1}.{quantity}_{direction} [{unit}]") in self.table:
                return self.table[name]
        raise KeyError(quantity)

    def arrival(self, i):
        """First time at which the velocity is 5 % of its largest value there [s]."""
        return float(self.t[numpy.argmax(self.column(i, "velocity", "m/s") > .05 * self.v[i])])

    def exponent(self):
        """n of v ~ r^-n by least squares from 2 to 10 radii."""
        far = [i for i, r in enumerate(RADII) if r >= 2 * A]
        return float(-numpy.polyfit(numpy.log([RADII[i] for i in far]), numpy.log([self.v[i] for i in far]), 1)[0])

    def energies(self):
        """Name -> numbers over time, of what became of the work of the pressure [J]."""
        ledger = self.run.table("statistics.csv")
        get = lambda start: numpy.array(next(values for name, values in ledger.items() if name.startswith(start)))
        return {"t": get("t "), "work": get("work of cavity pressure"), "kinetic": get("kinetic"), "stored": get("strain"),
                "law": get("dissipated by the law"), "viscosity": get("dissipated by bulk viscosity"), "radiated": -get("work of far field")}

    def shares(self):
        """Percent of the work at the end."""
        ledger = self.energies()
        return {f"{name} [%]": percent(ledger[name][-1], ledger["work"][-1]) for name in ("kinetic", "stored", "law", "viscosity", "radiated")}


def finished(case):
    return "yes" if not case.failed else case.failed


def percent(part, whole):
    return round(float(100 * part / whole), 6) + 0.  # without the traces that arrive before the wave


def add(table, **row):
    tables.setdefault(table, []).append(row)
    print("  " + table + ": " + ", ".join(f"{name} {common.text(value)}" for name, value in row.items()), flush=True)


def at(radius):
    return RADII.index(radius)


# --- the sand -----------------------------------------------------------------------------------------------------------
def sand():
    """The isotropic curve of the dry sand against a measured one of the same relative densities."""
    file = common.scratch().with_suffix(".csv")
    file.parent.mkdir(parents=True, exist_ok=True)
    subprocess.run([common.binary(), "material", study.folder / "isotropic.prm", "--output", file], check=True, stdout=subprocess.DEVNULL)
    rows = list(csv.reader(line for line in file.read_text().splitlines() if not line.startswith("#")))
    names = [name.split(" [")[0].strip() for name in rows[0]]
    density, pressure = (numpy.array([float(row[names.index(name)]) for row in rows[1:]]) for name in ("density", "p"))
    for rho, p in SAND:
        found = float(numpy.interp(rho / 1674, density / 1590, pressure)) / 1e6
        add("sand", **{"rho/rho_0": rho / 1674, "measured p [MPa]": p, "p [MPa]": found, "off": profiles.relative(found, p)})


# --- peaks and soils ----------------------------------------------------------------------------------------------------
def peaks_and_soils():
    cases = {}
    for soil in SOILS:
        for peak in study.choose((1e6, 1e7, 1e8, 1e9, 1e10), quick=(1e8,)):
            case = cases[soil, peak] = Cavity(soil, peak=peak)
            name = {"soil": soil, "peak [MPa]": peak / 1e6}
            if case.failed:
                add("peaks", **name, finished=case.failed)
                continue
            add("peaks", **name, **{"impulse [Pa s]": impulse(peak)}, finished=finished(case), **{"u(a)/a": case.wall},
                n=case.exponent(), **case.shares(), energy_error=case.energy_error, steps=case.run["steps"])
            for table, get in (("stress", lambda i: case.S[i] / 1e6), ("velocity", lambda i: case.v[i]), ("arrival", lambda i: case.arrival(i) * 1e3)):
                add(table, **name, **{f"{RADII[i] / A:g} a": get(i) for i in map(at, (.15, .2, .3, .5, 1.))})
    return cases


def figures(cases):
    for soil in SOILS:
        ledger = cases[soil, 1e8].energies()
        for fraction in (.005, .02, .1, .25, .5, 1.):
            k = numpy.argmin(abs(ledger["t"] - fraction * ledger["t"][-1]))
            add("energy", soil=soil, **{"t [ms]": float(ledger["t"][k] * 1e3), "work [kJ]": float(ledger["work"][k] / 1e3)},
                **{f"{name} [%]": percent(values[k], ledger["work"][k]) for name, values in ledger.items() if name not in ("t", "work")})
    if not study.write:
        return
    drawing, axes = common.plt.subplots(figsize=(6.4, 4.8))
    colours = dict(zip(SOILS, ("tab:orange", "tab:green", "tab:blue")))
    markers = dict(zip((1e6, 1e7, 1e8, 1e9, 1e10), "os^vD"))
    for (soil, peak), case in cases.items():
        axes.loglog([r / A for r in RADII[1:]], case.v[1:], markers[peak] + "-", color=colours[soil], markersize=4, linewidth=1)
    for soil in SOILS:
        axes.plot([], [], "-", color=colours[soil], label=soil)
    for peak, marker in markers.items():
        axes.plot([], [], "k" + marker, markersize=4, label=f"{peak / 1e6:g} MPa")
    # Swedish Civil Contingencies Agency, MSB B02-301 (2017), after TM 5-855-1: saturated clay, saturated sandy clay, wet clay, dry and loose dry sand
    for n, label in ((1.5, "1.5"), (2.4, ""), (2.5, "2.4, 2.5"), (2.75, "2.75"), (3.1, "3.1")):
        axes.loglog([5, 10], [600, 600 * 2 ** -n], "k--", linewidth=.8)
        axes.text(10.2, 600 * 2 ** -n, label, fontsize=7, va="center")
    axes.text(5, 700, "slopes of MSB B02-301", fontsize=7)
    axes.set(xlabel="r/a", ylabel="largest velocity [m/s]")
    axes.set_xticks([1.5, 2, 3, 5, 10], ["1.5", "2", "3", "5", "10"])
    axes.set_xticks([], minor=True)
    axes.grid(True, which="major", linewidth=.3)
    axes.legend(fontsize=7, loc="upper left", bbox_to_anchor=(1.01, 1.))
    drawing.savefig(study.folder / "attenuation.svg", bbox_inches="tight", metadata={"Date": None})
    common.plt.close(drawing)


# --- meshes -------------------------------------------------------------------------------------------------------------
def meshes():
    cells = (80, 160, 320, 640, 1280)
    ladders = [(soil, peak, cells[:3] if (soil, peak) == ("dry", 1e10) else cells) for soil in SOILS for peak in (1e8, 1e10)]
    for soil, peak, ladder in study.choose(ladders, quick=[("dry", 1e8, (40, 80, 160))]):
        runs = [Cavity(soil, peak=peak, layers=layers) for layers in ladder]
        for name, values in (("u(a)/a", [c.wall for c in runs]), ("S at 2a [MPa]", [c.S[at(.2)] / 1e6 for c in runs]),
                             ("S at 4a [MPa]", [c.S[at(.4)] / 1e6 for c in runs]), ("v at 2a [m/s]", [c.v[at(.2)] for c in runs]),
                             ("v at 5a [m/s]", [c.v[at(.5)] for c in runs]), ("v at 10a [m/s]", [c.v[at(1.)] for c in runs])):
            order, limit, bar = common.richardson(values)
            row = {f"on {n}": f"{value:.4g}" for n, value in zip(ladder, values)}
            add("meshes", soil=soil, **{"peak [MPa]": peak / 1e6}, quantity=name, **row, order=order, limit=f"{limit:.4g}",
                **{"bar [%]": 100 * bar / abs(limit)})
    for soil, peak in study.choose([(s, p) for s in SOILS for p in (1e8, 1e10) if (s, p) != ("dry", 1e10)], quick=()):
        # equal cells as far as both reach
        near, far = (Cavity(soil, {"Mesh/Outer radius": A * 2 ** (layers / 80)}, peak, layers) for layers in (280, 400))
        add("border", soil=soil, **{"peak [MPa]": peak / 1e6}, **{"u(a)": profiles.relative(near.wall, far.wall),
                                                                 "v at 5a": profiles.relative(near.v[at(.5)], far.v[at(.5)]),
                                                                 "v at 10a": profiles.relative(near.v[at(1.)], far.v[at(1.)])})


# --- parameters ---------------------------------------------------------------------------------------------------------
def against(reference, case):
    """Relative changes of what the study is about."""
    if case.failed:
        return {"u(a)": case.failed}
    return {"u(a)": profiles.relative(case.wall, reference.wall), "S at 2a": profiles.relative(case.S[at(.2)], reference.S[at(.2)]),
            "v at 2a": profiles.relative(case.v[at(.2)], reference.v[at(.2)]), "v at 5a": profiles.relative(case.v[at(.5)], reference.v[at(.5)]),
            "v at 10a": profiles.relative(case.v[at(1.)], reference.v[at(1.)]), "n": case.exponent(),
            "law [%]": case.shares()["law [%]"], "viscosity [%]": case.shares()["viscosity [%]"], "energy_error": case.energy_error}


PARAMETERS = {"Fluidity eta": (200, (12.5, 50, 800, 3200)), "Overstress scale f0": (1e6, (2.5e5, 4e6)), "Overstress exponent N": (1.5, (1, 3, 6)),
              "Hardening limit W": (.4, (.1, .2, .5)), "Hardening rate D": (5e-9, (1.25e-9, 2e-8)), "Cap axis ratio R": (5, (1.25, 2.5, 10))}


def parameters(reference):
    add("parameters", parameter="reference", value="", **against(reference, reference))
    for name, (_, values) in PARAMETERS.items():
        for value in study.choose(values, quick=values[:1] if name == "Fluidity eta" else ()):
            settings = {f"{SOIL}/{name}": value}
            if name == "Cap axis ratio R" and value == 10:
                settings[f"{SOIL}/Small cap rule"] = "true"  # X_min grows with R
            add("parameters", parameter=name, value=value, **against(reference, Cavity("dry", settings)))


def water():
    for saturation in study.choose((0, .25, .5, .75, .9, .98, 1), quick=(.5,)):
        case = Cavity("wet", {WATER: saturation})
        name = {"saturation": saturation, "water content [%]": 100 * saturation * .4 / .6 / 2.65, "air [%]": 40 * (1 - saturation)}
        add("water", **name, **{"u(a)/a": case.failed} if case.failed else {
            "u(a)/a": case.wall, "S at 2a [MPa]": case.S[at(.2)] / 1e6, "S at 5a [MPa]": case.S[at(.5)] / 1e6, "v at 2a [m/s]": case.v[at(.2)],
            "v at 10a [m/s]": case.v[at(1.)], "arrival at 10a [ms]": case.arrival(at(1.)) * 1e3, "n": case.exponent(), **case.shares(),
            "energy_error": case.energy_error})


def laws(reference):
    rate = {"rate independent": {f"{SOIL}/Viscosity": "none"},
            "Duvaut-Lions, 20 us": {f"{SOIL}/Viscosity": "Duvaut-Lions", f"{SOIL}/Relaxation time": 2e-5},
            "never yields (eta = 0)": {f"{SOIL}/Fluidity eta": 0}}
    others = {"cap with constant moduli, Perzyna": "constant", "geologic cap": "geologic", "tabulated compaction": "table", "elastic": "elastic"}
    runs = [("cap with stiffening, Perzyna", 1e8, lambda: reference)]
    runs += [(f"cap with stiffening, {name}", 1e8, lambda settings=settings: Cavity("dry", settings)) for name, settings in rate.items()]
    runs += [(name, peak, lambda scene=scene, peak=peak: Cavity(scene, peak=peak)) for peak in (1e8, 1e10) for name, scene in others.items()
             if scene in ("geologic", "table") or peak == 1e8]
    for name, peak, run in study.choose(runs, quick=runs[:1] + runs[5:6]):
        case = run()
        row = {"law": name, "peak [MPa]": peak / 1e6, "finished": finished(case), "u(a)/a": "" if case.failed else case.wall}
        add("laws", **row, **(against(reference, case) if peak == reference.peak else {"energy_error": case.energy_error}),
            steps="" if case.failed else case.run["steps"])


# --- other forms --------------------------------------------------------------------------------------------------------
FORM = {"Mesh/Outer radius": .4, "End time": 5e-4, "Receivers/array/Radii": ", ".join(map(str, RADII[:4])),
        "Receivers/array/Directions": "1, 0.7, 0.4"}


def one_form(soil, peak, settings):
    """Displacement of the wall over a, largest radial stress and velocity at 2a, along a generic direction; and the run."""
    run = study.run(PRM / f"cap_cavity_{soil}.prm", {**load(peak), **FORM, **settings}, repeat=1)
    table = {key: numpy.array(values) for key, values in run.table("receivers-array.csv").items()}
    letters = [c for c in "xyzr" if f"d1r1.displacement_{c} [m]" in table]
    letters = ["r"] + ["z"] * ("z" in letters) if "r" in letters else letters
    u = math.sqrt(sum(table[f"d1r1.displacement_{c} [m]"][-1] ** 2 for c in letters)) / A
    v = numpy.sqrt(sum(table[f"d1r3.velocity_{c} [m/s]"] ** 2 for c in letters)).max()
    place = [float(x) for x in (run.directory / "receivers-array-points.csv").read_text().splitlines()[3].split(",")[1:]]
    n = [x / math.hypot(*place) for x in place][:len(letters)]
    stress = lambda a, b: next((table[f"d1r3.stress_{p} [Pa]"] for p in (a + b, b + a) if f"d1r3.stress_{p} [Pa]" in table), 0.)
    S = -sum(n[i] * n[k] * stress(a, b) for i, a in enumerate(letters) for k, b in enumerate(letters))
    return u, float(S.max()), float(v), run


PLANE, SPACE = {"Dimension": 2, "Symmetry": "axisymmetric"}, {"Dimension": 3, "Symmetry": "none"}


def forms():
    for soil, peak, refinements in study.choose([("dry", 1e8, (2, 3))] + [(soil, 1e10, (2,)) for soil in SOILS], quick=[("wet", 1e10, (1,))]):
        for refinement in refinements:
            shell = {"Mesh/Radial layers": 16, "Mesh/Refinement": refinement}
            radius = None
            for form, settings in (("radius", {}), ("plane", PLANE), ("octant", SPACE)):
                *found, run = one_form(soil, peak, {**shell, **settings})
                radius = radius or found
                u, S, v = (profiles.relative(x, y) for x, y in zip(found, radius))
                add("forms", soil=soil, **{"peak [MPa]": peak / 1e6, "layers": 16 * 2 ** refinement, "cells across": 2 ** (refinement + 1)}, form=form,
                    **{"u(a)/a": found[0], "u(a) off": u, "S at 2a off": S, "v at 2a off": v}, energy_error=run["energy_error"],
                    core_seconds=run.core_seconds)


def hourglass():
    shell = {"Mesh/Radial layers": 8, "Mesh/Refinement": 2, "End time": 2e-4}
    for soil, peak in study.choose([(soil, peak) for soil in SOILS for peak in (1e8, 1e9, 1e10)], quick=()):
        radius = one_form(soil, peak, shell)
        for control, settings in {**{f"stiffness {x:g}": {"Element/Hourglass control": "stiffness", "Element/Hourglass coefficient": x}
                                     for x in (.01, .05, .2)}, "viscous 0.05": {}, "full hexahedron": {"Element/Type": "hexahedron"}}.items():
            u, S, v, run = one_form(soil, peak, {**shell, **PLANE, **settings})
            log = (run.directory / "log.txt").read_text()
            share = re.search(r"Hourglass .* J, (\S+) % of", log)
            add("hourglass", soil=soil, **{"peak [MPa]": peak / 1e6}, control=control,
                **{"u(a) off": profiles.relative(u, radius[0]), "v at 2a off": profiles.relative(v, radius[2]),
                   "hourglass [%]": float(share[1]) if share else 0.}, folded="yes" if "folded at a corner" in log else "",
                energy_error=run["energy_error"])


# --- overstress at the front --------------------------------------------------------------------------------------------
def overstress(case, i):
    """Largest f of (13.1) while the cap is loaded at receiver i, with the numbers of the scene [Pa]."""
    alpha, gamma, beta, theta, strongest, R = 64.2e3, 5.89e3, .34283e-6, .18257, 130e6, 5.
    bound = (strongest - alpha) / theta
    stress = [case.table[f"d1r{i + 1}.stress_{c} [Pa]"] for c in ("rr", "tt", "pp")]
    L, q = case.table[f"d1r{i + 1}.cap junction"], case.table[f"d1r{i + 1}.bulk viscosity [Pa]"]
    I1, j = -sum(stress) - 3 * q, abs(stress[0] - stress[1]) / math.sqrt(3)
    F = lambda x: alpha - gamma * numpy.exp(-beta * x) + theta * bound * (1 - numpy.exp(-x / bound))
    slope = lambda x: beta * gamma * numpy.exp(-beta * x) + theta * numpy.exp(-x / bound)
    h = R * slope(L)
    cap = numpy.sqrt(j ** 2 + ((I1 - L - R * F(L) * h) / R) ** 2) - F(L) * numpy.sqrt(1 + h ** 2)
    f = numpy.where(I1 >= L, cap, numpy.where(I1 >= 0, j - F(numpy.maximum(I1, 0)), 0.))
    return float(f.max())


def fronts():
    history = {"Receivers/array/Quantities": "displacement, velocity, stress, history"}
    rows = [("rate independent", {f"{SOIL}/Viscosity": "none"})]
    rows += [(f"eta = {eta:g}", {f"{SOIL}/Fluidity eta": eta}) for eta in (12.5, 50, 200, 800, 3200)]
    for name, settings in study.choose(rows, quick=rows[:1] + rows[3:4]):
        case = Cavity("dry", {**history, **settings})
        log = (case.run.directory / "log.txt").read_text()
        relaxation = re.search(r"relaxation time (\S+) s = (\S+) mean steps = (\S+) h/c", log)
        add("fronts", viscosity=name, **{f"f/S at {RADII[i] / A:g}a [%]": 100 * overstress(case, i) / case.S[i] for i in map(at, (.15, .2, .3, .5))},
            **{"f at 2a [kPa]": overstress(case, at(.2)) / 1e3},
            **({"relaxation [us]": float(relaxation[1]) * 1e6, "in mean steps": float(relaxation[2])} if relaxation else {}))


# --- stability ----------------------------------------------------------------------------------------------------------
def stability():
    plane = {"Dimension": 2, "Symmetry": "axisymmetric", "End time": 1e-3, "Mesh/Refinement": 2}
    for soil in study.choose(SOILS, quick=("dry",)):
        for form, settings, layers in (("radius", {}, LAYERS), ("axisymmetric", plane, 24)):
            reference = None
            row = {}
            for courant in study.choose((.5, .9, 1., 1.1, 1.2, 1.3, 1.5), quick=(.9, 1.1) if form == "radius" else ()):
                case = Cavity(soil, {"Time stepping/Courant number": courant, **settings}, layers=layers)
                reference = reference or case
                row[f"energy error at {courant:g}"] = case.failed or case.energy_error
                if courant in (.9, 1.1, 1.2) and not case.failed:
                    row[f"u(a) at {courant:g} off"] = profiles.relative(case.wall, reference.wall)
            if row:
                add("steps", soil=soil, form=form, **row)
    for soil in study.choose(SOILS, quick=()):
        for b1, b2 in ((0, 0), (.06, 1.2), (.2, 1.2), (.6, 2)):
            settings = {"Element/Linear bulk viscosity": b1, "Element/Quadratic bulk viscosity": b2}
            runs = [Cavity(soil, settings, layers=layers) for layers in (80, 160, 320)]
            for quantity, get in (("u(a)/a", lambda c: c.wall), ("v at 5a [m/s]", lambda c: c.v[at(.5)])):
                add("viscosity", soil=soil, b1=b1, b2=b2, quantity=quantity, **{n: c.failed or get(c) for n, c in zip(("80", "160", "320"), runs)},
                    **{"viscosity on 320 [%]": "" if runs[-1].failed else runs[-1].shares()["viscosity [%]"]})


sand()
cases = peaks_and_soils()
figures(cases)
meshes()
parameters(cases["dry", 1e8])
water()
laws(cases["dry", 1e8])
forms()
hourglass()
fronts()
stability()

shown = {name: common.markdown_table(rows) for name, rows in tables.items()}
print("\n" + "\n\n".join(shown.values()), flush=True)
if study.write:
    rows = [{"table": name, **row} for name, rows in tables.items() for row in rows]
    common.write_csv(study.folder / "results.csv", rows)
    facts = ", ".join(f"{name.replace('deal_ii', 'deal.II')} {value}" for name, value in common.machine(study.last).items())
    words = {
        "sand": "The dry sand under isotropic pressure, against the sand of Laine and Sandvik (2001):",
        "peaks": "Peaks from 1 MPa to 10 GPa, ten times the peak with twice the impulse, on 320 cells to 16 a, 4 ms. u(a): mean of the last quarter. "
                 "n: slope of the largest velocity from 2 to 10 a. Shares of the pressure's work at the end:",
        "stress": "Largest radial stress [MPa] over distance, bulk viscosity included:",
        "velocity": "Largest velocity [m/s]:",
        "arrival": "Arrival [ms] of 5 % of the largest velocity at the place:",
        "energy": "What has become of the work under 100 MPa, over time:",
        "meshes": "Meshes with 80 to 1280 cells; order, limit and error bar as in `arenite converge`:",
        "border": "The border at 11.3 a against that at 32 a, relative differences:",
        "parameters": "One parameter at a time, dry, 100 MPa: relative changes against the reference, n, and shares of the work:",
        "water": "Water content, `undrained cap`, porosity 40 %, 100 MPa:",
        "laws": "Other laws, dry, 100 MPa, relative changes against the first row:",
        "forms": "Plane and octant against the radius with the same layers, border at 4 a, 0.5 ms:",
        "fronts": "Largest overstress f at the front over the largest stress there (dry, 100 MPa), and the relaxation time of the log:",
        "steps": "Courant number (default 0.9) of 100 MPa: largest energy error, and u(a) against that at 0.5:",
        "viscosity": "Bulk viscosity b1, b2 on 80, 160 and 320 cells:",
        "hourglass": "Hourglass control in the plane, 32 layers and 8 cells across, 0.2 ms, against the radius; work on the patterns in percent of the "
                     "energy of the soil:"}
    body = "\n\n".join(f"{words[name]}\n\n{table}" + ("\n\n![largest velocity over distance](cap_cavity/attenuation.svg)" if name == "velocity" else "")
                       for name, table in shown.items())
    common.report(study.name, f"## Cap cavity\n\n{body}\n\n*{facts}. {study.disturbed}*")
