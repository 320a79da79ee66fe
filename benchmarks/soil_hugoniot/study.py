"""Cap with stiffening against the Hugoniot of Sjobo sand and split-bar tests of Mason sand: up to which pressure? See README.md."""
import math, sys
from pathlib import Path
sys.path.insert(0, str(Path(__file__).resolve().parents[1]))
import common, material_runs
from common import plt
import numpy

study = common.Study(__file__)
SAND, BAR = study.folder / "sand.prm", study.folder / "bar.prm"
M = "Materials/sand/"
RHO_0 = 1674.
# Laine & Sandvik (2001): density [kg/m^3], pressure [MPa], particle and shock velocity [m/s]
SHOCKS = ((1739.5, 4.577, 10.15, 269.47), (1873.8, 14.98, 30.89, 289.70), (1997, 29.15, 53.07, 328.12), (2143.8, 59.18, 88.01, 401.63),
          (2250, 98.10, 122.48, 478.45), (2380, 179.4, 178.32, 601.13), (2485, 289.4, 237.55, 727.87), (2585, 450.2, 307.86, 873.56),
          (2671.3, 650.7, 380.94, 1020.35))
CALIBRATED = 5  # rows up to 98 MPa; the others are judged
# dry Mason sand, 400 1/s: engineering strain, axial stress (mean of five), its smallest and largest, radial stress [MPa]
SLEEVE = ((.02, 4.1, 2.7, 4.9, 1.), (.04, 6.4, 5.4, 7.3, 2.), (.06, 9., 8.1, 9.8, 3.3), (.08, 11.2, 10.2, 12., 4.),
          (.1, 14.3, 13., 15.5, 5.1), (.12, 18.4, 16.9, 19.7, 6.5), (.14, 23.7, 21.7, 25.3, 8.), (.16, 30.8, 28.2, 32.9, 9.9),
          (.18, 39.8, 36.8, 42.4, 12.2), (.2, 52.2, 47.4, 56.1, 15.9), (.22, 68.8, 61.7, 74.3, 20.), (.24, 90.9, 81.3, 98.3, 25.1))
LOW_STRAIN = 6  # rows up to 12 %


def settings(values):
    return {M + name: value for name, value in values.items()}


# --- what is compared -------------------------------------------------------------------------------------------------------
def pressures(result):
    """Mean pressure [MPa] at the densities of the shocks."""
    return [float(numpy.interp(row[0], result["density"], result["p"])) / 1e6 for row in SHOCKS]


def shock_velocities(result, strength):
    """Us at the particle velocities of the shocks, from the axial stress or from the pressure alone."""
    stress = [-s for s in result["sigma11"]] if strength else result["p"]
    states = [(math.sqrt(s / (RHO_0 * (1 - RHO_0 / rho))), 1 - RHO_0 / rho)
              for s, rho in zip(stress[1:], result["density"][1:]) if s > 0]
    return [float(numpy.interp(row[2], [Us * c for Us, c in states], [Us for Us, _ in states])) for row in SHOCKS]


def sleeve(result):
    """Axial and radial stress [MPa] at the engineering strains of the bar."""
    strain = [1 - math.exp(e) for e in result["eps11"]]
    return [tuple(float(numpy.interp(row[0], strain, result[s])) / -1e6 for s in ("sigma11", "sigma22")) for row in SLEEVE]


def changes(values, data):
    return [100 * (v / d - 1) for v, d in zip(values, data)]


def fit_shocks(start, fixed, rows):
    def residuals(values):
        result = material_runs.run(SAND, settings({**fixed, **values}))
        return [math.log(p / row[1]) for p, row in list(zip(pressures(result), SHOCKS))[:rows]]
    values = material_runs.fit(residuals, start)
    return values, material_runs.run(SAND, settings({**fixed, **values}))


def fit_sleeve(start, rows):
    def residuals(values):
        return [math.log(s[0] / row[1]) for s, row in list(zip(sleeve(material_runs.run(BAR, settings(values))), SLEEVE))[:rows]]
    values = material_runs.fit(residuals, start)
    return values, material_runs.run(BAR, settings(values))


def valid(data, deviations, limit):
    """The largest datum up to which all deviations are within the limit."""
    last = 0.
    for datum, deviation in zip(data, deviations):
        if abs(deviation) > limit:
            break
        last = datum
    return last


