#!/usr/bin/python3
"""Damaged checkpoints, changed scenes, signals and limits. Usage: faults.py <arenite> <case> [ranks]

Cases: damage, changes, signals, limits, full_disk. Each message has at most 10 lines and no stack trace.
"""
import json, os, shutil, signal, subprocess, sys, tempfile, time
from pathlib import Path

here = Path(__file__).resolve().parent
sys.path.insert(0, str(here.parent))
from runs import UNFRIENDLY, command, conclude, disk  # noqa: E402
import run as restart  # noqa: E402  (tests/restart/run.py)

SCENE, LINE = here / "column.prm", here / "line.prm"


class Runs:
    def __init__(self, arenite, ranks, folder):
        self.arenite, self.ranks, self.folder, self.found = Path(arenite).resolve(), ranks, folder, []
        self.scenes = [LINE]

    def arguments(self, out, *more):
        return command([self.arenite, *self.run(out, *more)], self.ranks)

    def run(self, out, *more):
        return ["run", SCENE, *self.scenes, "--output", out, *more]

    def expect(self, code, what, out, *more, says=()):
        """A run that must end with this code; what it writes."""
        done = subprocess.run(self.arguments(out, *more), cwd=self.folder, stdin=subprocess.DEVNULL, capture_output=True, text=True,
                              errors="replace", timeout=120)
        self.judge(code, what, done.returncode, done.stdout, done.stderr, says)
        return done.stdout

    def judge(self, code, what, found_code, out, err, says=()):
        print(f"--- {what}: exit code {found_code}\n{err}", end="")
        if found_code != code:
            self.found.append(f"{what}: exit code {found_code} instead of {code}:\n" + "\n".join((out + err).splitlines()[-10:]))
        for text in says:
            if text not in out + err:
                self.found.append(f"{what}: does not say '{text}'")
        if UNFRIENDLY.search(err) or len(err.splitlines()) > 10:
            self.found.append(f"{what}: unfriendly message")

    def same(self, what, whole, resumed):
        self.found += [f"{what}: {text}" for text in restart.compare(whole, resumed, None)]


def checkpoints(out):
    return sorted(out.glob("checkpoint-*"))


