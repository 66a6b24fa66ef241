#!/usr/bin/env python3
"""Draws what build/release/bin/criteria has written.

    scripts/plot_criteria.py RUN.csv OUT.png

A row is a criterion, choice of umbrellas or method, a column a data set. The
colour says whether the closed surface has the true topology; the number is its
Hausdorff distance to the true surface, in thousandths of the size of the shape.
Needs matplotlib (Debian: python3-matplotlib).
"""

import csv
import sys

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
from matplotlib.colors import ListedColormap
from matplotlib.patches import Patch

OUTCOMES = ["not closed", "closed, not true", "true topology"]
COLORS = ["#d98880", "#f4d58d", "#a3c9a8"]


def outcome(row):
    if row["closed"] == "0":
        return 0
    return 2 if row["right"] == "1" else 1


def read(path):
    """Rows by (method, set), and both in the order of the file."""
    cells, methods, sets = {}, [], []
    with open(path, newline="") as file:
        for row in csv.DictReader(file):
            noise = "" if row["noise"] == "0" else ", noise " + row["noise"]
            data = row["shape"] + " " + row["points"] + noise
            if row["method"] not in methods:
                methods.append(row["method"])
            if data not in sets:
                sets.append(data)
            cells[row["method"], data] = row
    return cells, methods, sets


def draw(cells, methods, sets, out):
    values = [[outcome(cells[m, d]) for d in sets] for m in methods]
    figure, axes = plt.subplots(
        figsize=(1.5 + 0.42 * len(sets), 2.2 + 0.3 * len(methods))
    )
    axes.imshow(values, cmap=ListedColormap(COLORS), vmin=0, vmax=2, aspect="auto")
    for i, method in enumerate(methods):
        for k, data in enumerate(sets):
            far = float(cells[method, data]["hausdorff"])
            text = "%.0f" % far if far >= 9.5 else "%.1f" % far
            axes.text(k, i, text, ha="center", va="center", fontsize=6)
    axes.set_xticks(range(len(sets)), sets, rotation=90, fontsize=7)
    axes.set_yticks(range(len(methods)), methods, fontsize=7)
    axes.set_title(
        "After clean-up and closing: topology, and Hausdorff distance "
        "in thousandths of the size",
        fontsize=9,
    )
    axes.legend(
        [Patch(color=c) for c in COLORS],
        OUTCOMES,
        loc="upper center",
        bbox_to_anchor=(0.5, -0.33),
        ncols=3,
        frameon=False,
        fontsize=8,
    )
    figure.savefig(out, dpi=130, bbox_inches="tight")


def main():
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    cells, methods, sets = read(sys.argv[1])
    draw(cells, methods, sets, sys.argv[2])


if __name__ == "__main__":
    main()
