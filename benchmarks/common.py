"""What the studies share: run scenes, take medians, write tables, figures and the report.

A study is benchmarks/NAME/study.py, started by `./arenite bench NAME`:

    import sys
    from pathlib import Path
    sys.path.insert(0, str(Path(__file__).resolve().parents[1]))
    import common

    study = common.Study(__file__)                       # reads --quick, --repeat, --no-report
    for degree in (1, 2, 4):
        for refinement in study.choose(range(2, 6), quick=range(2, 4)):
            run = study.run("cavity.prm", {"Element/Degree": degree, "Mesh/Refinement": refinement})
            study.add(f"degree {degree}", run, error=run.errors["array.displacement.E_t"], dofs=run["dofs"])
    study.finish("What was asked, and what was found.")

finish() writes results.csv and error_versus_time.svg next to study.py and the section of the study in benchmarks/REPORT.md.
A measurement is always a pair, error and core-seconds, with ranks, machine and commit. Runs that the launcher did not build
(ARENITE_BINARY not set) are refused, so that nobody measures a stale program.
"""
import argparse, atexit, csv, json, math, os, platform, re, shutil, statistics, subprocess, sys, tempfile
from pathlib import Path

BENCHMARKS = Path(__file__).resolve().parent
REPORT = BENCHMARKS / "REPORT.md"


def stop(message):
    """End with a message for the user; exit code 2 as for every wrong command."""
    print(f"benchmark: {message}", file=sys.stderr)
    sys.exit(2)


try:
    import matplotlib
    matplotlib.use("Agg")
    import matplotlib.pyplot as plt
    plt.rcParams.update({"svg.hashsalt": "arenite", "svg.fonttype": "none", "font.size": 10})  # equal results, equal files
except ImportError:
    stop("the figures need matplotlib (Debian: apt-get install python3-matplotlib)")


# --- runs ---------------------------------------------------------------------------------------------------------------
class Run:
    """Results of one scene: run["dofs"] is an entry of run.json, run.errors[...] an error, run.column(...) a receiver.

    core_seconds is the median over the repetitions, spread the largest deviation from it relative to it; fastest the least of them.
    """

    def __init__(self, repetitions, directory):
        times = [r["core_seconds"] for r in repetitions]
        self.core_seconds = statistics.median(times)
        self.spread = max(abs(t - self.core_seconds) for t in times) / self.core_seconds if self.core_seconds else 0.
        self.fastest = min(times)
        self.repetitions = len(times)
        self.values = dict(repetitions[-1], core_seconds=self.core_seconds)
        for name in ("setup_core_seconds", "output_core_seconds", "mdofs_per_core_second"):
            if all(name in r for r in repetitions):
                self.values[name] = statistics.median(r[name] for r in repetitions)
        self.errors = self.values.get("errors", {})
        self.directory = directory

    def __getitem__(self, name):
        return self.values[name]

    def table(self, file):
        """Column name -> numbers, of a CSV file in the output of the last repetition."""
        with open(self.directory / file, newline="") as stream:
            lines = list(csv.reader(stream))
        return {name.strip(): [float(line[i]) for line in lines[1:] if line] for i, name in enumerate(lines[0])}

    def column(self, file, name):
        return self.table(file)[name]


def binary():
    path = os.environ.get("ARENITE_BINARY")
    if not path or not os.access(path, os.X_OK):
        stop("start studies with './arenite bench NAME', which builds the program first")
    return path


def program(name):
    """Build the program `name` of benchmarks/CMakeLists.txt; returns its path."""
    build = Path(binary()).resolve().parent
    done = subprocess.run(["cmake", "--build", build, "--target", name], capture_output=True, text=True)
    if done.returncode != 0:
        stop(f"the program {name} could not be built:\n" + "\n".join(done.stdout.splitlines()[-20:]))
    return build / "benchmarks" / name


def scratch():
    """A directory that lives as long as this process."""
    if not hasattr(scratch, "path"):
        scratch.path = Path(tempfile.mkdtemp(prefix="arenite-bench-"))
        atexit.register(shutil.rmtree, scratch.path, ignore_errors=True)
        scratch.runs = 0
    scratch.runs += 1
    return scratch.path / f"run-{scratch.runs}"


def command(arguments, ranks):
    """The program with these arguments, under mpirun for more than one rank."""
    call = [binary()] + [str(a) for a in arguments]
    if ranks == 1:
        return call
    more = ["--oversubscribe"] if ranks > physical_cores() else []
    return [shutil.which("mpirun.openmpi") or "mpirun", "--quiet"] + more + ["-n", str(ranks)] + call