def flip_bit(file):
    content = bytearray(file.read_bytes())
    content[len(content) // 2] ^= 8
    file.write_bytes(content)


def damage(runs):
    """What was changed after it was written is not believed; the checkpoint before it serves."""
    whole = runs.folder / "whole"
    runs.expect(0, "whole", whole, "--set", "Output/Checkpoint steps=100")
    number = 0

    def spoilt(what, spoil, code, says):
        nonlocal number
        number += 1
        out = runs.folder / f"spoilt-{number}"
        shutil.copytree(whole, out)
        (out / "run.json").unlink()
        spoil(*checkpoints(out))
        runs.expect(code, what, out, "--set", "Output/Checkpoint steps=100", "--resume", says=says)
        if code == 0:
            runs.same(what, whole, out)
        elif (out / "run.json").exists():
            runs.found.append(f"{what}: writes results")

    def cut(file):
        file.write_bytes(file.read_bytes()[:-100])

    def newer(manifest):
        content = json.loads(manifest.read_text())
        content.update(format=content["format"] + 1, version="99.0")
        manifest.write_text(json.dumps(content))

    spoilt("cut off", lambda old, new: cut(new / "cells-0.bin"), 0, ["bytes instead of", "Resumed    checkpoint-"])
    spoilt("bit flipped", lambda old, new: flip_bit(new / "run.state"), 0, ["checksum"])
    spoilt("from the other checkpoint", lambda old, new: shutil.copy(old / "cells-0.bin", new / "cells-0.bin"), 0, ["cells-0.bin has"])
    spoilt("file missing", lambda old, new: (new / "cells-0.bin").unlink(), 0, ["cells-0.bin is missing"])
    spoilt("manifest is no manifest", lambda old, new: (new / "manifest.json").write_text("{"), 0, ["manifest is damaged"])
    spoilt("manifest missing", lambda old, new: (new / "manifest.json").unlink(), 0, ["no manifest"])
    spoilt("all damaged", lambda old, new: (flip_bit(old / "cells-0.bin"), flip_bit(new / "cells-0.bin")), 5, ["none of the checkpoints can be used"])
    spoilt("newer format", lambda old, new: (newer(old / "manifest.json"), newer(new / "manifest.json")), 5, ["version 99.0"])
    spoilt("table shorter than it was", lambda old, new: (old.parent / "statistics.csv").write_text("t [s]\n"), 4, ["shorter than it was"])
    spoilt("half a checkpoint of a crash", lambda old, new: shutil.copytree(new, new.parent / "checkpoint.new"), 0, ["Resumed"])


def changes(runs):
    """Another scene is refused with what differs; the end may change."""
    out = runs.folder / "out"
    runs.expect(5, "no directory", out, "--resume", says=["there is no checkpoint to resume from"])
    runs.expect(0, "no checkpoints", out)
    runs.expect(5, "results without checkpoints", out, "--resume", says=["no checkpoint to resume from"])
    runs.expect(2, "results are there", out, says=["--overwrite", "--resume"])
    runs.expect(2, "both flags", out, "--overwrite", "--resume", says=["excludes"])
    runs.expect(0, "overwrite", out, "--overwrite", "--set", "Output/Checkpoint steps=100")
    runs.expect(2, "other material", out, "--resume", "--set", "Materials/soil/Density=1900",
                says=["Materials/soil/Density: 1800 in the checkpoint, 1900 now", "'End time'"])
    runs.expect(2, "other mesh", out, "--resume", "--set", "Mesh/Cells=20", "--set", "Element/Degree=2", "--set", "Element/Type=spectral element",
                says=["Mesh/Cells: ", "Element/Degree: "])
    runs.expect(2, "other load", out, "--resume", "--set", "Loads/blast/Amplitude=3e6", says=["Loads/blast/Amplitude"])
    runs.expect(2, "longer, with a line of receivers", out, "--resume", "--set", "End time=8e-3", says=["receivers.h5"])
    runs.scenes = []
    runs.expect(0, "without the line", out, "--overwrite", "--set", "Output/Checkpoint steps=100")
    runs.expect(0, "longer, another title", out, "--resume", "--set", "End time=8e-3", "--set", "Title=Longer")
    run = json.loads((out / "run.json").read_text())
    if run["title"] != "Longer" or abs(run["time"] - 8e-3) > 1e-12:
        runs.found.append("the longer run did not get to its end")
    runs.expect(0, "overwrite again", out, "--overwrite")
    if checkpoints(out):
        runs.found.append("--overwrite leaves checkpoints of another run")


def signals(runs):
    """SIGUSR1: a checkpoint, and on; SIGUSR2, SIGTERM, SIGINT: a checkpoint and exit 75. What was interrupted ends like what was not.

    mpirun forwards USR1 and USR2, but kills its processes one second after SIGTERM and SIGINT: the launcher sends it USR2 instead."""
    slow = ["--set", "Mesh/Cells=800"]
    whole = runs.folder / "whole"
    runs.expect(0, "whole", whole, *slow)

    def until(condition, process, seconds=60):
        start = time.time()
        while not condition() and process.poll() is None and time.time() - start < seconds:
            time.sleep(.02)
        return condition()

    launcher, build = Path(__file__).resolve().parents[2] / "arenite", runs.arenite.parent
    for kind in (signal.SIGUSR1, signal.SIGUSR2, signal.SIGTERM, signal.SIGINT):
        out = runs.folder / kind.name
        command, environment = runs.arguments(out, *slow), os.environ
        if runs.ranks > 1 and kind in (signal.SIGTERM, signal.SIGINT):
            if not (build / "configured").exists():
                print(f"{kind.name}: not tried, the launcher has not made this build")
                continue
            command = [launcher, "-n", runs.ranks, *runs.run(out, *slow)]
            environment = dict(os.environ, ARENITE_BUILD_DIR=str(build), ARENITE_SKIP_PACKAGES="1")
        process = subprocess.Popen([str(part) for part in command], cwd=runs.folder, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
                                   stderr=subprocess.PIPE, text=True, env=environment)
        rows = out / "statistics.csv"
        if not until(lambda: rows.exists() and rows.stat().st_size > 0, process):
            runs.found.append(f"{kind.name}: the run does not begin")
        time.sleep(.1)
        process.send_signal(kind)
        stdout, stderr = process.communicate(timeout=120)
        stops = kind != signal.SIGUSR1
        runs.judge(75 if stops else 0, kind.name, process.returncode, stdout, stderr, ["Checkpoint t = "] + ["Stopped    by a signal"] * stops)
        if stops and (out / "run.json").exists():
            runs.found.append(f"{kind.name}: there is a run.json, though the run is not at its end")
        if stops:
            runs.expect(0, f"after {kind.name}", out, *slow, "--resume", says=["Resumed"])
        runs.same(kind.name, whole, out)


def limits(runs):
    """The wall time and a file STOP end a run with a checkpoint. Limits are parts of the time that a whole run takes on this machine."""
    slow = ["--set", "Mesh/Cells=800"]
    whole, out = runs.folder / "whole", runs.folder / "out"
    runs.expect(0, "whole", whole, *slow)
    seconds = json.loads((whole / "run.json").read_text())["core_seconds"]
    runs.expect(75, "wall time", out, *slow, "--set", f"Output/Largest wall time={.5 * seconds:.3g}", says=["by the largest wall time"])
    (out / "STOP").touch()
    runs.expect(75, "STOP", out, *slow, "--resume", says=["by a file STOP"])
    if (out / "STOP").exists():
        runs.found.append("STOP is still there and would stop the next run")
    runs.expect(0, "the rest", out, *slow, "--resume", says=["Resumed"])
    runs.same("three pieces", whole, out)
    runs.expect(0, "by wall time", runs.folder / "interval", *slow, "--set", f"Output/Checkpoint interval={.2 * seconds:.3g}", says=["Checkpoint t = "])


def full_disk(runs):
    """A full disk ends a run with exit code 4 and the checkpoint before in place, whichever file it is that fills it."""
    slow = ["--set", "Mesh/Cells=800"]
    for size in ("640k", "700k", "720k", "800k"):  # in cells, at their end, at the manifest, at a table
        folder = runs.folder / size
        folder.mkdir()
        with disk(folder, [size]) as place:
            out = place / "output"
            runs.expect(4, size, out, *slow, "--set", "Output/Checkpoint steps=300", says=["cannot be written"])
            if not checkpoints(out):
                runs.found.append(f"{size}: no checkpoint is left")
            if (out / "checkpoint.new").exists():
                runs.found.append(f"{size}: half a checkpoint is left")


if __name__ == "__main__":
    if len(sys.argv) not in (3, 4):
        sys.exit(__doc__)
    with tempfile.TemporaryDirectory(prefix="arenite-") as name:
        all_runs = Runs(sys.argv[1], int((sys.argv[3:] or ["1"])[0]), Path(name))
        {case.__name__: case for case in (damage, changes, signals, limits, full_disk)}[sys.argv[2]](all_runs)
    conclude(all_runs.found)