# --- shocks -----------------------------------------------------------------------------------------------------------------
checks = material_runs.Checks()
D, X0, W = "Hardening rate D", "Initial cap position X0", "Hardening limit W"
DRY = {"Soil state/Water content": 0}
written = material_runs.run(SAND)
start = {D: written.number(D), X0: written.number(X0)}
calibrations = {"moist, W = air": (start, {}, CALIBRATED)}
if not study.quick:
    calibrations.update({"dry, W = air": ({D: 2.7e-9, X0: 3e6}, DRY, CALIBRATED),
                         "dry, W fitted, all rows": ({D: 3.3e-9, X0: 3.5e6, W: .41}, DRY, len(SHOCKS)),
                         "moist, R = 4": (start, {"Cap axis ratio R": 4}, CALIBRATED),
                         "moist, K_0 = 400 MPa": (start, {"Bulk modulus": 400e6}, CALIBRATED),
                         "moist, m = 1": (start, {"Stiffening exponent": 1}, CALIBRATED),
                         "moist, half the strength": (start, {"Failure alpha": 65e6, "Failure gamma": 64.95e6}, CALIBRATED)})


def air(result):
    """Volume strain that closes all air: what W is when it is left out."""
    rho, w, G = (result.number(name) for name in ("Density", "Water content", "Specific gravity"))
    return -math.log(rho / (1 + w) * (1 / G + w) / 1000)


shocks, shock_rows = {}, []
for name, (first, fixed, rows) in calibrations.items():
    values, result = fit_shocks(first, fixed, rows)
    shocks[name] = values, result
    deviation = changes(pressures(result), [row[1] for row in SHOCKS])
    shock_rows.append({"sand": name, "D [1/GPa]": 1e9 * values[D], "X0 [MPa]": values[X0] / 1e6, "W": values.get(W, air(result)),
                       "rows fitted": rows, **{f"{row[1]:.3g} MPa": f"{d:+.1f}" for row, d in zip(SHOCKS, deviation)}})
    print(f"  {name}: {values}", flush=True)

values, main = shocks["moist, W = air"]
checks.add("D and X0 of sand.prm against the calibration", max(abs(values[n] / written.number(n) - 1) for n in (D, X0)), 2e-2)
for rho, p, up, Us in SHOCKS:
    checks.add("rows of the data: P = rho_0 Us up", RHO_0 * Us * up / (1e6 * p) - 1, 1e-3)
for Us, s, rho in list(zip(main["Us"], main["sigma11"], main["density"]))[1:]:
    checks.add("Us of the bench against the jump conditions", Us / math.sqrt(-s / (RHO_0 * (1 - RHO_0 / rho))) - 1, 1e-9)
end = main.surface
checks.add("slow loading ends on the yield surface, f / strength", main.yield_function() / end.failure(main["I1"][-1])[0], 1e-9)
for row in (50, 100, 150):  # compaction on the way: X(k) with k from the cap is what the plastic volume strain made of it
    X, k = end.cap(main["cap junction"][row])[0], 0.
    k = air(main) * (1 - 1 / (1 + values[D] * (X - values[X0])))
    elastic = math.log(main["density"][row] / RHO_0) - k
    checks.add("volume strain = compaction + p/K with K_0 < K < K_wg: outside by", max(
        0., main["p"][row] / 11.1e9 - elastic, elastic - main["p"][row] / 200e6), 1e-6)

P, Us = [row[1] for row in SHOCKS], [row[3] for row in SHOCKS]
of_pressure, of_stress = shock_velocities(main, False), shock_velocities(main, True)
rows = [{"density [kg/m^3]": row[0], "P data [MPa]": row[1], "P model [MPa]": p, "P deviation [%]": f"{d:+.1f}", "up [m/s]": row[2],
         "Us data [m/s]": row[3], "Us of P [m/s]": u, "deviation [%]": f"{du:+.1f}", "Us of axial stress [m/s]": a,
         "deviation, axial [%]": f"{da:+.1f}", "used": "fitted" if i < CALIBRATED else "judged"}
        for i, (row, p, d, u, du, a, da) in enumerate(zip(SHOCKS, pressures(main), changes(pressures(main), P), of_pressure,
                                                          changes(of_pressure, Us), of_stress, changes(of_stress, Us)))]
ranges = []
for name, (_, result) in shocks.items():
    p, u, a = (changes(v, d) for v, d in ((pressures(result), P), (shock_velocities(result, False), Us),
                                          (shock_velocities(result, True), Us)))
    ranges.append({"sand": name, **{f"{what} within {limit} % up to [MPa]": valid(P, d, limit)
                                    for what, d in (("P(rho)", p), ("Us(up) of P", u), ("Us(up) of axial stress", a))
                                    for limit in (10, 25)}})

