"""What the tests of whole runs share: commands, comment lines of scenes, tables, and how they end."""
import contextlib, csv, math, os, re, shlex, subprocess, sys
from pathlib import Path

UNFRIENDLY = re.compile(r"stack ?trace|backtrace|terminate called|what\(\):|core dumped|An error occurred in line"
                        r"|MPI_ABORT|Segmentation fault|Assertion", re.IGNORECASE)


def command(arguments, ranks):
    """The arguments, under mpirun for more than one rank."""
    mpirun = [os.environ.get("ARENITE_MPIRUN", "mpirun"), "--quiet", "-n", str(ranks)] if ranks > 1 else []
    return mpirun + [str(a) for a in arguments]


def directives(scene):
    """All '# NAME: value' lines of the scene: name -> list of values."""
    found = {}
    for line in Path(scene).read_text(errors="replace").splitlines():
        match = re.match(r"^\s*#\s*([A-Z]{4,}):\s*(.*?)\s*$", line)
        if match:
            found.setdefault(match[1], []).append(match[2])
    return found


@contextlib.contextmanager
def disk(folder, size):
    """A disk of the wanted size inside of the folder, or the folder itself."""
    if not size:
        yield folder
        return
    place = Path(folder) / "disk"
    place.mkdir()
    if subprocess.run(["mount", "-t", "tmpfs", "-o", f"size={size[0]}", "tmpfs", place], stderr=subprocess.DEVNULL).returncode:
        print("skipped: no small disk can be mounted here")
        sys.exit(77)
    try:
        yield place
    finally:
        subprocess.run(["umount", "--lazy", place])


def extra_arguments(wanted, scene):
    """The arguments of the comment lines '# ARGS:'."""
    return [a.replace("{folder}", str(scene.parent)) for line in wanted.get("ARGS", []) for a in shlex.split(line)]


def table(file):
    """Column name -> list of numbers."""
    with open(file, newline="") as stream:
        lines = [[cell.strip() for cell in line] for line in csv.reader(stream) if line and not line[0].startswith("#")]
    numbers = [[float(cell) for cell in line] for line in lines[1:]]
    return {name: [line[i] for line in numbers] for i, name in enumerate(lines[0])}


def difference(a, b):
    """Relative difference of two values or tables, with the place where it is largest."""
    if isinstance(a, dict):
        if a.keys() != b.keys():
            return math.inf, "different columns"
        worst = (0., "")
        for name in a:
            if len(a[name]) != len(b[name]):
                return math.inf, f"{len(a[name])} and {len(b[name])} rows"
            size = max((abs(x) for x in a[name]), default=0.)
            gap = max((abs(x - y) for x, y in zip(a[name], b[name])), default=0.)
            worst = max(worst, (gap / size if size > 0 else (math.inf if gap > 0 else 0.), name))
        return worst
    if isinstance(a, (int, float)) and isinstance(b, (int, float)):
        return (abs(a - b) / max(abs(a), abs(b)) if a != b else 0.), f"{a!r} and {b!r}"
    return (0. if a == b else math.inf), f"{a!r} and {b!r}"


def conclude(found):
    """Print what was found and end the program."""
    print("".join(f"FAILED: {p}\n" for p in found) or "passed\n", end="")
    sys.exit(bool(found))