def run_scene(scenes, settings=None, ranks=1, repeat=1, timeout=None):
    """Run one scene (a path or a list of paths) with settings {"Section/Entry": value} on `ranks` ranks; returns a Run."""
    scenes = [Path(s) for s in ([scenes] if isinstance(scenes, (str, Path)) else scenes)]
    repetitions = []
    for _ in range(max(1, repeat)):
        out = scratch()
        arguments = ["run", *scenes, "--output", out]
        for name, value in (settings or {}).items():
            arguments += ["--set", f"{name}={value}"]
        environment = dict(os.environ, OMP_NUM_THREADS="1", DEAL_II_NUM_THREADS="1")
        done = subprocess.run(command(arguments, ranks), stdin=subprocess.DEVNULL, capture_output=True, text=True,
                              errors="replace", timeout=timeout, env=environment)
        if done.returncode != 0:
            tail = "\n".join((done.stdout + done.stderr).splitlines()[-15:])
            raise RuntimeError(f"{scenes[0].name} {settings or ''} ended with exit code {done.returncode}:\n{tail}")
        repetitions.append(json.loads((out / "run.json").read_text()))
        directory = out
    return Run(repetitions, directory)


# --- machine ------------------------------------------------------------------------------------------------------------
def physical_cores():
    try:
        lines = subprocess.run(["lscpu", "-p=Core,Socket"], capture_output=True, text=True, check=True).stdout.splitlines()
        return len({line for line in lines if line and not line.startswith("#")})
    except (OSError, subprocess.CalledProcessError):
        return os.cpu_count() or 1


def machine(run=None):
    """Processor, cores, and from the run.json of a run: compiler, deal.II, version and commit."""
    model = platform.processor() or platform.machine()
    try:
        match = re.search(r"^model name\s*:\s*(.*)$", Path("/proc/cpuinfo").read_text(), re.MULTILINE)
        model = match[1] if match else model
    except OSError:
        pass
    facts = {"processor": model, "cores": physical_cores()}
    for name in ("compiler", "deal_ii", "lanes", "version", "commit"):
        if run is not None and name in run.values:
            facts[name] = run[name]
    return facts


def busy():
    """A warning when other programs disturb the clock, else an empty text."""
    load, cores = os.getloadavg()[0], physical_cores()
    return f"The machine was busy (load {load:.1f} on {cores} cores): times are upper bounds." if load > .5 * cores else ""


# --- tables and figures -------------------------------------------------------------------------------------------------
def text(value):
    """Numbers as a reader wants them: three digits, no useless zeros."""
    if isinstance(value, bool) or not isinstance(value, (int, float)):
        return str(value)
    if isinstance(value, int) or not math.isfinite(value):
        return str(value)
    return f"{value:.3g}"


def columns_of(rows):
    return list(dict.fromkeys(name for row in rows for name in row))


def write_csv(path, rows, columns=None):
    columns = columns or columns_of(rows)
    with open(path, "w", newline="") as stream:
        writer = csv.DictWriter(stream, columns, extrasaction="ignore", restval="", lineterminator="\n")
        writer.writeheader()
        writer.writerows(rows)


def markdown_table(rows, columns=None, titles=None):
    """Rows (dictionaries) as a Markdown table; titles: column -> heading."""
    columns = columns or columns_of(rows)
    number = {c: all(isinstance(r.get(c, 0), (int, float)) for r in rows) for c in columns}
    lines = ["| " + " | ".join((titles or {}).get(c, c.replace("_", " ")) for c in columns) + " |",
             "|" + "|".join("---:" if number[c] else "---" for c in columns) + "|"]
    lines += ["| " + " | ".join(text(row.get(c, "")) for c in columns) + " |" for row in rows]
    return "\n".join(lines)


def rate(rows, x, y):
    """Slope of log y over log x between the last two rows: with x = cells per length, minus the order of convergence."""
    a, b = rows[-2:]
    return math.log(b[y] / a[y]) / math.log(b[x] / a[x])


def richardson(values):
    """Order, limit and error bar from the last three of meshes with half the cell size each; doc/theory.md, section 12."""
    f1, f2, f3 = values[-3:]
    ratio = (f1 - f2) / (f2 - f3) if f2 != f3 else math.nan
    order = math.log2(ratio) if ratio > 0 else math.nan
    if .5 < order < 4:
        limit = f3 + (f3 - f2) / (2 ** order - 1)
        return order, limit, 1.25 * abs(limit - f3)
    return "not asymptotic", f3, 3 * abs(f3 - f2)


