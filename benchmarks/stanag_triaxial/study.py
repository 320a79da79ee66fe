"""Failure surface of the STANAG sand from triaxial tests, and what the tests leave open. See README.md."""
import math, sys
from pathlib import Path
sys.path.insert(0, str(Path(__file__).resolve().parents[1]))
import common, material_runs
from common import plt
import numpy

study = common.Study(__file__)
SCENE = study.folder / "triaxial.prm"
# Roger (2015), table 1.5: grain size [um] -> (confining pressure [kPa], friction angle [degrees])
DATA = {"250 to 400": ((200, 46.3), (300, 45.32), (390, 44.03)), "400 to 500": ((200, 46.1), (300, 44.37), (390, 43.49)),
        "500 to 800": ((200, 46.73), (290, 45.21), (390, 44.32)), "below 800": ((200, 46.63), (300, 45.37), (400, 42.82))}


# --- Mohr-Coulomb and the failure surface -----------------------------------------------------------------------------------
def at_failure(confinement, angle):
    """I1, sqrt(J2) and q of triaxial compression at the friction angle [degrees]; stresses in the unit of the confinement."""
    q = confinement * 2 * math.sin(math.radians(angle)) / (1 - math.sin(math.radians(angle)))
    return 3 * confinement + q, q / math.sqrt(3), q


def friction_angle(large, small):
    return math.degrees(math.asin((large - small) / (large + small)))


def angle_of_surface(failure, confinement):
    """Friction angle where q/sqrt(3) = Fe(3 confinement + q), by bisection in q."""
    low, high = 0., 1e3 * confinement
    for _ in range(200):
        q = .5 * (low + high)
        low, high = (q, high) if q / math.sqrt(3) < failure(3 * confinement + q) else (low, q)
    return friction_angle(confinement + q, confinement)


def straight_fit(points):
    """alpha [Pa], theta: least squares of sqrt(J2) over I1."""
    I1, j, _ = numpy.array([at_failure(1e3 * s, a) for s, a in points]).T
    theta, alpha = numpy.polyfit(I1, j, 1)
    return float(alpha), float(theta)


def curved_fit(points, beta):
    """alpha, gamma, theta of least squares for one beta, gamma and theta not negative; None if alpha <= gamma."""
    I1, j, _ = numpy.array([at_failure(1e3 * s, a) for s, a in points]).T
    unit, decay, slope = numpy.ones_like(I1), -numpy.exp(-beta * I1), I1 / 1e6
    best = None
    for columns in ((0, 1, 2), (0, 1), (0, 2)):
        matrix = numpy.stack([(unit, decay, slope)[c] for c in columns], axis=1)
        x = numpy.linalg.lstsq(matrix, j, rcond=None)[0]
        full = dict(zip(columns, x))
        alpha, gamma, theta = full[0], full.get(1, 0.), full.get(2, 0.) / 1e6
        if gamma >= 0 and theta >= 0 and alpha > gamma:
            residual = float(numpy.sum((matrix @ x - j)**2))
            if best is None or residual < best[0]:
                best = residual, float(alpha), float(gamma), float(theta)
    return best and best[1:]


def misfit(failure, points):
    """Root mean square of the friction angles [degrees]."""
    return math.sqrt(sum((angle_of_surface(failure, 1e3 * s) - a)**2 for s, a in points) / len(points))


# --- the tests on the bench ---------------------------------------------------------------------------------------------------
checks = material_runs.Checks()
allpoints = [point for points in DATA.values() for point in points]
fits = {name: straight_fit(points) for name, points in DATA.items()}
fits["all twelve"] = straight_fit(allpoints)
written = material_runs.plot_material.entries(SCENE)
checks.add("alpha of triaxial.prm against the fit of all twelve", float(written["Failure alpha"]) / fits["all twelve"][0] - 1, 1e-3)
checks.add("theta of triaxial.prm against the fit of all twelve", float(written["Failure theta"]) / fits["all twelve"][1] - 1, 1e-3)


def settings(grading, confinement, **more):
    alpha, theta = fits[grading]
    return {"Materials/sand/Failure alpha": alpha, "Materials/sand/Failure theta": theta,
            "Test/Confining pressure": 1e3 * confinement, **more}


