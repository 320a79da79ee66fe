#!/usr/bin/python3
"""A run that goes on from a checkpoint must end as if it had not been interrupted. Usage: run.py <arenite> <scene.prm>

A comment line of the scene says how:

    # RESTART: 120 1e-12 2   write a checkpoint after each 120 steps, on 2 ranks (default: the scene's first number); another number of ranks
                             may differ by 1e-12

The scene runs to its end on this number of ranks. Then the newest checkpoint is taken away, and the run goes on from the one before it
on each number of ranks of the scene. On as many ranks as before all tables and the fields of the newest checkpoint must be the same byte by
byte, and so must what run.json says of values and energies; on others they may differ by the number given, relative to the largest value of
the same unit.
"""
import json, shutil, subprocess, sys, tempfile
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))
from runs import command, conclude, difference, directives, extra_arguments, table  # noqa: E402

OF_RUN = ["cells", "dofs", "steps", "time", "energy_error", "impulse_error", "mass_error", "momentum_error", "dissipation", "artificial_dissipation",
          "hourglass_energy", "errors", "values"]


def execute(arguments, ranks, folder):
    done = subprocess.run(command(arguments, ranks), cwd=folder, stdin=subprocess.DEVNULL, capture_output=True, text=True, errors="replace")
    if done.returncode:
        raise SystemExit(f"FAILED: exit code {done.returncode}:\n" + "\n".join((done.stdout + done.stderr).splitlines()[-20:]))
    return done.stdout


def numbers(run):
    """What run.json says of the result, flat."""
    flat = {}
    for name in OF_RUN:
        if isinstance(run[name], dict):
            flat.update({f"{name}.{key}": value for key, value in run[name].items()})
        else:
            flat[name] = run[name]
    return flat


def largest_gap(one, other):
    """Largest difference of two tables relative to the largest value of the same unit: a component that should vanish is round-off."""
    if one.keys() != other.keys() or any(len(one[name]) != len(other[name]) for name in one):
        return float("inf"), "other columns or rows"
    sizes, gaps = {}, []
    for name, values in one.items():
        unit = name[name.find("["):]
        sizes[unit] = max([sizes.get(unit, 0.)] + [abs(x) for x in values])
        gaps.append((max((abs(x - y) for x, y in zip(values, other[name])), default=0.), unit, name))
    return max((gap / sizes[unit] if gap else 0., name) for gap, unit, name in gaps)


def compare(whole, resumed, tolerance):
    """What differs between two directories of results; exactly without a tolerance."""
    found = []
    tables = sorted(file.name for file in whole.glob("*.csv"))
    if tables != sorted(file.name for file in resumed.glob("*.csv")):
        found.append(f"other tables: {tables}")
    for name in tables:
        if (whole / name).read_bytes() == (resumed / name).read_bytes():
            continue
        if (whole / name).read_text().startswith("name"):  # errors, which run.json has as well, and places
            continue
        if tolerance is None:
            found.append(f"{name} is not the same")
        else:
            one, other = table(whole / name), table(resumed / name)
            for ledger in ("imbalance (full body)", "relative energy error", "relative momentum error", "step changes", "adaptation"):  # differences of large numbers
                for column in [c for c in one if c.startswith(ledger)]:
                    one.pop(column), other.pop(column, None)
            gap, where = largest_gap(one, other)
            print(f"    {name}: {gap:.2e} ({where})")
            if gap > tolerance:
                found.append(f"{name} differs by {gap:.2e} > {tolerance} ({where})")
    one, other = (numbers(json.loads((folder / "run.json").read_text())) for folder in (whole, resumed))
    if one.keys() != other.keys():
        found.append(f"run.json has other entries: {sorted(one.keys() ^ other.keys())}")
    for name in one.keys() & other.keys():
        gap, where = difference(one[name], other[name])
        if name.startswith("errors."):  # exact solutions differ in round-off with the times at which they were asked before
            wrong = abs(one[name] - other[name]) > max(1e-12, tolerance or 0.) * max(1., abs(one[name]))
        elif tolerance is None:
            wrong = gap > 0.
        else:  # balances are round-off themselves
            wrong = gap > tolerance and name not in ("energy_error", "impulse_error", "mass_error", "momentum_error")
        if wrong:
            found.append(f"run.json, {name}: {where}")
    return found


def same_fields(whole, resumed):
    """Whether the last checkpoints have the same meshes and fields, to the last bit."""
    return all(file.read_bytes() == (resumed / file.parent.name / file.name).read_bytes() for file in whole.glob("checkpoint-*/cells-*.bin"))


def main(arenite, scene):
    arenite, scene = Path(arenite).resolve(), Path(scene).resolve()
    wanted = directives(scene)
    steps, tolerance, *writers = wanted["RESTART"][0].split()
    ranks = [int(r) for r in wanted.get("RANKS", ["1"])[0].split()]
    written = int(writers[0]) if writers else ranks[0]
    found = []
    with tempfile.TemporaryDirectory(prefix="arenite-") as folder:
        folder = Path(folder)
        whole = folder / "whole"
        arguments = [arenite, "run", scene, "--set", f"Output/Checkpoint steps={steps}"] + extra_arguments(wanted, scene)
        execute(arguments + ["--output", whole], written, folder)
        checkpoints = sorted(whole.glob("checkpoint-*"))
        if len(checkpoints) != 2:
            return [f"the last two checkpoints should be there: {[c.name for c in checkpoints]}"]
        for n in ranks:
            resumed = folder / f"resumed-{n}"
            shutil.copytree(whole, resumed)
            shutil.rmtree(resumed / checkpoints[-1].name)
            (resumed / "run.json").unlink()
            screen = execute(arguments + ["--output", resumed, "--resume"], n, folder)
            print(f"{checkpoints[0].name} on {n} rank{'s' * (n > 1)}")
            if f"Resumed    {checkpoints[0].name}" not in screen:
                found.append("the run does not say from where it goes on")
            found += [f"{n} ranks: {text}" for text in compare(whole, resumed, None if n == written else float(tolerance))]
            if n == written and not same_fields(whole, resumed):
                found.append("the fields of the last checkpoint differ")
    return found


if __name__ == "__main__":
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    conclude(main(sys.argv[1], sys.argv[2]))
