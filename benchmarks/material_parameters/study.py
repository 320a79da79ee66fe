"""Influence of each parameter of the viscoplastic cap on six tests, slow and fast, with closed forms as checks. See README.md."""
import math, sys
from pathlib import Path
sys.path.insert(0, str(Path(__file__).resolve().parents[1]))
import common, material_runs
from common import plt

study = common.Study(__file__)
ENTRIES = {"alpha": "Failure alpha", "gamma": "Failure gamma", "beta": "Failure beta", "theta": "Failure theta",
           "R": "Cap axis ratio R", "X0": "Initial cap position X0", "D": "Hardening rate D", "W": "Hardening limit W",
           "T": "Tension limit T", "eta": "Fluidity eta", "f0": "Overstress scale f0", "N": "Overstress exponent N",
           "K": "Bulk modulus", "G": "Shear modulus"}
VISCOUS = ("eta", "f0", "N")
SPEEDS = {"slow": {"Materials/soil/Viscosity": "none"}, "fast": {}}  # the rate-independent limit, and 100 1/s
FACTORS = (.6, .8, 1., 1.2, 1.4)
CONFINED = ("triaxial_low", "triaxial_high", "shear")


# --- measures -------------------------------------------------------------------------------------------------------------
def compaction(result, row=-1):
    """Compactive viscoplastic volume strain k of an isotropic test: all strain that is not elastic."""
    return -3 * result["eps11"][row] - result["p"][row] / result.number("Bulk modulus")


def tested(result):
    """First row of the test itself, after the confining pressure."""
    return int(result.number("Rows")) if result.number("Confining pressure") else 0


def swelling(result):
    """Volume strain during the test, positive if the soil grows."""
    return -math.log(result["density"][-1] / result["density"][tested(result)])


def dissipated(result):
    return result["dissipated"][-1] - result["dissipated"][tested(result)]


# test -> measure -> (unit, function)
MEASURES = {
    "isotropic": {"p": ("MPa", lambda r: r["p"][-1] / 1e6), "compaction k": ("%", lambda r: 100 * compaction(r)),
                  "dissipated": ("kJ/m^3", lambda r: dissipated(r) / 1e3)},
    "uniaxial": {"axial stress": ("MPa", lambda r: -r["sigma11"][-1] / 1e6),
                 "lateral / axial": ("-", lambda r: r["sigma22"][-1] / r["sigma11"][-1]),
                 "dissipated": ("kJ/m^3", lambda r: dissipated(r) / 1e3)},
    "triaxial_low": {"peak q": ("kPa", lambda r: max(r["q"]) / 1e3), "volume strain": ("%", lambda r: 100 * swelling(r))},
    "triaxial_high": {"peak q": ("kPa", lambda r: max(r["q"]) / 1e3), "volume strain": ("%", lambda r: 100 * swelling(r))},
    "shear": {"peak shear stress": ("kPa", lambda r: max(r["sigma12"]) / 1e3), "final p": ("kPa", lambda r: r["p"][-1] / 1e3)},
    "tension": {"peak tension": ("kPa", lambda r: -min(r["p"]) / 1e3), "dissipated": ("J/m^3", dissipated)}}


# --- what is known --------------------------------------------------------------------------------------------------------
def pressure_at_rest(result):
    """I1 after a slow isotropic compression to the volume strain ev: with y = 1 + D (X - X0) the positive root of
    y^2/(3 K D) + (X0/(3 K) - 1/(3 K D) + W - ev) y - W = 0."""
    K, X0, D, W = (result.number(ENTRIES[name]) for name in ("K", "X0", "D", "W"))
    a, b, c = 1 / (3 * K * D), X0 / (3 * K) - 1 / (3 * K * D) + W + 3 * result["eps11"][-1], -W
    return X0 + ((-b + math.sqrt(b * b - 4 * a * c)) / (2 * a) - 1) / D


