"""Speed of the whole step for every element, beside what processor and memory allow. See README.md."""
import json, os, subprocess, sys
from pathlib import Path
sys.path.insert(0, str(Path(__file__).resolve().parents[1]))
import common
from common import plt

if os.environ.get("ARENITE_BENCH_QUICK") == "1" and "--quick" not in sys.argv:
    sys.argv.append("--quick")
study = common.Study(__file__)
program = common.program("throughput_benchmark")

# refinement: about 45 000, 300 000 and 2.6 million unknowns
SIZES = {4: "small"} if study.quick else {5: "in L3", 6: "beyond L3"}
REPETITIONS = {4: 3, 5: 9, 6: 3}
PEERS = """| other code, same kind of machine, one core | MDoF/s |
|---|---:|
| OpenRadioss, one-point hexahedra, double precision, 0.8 M unknowns | 2.5 to 3.4 |
| OpenRadioss, 2x2x2 hexahedra | 0.9 to 1.3 |
| LULESH 2.0 (hydrodynamics, one point) | 4 |
| SPECFEM3D 4.1.1, degree 4, single precision, 6.4 M unknowns | 46 |
| CalculiX 2.20, explicit C3D8 | 0.3 |"""


def measure(refinement, ranks):
    """The record of one start of the program: limits of the machine and all elements."""
    file = common.scratch().with_suffix(".json")
    file.parent.mkdir(exist_ok=True)
    call = [str(program), str(study.folder / "throughput.prm"), "--refinement", str(refinement), "--repetitions",
            str(REPETITIONS[refinement]), "--output", str(file)]
    if ranks > 1:
        call = ["mpirun", "--quiet"] + (["--oversubscribe"] if ranks > common.physical_cores() else []) + ["-n", str(ranks)] + call
    run = subprocess.run(call, stdin=subprocess.DEVNULL, capture_output=True, text=True,
                         env=dict(os.environ, OMP_NUM_THREADS="1", DEAL_II_NUM_THREADS="1"))
    if run.returncode != 0:
        raise RuntimeError(f"{' '.join(call)} failed:\n{run.stderr[-2000:]}")
    return json.loads(file.read_text())


def bandwidth(record, megabytes):
    """The triad whose vectors are nearest in size [GB/s per core]."""
    return min(record["bandwidth"], key=lambda b: abs(b["megabytes"] / megabytes - 1) + abs(megabytes / b["megabytes"] - 1))["gb_per_s"]


rows, machine, records = [], [], {}
for refinement, size in SIZES.items():
    for ranks in (1, 2):
        record = records[refinement, ranks] = measure(refinement, ranks)
        machine.append({"unknowns": size, "ranks": ranks, "multiply-add peak [GFlop/s per core]": record["peak_gflops"],
                        **{f"triad {b['megabytes']:g} MB [GB/s per core]": b["gb_per_s"] for b in record["bandwidth"]}})
    for one, two in zip(records[refinement, 1]["cases"], records[refinement, 2]["cases"]):
        record = records[refinement, 1]
        flop_bound = 1e3 * record["peak_gflops"] / one["flops_per_dof"]
        byte_bound = 1e3 * bandwidth(record, one["working_set_mb"]) / one["bytes_per_dof"]
        best = one["overlap"]["best"]
        row = {"element": one["element"], "size": size, "dofs": one["dofs"], "hanging": one["hanging_lines"],
               "best_1": best, "median_1": one["overlap"]["median"], "best_2": two["overlap"]["best"],
               "median_2": two["overlap"]["median"], "best_2_without": two["no_overlap"]["best"],
               "speed_up": 2 * two["overlap"]["best"] / best,
               "saved": 100 * (1 - two["no_overlap"]["best"] / two["overlap"]["best"]),
               "flops": one["flops_per_dof"], "bytes": one["bytes_per_dof"], "gflops": best * one["flops_per_dof"] / 1e3,
               "flop_bound": flop_bound, "byte_bound": byte_bound, "part": 100 * best / min(flop_bound, byte_bound)}
        rows.append(row)
        print("  " + ", ".join(f"{name} {common.text(value)}" for name, value in row.items()), flush=True)

titles = {"best_1": "1 rank, best", "median_1": "median", "best_2": "2 ranks, best", "median_2": "median",
          "best_2_without": "2 ranks without overlap, best", "speed_up": "speed-up", "saved": "saved by overlap [%]",
          "flops": "flop/dof", "bytes": "B/dof", "gflops": "GFlop/s", "flop_bound": "bound of the peak", "byte_bound":
          "bound of the triad", "part": "reached [%]"}
table = common.markdown_table(rows, titles=titles)
limits = common.markdown_table(machine)
print("\n" + table + "\n\n" + limits, flush=True)

if study.write:
    common.write_csv(study.folder / "results.csv", rows)
    drawing, axes = plt.subplots(figsize=(7.2, 4.4))
    names = list(dict.fromkeys(row["element"] for row in rows))
    bars = [(size, ranks) for size in SIZES.values() for ranks in (1, 2)]
    for i, (size, ranks) in enumerate(bars):
        chosen = [row for row in rows if row["size"] == size]
        places = [names.index(row["element"]) + .2 * (i - 1.5) for row in chosen]
        axes.bar(places, [row[f"best_{ranks}"] for row in chosen], .19, label=f"{size}, {ranks} rank{'s' * (ranks > 1)}",
                 color=["#1f6f8b", "#7fb7c9", "#c8553d", "#eab8a9"][i])
        axes.plot(places, [min(row["flop_bound"], row["byte_bound"]) for row in chosen], "k_", markersize=11,
                  label="bound of peak and triad" if i == 0 else None)
    axes.set_xticks(range(len(names)))
    axes.set_xticklabels([name.replace(", ", "\n") for name in names], fontsize=8)
    axes.set_yscale("log")
    axes.set(ylabel="million unknowns per second and core")
    axes.grid(True, axis="y", which="both", linewidth=.3)
    axes.legend(fontsize=8)
    drawing.savefig(study.folder / "throughput.svg", bbox_inches="tight", metadata={"Date": None})
    one = records[max(SIZES), 1]
    facts = ", ".join(f"{name.replace('deal_ii', 'deal.II')} {value}" for name, value in
                      {**common.machine(), **{k: one[k] for k in ("compiler", "deal_ii", "lanes", "version", "commit")}}.items())
    common.report(study.name, f"""## Throughput

Million unknowns per second and core for the whole step (ghosts, hanging nodes, kernel, loads, spherical boundary, work of all
forces, update, ledgers every 50 steps) on a curved octant with hanging nodes. Speed-up is that
of the best. `reached` compares the best of one rank with the
smaller of two bounds: flops counted by running the kernel with a counting number, against the multiply-add peak; bytes that must
move if every entry crosses once per sweep, against the triad on vectors of the same size. `saved by overlap` is the part of the
step on two ranks that disappears when messages travel beside the cells that do not need them (best of repetitions that alternate).

{table}

{limits}

{PEERS}

![million unknowns per second and core](throughput/throughput.svg)

*{facts}. {', '.join(f'{REPETITIONS[r]} repetitions of 50 steps {size}' for r, size in SIZES.items())}.* {study.disturbed}""")
