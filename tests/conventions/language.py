#!/usr/bin/python3
"""Check what no compiler checks in the files of the repository. Usage: language.py [repository root]

No paths of somebody's machine, no open ends, no large files, no C++ file so long that nobody dares to touch it.
"""
import os, re, subprocess, sys
from pathlib import Path

MOST_BYTES = 1_000_000
MOST_LINES = 600
LONG_FILES = {}  # "source/io/x.cc": "reason why it is longer than MOST_LINES"
RULES = [
    (re.compile(r"(?<![\w.}~-])/(?:work|root|home|Users)/"), "path of one machine"),
    (re.compile(r"\b(?:TO" r"DO|FIX" r"ME|XX" r"X)\b"), "open end: do it, or describe it in doc/"),
    (re.compile(r"^(?:<{7}|>{7}) "), "merge conflict"),
]
THIS_FILE = "tests/conventions/language.py"


def files(root):
    """Files under version control and new ones, or all files if this is not a clone."""
    git = subprocess.run(["git", "-C", root, "-c", "safe.directory=*", "ls-files", "-z", "--cached", "--others",
                          "--exclude-standard"], capture_output=True, text=True) if (root / ".git").exists() else None
    if git and git.returncode == 0:
        yield from (name for name in git.stdout.split("\0") if name and (root / name).is_file())
        return
    for folder, folders, names in os.walk(root):
        folders[:] = [f for f in folders if not re.match(r"\.git$|build|output$|__pycache__$", f)]
        yield from (str((Path(folder) / name).relative_to(root)) for name in names)


def violations(root):
    for name in sorted(files(root)):
        data = (root / name).read_bytes()
        if len(data) > MOST_BYTES:
            yield f"{name}: {len(data) / 1e6:.1f} MB; files have at most {MOST_BYTES / 1e6:.0f} MB"
        if b"\0" in data or name in (THIS_FILE, "LICENSE"):
            continue
        try:
            lines = data.decode("utf-8").splitlines()
        except UnicodeDecodeError:
            if not name.startswith("tests/errors/"):
                yield f"{name}: not UTF-8"
            continue
        for number, line in enumerate(lines, 1):
            for rule, meaning in RULES:
                if rule.search(line):
                    yield f"{name}:{number}: {meaning}: {line.strip()[:100]}"
        if name.startswith(("include/", "source/")) and len(lines) > MOST_LINES and name not in LONG_FILES:
            yield f"{name}: {len(lines)} lines; split it, or give the reason in LONG_FILES of {THIS_FILE}"


if __name__ == "__main__":
    found = list(violations(Path(sys.argv[1] if len(sys.argv) > 1 else Path(__file__).resolve().parents[2])))
    print("\n".join(found) or "language: ok")
    sys.exit(bool(found))
