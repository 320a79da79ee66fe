"""What the studies of material laws share: runs of `arenite material`, sweeps, yield surfaces, checks that end a study.

    import common, material_runs
    result = material_runs.run(folder / "soil.prm", {"Test/Strain rate": 100})
    result["p"][-1], result.entries["Bulk modulus"], result.surface.failure(3e6)
"""
import concurrent.futures, math, os, re, subprocess, threading
import common, plot_material

lock = threading.Lock()


class Result(dict):
    """Column name without unit -> numbers. entries: all entries of the test by name; surface: that of a viscoplastic cap."""

    def __init__(self, file):
        super().__init__(plot_material.table(file))
        self.entries = plot_material.entries(file.with_name(file.stem + "_used.prm"))

    def number(self, entry):
        return float(self.entries[entry])

    @property
    def surface(self):
        return plot_material.CapSurface(self.entries)

    def yield_function(self, row=-1):
        """f of the present cap in this row [Pa]: zero on the surface."""
        surface, I1, j = self.surface, self["I1"][row], self["sqrt J2"][row]
        X, L, M, b, R = surface.cap(self["cap junction"][row])
        if I1 < 0:
            return math.hypot(j, (I1 - surface.C) / surface.r) - surface.B
        return j - surface.failure(I1)[0] if I1 < L else math.hypot(j, (I1 - M) / R) - b


def call(file, settings, more):
    arguments = ["material", file]
    for entry, value in (settings or {}).items():
        arguments += ["--set", f"{entry}={value}"]
    done = subprocess.run(common.command(arguments + more, 1), stdin=subprocess.DEVNULL, capture_output=True, text=True)
    if done.returncode != 0:
        raise RuntimeError(f"{file.name} {settings or ''} ended with exit code {done.returncode}:\n"
                           + "\n".join((done.stdout + done.stderr).splitlines()[-15:]))


def scratch_file():
    with lock:
        return common.scratch().with_suffix(".csv")


def together(function, cases):
    """[function(*case) for case in cases], several at once: half of a run is the start of the program."""
    with concurrent.futures.ThreadPoolExecutor(2 * (os.cpu_count() or 1)) as pool:
        return [future.result() for future in [pool.submit(function, *case) for case in cases]]


def run(file, settings=None):
    """One test, with settings {"Section/Entry": value}; returns its Result."""
    out = scratch_file()
    call(file, settings, ["--output", out])
    return Result(out)


def sweep(file, entry, first, last, count, settings=None):
    """One test per value of `entry`; returns their Results."""
    out = scratch_file()
    call(file, settings, ["--output", out, "--sweep", f"{entry}={first!r}:{last!r}:{count}"])
    return [Result(out.with_name(f"{out.stem}-{i + 1}.csv")) for i in range(count)]


def save(drawing, path):
    """Write an SVG with two decimals of a point and one name of the font: half the size, the same picture."""
    drawing.savefig(path, metadata={"Date": None})
    common.plt.close(drawing)
    text = re.sub(r"(\.\d\d)\d+", r"\1", path.read_text())
    path.write_text(re.sub(r"'DejaVu Sans'.*?sans-serif", "'DejaVu Sans', sans-serif", text))


def fit(residuals, start, iterations=12):
    """Positive parameters {name: value} that make the sum of squares of residuals({name: value}) smallest: Levenberg and Marquardt in
    their logarithms, derivatives from differences of 2 %. Parameters that the program refuses count as infinitely bad."""
    import numpy

    def attempt(x):
        try:
            return numpy.array(residuals({name: math.exp(v) for name, v in zip(start, x)}))
        except RuntimeError:
            return None

    x = numpy.log(list(start.values()))
    f, damping = attempt(x), 1e-3
    for _ in range(iterations):
        near = [x - .02 * row for row in numpy.eye(len(x))]
        J = numpy.array([(f - g) / .02 for g in together(attempt, [(y,) for y in near])]).T
        step = numpy.clip(numpy.linalg.solve(J.T @ J + damping * numpy.eye(len(x)), -J.T @ f), -1, 1)
        g = attempt(x + step)
        if g is None or g @ g > f @ f:
            damping = max(10 * damping, 1e-2)
            continue
        small, x, f, damping = f @ f - g @ g < 1e-7, x + step, g, damping / 5
        if small:
            break
    return {name: math.exp(v) for name, v in zip(start, x)}


class Checks:
    """Deviations from what is known; a study with one beyond its limit ends before it writes anything."""

    def __init__(self):
        self.rows = {}

    def add(self, name, deviation, limit):
        """Keep the largest relative deviation of this name."""
        row = self.rows.setdefault(name, {"check": name, "cases": 0, "largest deviation": 0., "limit": limit})
        row["cases"] += 1
        row["largest deviation"] = max(row["largest deviation"], abs(deviation) if deviation == deviation else math.inf)

    def table(self):
        return common.markdown_table(list(self.rows.values()))

    def finish(self):
        print("\n" + self.table(), flush=True)
        failed = [name for name, row in self.rows.items() if not row["largest deviation"] <= row["limit"]]
        if failed:
            common.stop("beyond the limit: " + "; ".join(failed))