# --- overstress: only the ratio of strain rate and fluidity matters for N = 1 ---------------------------------------------------
def viscous(ratio, eta=1e3):
    return {M + "Viscosity": "Perzyna", M + "Fluidity eta": eta, M + "Overstress scale f0": 1e6, "Test/Strain rate": ratio * eta}


ratios = [.1, 1., 10., 100.]
fast = material_runs.together(material_runs.run, [(SAND, {**settings(values), **viscous(r)}) for r in ratios])
again = material_runs.run(SAND, {**settings(values), **viscous(1., 1e5)})
checks.add("rate and fluidity 100 times as large: the same curve", again["p"][-1] / fast[1]["p"][-1] - 1, 1e-9)
overstress = []
for ratio, result in zip(ratios, fast):
    shift = changes(pressures(result), pressures(main))
    faster = changes(shock_velocities(result, True), of_stress)
    overstress.append({"strain rate / eta": ratio, **{f"P at {P[i]:.3g} MPa [%]": f"{shift[i]:+.2f}" for i in (0, 4, 8)},
                       **{f"Us at up = {SHOCKS[i][2]:.0f} m/s [%]": f"{faster[i]:+.2f}" for i in (0, 4, 8)}})

# --- the sleeve -----------------------------------------------------------------------------------------------------------------
bars = {"W = air, rows up to 12 %": fit_sleeve({D: 5.85e-9, X0: 5.54e6}, LOW_STRAIN)}
if not study.quick:
    bars["W fitted, all rows"] = fit_sleeve({D: 1.3e-8, X0: 4.5e6, W: .36}, len(SLEEVE))
guess = {**values, W: air(main)}
bars["D, X0, W of the Sjobo sand"] = guess, material_runs.run(BAR, settings(guess))
bar_rows = [{"strain [%]": 100 * row[0], "axial stress, mean [MPa]": row[1], "range [MPa]": f"{row[2]} to {row[3]}"} for row in SLEEVE]
bar_fits = []
for name, (found, result) in bars.items():
    axial, radial = zip(*sleeve(result))
    deviation = changes(axial, [row[1] for row in SLEEVE])
    for line, a, d in zip(bar_rows, axial, deviation):
        line[f"{name} [MPa]"], line[f"{name} [%]"] = a, f"{d:+.0f}"
    ratio = [r / a / (row[4] / row[1]) for r, a, row in zip(radial, axial, SLEEVE)]
    bar_fits.append({"calibration": name, "D [1/GPa]": 1e9 * found[D], "X0 [MPa]": found[X0] / 1e6, "W": found.get(W, air(result)),
                     "axial within 10 % up to [MPa]": valid([row[1] for row in SLEEVE], deviation, 10),
                     "radial / axial over that measured": f"{min(ratio):.2f} to {max(ratio):.2f}"})
found, slow = list(bars.values())[-2]
axis_ratios = [.5, 1., 2., 4.]
lateral_runs = material_runs.together(material_runs.run, [(BAR, settings({**found, "Cap axis ratio R": R})) for R in axis_ratios])
lateral_rows = [{"R": R, **{f"at {100 * SLEEVE[i][0]:.0f} %": f"{sleeve(r)[i][1] / sleeve(r)[i][0]:.2f}" for i in (0, 4, 8, 11)}}
                for R, r in zip(axis_ratios, lateral_runs)]
lateral_rows.append({"R": "measured", **{f"at {100 * SLEEVE[i][0]:.0f} %": f"{SLEEVE[i][4] / SLEEVE[i][1]:.2f}" for i in (0, 4, 8, 11)}})
bar_ratios = [.1, .3, 1., 3., 10.]
bar_fast = material_runs.together(material_runs.run, [(BAR, {**settings(found), **viscous(r, 400 / r)}) for r in bar_ratios])
shifts = [max(changes([s[0] for s in sleeve(r)], [s[0] for s in sleeve(slow)])[1:]) for r in bar_fast]
bound = math.exp(float(numpy.interp(math.log(10), [math.log(s) for s in shifts], [math.log(r) for r in bar_ratios])))
rate_rows = [{"strain rate / eta": r, "eta [1/s]": 400 / r, "largest rise of the axial stress from 4 % on [%]": f"{s:.1f}"}
             for r, s in zip(bar_ratios, shifts)]

for table in (shock_rows, rows, ranges, overstress, bar_fits, bar_rows, lateral_rows, rate_rows):
    print("\n" + common.markdown_table(table), flush=True)
