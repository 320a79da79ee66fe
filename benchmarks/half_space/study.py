"""A cavity below a free surface: error and cost, and what surface, depth, borders and absorbing boundaries do. See README.md."""
import math, sys
from pathlib import Path
sys.path.insert(0, str(Path(__file__).resolve().parents[1]))
import common, tuning
import numpy

study = common.Study(__file__)
SCENE, INFINITE, FILE = "../../prm/buried_cavity.prm", "infinite.prm", "receivers-surface.csv"
RADIUS = .1
OFFSETS = (0., .25, .5, 1., 2.)  # of the receivers from the axis, in depths


def buried(depth=.5, offsets=None, **more):
    places = [o * depth for o in offsets] if offsets else (0., .2, .5, 1.)
    return {"Mesh/Depth": depth, "Verification/Depth": depth, "Output/VTU interval": 0,
            "Receivers/surface/Points": "; ".join(f"{x}, 0, {depth}" for x in places),
            "Receivers/surface/Quantities": "displacement, velocity", **more}


def signals(run, point, quantity):
    """Times and the components, radial and upward."""
    table = run.table(FILE)
    unit = {"displacement": "m", "velocity": "m/s"}[quantity]
    return numpy.array(table["t [s]"]), numpy.array([table[f"{point}.{quantity}_{c} [{unit}]"] for c in "rz"])


# 1. error and cost against Cagniard's method, in the meridian plane and once as a quarter of the body
for name in ("Q1, one point", "Q1, 2x2x2", "Q2", "Q4"):
    for refinement in study.choose({"Q2": (1, 2, 3, 4), "Q4": (0, 1, 2, 3)}.get(name, (2, 3, 4, 5)), quick=(1, 2)):
        run = study.run(SCENE, buried(**tuning.ELEMENTS[name], **{"Mesh/Refinement": refinement}), timeout=600)
        study.add(f"axisymmetric, {name}", run, run.errors["surface.displacement.E_t"], refinement=refinement, dofs=run["dofs"],
                  steps=run["steps"], memory_mb=run["total_memory_mb"])
space = {"Dimension": 3, "Symmetry": "none", "Mesh/Refinement": 0 if study.quick else 1}
run = study.run(SCENE, buried(**space), repeat=1, timeout=600)
study.add("quarter, Q4", run, run.errors["surface.displacement.E_t"], refinement=space["Mesh/Refinement"], dofs=run["dofs"],
          steps=run["steps"], memory_mb=run["total_memory_mb"])

# 2. free surface and depth: peaks over those of the same point in infinite space, where the motion is radial
depths, curves, waves = [], {}, {}
for depth in study.choose((.15, .2, .3, .5, 1.), quick=(.3, .5)):
    half = study.run(SCENE, buried(depth, OFFSETS, **{"Mesh/Refinement": 2, "Mesh/Outer distance": 3. if depth < 1. else 4., "End time": 1e-2}),
                     repeat=1, timeout=600)
    whole = study.run(INFINITE, {"Receivers/surface/Points": "; ".join(f"{o * depth}, 0, {depth}" for o in OFFSETS), "End time": 1e-2}, repeat=1)
    row = {"depth [m]": depth, "error of u": half.errors["surface.displacement.E_t"]}
    for point, offset in enumerate(OFFSETS, 1):
        factor = {}
        for quantity in ("displacement", "velocity"):
            _, u = signals(half, f"p{point}", quantity)
            radial = numpy.array(whole.column(FILE, f"p{point}.{quantity}_r [{'m' if quantity == 'displacement' else 'm/s'}]"))
            factor[quantity] = numpy.hypot(*u).max() / numpy.abs(radial).max()
        row[f"u at r/h = {offset:g}"], row[f"v at r/h = {offset:g}"] = factor["displacement"], factor["velocity"]
        curves.setdefault(f"h = {depth:g} m", []).append((offset * depth, numpy.hypot(*signals(half, f"p{point}", "velocity")[1]).max()))
    depths.append(row)
    if depth == .5:
        t, u = signals(half, "p1", "displacement")
        waves["half-space, above the cavity"] = list(zip(1e3 * t, 1e3 * u[1]))
        waves["infinite space, the same point"] = [(1e3 * a, 1e3 * b) for a, b in zip(whole.column(FILE, "t [s]"), whole.column(FILE, "p1.displacement_r [m]"))]
        waves["half-space, r = 2 h, upwards"] = list(zip(1e3 * t, 1e3 * signals(half, "p5", "displacement")[1][1]))

# 3. borders: the same mesh around the cavity, outer boundary nearer or farther; the reference is too large for anything to come back
END, FAR, WIDTH, STEP = 1.2e-2, 4.4, 1., 8e-6  # distances: multiples of the cells, so that the mesh within is the same
LAYER = {"Type": "sponge", "Shape": "sphere", "Origin": "0, 0", "Target reflection": .3}


def bordered(kind, outer):
    options = buried(**{"Mesh/Refinement": 1, "Mesh/Outer distance": outer, "End time": END, "Time stepping/Fixed step": STEP})
    if kind == "fixed":
        options["Constraints/Fixed boundaries"] = "outer"
    if kind == "Lysmer and sponge":
        options["Loads"] = "cavity pressure, far field, layer"
        options.update({f"Loads/layer/{entry}": value for entry, value in LAYER.items()})
        options.update({"Loads/layer/Start": outer - WIDTH, "Loads/layer/End": outer})
    return study.run(SCENE, options, repeat=1)


alone, borders = bordered("Lysmer", FAR), []
for outer in study.choose((1.2, 1.6, 2., 2.4, 3.), quick=(1.6,)):
    for kind in ("fixed", "Lysmer", "Lysmer and sponge"):
        if kind == "Lysmer and sponge" and outer - WIDTH < 1.:
            continue  # the layer would begin before the last receiver
        run, row = bordered(kind, outer), {"boundary": kind, "outer distance [m]": outer}
        for quantity in ("displacement", "velocity"):
            difference = reference = 0.
            for point in ("p1", "p2", "p3", "p4"):
                whole = signals(alone, point, quantity)[1]
                difference += ((signals(run, point, quantity)[1] - whole) ** 2).sum()
                reference += (whole ** 2).sum()
            row[f"E_t of {quantity}"] = math.sqrt(difference / reference)
        last = signals(alone, "p4", "velocity")[1]
        row["largest v sent back"] = numpy.abs(signals(run, "p4", "velocity")[1] - last).max() / numpy.abs(last).max()
        borders.append({**row, "dofs": run["dofs"], "core-seconds": run.core_seconds})

print("\n" + common.markdown_table(depths) + "\n\n" + common.markdown_table(borders), flush=True)
if study.write:
    common.figure(study.folder / "waveforms.svg", waves, xlabel="t [ms]", ylabel="displacement [mm]", loglog=False, markers=False)
    common.figure(study.folder / "attenuation.svg", {name: [p for p in c if p[0] > 0.] for name, c in curves.items()},
                  xlabel="distance from the axis [m]", ylabel="largest velocity of the surface [m/s]")
study.finish(f"""Free surface and depth: largest displacement u and velocity v of the surface over those of the same point in infinite space.

{common.markdown_table(depths)}

![waveforms](half_space/waveforms.svg)
![attenuation](half_space/attenuation.svg)

Borders, against the run with the border {FAR:g} m away, {1e3 * END:g} ms, receivers up to 1 m; the sponge is {WIDTH:g} m wide:

{common.markdown_table(borders)}

Error and cost against Cagniard's method:""", slopes=(-1,))
