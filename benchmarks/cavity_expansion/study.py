"""Cavities that open at constant velocity, and cavities under pulses at large strain. See README.md."""
import math, sys
from pathlib import Path
sys.path.insert(0, str(Path(__file__).resolve().parents[1]))
import common, profiles, tuning
import numpy
import lagrangian
from reference import LOCKING, SOLIDS, Expansion

study = common.Study(__file__)
FIRST = .01  # radius of the cavity at the start [m]
SCENES = {"Mises": "expansion.prm", "Drucker-Prager": "friction.prm"}
ELEMENTS = {name: tuning.ELEMENTS[name] for name in ("Q1, one point", "Q1, 2x2x2")}


def layers(inner, outer, n, refinement=None):
    """Settings of a shell of n layers, a radius or an octant of that refinement, and the middles of the layers."""
    coarse = n // 2 ** (refinement or 0)  # of equal ratio; refinement halves them
    radii = inner * (outer / inner) ** (numpy.arange(coarse + 1) / coarse)
    radii = numpy.interp(numpy.arange(n + 1) / n, numpy.arange(coarse + 1) / coarse, radii)
    form = {"Mesh/Radial layers": n} if refinement is None else profiles.octant(n, refinement)
    return {"Mesh/Inner radius": inner, "Mesh/Outer radius": outer, **form}, (radii[1:] + radii[:-1]) / 2


def in_space(refinement):
    return "" if refinement is None else f", octant {2 ** (refinement + 1)} across, 3-D"


def expand(name, V, element, cells, growth, refinement=None):
    """The cavity opens to `growth` times its first radius; fields against the self-similar ones at the same place."""
    solid, exact = SOLIDS[name], Expansion(SOLIDS[name], V)
    end = (growth - 1) * FIRST / V
    age = growth * FIRST / V  # of a cavity that began from nothing and has this radius now
    mesh, middles = layers(FIRST, FIRST + 1.05 * solid.ce * end, cells, refinement)
    run = study.run(SCENES[name], {**ELEMENTS[element], **mesh, "End time": end, "Constraints/cavity/Amplitude": -V,
                                   **profiles.at("wall", middles[middles < 1.3 * exact.boundary * age], interval=end)}, repeat=1)
    profile = profiles.read(run, "wall", power=2)
    v, S, _, rho = exact.at(profile.x / age)
    plastic = profile.x < .9 * exact.boundary * age
    yields = profile.q - .995 * (solid.Ya + solid.Yb * profile.p)
    return study.add(f"{name}, {V} m/s, {element}" + in_space(refinement), run, profiles.relative(profile.S[0], S[0]), cells=cells, growth=growth,
                     S_L1=profile.l1(profile.S, S, plastic), v_L1=profile.l1(profile.v, v, plastic),
                     rho_at_wall=profiles.relative(profile.rho[0], rho[0]),
                     # on the plane sides of an octant's cells the radius is not quite a principal direction
                     boundary=profiles.relative(profile.crossing(yields, 0., profile.x) / age, exact.boundary) if refinement is None else "",
                     energy_error=run["energy_error"])


def lock(V, cells):
    end = 2 * FIRST / V
    mesh, _ = layers(FIRST, .1, cells)
    run = study.run("locking.prm", {**mesh, "End time": end, "Constraints/cavity/Amplitude": -V}, repeat=1)
    table = run.table("receivers-wall.csv")
    t, S = (numpy.array(table[name]) for name in ("t [s]", "p1.stress_rr [Pa]"))
    late = t > .9 * end
    return study.add(f"locking, {V} m/s", run, profiles.relative(-S[late].mean(), LOCKING.wall_stress(V)), cells=cells, growth=3,
                     scatter=float(S[late].std() / abs(S[late].mean())), energy_error=run["energy_error"])


def pulse(name, element, cells, reference, refinement=None):
    form = {"Mesh/Radial layers": cells} if refinement is None else profiles.octant(cells, refinement)
    run = study.run(f"{name}.prm", {**ELEMENTS[element], **form}, repeat=1)
    r = "r" if refinement is None else "x"
    table = run.table("receivers-cavity.csv")
    columns = [table["t [s]"]] + [table[f"p{i}.displacement_{r} [m]"] for i in (1, 2, 3)]
    found = numpy.array(columns).T
    off = [lagrangian.distance(found, reference, i) for i in (1, 2, 3)]
    return study.add(f"{name}, {element}" + in_space(refinement), run, off[0], cells=cells, **{f"u_at_{R}": x for R, x in zip(lagrangian.RADII, off)},
                     largest_u=profiles.relative(found[:, 1].max(), reference[:, 1].max()), energy_error=run["energy_error"])


orders = []
for name, velocities in (("Mises", (200, 400)), ("Drucker-Prager", (20, 50))):
    for V in study.choose(velocities, quick=velocities[-1:]):
        for element in ELEMENTS:
            for cells, growth in study.choose(((250, 4), (500, 4), (1000, 4), (250, 8), (500, 8)), quick=((250, 4),)):
                expand(name, V, element, cells, growth)
for refinement in (None, *study.choose((2, 3), quick=(1,))):
    expand("Mises", 400, "Q1, one point", 64, study.choose((4,), quick=(2,))[0], refinement)
for V in study.choose((50, 100, 300), quick=(100,)):
    for cells in study.choose((150, 300, 600), quick=(150,)):
        lock(V, cells)
for name, case in lagrangian.CASES.items():
    reference = lagrangian.run(case, study.choose((1200,), quick=(600,))[0], kirchhoff=True)[::10]
    for element in ELEMENTS:
        ladder = study.choose((75, 150, 300, 600), quick=(75, 150))
        rows = [pulse(name, element, cells, reference) for cells in ladder]
        orders.append({"case": name, "element": element, "order of u at the wall": profiles.order(ladder, [row["error"] for row in rows])})
        for refinement in (None, *study.choose((1, 2, 3), quick=(2,))):
            pulse(name, element, study.choose((144,), quick=(72,))[0], reference, refinement)

table = common.markdown_table(orders)
print("\n" + table, flush=True)
study.series = {name: [(t, abs(error)) for t, error in points] for name, points in study.series.items()}
study.finish(f"""Orders of the pulses at large strain:

{table}

error: of the radial stress in the first cell at the wall (expansions, signed), of the displacement of the wall over time (pulses).""")
