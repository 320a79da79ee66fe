#!/usr/bin/python3
"""A wrong scene must end with the right message. Usage: run.py <arenite> <scene.prm>

Comment lines of the scene say what must happen:

    # EXPECT: <regular expression>     found exactly once in the standard error output; may be given several times
    # EXIT: 2                          exit code (default 2)
    # ARGS: check {file}               instead of  run {file} --output {out};  {folder} is the folder of the scene
    # RANKS: 2                         processes (default 1); the message must still come once
    # DISK: 1m                         {out} lies on a disk of this size; skipped where nobody may mount one

Whatever the mistake, the message has at most 10 lines and no stack trace, and comes within 60 s.
"""
import re, shlex, subprocess, sys, tempfile
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))
from runs import UNFRIENDLY, command, conclude, directives, disk  # noqa: E402

MOST_LINES = 10
SECONDS = 60


def problems(arenite, scene):
    scene = Path(scene).resolve()
    wanted = directives(scene)
    unknown = set(wanted) - {"EXPECT", "EXIT", "ARGS", "RANKS", "DISK", "LABEL", "TIMEOUT"}
    if unknown:
        return [f"unknown comment lines: {', '.join(sorted(unknown))}"]
    if "EXPECT" not in wanted:
        return ["the scene has no line '# EXPECT: <regular expression>'"]
    ranks = int(wanted.get("RANKS", ["1"])[0])
    code = int(wanted.get("EXIT", ["2"])[0])
    with tempfile.TemporaryDirectory(prefix="arenite-") as folder, disk(folder, wanted.get("DISK")) as place_of_output:
        places = {"{file}": str(scene), "{out}": f"{place_of_output}/output", "{folder}": str(scene.parent)}
        arguments = shlex.split(wanted.get("ARGS", ["run {file} --output {out}"])[0])
        for place, path in places.items():
            arguments = [a.replace(place, path) for a in arguments]
        try:
            done = subprocess.run(command([arenite] + arguments, ranks), cwd=folder, stdin=subprocess.DEVNULL,
                                  capture_output=True, text=True, errors="replace", timeout=SECONDS)
        except subprocess.TimeoutExpired:
            return [f"no end after {SECONDS} s"]
    print(f"exit code {done.returncode}, standard error output:\n{done.stderr}", end="")

    found = []
    if done.returncode != code:
        found.append(f"exit code is {done.returncode}, must be {code}")
    for expression in wanted["EXPECT"]:
        times = len(re.findall(expression, done.stderr))
        if times != 1:
            found.append(f"standard error output has {times} instead of 1 match of: {expression}")
    if UNFRIENDLY.search(done.stderr):
        found.append(f"standard error output contains '{UNFRIENDLY.search(done.stderr)[0]}'")
    if len(done.stderr.splitlines()) > MOST_LINES:
        found.append(f"the message has {len(done.stderr.splitlines())} lines, at most {MOST_LINES} are readable")
    return found


if __name__ == "__main__":
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    conclude(problems(sys.argv[1], sys.argv[2]))
