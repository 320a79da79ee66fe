#!/usr/bin/python3
"""Check that the gallery is whole. Usage: gallery.py [repository root]

Every scene of prm/ has a page in doc/gallery, the index names every page, what a page names is there, and every picture is made by a command of a page.
"""
import re, sys
from pathlib import Path

MOST_BYTES = 200_000  # of a picture
COMMAND = re.compile(r"^    (?:\./arenite|benchmarks/)\S*(?: .*)?$", re.MULTILINE)


def violations(root):
    pages, figures = root / "doc" / "gallery", root / "doc" / "figures"
    index = (pages / "README.md").read_text()
    run, drawn = set(), set()
    for page in sorted(pages.glob("*.md")):
        name, text = page.relative_to(root), page.read_text()
        for target in re.findall(r"\]\(([^)#:]+)(?:#[^)]*)?\)", text):
            if not (pages / target).exists():
                yield f"{name}: {target} is not there"
        if page.name == "README.md":
            continue
        words = " ".join(COMMAND.findall(re.sub(r"\\\n\s*", "", text))).split()
        scenes, made = {w for w in words if w.endswith(".prm")}, {w for w in words if w.startswith("doc/figures/")}
        shown = {f"doc/figures/{picture}" for picture in re.findall(r"!\[[^]]*\]\(\.\./figures/([^)]+)\)", text)}
        run |= scenes
        drawn |= made
        if not scenes or not shown:
            yield f"{name}: a page has a scene and a picture"
        if shown != made:
            yield f"{name}: shows {sorted(shown - made)} without a command that draws it, draws {sorted(made - shown)} without showing it"
        yield from (f"{name}: the scene {scene} is not there" for scene in sorted(scenes) if not (root / scene).is_file())
        if f"({page.name})" not in index:
            yield f"doc/gallery/README.md: the page {page.name} is missing"
        if "<!-- measured:begin -->" not in text or "<!-- measured:end -->" not in text:
            yield f"{name}: there is no place for what is measured"
    yield from (f"prm/{scene.name}: no page of doc/gallery runs it" for scene in sorted((root / "prm").glob("*.prm")) if f"prm/{scene.name}" not in run)
    for picture in sorted(figures.iterdir()):
        name = str(picture.relative_to(root))
        if name not in drawn:
            yield f"{name}: no page of doc/gallery draws it"
        if picture.stat().st_size > MOST_BYTES:
            yield f"{name}: {picture.stat().st_size / 1e3:.0f} kB; pictures have at most {MOST_BYTES / 1e3:.0f} kB"


if __name__ == "__main__":
    found = list(violations(Path(sys.argv[1] if len(sys.argv) > 1 else Path(__file__).resolve().parents[2])))
    print("\n".join(found) or "gallery: ok")
    sys.exit(bool(found))
