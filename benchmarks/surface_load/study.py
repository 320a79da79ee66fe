"""Lamb's problem: elements per wavelength for a given error, speed of the Rayleigh wave, borders that reflect it. See README.md."""
import csv, math, sys
from pathlib import Path
sys.path.insert(0, str(Path(__file__).resolve().parents[1]))
import common, tuning
import numpy

study = common.Study(__file__)
SCENE = "../../prm/surface_load.prm"
RADIUS, CS, CR, DURATION = .3, 190.6925, 175.3230, 3e-3  # m, m/s, m/s, s
WAVE = CS * 2 * DURATION / math.sqrt(28 / 3)              # S wave of the pulse's main frequency [m]
PLACES = (.6, .9, 1.2, 1.5)
FILE = "receivers-surface.csv"
COMMON = {"Mesh/Load radius": RADIUS, "Verification/Load radius": RADIUS, "Mesh/Outer distance": 3, "End time": 1.3e-2,
          "Receivers/surface/Points": "; ".join(f"{r}, 0, 0" for r in PLACES), "Output/VTU interval": 0}
WISHES = {"10 %": .1, "1 %": .01, "0.1 %": .001}
CASES = {  # element and step: coarse cells across the load
    "Q1, one point": ("Q1, one point", .9, (6, 9, 12, 18, 24, 36, 48, 76)),
    "Q1, 2x2": ("Q1, 2x2x2", .9, (4, 6, 9, 12, 18, 24, 36, 52)),
    "Q2": ("Q2", .9, (1, 2, 3, 4, 6, 9, 13)),
    "Q3": ("Q3", .9, (1, 2, 3, 4, 6, 7)),
    "Q3, third of the step": ("Q3", .3, (1, 2, 3, 4)),
    "Q4": ("Q4", .9, (1, 2, 3, 4)),
    "Q4, third of the step": ("Q4", .3, (1, 2, 3, 4)),
}
STEP = 2.9e-5  # s, the same for all borders: 0.8 of the stable one


def error_at(run, point):
    with open(run.directory / "receivers-surface-errors.csv", newline="") as stream:
        return next(float(row["displacement.E_t"]) for row in csv.DictReader(stream) if row["name"] == point)


def delay(run, reference, point):
    """Time by which the vertical displacement u lags behind the reference v: -int (u - v) v' / int v'^2, until it stands."""
    name = f"{point}.displacement_z [m]"
    t, u = numpy.array(run.column(FILE, "t [s]")), numpy.array(run.column(FILE, name))
    s, v = numpy.array(reference.column(FILE, "t [s]")), numpy.array(reference.column(FILE, name))
    slope, lag = numpy.gradient(v, s), 0.
    for _ in range(50):
        there = numpy.interp(t - lag, s, v), numpy.interp(t - lag, s, slope)
        lag -= numpy.trapz((u - there[0]) * there[1], t) / numpy.trapz(there[1] ** 2, t)
    return lag


def at_error(rows, error, name):
    """Column `name` where the error has this size, between two rows of a ladder (straight in logarithms); empty outside."""
    for coarse, fine in zip(rows, rows[1:]):
        if coarse["error"] >= error > fine["error"]:
            part = math.log(coarse["error"] / error) / math.log(coarse["error"] / fine["error"])
            return coarse[name] * (fine[name] / coarse[name]) ** part
    return ""


# the reference for delays: its own error is printed with it
reference = study.run(SCENE, dict(COMMON, **tuning.ELEMENTS["Q4"], **{"Mesh/Cells across load": 6, "Time stepping/Courant number": .2,
                                                                      "Receivers/surface/Interval": 5e-6}), repeat=1)
print(f"  reference: E_t {reference.errors['surface.displacement.E_t']:.1e}", flush=True)

rule, dispersion, waves = [], {}, {}


def waveform(run, point):
    """Upward displacement [micrometre] over time [ms]."""
    return [(1e3 * t, 1e6 * u) for t, u in zip(run.column(FILE, "t [s]"), run.column(FILE, f"{point}.displacement_z [m]"))]


for point in ("p1", "p4"):
    waves[f"exact to {reference.errors['surface.displacement.E_t']:.0e}, {PLACES[int(point[1]) - 1]} m"] = waveform(reference, point)