def overstress_of_cap(result, row):
    """(I1 - X)/R against f0 (R k_dot/(3 eta))^(1/N), as a difference relative to I1; k_dot from the neighbouring rows."""
    R, X0, D, W, eta, f0, N = (result.number(ENTRIES[name]) for name in ("R", "X0", "D", "W", "eta", "f0", "N"))
    k, t = [compaction(result, row + i) for i in (-1, 0, 1)], result["time"]
    X = X0 + (1 / (1 - k[1] / W) - 1) / D
    expected = R * f0 * (R * (k[2] - k[0]) / (t[row + 1] - t[row - 1]) / (3 * eta))**(1 / N)
    return (result["I1"][row] - X - expected) / result["I1"][row]


def steady_tension(result):
    """-I1 under a constant rate of volume strain: T + r f0 (rate r/(3 eta))^(1/N)."""
    T, eta, f0, N = (result.number(ENTRIES[name]) for name in ("T", "eta", "f0", "N"))
    r = result.surface.r
    return T + r * f0 * (result.number("Strain rate") * r / (3 * eta))**(1 / N)


def rising_tension(result, row):
    """The same for N = 1 while it rises: -I1 = T + r f, f = (a/c)(1 - exp(-c (t - t0))), a = 3 K rate/r, c = 9 K eta/(r^2 f0)."""
    K, T, eta, f0 = (result.number(ENTRIES[name]) for name in ("K", "T", "eta", "f0"))
    r, rate = result.surface.r, result.number("Strain rate")
    a, c, t = 3 * K * rate / r, 9 * K * eta / (r * r * f0), result["time"][row] - T / (3 * K * rate)
    return T + r * a / c * (1 - math.exp(-c * t)) if t > 0 else 3 * K * rate * result["time"][row]


def check(test, speed, result):
    ledger = (result["work"][-1] - result["stored"][-1] - result["dissipated"][-1] + result["stored by volume change"][-1])
    checks.add(f"work = stored + dissipated, of the work ({speed})", ledger / result["work"][-1], 1e-12)
    if speed == "slow" and test != "tension":
        surface = result.surface
        checks.add("slow tests end on the yield surface, f / strength", result.yield_function()
                   / surface.failure(result["I1"][-1])[0], 1e-12)
    if test == "isotropic" and speed == "slow":
        checks.add("pressure of slow isotropic compression, closed form", result["I1"][-1] / pressure_at_rest(result) - 1, 1e-12)
    if test == "isotropic" and speed == "fast":
        for row in (20, 40, 59):
            checks.add("overstress of fast isotropic compression, of I1", overstress_of_cap(result, row), 1e-4)
    if test == "tension" and speed == "slow":
        checks.add("slow tension stays at the cut-off, p = -T/3", -result["I1"][-1] / result.number(ENTRIES["T"]) - 1, 1e-12)
    if test == "tension" and speed == "fast":
        # 0.1 % of strain are 5 to 100 relaxation times: up to 5e-6 are still missing
        checks.add("steady fast tension, closed form", -result["I1"][-1] / steady_tension(result) - 1, 2e-5)
    if test in ("triaxial_low", "triaxial_high"):
        wanted, start = result.number("Confining pressure"), tested(result)
        checks.add("lateral stress of triaxial tests, of the axial one", max(
            abs(s + wanted) for s in result["sigma22"][start:]) / max(-s for s in result["sigma11"][start:]), 5e-10)


# --- runs -----------------------------------------------------------------------------------------------------------------
def file_of(test):
    return study.folder / f"{test}.prm"


checks = material_runs.Checks()
single = [(test, speed) for test in MEASURES for speed in SPEEDS]
base = dict(zip(single, material_runs.together(material_runs.run, [(file_of(t), SPEEDS[s]) for t, s in single])))
finer = material_runs.together(material_runs.run, [(file_of(t), dict(SPEEDS[s], **{"Test/Steps per row": 40})) for t, s in single])
for (test, speed), fine in zip(single, finer):
    check(test, speed, base[test, speed])
    for name, (unit, measure) in MEASURES[test].items():
        checks.add(f"measures with a quarter of the step ({speed})", measure(fine) / measure(base[test, speed]) - 1, 2e-3)