print(f"10 % at the ratio {bound:.2f}: eta above {400 / bound:.0f} 1/s with f0 = 1 MPa, N = 1")
checks.finish()
if not study.write:
    sys.exit()

# --- figure and report ----------------------------------------------------------------------------------------------------------
plt.rcParams["font.size"] = 8
drawing, (density, velocity, bar, lateral) = plt.subplots(1, 4, figsize=(14, 3.6), constrained_layout=True)
for name, style in (("moist, W = air", "k-"), ("dry, W = air", "b--"), ("dry, W fitted, all rows", "r:")):
    result = shocks[name][1]
    density.plot(result["density"][2::4], [p / 1e6 for p in result["p"][2::4]], style, lw=1.2, label=name)
density.plot([row[0] for row in SHOCKS], P, "o", color="tab:green", ms=4, label="Laine and Sandvik")
density.set(xlabel="density [kg/m^3]", ylabel="P [MPa]", yscale="log", title="Sjobo sand", ylim=(2, 1000), xlim=(1660, 2720))
for strength, label, style in ((False, "of P", "k-"), (True, "of the axial stress", "k--")):
    stress = [-s for s in main["sigma11"]] if strength else main["p"]
    states = [(math.sqrt(s / (RHO_0 * (1 - RHO_0 / r))), 1 - RHO_0 / r) for s, r in zip(stress[2::4], main["density"][2::4])]
    velocity.plot([U * c for U, c in states], [U for U, _ in states], style, lw=1.2, label=label)
velocity.plot([states[2] for states in SHOCKS], Us, "o", color="tab:green", ms=4, label="Laine and Sandvik")
velocity.set(xlabel="particle velocity [m/s]", ylabel="shock velocity [m/s]", title="shock velocity", xlim=(0, 400), ylim=(0, 1300))
for (name, (_, result)), style in zip(bars.items(), ("k-", "r:", "b--")):
    strain = [100 * (1 - math.exp(e)) for e in result["eps11"]]
    bar.plot(strain, [-s / 1e6 for s in result["sigma11"]], style, lw=1.2, label=name)
    lateral.plot(strain[2:], [b / a for a, b in zip(result["sigma11"][2:], result["sigma22"][2:])], style, lw=1.2, label=name)
bar.errorbar([100 * row[0] for row in SLEEVE], [row[1] for row in SLEEVE], [[row[1] - row[2] for row in SLEEVE],
             [row[3] - row[1] for row in SLEEVE]], fmt="o", color="tab:green", ms=3, lw=1, label="split bar, five tests")
lateral.plot([100 * row[0] for row in SLEEVE], [row[4] / row[1] for row in SLEEVE], "o", color="tab:green", ms=3)
bar.set(xlabel="engineering strain [%]", ylabel="axial stress [MPa]", title="Mason sand, 400 1/s", xlim=(0, 25), ylim=(0, 110))
lateral.set(xlabel="engineering strain [%]", ylabel="radial / axial stress", title="Mason sand, 400 1/s", xlim=(0, 25), ylim=(0, .6))
for axes in (density, velocity, bar):
    axes.legend(fontsize=7)
for axes in (density, velocity, bar, lateral):
    axes.grid(alpha=.3)
material_runs.save(drawing, study.folder / "hugoniot.svg")

common.write_csv(study.folder / "results.csv", rows)
common.report(study.name, f"""## Sand behind a shock: valid range of the cap with stiffening

Sjobo sand, Laine & Sandvik (2001), rows of the moist sand with W from its air; D and X0 fitted to the rows up to 98 MPa.

{common.markdown_table(rows)}

Deviation of P(rho) in per cent, other assumptions fitted alike:

{common.markdown_table(shock_rows)}

{common.markdown_table(ranges)}

Overstress (N = 1, f0 = 1 MPa) against the rate-independent curve:

{common.markdown_table(overstress)}

Dry Mason sand in a steel sleeve, 400 1/s. Deviation of the axial stress:

{common.markdown_table(bar_fits)}

{common.markdown_table(bar_rows)}

Radial over axial stress with other axis ratios of the cap:

{common.markdown_table(lateral_rows)}

Overstress in the sleeve; 10 % are reached at a strain rate of {bound:.2f} eta, eta = {400 / bound:.0f} 1/s:

{common.markdown_table(rate_rows)}

![pressure, shock velocity, split bar, lateral stress](soil_hugoniot/hugoniot.svg)

{checks.table()}""")
