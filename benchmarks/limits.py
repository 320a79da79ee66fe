"""Runs that may fail, and the largest step with which a scene keeps its error.

    tried  = Attempt(study, "spall.prm", settings)           # tried.code, tried.run or None, tried.said
    row    = limits_of(study, "spall.prm", settings, error, tried.run)    # error(run) is relative
    search = Search(study, "spall.prm", settings, error, 0.02, COURANT, 1., [.9, 1.1, 1.3, 1.6, 2.])   # search.good, search.beyond
"""
import math, re, subprocess
import common
import numpy

COURANT, FIXED = "Time stepping/Courant number", "Time stepping/Fixed step"
REASONS = ("inverted", "a value is not a number", "the state is not a number", "the energy balance is off", "the strain energy grew", "the energy grew")


def series(run, name, file="receivers-points.csv"):
    """A column; the table is read once."""
    tables = run.__dict__.setdefault("tables", {})
    if file not in tables:
        tables[file] = {column: numpy.array(values) for column, values in run.table(file).items()}
    return tables[file][name]


class Attempt:
    """A run, or how it ended. said: the reason that the program gave; a run of exit code 0 with a number that is none says so, too."""

    def __init__(self, study, scene, settings, receivers="receivers-points.csv"):
        self.code, self.run, self.said, self.message = 0, None, "", ""
        try:
            self.run = study.run(scene, settings, repeat=1, timeout=600)
            series(self.run, "t [s]", receivers), series(self.run, "t [s]", "statistics.csv")
            if not all(numpy.isfinite(values).all() for table in self.run.tables.values() for values in table.values()):
                self.said = "exit code 0 with values that are not finite"
        except subprocess.TimeoutExpired:
            self.code, self.said = -1, "no end within 600 s"
        except RuntimeError as problem:
            self.code, self.message = int(re.search(r"exit code (-?\d+)", str(problem))[1]), str(problem)
            self.said = next((reason for reason in REASONS if reason in self.message), self.message.splitlines()[-1])

    @property
    def good(self):
        return self.run is not None and not self.said


class Search:
    """The largest factor of an entry, from the first of `factors` on, with which the error is at most `allowed`. good: that factor, energy: the energy
    error there; beyond: what happens at most 3 % above it, exit code first, and up to where a wrong result goes unnoticed. words(run) names the error."""

    def __init__(self, study, scene, settings, error, allowed, entry, unit, factors, words=None, receivers="receivers-points.csv"):
        name = words or (lambda run: f"error {common.text(abs(error(run)))}")

        def judge(factor):
            tried = Attempt(study, scene, {**settings, entry: f"{factor * unit:.9g}"}, receivers)
            if not tried.good:
                return False, f"{tried.code}: {tried.said}"
            found = abs(error(tried.run))
            if found <= allowed:
                self.energy = tried.run["energy_error"]
            return found <= allowed, f"0: {name(tried.run)}"  # not so for NaN

        self.good, self.energy, self.beyond, bad = None, math.nan, "", None
        for factor in factors:
            fine, verdict = judge(factor)
            if not fine:
                bad, self.beyond = factor, verdict
                break
            self.good = factor
        while self.good and bad and bad > 1.03 * self.good:
            middle = math.sqrt(self.good * bad)
            fine, verdict = judge(middle)
            if fine:
                self.good = middle
            else:
                bad, self.beyond = middle, verdict
        if self.beyond.startswith("0:"):  # wrong without a word up to where?
            for k in range(1, 20):
                factor = min(bad * 1.15 ** k, factors[-1])
                if factor == bad:
                    break
                fine, verdict = judge(factor)
                if not verdict.startswith("0:"):
                    self.beyond += f"; from {common.text(factor)} {verdict}"
                    break
                if factor == factors[-1]:
                    self.beyond += f", no alarm up to {common.text(factor)}"
                    break


def limits_of(study, scene, settings, error, run):
    """Columns: the largest good Courant number, and the largest good fixed step over the smallest stable step of the automatic run."""
    usual = abs(error(run))
    allowed = 1.1 * usual + .01
    dt = series(run, "dt [s]", "statistics.csv")
    start = int(numpy.argmax(dt[1:] < 1.05 * dt[:-1]))  # the first step is short, the next ones grow by a tenth
    smallest = float(dt[start:].min()) / .9
    courant = Search(study, scene, settings, error, allowed, COURANT, 1., [.9, 1.1, 1.3, 1.6, 2.])
    fixed = Search(study, scene, settings, error, allowed, FIXED, smallest, [.5, .7, 1., 1.4, 2., 2.8, 4., 5.6, 8.])
    return {"Courant number": courant.good, "energy error": courant.energy, "beyond": courant.beyond,
            "fixed step/limit": fixed.good, "energy error ": fixed.energy, "beyond it": fixed.beyond}