cases = [(name, s, angle) for name, points in DATA.items() for s, angle in points]
compression = material_runs.together(material_runs.run, [(SCENE, settings(n, s)) for n, s, _ in cases])
extension = material_runs.together(material_runs.run, [(SCENE, settings(n, s, **{"Test/Strains": .05})) for n, s, _ in cases])
rows = []
for (name, s, angle), pressed, pulled in zip(cases, compression, extension):
    alpha, theta = fits[name]
    axial, lateral = -pressed["sigma11"][-1], -pressed["sigma22"][-1]
    computed = friction_angle(axial, lateral)
    checks.add("friction angle of the bench against its surface [degrees]",
               computed - angle_of_surface(lambda I1: alpha + theta * I1, 1e3 * s), 1e-6)
    checks.add("plateau: change of q over the last fifth of the strain", pressed["q"][-1] / pressed["q"][-11] - 1, 1e-6)
    coulomb = 1e3 * s * (1 - math.tan(math.radians(45 - angle / 2))**2)  # q of extension with the measured angle
    growth = -math.log(pressed["density"][-1] / pressed["density"][-11]) / (pressed["eps11"][-11] - pressed["eps11"][-1])
    rows.append({"grains [um]": name, "confinement [kPa]": s, "phi measured [deg]": f"{angle:.2f}", "phi computed [deg]": f"{computed:.2f}",
                 "difference [deg]": f"{computed - angle:+.2f}", "q measured [kPa]": round(at_failure(s, angle)[2]),
                 "q computed [kPa]": round(pressed["q"][-1] / 1e3), "dilation": round(growth, 2),
                 "extension, Mohr-Coulomb q [kPa]": round(coulomb / 1e3), "extension, q computed [kPa]": round(pulled["q"][-1] / 1e3),
                 "ratio": round(pulled["q"][-1] / coulomb, 2), "axial stress in extension [kPa]": round(-pulled["sigma11"][-1] / 1e3)})

# --- what the tests leave open --------------------------------------------------------------------------------------------------
middle = settings("all twelve", 300)
plateau = lambda r: friction_angle(-r["sigma11"][-1], -r["sigma22"][-1])
variants = {"as in triaxial.prm": {}, "K and G three times as large": {"Bulk modulus": 300e6, "Shear modulus": 180e6},
            "D three times as large": {"Hardening rate D": 3e-8}, "W halved": {"Hardening limit W": .15},
            "T halved": {"Tension limit T": 5e3}, "R = 3": {"Cap axis ratio R": 3},
            "X0 doubled": {"Initial cap position X0": 40e6}}
variant_runs = material_runs.together(material_runs.run, [
    (SCENE, dict(middle, **{f"Materials/sand/{k}": v for k, v in change.items()})) for change in variants.values()])
undetermined = [{"change": name, "phi at 300 kPa [deg]": f"{plateau(r):.4f}"} for name, r in zip(variants, variant_runs)]
for r in variant_runs:
    checks.add("plateau without elastic constants and cap [degrees]", plateau(r) - plateau(variant_runs[0]), 1e-6)

positions = [1.5e6, 3e6, 6e6, 8e6, 9e6, 10e6, 11e6, 12e6, 14e6, 17e6, 20e6]
early = material_runs.together(material_runs.run, [
    (SCENE, dict(middle, **{"Materials/sand/Initial cap position X0": X, "Test/Strains": -.6})) for X in positions])
surface, sigma = early[0].surface, 300e3
low, high = 0., 20e6  # the critical state: I1 = M, no change of volume, wherever the cap began
for _ in range(200):
    L = .5 * (low + high)
    X, _, M, b, _ = surface.cap(L)
    low, high = (L, high) if 3 * sigma + math.sqrt(3) * b > M else (low, L)
critical = friction_angle(sigma + math.sqrt(3) * b, sigma)
checks.add("early cap: critical state at I1 = M, closed form [degrees]", plateau(early[0]) - critical, 2e-3)

# --- curvature ------------------------------------------------------------------------------------------------------------------
betas = [10**(-8 + .1 * i) for i in range(31)]
curved = [(beta, fit, misfit(lambda I1: fit[0] - fit[1] * math.exp(-beta * I1) + fit[2] * I1, allpoints))
          for beta in betas for fit in [curved_fit(allpoints, beta)] if fit]
best = min(curved, key=lambda c: c[2])
alpha, theta = fits["all twelve"]
straight = misfit(lambda I1: alpha + theta * I1, allpoints)
strength = lambda fit, beta, p: math.sqrt(3) * (fit[0] - fit[1] * math.exp(-3 * beta * p) + fit[2] * 3 * p)  # q at p
of_beta = lambda beta: (beta, curved_fit(allpoints, beta), None)
curvature = []
for name, (beta, fit, error) in (("straight", (0., (alpha, 0., theta), straight)), ("slightly curved", of_beta(2e-8)),
                                 ("curved", of_beta(5e-8)), ("best", best)):
    error = error or misfit(lambda I1: fit[0] - fit[1] * math.exp(-beta * I1) + fit[2] * I1, allpoints)
    curvature.append({"surface": name, "beta [1/MPa]": 1e6 * beta, "alpha [kPa]": fit[0] / 1e3, "gamma [kPa]": fit[1] / 1e3,
                      "alpha - gamma [kPa]": (fit[0] - fit[1]) / 1e3, "theta": fit[2], "misfit [deg]": f"{error:.3f}",
                      "q at p = 1 MPa [MPa]": strength(fit, beta, 1e6) / 1e6,
                      "q at p = 100 MPa [MPa]": strength(fit, beta, 1e8) / 1e6})
