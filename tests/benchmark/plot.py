"""plot.py BENCHMARK.json PLOT.svg: time and memory a vertex against the size of the mesh, if the scaling
suite ran."""

import json
import sys

import matplotlib

matplotlib.use("svg")
matplotlib.rcParams["svg.hashsalt"] = "morsel"  # the same file from the same numbers
import matplotlib.pyplot as plt  # noqa: E402


def main(source, target):
    with open(source, encoding="utf-8") as file:
        rows = json.load(file)["suites"].get("scaling")
    if not rows:
        return
    steps = list(dict.fromkeys(row["step"] for row in rows))
    figure, (time, memory) = plt.subplots(1, 2, figsize=(11, 4.2), constrained_layout=True)
    markers = "osv^D<>Ph*X"
    for marker, step in zip(markers, steps):
        chosen = [row for row in rows if row["step"] == step]
        sizes = [row["vertices"] for row in chosen]
        style = {"marker": marker, "markersize": 4, "linewidth": 1.2, "label": step}
        time.plot(sizes, [row["ns_per_vertex"] for row in chosen], **style)
        memory.plot(sizes, [row["peak_bytes"] / row["vertices"] for row in chosen], **style)
    for axes, title in ((time, "nanoseconds a vertex"), (memory, "bytes a vertex, at peak")):
        axes.set_xscale("log")
        axes.set_yscale("log")
        axes.set_xlabel("vertices")
        axes.set_title(title, fontsize=10)
        axes.grid(True, which="major", color="0.9")
        axes.spines[["top", "right"]].set_visible(False)
    memory.legend(fontsize=8, frameon=False, bbox_to_anchor=(1.02, 1), loc="upper left")
    figure.savefig(target, metadata={"Date": None})


if __name__ == "__main__":
    main(*sys.argv[1:])
