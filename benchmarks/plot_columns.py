#!/usr/bin/python3
"""Draw columns of receivers, statistics and material tests: against time, or one against another.

    plot_columns.py output/cap_cavity_dry/receivers-array.csv -o wall.svg --y "d1r1.displacement*" --scale 1e3 1e3 --xlabel "t [ms]"

    plot_columns.py output/a/receivers-array.csv output/b/receivers-array.csv -o two.svg --y "d1r[35].velocity_r" --names dry wet

    plot_columns.py output/triaxial_specimen/receivers-points.csv -o path.svg --x p2.displacement_z --y p1.stress_zz --scale -1000 -0.001

Columns are named without their units, with the wild cards of the shell. All files get the same ones; more than one file is told apart by its
kind of line. Needs python3-matplotlib.
"""
import argparse, fnmatch, sys
from pathlib import Path
import plot_material
from plot_material import plt


def arguments():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("files", nargs="+", type=Path, help="CSV of a run or of a material test")
    parser.add_argument("-o", "--output", required=True, type=Path, help=".svg, .png or .pdf to write")
    parser.add_argument("--x", help="column (default: the first, which is the time)")
    parser.add_argument("--y", nargs="+", required=True, help="columns, with wild cards")
    parser.add_argument("--scale", nargs=2, type=float, default=(1., 1.), metavar=("X", "Y"), help="factors of the numbers")
    parser.add_argument("--labels", nargs="+", help="names of the columns, in their order (default: those of the file)")
    parser.add_argument("--names", nargs="+", help="names of the files")
    parser.add_argument("--xlabel")
    parser.add_argument("--ylabel")
    parser.add_argument("--xlim", nargs=2, type=float)
    parser.add_argument("--level", type=float, help="a dashed line at this height")
    parser.add_argument("--log", action="store_true", help="logarithms upwards")
    return parser.parse_args()


def main():
    options = arguments()
    plt.rcParams.update({"svg.hashsalt": "arenite", "svg.fonttype": "none", "font.size": 10})
    drawing, axes = plt.subplots(figsize=(6.4, 3.8), constrained_layout=True)
    for file, style, of in zip(options.files, ("-", "--", ":", "-."), options.names or [""] * len(options.files)):
        numbers = plot_material.columns(file)
        full = {plot_material.without_unit(name): name for name in numbers}
        columns = plot_material.table(file)
        x = options.x or next(iter(columns))
        chosen = [name for pattern in options.y for name in columns if fnmatch.fnmatchcase(name, pattern)]
        if x not in columns or not chosen:
            sys.exit(f"{file} has no column '{x}' or none like {' '.join(options.y)}; it has {', '.join(columns)}")
        for i, name in enumerate(chosen):
            label = " ".join(filter(None, ((options.labels or chosen)[i], of)))
            axes.plot([options.scale[0] * v for v in columns[x]], [options.scale[1] * v for v in columns[name]], style, color=f"C{i}", lw=1.3,
                      label=label)
    if options.level is not None:
        axes.axhline(options.level, color="k", lw=.8, ls="--")
    axes.set(xlabel=options.xlabel or full[x], ylabel=options.ylabel or full[chosen[0]])
    if options.log:
        axes.set_yscale("log")
    if options.xlim:
        axes.set_xlim(*options.xlim)
    axes.grid(alpha=.3)
    axes.legend(fontsize=8)
    drawing.savefig(options.output, metadata={"Date": None} if options.output.suffix == ".svg" else None)


if __name__ == "__main__":
    main()