swept = [] if study.quick else [(t, s, p) for t, s in single for p in ENTRIES if s == "fast" or p not in VISCOUS]
cases = []
for test, speed, parameter in swept:
    value = base[test, speed].number(ENTRIES[parameter])
    cases.append((file_of(test), f"Materials/soil/{ENTRIES[parameter]}", FACTORS[0] * value, FACTORS[-1] * value, len(FACTORS),
                  SPEEDS[speed]))
curves = dict(zip(swept, material_runs.together(material_runs.sweep, cases)))
for (test, speed, parameter), results in curves.items():
    for result in results:
        check(test, speed, result)
linear = material_runs.run(file_of("tension"), {"Materials/soil/Overstress exponent N": 1, "Materials/soil/Fluidity eta": 1,
                                                "Test/Steps per row": 400})
for row in range(1, 61):
    checks.add("rise of fast tension with N = 1, of the steady value", (-linear["I1"][row] - rising_tension(linear, row))
               / -linear["I1"][-1], 1e-3)
checks.finish()

# --- tables ---------------------------------------------------------------------------------------------------------------
rows, tables = [], {"slow": [], "fast": []}
for speed in SPEEDS:
    head = {"parameter": "*value*"}
    for test, measures in MEASURES.items():
        for name, (unit, measure) in measures.items():
            head[f"{test.replace('_', ', ')}: {name} [{unit}]"] = common.text(measure(base[test, speed]))
    tables[speed].append(head)
    for parameter in {} if study.quick else ENTRIES:
        if speed == "slow" and parameter in VISCOUS:
            continue
        line = {"parameter": parameter}
        for test, measures in MEASURES.items():
            for name, (unit, measure) in measures.items():
                values = [measure(result) for result in curves[test, speed, parameter]]
                change = [100 * (v / values[2] - 1) for v in values]
                line[f"{test.replace('_', ', ')}: {name} [{unit}]"] = (
                    "." if max(abs(change[1]), abs(change[3])) < .05 else f"{change[1]:+.1f} / {change[3]:+.1f}")
                rows.append({"speed": speed, "test": test, "measure": name, "unit": unit, "parameter": parameter,
                             **{f"at {f:g}": f"{v:.6g}" for f, v in zip(FACTORS, values)},
                             "change at 0.8 [%]": f"{change[1]:.3f}", "change at 1.2 [%]": f"{change[3]:.3f}"})
        tables[speed].append(line)
    print(f"\n{speed}\n" + common.markdown_table(tables[speed]), flush=True)

# --- figure: each parameter where it matters most ---------------------------------------------------------------------------
PANELS = [("alpha", "triaxial_low", "slow", 1), ("gamma", "triaxial_low", "slow", 1), ("beta", "triaxial_low", "slow", 1),
          ("theta", "triaxial_high", "slow", 20), ("R", "triaxial_high", "slow", 20), ("X0", "shear", "slow", 1.5),
          ("D", "isotropic", "slow", 15), ("W", "isotropic", "slow", 15), ("T", "tension", "slow", .05), ("eta", "shear", "fast", 3),
          ("f0", "shear", "fast", 3), ("N", "shear", "fast", 3), ("K", "isotropic", "slow", 15), ("G", "triaxial_low", "slow", 1)]
AXES = {"isotropic": ("volume strain [%]", "p [MPa]", lambda r: [-300 * e for e in r["eps11"]], lambda r: [p / 1e6 for p in r["p"]]),
        "tension": ("volume strain [%]", "-p [kPa]", lambda r: [300 * e for e in r["eps11"]], lambda r: [-p / 1e3 for p in r["p"]]),
        "uniaxial": ("axial strain [%]", "axial stress [MPa]", lambda r: [-100 * e for e in r["eps11"]],
                     lambda r: [-s / 1e6 for s in r["sigma11"]]),
        "shear": ("gamma [%]", "shear stress [kPa]", lambda r: [200 * e for e in r["eps12"]],
                  lambda r: [s / 1e3 for s in r["sigma12"]])}
