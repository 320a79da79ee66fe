#!/usr/bin/python3
"""Make the gallery: run the scenes of the pages in doc/gallery, draw their pictures, and write what was measured into the pages.

    ./arenite gallery                        everything
    ./arenite gallery surface_load ...       these pages only; the index keeps its times

A page is doc/gallery/NAME.md. Its indented lines that begin with ./arenite or benchmarks/ are the commands that make its pictures; they are run as they
stand, one after the other. Paths of the project mean the project, all others (output/...) the folder of the gallery, output/gallery or --folder. Between
<!-- measured:begin --> and <!-- measured:end --> stands what run.json, the table of `converge` and the summary of `material` say.
"""
import argparse, json, re, shlex, subprocess, sys, time
from pathlib import Path
import common

PROJECT = common.BENCHMARKS.parent
PAGES = PROJECT / "doc" / "gallery"
OURS = ("prm/", "benchmarks/", "tests/", "doc/")  # paths in the project
COMMAND = re.compile(r"^    ((?:\./arenite|benchmarks/)\S*(?: .*)?)$", re.MULTILINE)
SHOWN = {"dofs": "unknowns", "steps": "steps", "newton_iterations": "Newton iterations", "energy_error": "energy error", "mass_error": "mass error",
         "setup_core_seconds": "set-up [core-s]", "core_seconds": "time loop [core-s]", "adaptation_core_seconds": "of that changes of the mesh [core-s]",
         "output_core_seconds": "output [core-s]", "peak_memory_mb": "largest memory [MB]"}


def commands(page):
    """The commands of a page as lists of words; a line that ends with a backslash goes on."""
    return [shlex.split(line) for line in COMMAND.findall(re.sub(r"\\\n\s*", "", page))]


def run(words, folder):
    """One command in the folder; returns what it printed."""
    words = [str(PROJECT / word) if word.startswith(OURS) else word for word in words]
    if words[0] == "./arenite":
        words[0] = common.binary()
        if words[1] in ("run", "converge"):
            words.append("--overwrite")
    done = subprocess.run(words, cwd=folder, stdin=subprocess.DEVNULL, capture_output=True, text=True)
    if done.returncode != 0:
        common.stop(f"{shlex.join(words)} ended with exit code {done.returncode}:\n" + "\n".join((done.stdout + done.stderr).splitlines()[-15:]))
    return done.stdout


def of_run(result):
    """Quantity -> number, of a run.json."""
    shown = {f"error {name}": value for name, value in result["errors"].items()}
    return {**shown, **{title: result[name] for name, title in SHOWN.items()
                        if name in result and not (name in ("mass_error", "adaptation_core_seconds") and result[name] == 0)}}


def measured(calls, folder):
    """Run the commands of a page; returns its measured part."""
    runs, texts, last, seconds = {}, [], None, 0.
    for words in calls:
        begin = time.monotonic()
        printed = run(words, folder)
        seconds += time.monotonic() - begin
        if words[0] != "./arenite":
            continue
        scene = Path(next(word for word in words[2:] if word.endswith(".prm")))
        if words[1] == "run":
            place = Path(words[words.index("--output") + 1] if "--output" in words else f"output/{scene.stem}")
            last = json.loads((folder / place / "run.json").read_text())
            runs[place.name] = of_run(last)
        elif words[1] == "converge":
            table = "\n".join(line.rstrip() for line in printed[printed.index("\nConvergence of "):].strip().splitlines()[1:])
            texts.append(f"`{shlex.join(words)}`:\n\n```text\n{table}\n```")
        elif words[1] == "material":
            lines = [line.rstrip() for line in printed.strip().splitlines() if ".csv" not in line]
            rows = next(i for i, line in enumerate(lines) if line.endswith(" rows:"))
            texts.append(f"`{shlex.join(words)}`:\n\n```text\n" + "\n".join(lines[rows:]) + "\n```")
    if runs:
        quantities = list(dict.fromkeys(name for values in runs.values() for name in values))
        texts.insert(0, common.markdown_table([{"": name, **{title: values.get(name, "") for title, values in runs.items()}} for name in quantities]))
    return "\n\n".join(texts), seconds, last


def put(text, part):
    """The text with a new measured part."""
    begin, end = "<!-- measured:begin -->", "<!-- measured:end -->"
    if begin not in text or end not in text:
        common.stop("a page has no measured part")
    return text[:text.index(begin) + len(begin)] + f"\n{part}\n" + text[text.index(end):]


def main():
    pages = sorted(file.stem for file in PAGES.glob("*.md") if file.stem != "README")
    parser = argparse.ArgumentParser(prog="./arenite gallery")
    parser.add_argument("pages", nargs="*", metavar="PAGE", help="all without one: " + " ".join(pages))
    parser.add_argument("--folder", type=Path, default=PROJECT / "output" / "gallery", help="where the scenes are run (default: output/gallery)")
    options = parser.parse_args()
    if unknown := set(options.pages) - set(pages):
        common.stop(f"the gallery has no page '{unknown.pop()}'. Known: {' '.join(pages)}")
    folder = options.folder.resolve()
    (folder / "output").mkdir(parents=True, exist_ok=True)
    rows, disturbed, fact = [], common.busy(), None
    for name in options.pages or pages:
        file = PAGES / f"{name}.md"
        part, seconds, last = measured(commands(file.read_text()), folder)
        file.write_text(put(file.read_text(), part))
        fact = fact or last
        rows.append({"page": name, "wall [s]": round(seconds, 1)})
        print(f"{name}: {seconds:.1f} s", flush=True)
    total = sum(row["wall [s]"] for row in rows)
    print(f"{total:.0f} s, results in {folder}, pictures in doc/figures")
    if not options.pages:
        facts = common.machine()
        facts.update({key: fact[key] for key in ("compiler", "deal_ii", "lanes", "version", "commit")})
        words = ", ".join(f"{key.replace('deal_ii', 'deal.II')} {value}" for key, value in facts.items())
        index = PAGES / "README.md"
        index.write_text(put(index.read_text(), f"All pages took {total:.0f} s, pictures included, one process at a time:\n\n{common.markdown_table(rows)}\n\n"
                                                f"*{words}.* {disturbed}".rstrip()))


if __name__ == "__main__":
    main()