for name, (element, courant, ladder) in CASES.items():
    rows = []
    for across in ladder[:2] if study.quick else ladder:
        run = study.run(SCENE, dict(COMMON, **tuning.ELEMENTS[element], **{"Mesh/Cells across load": across,
                                                                           "Time stepping/Courant number": courant}), timeout=600)
        if (name, across) in (("Q1, one point", 9), ("Q4", 2)):
            waves[f"{name}, {WAVE * across / RADIUS:.2g} cells per S wave, {PLACES[3]} m"] = waveform(run, "p4")
        path = PLACES[3] - PLACES[1]
        late = delay(run, reference, "p4") - delay(run, reference, "p2")
        rows.append(study.add(name, run, run.errors["surface.displacement.E_t"], cells_per_wave=WAVE * across / RADIUS,
                              dofs=run["dofs"], steps=run["steps"], near=error_at(run, "p1"), far=error_at(run, "p4"),
                              speed=-late * CR / path))
    dispersion[name] = [(row["cells_per_wave"], abs(row["speed"])) for row in rows]
    rule.append({"element": name, **{f"cells for {wish}": at_error(rows, error, "cells_per_wave") for wish, error in WISHES.items()},
                 **{f"core-s for {wish}": at_error(rows, error, "core_seconds") for wish, error in WISHES.items()}})

# what comes back from the border: the Rayleigh wave returns from all of these before 40 ms, and from 8 m nothing does
START, FAR, END = 1.6, 8., 4e-2
SPONGES = {"fixed": None, "Lysmer": None, "Lysmer and sponge, target 0.3": .3, "Lysmer and sponge, target 0.1": .1,
           "Lysmer and sponge, target 0.01": .01}


def with_border(condition, outer):
    options = dict(COMMON, **tuning.ELEMENTS["Q4"], **{"Mesh/Cells across load": 3, "Mesh/Outer distance": outer, "End time": END,
                                                       "Receivers/surface/Interval": 2e-4, "Time stepping/Fixed step": STEP,
                                                       "Receivers/surface/Quantities": "displacement, velocity"})
    loads = ["pulse", "far field"]
    if condition == "fixed":
        options["Constraints/Fixed boundaries"] = "outer"
    if SPONGES[condition]:
        for load, direction, origin in (("side", "1, 0", f"{START}, 0"), ("below", "0, -1", f"0, {-START}")):
            loads.append(load)
            options.update({f"Loads/{load}/{entry}": value for entry, value in (
                ("Type", "sponge"), ("Shape", "plane"), ("Origin", origin), ("Direction", direction), ("Start", 0),
                ("End", outer - START), ("Target reflection", SPONGES[condition]))})
    return study.run(SCENE, dict(options, Loads=", ".join(loads)), repeat=1)


def reflected(run, alone):
    """Velocity that the border sends back to the last receiver, over time and at its largest, relative to that without border."""
    difference, whole = (numpy.array([numpy.array(r.column(FILE, f"p4.velocity_{c} [m/s]")) for c in "rz"]) for r in (run, alone))
    difference = difference - whole
    return (math.sqrt((difference ** 2).sum() / (whole ** 2).sum()), numpy.abs(difference).max() / numpy.abs(whole).max())


borders = []
alone = with_border("Lysmer", FAR)
for outer in (2., 3.) if study.quick else (2., 2.5, 3., 4.):
    for condition in SPONGES:
        run = with_border(condition, outer)
        over_time, largest = reflected(run, alone)
        borders.append({"border": condition, "outer distance [m]": outer,
                        "sponge in waves": (outer - START) / WAVE if SPONGES[condition] else "",
                        "E_t of u": run.errors["surface.displacement.E_t"], "E_t of v at the last receiver": over_time,
                        "largest v sent back": largest, "dofs": run["dofs"], "core-seconds": run.core_seconds})

print("\n" + common.markdown_table(rule) + "\n\n" + common.markdown_table(borders), flush=True)
if study.write:
    common.figure(study.folder / "dispersion.svg", dispersion, xlabel="cells per S wave", ylabel="relative error of the Rayleigh wave's speed",
                  slopes=(-2, -4))
    common.figure(study.folder / "waveforms.svg", waves, xlabel="t [ms]", ylabel="upward displacement [um]", loglog=False, markers=False)
study.finish(f"""Cells per S wave of the pulse's main frequency (wave of {WAVE:.3f} m), for an error of the surface's displacement at {PLACES[0]} to
{PLACES[-1]} m from the centre, up to {PLACES[-1] * CS / CR / WAVE:.1f} Rayleigh waves (interpolated in the table below):

{common.markdown_table(rule)}

What borders send back, degree 4, three cells across the load, {1e3 * END:g} ms; sponges begin {START} m from the centre. E_t of u against the
exact solution ({alone.errors['surface.displacement.E_t']:.1e} with the border {FAR:g} m away), v against the run with the border there:

{common.markdown_table(borders)}

![waveforms](surface_load/waveforms.svg)
![dispersion](surface_load/dispersion.svg)

`near`, `far`: errors at the first and last receiver. `speed`: relative error of the Rayleigh wave's speed between the second and the
last one. Reference of the delays: error {reference.errors['surface.displacement.E_t']:.1e}.""", slopes=(-1,))
