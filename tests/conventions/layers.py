#!/usr/bin/python3
"""Check that every #include points downwards. Usage: layers.py [repository root]

The table below is the architecture: a folder may include itself and the folders listed for it, nothing else.
"""
import re, sys
from pathlib import Path

MAY_INCLUDE = {
    "base":         [],
    "materials":    ["base"],
    "verification": ["base", "materials"],
    "mesh":         ["base"],
    "mechanics":    ["base", "materials", "mesh"],
    "loads":        ["base", "materials", "verification", "mesh", "mechanics"],
    "time":         ["base", "mechanics", "loads"],
    "statics":      ["base", "mechanics", "loads", "time"],
    "adaptivity":   ["base", "materials", "mesh", "mechanics", "loads", "time"],
    "io":           ["base", "materials", "verification", "mesh", "mechanics", "loads", "time"],
    "simulation":   ["base", "materials", "verification", "mesh", "mechanics", "loads", "time", "statics", "adaptivity", "io"],
}
INCLUDE = re.compile(r'^\s*#\s*include\s*[<"](?:arenite/)?([a-z_]+)/([a-z_0-9]+\.h)[>"]')


def violations(root):
    for top in ("include/arenite", "source"):
        for file in sorted((Path(root) / top).rglob("*.[hc]*")):
            parts = file.relative_to(Path(root) / top).parts
            layer = parts[0] if len(parts) > 1 else "simulation"  # main.cc
            if layer not in MAY_INCLUDE:
                yield f"{file}: folder '{layer}' is not in the table of tests/conventions/layers.py"
                continue
            for number, line in enumerate(file.read_text().splitlines(), 1):
                match = INCLUDE.match(line)
                if match and match[1] in MAY_INCLUDE and match[1] != layer and match[1] not in MAY_INCLUDE[layer]:
                    allowed = ", ".join(MAY_INCLUDE[layer]) or "nothing else"
                    yield (f"{file}:{number}: {layer} includes <arenite/{match[1]}/{match[2]}>; "
                           f"{layer} may include only {allowed}")


if __name__ == "__main__":
    found = list(violations(sys.argv[1] if len(sys.argv) > 1 else Path(__file__).resolve().parents[2]))
    print("\n".join(found) or "layers: ok")
    sys.exit(bool(found))
