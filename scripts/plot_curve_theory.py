#!/usr/bin/env python3
"""Draws what bench/curve_theory prints: scripts/plot_curve_theory.py IN.csv OUT.svg

Needs nothing but Python. Left the regular curves, right the benign ones; above
the shares of samples, below the lambda bounds, all against the density.
"""

import csv
import math
import sys

WIDTH, HEIGHT, GAP, LEFT, TOP = 420, 250, 70, 60, 40
COLORS = {
    "circle": "#2c7bb6",
    "ellipse": "#1a9641",
    "wave": "#d7191c",
    "square": "#2c7bb6",
    "drop": "#1a9641",
    "star": "#d7191c",
}
LEAST = 1e-3  # of what is drawn on a logarithmic axis


def read(path):
    curves = {}
    with open(path) as file:
        for row in csv.DictReader(file):
            name = row.pop("curve")
            curves.setdefault(name, []).append({k: float(v) for k, v in row.items()})
    return curves


class Panel:
    def __init__(self, column, line, title, low, high, log):
        self.x = LEFT + column * (WIDTH + GAP)
        self.y = TOP + line * (HEIGHT + GAP)
        self.low, self.high, self.log = low, high, log
        self.out = [
            f'<rect x="{self.x}" y="{self.y}" width="{WIDTH}" height="{HEIGHT}" '
            'fill="none" stroke="#999"/>',
            f'<text x="{self.x}" y="{self.y - 8}">{title}</text>',
        ]
        for n in (10, 100, 1000):
            self.tick(self.across(n), HEIGHT, str(n), 0, 16)
        for value in (0.001, 0.01, 0.1, 1) if log else (0, 0.25, 0.5, 0.75, 1):
            self.tick(0, self.down(value), f"{value:g}", -28, 4)

    def across(self, points):
        return WIDTH * math.log(points / 10) / math.log(200)

    def down(self, value):
        if self.log:
            value = math.log(max(value, self.low) / self.low)
            return HEIGHT * (1 - value / math.log(self.high / self.low))
        return HEIGHT * (1 - (value - self.low) / (self.high - self.low))

    def tick(self, x, y, text, dx, dy):
        self.out.append(
            f'<text x="{self.x + x + dx:.1f}" y="{self.y + y + dy:.1f}" '
            f'fill="#555">{text}</text>'
        )

    def curve(self, rows, key, color, dash):
        points = " ".join(
            f"{self.x + self.across(r['points']):.1f},{self.y + self.down(r[key]):.1f}"
            for r in rows
        )
        self.out.append(
            f'<polyline points="{points}" fill="none" stroke="{color}" '
            f'stroke-width="2" stroke-dasharray="{dash}"/>'
        )


def legend(column, names):
    x, y = LEFT + column * (WIDTH + GAP), TOP + 2 * HEIGHT + GAP + 40
    out = []
    for i, name in enumerate(names):
        out.append(
            f'<text x="{x + 80 * i}" y="{y}" fill="{COLORS[name]}">{name}</text>'
        )
    return out


def main(source, target):
    curves = read(source)
    out = []
    for column, (kind, names) in enumerate(
        (
            ("regular", ("circle", "ellipse", "wave")),
            ("benign", ("square", "drop", "star")),
        )
    ):
        shares = Panel(
            column, 0, f"{kind}: samples exact (line), true edges Delaunay (dashes)",
            -0.05, 1.05, False,
        )
        bounds = Panel(
            column, 1,
            "right: most lower (line); wrong: least max(lower, 1 - upper) (dashes)",
            LEAST, 1, True,
        )
        for name in names:
            rows = curves[name]
            shares.curve(rows, "exact", COLORS[name], "")
            shares.curve(rows, "delaunay", COLORS[name], "2 4")
            bounds.curve(rows, "lower", COLORS[name], "")
            bounds.curve(rows, "wrong", COLORS[name], "6 4")
        out += shares.out + bounds.out + legend(column, names)
    width, height = LEFT + 2 * (WIDTH + GAP), TOP + 2 * HEIGHT + GAP + 60
    with open(target, "w") as file:
        file.write(
            f'<svg xmlns="http://www.w3.org/2000/svg" width="{width}" '
            f'height="{height}" font-family="sans-serif" font-size="11">\n'
            f'<rect width="{width}" height="{height}" fill="white"/>\n'
        )
        file.write("\n".join(out) + "\n</svg>\n")


if __name__ == "__main__":
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    main(*sys.argv[1:])
