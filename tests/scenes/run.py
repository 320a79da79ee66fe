#!/usr/bin/python3
"""Run a scene and check its results. Usage: run.py <arenite> <scene.prm>

Comment lines of the scene say what must hold:

    # RANKS: 1 2                                     run on each of these numbers of ranks (default 1)
    # CHECK: errors["array.displacement.E_t"] < 1e-2   must be true in every run (Python)
    # SAME: 1e-12 errors["array.displacement.E_t"]     equal in all runs up to this relative difference; a number or text
    # SAME: 1e-6 receivers-array.csv                 the same for a table, column by column relative to its largest value
    # ARGS: --set "End time=1e-3"                    more arguments; {folder} is the folder of the scene
    # EXIT: 0                                        exit code
    # COMMAND: material                              instead of run; the result is result.csv in the output directory
    # COMMAND: check                                 instead of run; there is no output but the screen
    # RESTART: 120 1e-12                             see tests/restart/run.py

CHECK and SAME know: run (the contents of run.json), errors (run["errors"]), log (log.txt as text), column("file.csv",
"name"), rows("file.csv"), out (the output directory), screen (the standard output) and the functions of math. All measured
values are printed.
"""
import json, math, re, subprocess, sys, tempfile
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))
from runs import command, conclude, difference, directives, extra_arguments, table  # noqa: E402


def names(out, screen):
    """What an expression may use."""
    run = json.loads((out / "run.json").read_text()) if (out / "run.json").exists() else {}
    log = (out / "log.txt").read_text() if (out / "log.txt").exists() else ""
    values = {name: getattr(math, name) for name in dir(math) if not name.startswith("_")}
    values.update(run=run, errors=run.get("errors", {}), log=log, out=out, screen=screen, abs=abs, min=min, max=max, re=re,
                  rows=lambda file: len(next(iter(table(out / file).values()))),
                  column=lambda file, name: table(out / file)[name])
    return values


def evaluate(expression, values):
    try:
        return eval(expression, dict(values))
    except Exception as problem:  # an expression may fail in any way; the reader needs to know what was there
        known = ", ".join(values["errors"]) or "none"
        raise SystemExit(f"FAILED: {expression}\n  {type(problem).__name__}: {problem}\n  errors known: {known}\n"
                         f"  entries of run.json: {', '.join(values['run'])}")


def measured(expression, values):
    """The left side of a comparison with its value, for the log."""
    left = re.split(r"\s(?:<=|>=|<|>|==|!=)\s", expression)[0]
    try:
        return f"{left} = {eval(left, dict(values))}"
    except Exception:
        return expression


def main(arenite, scene):
    arenite, scene = Path(arenite).resolve(), Path(scene).resolve()
    wanted = directives(scene)
    unknown = set(wanted) - {"RANKS", "CHECK", "SAME", "ARGS", "EXIT", "COMMAND", "LABEL", "TIMEOUT", "RESTART"}
    if unknown:
        return [f"unknown comment lines: {', '.join(sorted(unknown))}"]
    if not {"CHECK", "SAME"} & set(wanted):
        return ["the scene has no line '# CHECK: <what must hold>'"]
    code = int(wanted.get("EXIT", ["0"])[0])
    found, results = [], []
    with tempfile.TemporaryDirectory(prefix="arenite-") as folder:
        for i, ranks in enumerate(int(r) for r in wanted.get("RANKS", ["1"])[0].split()):
            out = Path(folder) / f"output-{i}"
            subcommand = wanted.get("COMMAND", ["run"])[0]
            result = out / "result.csv" if subcommand == "material" else out
            arguments = [subcommand, scene] + ["--output", result] * (subcommand != "check") + extra_arguments(wanted, scene)
            done = subprocess.run(command([arenite] + arguments, ranks), cwd=folder, stdin=subprocess.DEVNULL,
                                  capture_output=True, text=True, errors="replace")
            print(f"--- {ranks} rank{'s' * (ranks > 1)}")
            if done.returncode != code:
                return [f"exit code is {done.returncode}, must be {code}; last output:\n" +
                        "\n".join((done.stdout + done.stderr).splitlines()[-20:])]
            values = names(out, done.stdout)
            for expression in wanted.get("CHECK", []):
                ok = evaluate(expression, values)
                print(f"{'ok' if ok else 'NO':3} {measured(expression, values)}")
                if not ok:
                    found.append(f"{expression}, {measured(expression, values)}, {ranks} ranks")
            results.append((ranks, values, out))

        ranks_0, values_0, out_0 = results[0]
        for line in wanted.get("SAME", []):
            tolerance, what = line.split(maxsplit=1)
            get = (lambda values, out: table(out / what)) if what.endswith(".csv") else \
                  (lambda values, out: evaluate(what, values))
            for ranks, values, out in results[1:]:
                gap, where = difference(get(values_0, out_0), get(values, out))
                ok = gap <= float(tolerance)
                print(f"{'ok' if ok else 'NO':3} {what}: {ranks_0} and {ranks} ranks differ by {gap:.2e} ({where})")
                if not ok:
                    found.append(f"{what} differs by {gap:.2e} > {tolerance} between {ranks_0} and {ranks} ranks ({where})")
        if "SAME" in wanted and len(results) < 2:
            found.append("'# SAME:' needs two runs: '# RANKS: 1 2'")
    return found


if __name__ == "__main__":
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    conclude(main(sys.argv[1], sys.argv[2]))