def figure(path, series, xlabel="core-seconds", ylabel="error", title="", slopes=(), loglog=True, markers=True):
    """One curve per series, {name: [(x, y), ...]}; slopes draws guides of these orders. The suffix of path is the format."""
    drawing, axes = plt.subplots(figsize=(6.4, 4.4))
    for i, (name, points) in enumerate(series.items()):
        points = sorted(points)
        axes.plot([p[0] for p in points], [p[1] for p in points], ("osD^vP*Xdh<>"[i % 12] if markers else "") + "-", label=name, markersize=5,
                  linewidth=1.4)
    if loglog:
        axes.set_xscale("log")
        axes.set_yscale("log")
    points = [p for s in series.values() for p in s]
    if points and loglog:
        left, right = min(p[0] for p in points), max(p[0] for p in points)
        top = max(p[1] for p in points)
        for slope in slopes:
            axes.plot([left, right], [top, top * (right / left) ** slope], "k:", linewidth=.8, label=f"slope {slope:g}")
    axes.set(xlabel=xlabel, ylabel=ylabel, title=title)
    axes.grid(True, which="both", linewidth=.3)
    axes.legend(fontsize=8)
    # No date inside: equal results give equal files.
    drawing.savefig(path, bbox_inches="tight", dpi=120, metadata={"Date": None} if str(path).endswith("svg") else None)
    plt.close(drawing)


def report(name, content, path=REPORT):
    """Put the section of a study into the report, in place of its former text or at the end."""
    begin, end = f"<!-- begin {name} -->", f"<!-- end {name} -->"
    section = f"{begin}\n{content.strip()}\n{end}"
    old = path.read_text() if path.exists() else "# Benchmarks: error and time\n\nWritten by `./arenite bench all`.\n"
    pattern = re.compile(re.escape(begin) + r".*?" + re.escape(end), re.DOTALL)
    new = pattern.sub(lambda _: section, old) if pattern.search(old) else old.rstrip() + f"\n\n{section}\n"
    path.write_text(new)


# --- the usual study ----------------------------------------------------------------------------------------------------
class Study:
    """Options, rows and files of one study; see the example above. Everything can also be done with the functions."""

    def __init__(self, file):
        self.folder = Path(file).resolve().parent
        self.name = self.folder.name
        parser = argparse.ArgumentParser(prog=f"./arenite bench {self.name}")
        parser.add_argument("--quick", action="store_true", help="few coarse cases, one repetition; the report is left alone")
        parser.add_argument("--repeat", type=int, default=3, help="repetitions of every run; times are medians (default 3)")
        parser.add_argument("--no-report", action="store_true", help="print the table only, write no files")
        options = parser.parse_args()
        self.quick = options.quick
        self.repeat = 1 if options.quick else options.repeat
        self.write = not (options.quick or options.no_report)
        self.rows, self.series, self.last, self.disturbed = [], {}, None, busy()
        binary()
        print(f"== {self.name}", flush=True)

    def choose(self, full, quick):
        return list(quick if self.quick else full)

    def run(self, scene, settings=None, ranks=1, repeat=None, timeout=None):
        """run_scene() with scene paths relative to the study."""
        scenes = [self.folder / s for s in ([scene] if isinstance(scene, (str, Path)) else scene)]
        self.last = run_scene(scenes, settings, ranks, repeat or self.repeat, timeout)
        return self.last

    def add(self, series, run, error, **columns):
        """One measured pair: a row of the table and a point of the curve `series`."""
        row = {"series": series, **columns, "ranks": run.values.get("ranks", 1), "error": error,
               "core_seconds": run.core_seconds, "spread": run.spread}
        self.rows.append(row)
        self.series.setdefault(series, []).append((run.core_seconds, error))
        print("  " + ", ".join(f"{name} {text(value)}" for name, value in row.items()), flush=True)
        return row

    def finish(self, words, ylabel="relative error", slopes=(), title=""):
        """Print the table; for a full study also write CSV, figure and report."""
        facts = ", ".join(f"{name.replace('deal_ii', 'deal.II')} {value}" for name, value in machine(self.last).items())
        table = markdown_table(self.rows)
        print("\n" + table + f"\n\n{facts}\n{self.disturbed}", flush=True)
        if not self.write:
            return
        write_csv(self.folder / "results.csv", self.rows)
        figure(self.folder / "error_versus_time.svg", self.series, ylabel=ylabel, slopes=slopes, title=title)
        heading = self.name.replace("_", " ").capitalize()
        report(self.name, f"## {heading}\n\n{words.strip()}\n\n{table}\n\n![error versus core-seconds]"
                          f"({self.name}/error_versus_time.svg)\n\n*{facts}. Times are medians of {self.repeat}.* {self.disturbed}")