fit_rows = [{"grains [um]": name, "alpha [kPa]": a / 1e3, "theta": t,
             "misfit [deg]": f"{misfit(lambda I1: a + t * I1, DATA.get(name, allpoints)):.2f}"} for name, (a, t) in fits.items()]
cap_rows = [{"X0 [MPa]": X / 1e6, "phi at 300 kPa [deg]": f"{plateau(r):.2f}"} for X, r in zip(positions, early)]

for table in (fit_rows, rows, undetermined, cap_rows, curvature):
    print("\n" + common.markdown_table(table), flush=True)
print(f"critical state {critical:.2f} degrees")
checks.finish()
if not study.write:
    sys.exit()

# --- figure ---------------------------------------------------------------------------------------------------------------------
plt.rcParams["font.size"] = 8
drawing, (plane, angles, stress, caps) = plt.subplots(1, 4, figsize=(14, 3.5), constrained_layout=True)
colours = dict(zip(DATA, ("tab:blue", "tab:orange", "tab:green", "tab:red")))
for name, points in DATA.items():
    xy = [at_failure(s / 1e3, a)[:2] for s, a in points]
    plane.plot(*zip(*xy), "o", color=colours[name], ms=4, label=f"{name} um")
    angles.plot([s for s, _ in points], [a for _, a in points], "o", color=colours[name], ms=4, label=f"{name} um, measured")
    angles.plot([r["confinement [kPa]"] for r in rows if r["grains [um]"] == name],
                [float(r["phi computed [deg]"]) for r in rows if r["grains [um]"] == name], "-", color=colours[name], lw=1)
I1 = [.05 * i for i in range(81)]
plane.plot(I1, [(alpha + theta * 1e6 * x) / 1e6 for x in I1], "k-", lw=1, label="straight, all")
beta, fit, _ = best
plane.plot(I1, [(fit[0] - fit[1] * math.exp(-beta * 1e6 * x) + fit[2] * 1e6 * x) / 1e6 for x in I1], "k--", lw=1, label="curved, all")
for (name, s, _), pressed, pulled in zip(cases, compression, extension):
    if name == "below 800":
        line, = stress.plot([-100 * e for e in pressed["eps11"][50:]], [(b - a) / 1e6 for a, b in zip(
            pressed["sigma11"][50:], pressed["sigma22"][50:])], lw=1.2, label=f"{s} kPa")
        stress.plot([-100 * e for e in pulled["eps11"][50:]], [(b - a) / 1e6 for a, b in zip(
            pulled["sigma11"][50:], pulled["sigma22"][50:])], color=line.get_color(), lw=1.2)
        coulomb = s / 1e3 * (1 - math.tan(math.radians(45 - _ / 2))**2)
        stress.plot([-5, 0], [-coulomb, -coulomb], ":", color=line.get_color(), lw=1)
caps.plot([r["X0 [MPa]"] for r in cap_rows], [float(r["phi at 300 kPa [deg]"]) for r in cap_rows], "ko-", ms=3, lw=1)
caps.axhline(critical, color=".5", ls=":", lw=1)
plane.set(xlabel="I1 [MPa]", ylabel="sqrt J2 [MPa]", title="stresses at failure", xlim=(0, 4), ylim=(0, 1.4))
angles.set(xlabel="confining pressure [kPa]", ylabel="friction angle [deg]", title="points: measured, lines: computed")
stress.set(xlabel="axial strain, compression positive [%]", ylabel="axial - lateral stress [MPa]",
           title="below 800 um; dotted: Mohr-Coulomb in extension")
caps.set(xlabel="X0 [MPa]", ylabel="friction angle at 300 kPa [deg]", title="an early cap hides the failure surface")
for axes in (plane, angles, stress, caps):
    axes.grid(alpha=.3)
for axes in (plane, stress):
    axes.legend(fontsize=7)
material_runs.save(drawing, study.folder / "triaxial.svg")

common.write_csv(study.folder / "results.csv", rows)
common.report(study.name, f"""## STANAG sand in the triaxial cell

Failure surface from twelve drained triaxial tests, Roger (2015), table 1.5: least squares of sqrt(J2) = alpha + theta I1.

{common.markdown_table(fit_rows)}

The same tests on the bench. Columns on the right: extension, where the surface is a circle in the deviatoric plane and the soil
is not.

{common.markdown_table(rows)}

Curvature of the surface, all twelve points: the tests do not tell these surfaces apart, and they differ where an explosion is.

{common.markdown_table(curvature)}

Elastic constants, cap and tension limit leave the plateau alone as long as the cap is far away:

{common.markdown_table(undetermined)}

A cap that begins early hides the failure surface: the test then ends in the critical state of the cap, I1 = M, at {critical:.2f} degrees.

{common.markdown_table(cap_rows)}

![stresses at failure, friction angles, stress against strain, influence of the cap](stanag_triaxial/triaxial.svg)

{checks.table()}""")