AXES["triaxial_low"] = AXES["triaxial_high"] = ("axial strain [%]", "q [kPa]", lambda r: [-100 * e for e in r["eps11"]],
                                                lambda r: [q / 1e3 for q in r["q"]])
if not study.write:
    sys.exit()
plt.rcParams["font.size"] = 8
drawing, grid = plt.subplots(3, 5, figsize=(13, 7.4), constrained_layout=True)
for axes, (parameter, test, speed, last) in zip(grid.flat, PANELS):
    xlabel, ylabel, x, y = AXES[test]
    for index, colour in ((0, "tab:blue"), (2, "black"), (4, "tab:red")):
        result = curves[test, speed, parameter][index]
        start = tested(result)
        axes.plot(x(result)[start:], y(result)[start:], color=colour, lw=1.2)
    axes.set(xlabel=xlabel, ylabel=ylabel, xlim=(0, last), title=f"{parameter}: {test.replace('_', ', ')}, {speed}")
    axes.grid(alpha=.3)
axes = grid.flat[-1]
result = base["uniaxial", "slow"]
surface = result.surface
for junction, style, label in ((surface.junction(surface.X0), "--", "surface at rest"),
                               (base["triaxial_high", "slow"]["cap junction"][-1], "-", "after triaxial, high")):
    axes.plot(*surface.curve(junction, 40), color=".5", ls=style, lw=1, label=label)
for test in ("triaxial_low", "triaxial_high", "shear"):
    r = base[test, "slow"]
    axes.plot([p / 1e6 for p in r["p"]], [q / 1e6 for q in r["q"]], lw=1.2, label=test.replace("_", ", "))
axes.set(xlabel="p [MPa]", ylabel="q [MPa]", title="black in the q-p plane", xlim=(-.1, 2.4), ylim=(0, 1.7))
axes.legend(fontsize=6)
axes.grid(alpha=.3)
drawing.suptitle("blue: parameter x 0.6, black: as in soil.prm, red: x 1.4", fontsize=9)
material_runs.save(drawing, study.folder / "parameters.svg")

common.write_csv(study.folder / "results.csv", rows)
strongest = []
for test, speed, name in (("isotropic", "slow", "p"), ("uniaxial", "fast", "axial stress"), ("triaxial_low", "slow", "peak q"),
                          ("triaxial_high", "slow", "peak q"), ("tension", "fast", "peak tension")):
    line = [r for r in rows if (r["test"], r["speed"], r["measure"]) == (test, speed, name)]
    line.sort(key=lambda r: -max(abs(float(r["change at 0.8 [%]"])), abs(float(r["change at 1.2 [%]"]))))
    strongest.append({"test": f"{test.replace('_', ', ')}, {speed}", "measure": name,
                      "strongest parameters, change of the measure at 0.8 / 1.2 of the parameter [%]": ", ".join(
                          f"{r['parameter']} {float(r['change at 0.8 [%]']):+.0f} / {float(r['change at 1.2 [%]']):+.0f}"
                          for r in line[:4])})
(study.folder / "tables.md").write_text(f"""# Influence of the parameters: all numbers

Written by `./arenite bench material_parameters`. Row *value*: the measure with the soil of soil.prm. Other rows: its change in per
cent when the parameter is 0.8 and 1.2 times as large; a dot is less than 0.05 %. Relative changes of a measure that is nearly zero are
large and say little (volume strain of the fast test "triaxial, low").

## Slow: the rate-independent limit

{common.markdown_table(tables["slow"])}

## Fast: 100 1/s

{common.markdown_table(tables["fast"])}

## Checks

{checks.table()}
""")
common.report(study.name, f"""## Influence of the parameters of the viscoplastic cap

Six tests of one point, slow and at 100 1/s, each parameter between 0.6 and 1.4 of its value;
all numbers in [tables.md](material_parameters/tables.md), their meaning in [doc/material_study.md](../doc/material_study.md).

{common.markdown_table(strongest)}

![each parameter where it matters](material_parameters/parameters.svg)

Closed forms and balances, over all runs; the study stops if one of them is not met:

{checks.table()}""")
