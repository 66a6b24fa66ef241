#!/usr/bin/env python3
"""Reconstructs point sets that are hard to close, and tables what comes out.

    scripts/hard_inputs.py UMBRELLA [-n N]... [--family NAME]... [--keep DIR]
    scripts/hard_inputs.py build/release/bin/umbrella -n 1000 -n 30000

Most of these are no sample of any surface: volumes, layers a spacing apart,
curves. What counts is that each closes, through as many of its points as it
can, and how long that takes: "seconds" is processor time of the whole run, and
"us" that by the point. The points of a family depend on its name and N alone.
"""

import argparse
import math
import pathlib
import random
import sys
import tempfile

from timed_reconstruct import reconstruct

FAMILIES = {}


def family(make):
    FAMILIES[make.__name__.replace("_", "-")] = make
    return make


def families(**values):
    """One for each value of the last argument, by name."""
    def add(make):
        for name, value in values.items():
            FAMILIES[name.replace("_", "-")] = (
                lambda rng, n, value=value: make(rng, n, value))
        return make
    return add


def on_sphere(rng, radius=1.0, centre=(0, 0, 0)):
    """Uniform on a sphere."""
    v = [rng.gauss(0, 1) for _ in range(3)]
    scale = radius / math.sqrt(sum(x * x for x in v))
    return tuple(c + scale * x for c, x in zip(centre, v))


def lattice(side):
    return [(x, y, z) for x in range(side) for y in range(side)
            for z in range(side)]


def sheet(rng, n, height, noise=0.0):
    """Jittered grid over the unit square, so many points, a height apart."""
    side = math.isqrt(n)
    return [((x + rng.uniform(-0.3, 0.3)) / side,
             (y + rng.uniform(-0.3, 0.3)) / side,
             height + noise * rng.uniform(-1, 1) / side)
            for x in range(side) for y in range(side)]


@families(sphere_noise_1=0.01, sphere_noise_3=0.03, sphere_noise_10=0.1)
def noisy_sphere(rng, n, noise):
    return [on_sphere(rng, 1 + noise * rng.gauss(0, 1)) for _ in range(n)]


@families(two_sheets_03=0.3, two_sheets_05=0.5, two_sheets_10=1)
def two_sheets(rng, n, spacings):
    side = math.isqrt(n // 2)
    return sheet(rng, n // 2, 0) + sheet(rng, n // 2, spacings / side)


@family
def cube(rng, n):
    return [tuple(rng.random() for _ in range(3)) for _ in range(n)]


@family
def ball(rng, n):
    return [on_sphere(rng, rng.random() ** (1 / 3)) for _ in range(n)]


@family
def cubic_lattice(_, n):
    return lattice(math.ceil(n ** (1 / 3)))[:n]


@family
def jittered_lattice(rng, n):
    return [tuple(x + rng.uniform(-0.2, 0.2) for x in p)
            for p in lattice(math.ceil(n ** (1 / 3)))[:n]]


@family
def bcc_lattice(_, n):
    points = lattice(math.ceil((n / 2) ** (1 / 3)))
    return [(2 * x + i, 2 * y + i, 2 * z + i)
            for x, y, z in points for i in (0, 1)][:n]


@family
def fcc_lattice(_, n):
    points = lattice(math.ceil((2 * n) ** (1 / 3)))
    return [p for p in points if sum(p) % 2 == 0][:n]


@family
def noisy_layers(rng, n):
    side = math.isqrt(n // 5)
    return [p for i in range(5)
            for p in sheet(rng, n // 5, 2 * i / side, noise=1)]


@family
def crossing_planes(rng, n):
    flat = sheet(rng, n // 3, 0)
    return ([(x, y, z + 0.4831) for x, y, z in flat] +
            [(x, z + 0.5117, y) for x, y, z in sheet(rng, n // 3, 0)] +
            [(z + 0.4973, x, y) for x, y, z in sheet(rng, n // 3, 0)])


@family
def segments(rng, n):
    points = []
    while len(points) < n:
        a, b = ([rng.random() for _ in range(3)] for _ in range(2))
        for _ in range(min(50, n - len(points))):
            t = rng.random()
            points.append(tuple(x + t * (y - x) for x, y in zip(a, b)))
    return points


@family
def space_curve(rng, n):
    turns = [2 * math.pi * i / (n - 10) for i in range(n - 10)]
    knot = [((2 + math.cos(3 * t)) * math.cos(2 * t),
             (2 + math.cos(3 * t)) * math.sin(2 * t),
             math.sin(3 * t)) for t in turns]
    return knot + [tuple(rng.uniform(-3, 3) for _ in range(3))
                   for _ in range(10)]


@family
def clusters(rng, n):
    centres = [(rng.random(), rng.random(), rng.random(),
                10 ** rng.uniform(-3, -1)) for _ in range(20)]
    points = []
    for _ in range(n):
        *centre, width = rng.choice(centres)
        points.append(tuple(c + width * rng.gauss(0, 1) for c in centre))
    return points


@families(balls_of_100=100, balls_of_1000=1000)
def far_balls(rng, n, size):
    """Balls full of so many points each, apart on a lattice."""
    return [tuple(5 * c + x for c, x in zip(
                ((i // size) % 10, (i // size) // 10 % 10, i // size // 100),
                on_sphere(rng, rng.random() ** (1 / 3)))) for i in range(n)]


@families(warts_of_60=60, warts_of_1000=1000)
def sphere_with_balls(rng, n, size):
    """A fifth of the points in balls of so many, centred on a unit sphere."""
    radius = math.sqrt(size / n)
    points = []
    for i in range(n - n // 5):
        p = on_sphere(rng)
        points.append(p)
        if i % (4 * size) == 0:
            points += [on_sphere(rng, radius * rng.random() ** (1 / 3), p)
                       for _ in range(size)]
    return points


@family
def nested_spheres(rng, n):
    spacing = math.sqrt(8 * math.pi / n)
    return ([on_sphere(rng) for _ in range(n // 2)] +
            [on_sphere(rng, 1 - spacing) for _ in range(n // 2)])


@family
def thin_plate(rng, n):
    side = math.isqrt(n // 2)
    rim = [(x / side, y / side, 0.5 / side) for i in range(side)
           for x, y in ((i, 0), (i, side), (0, i), (side, i))]
    return sheet(rng, n // 2, 0) + sheet(rng, n // 2, 1 / side) + rim


@family
def wild_density(rng, n):
    return [on_sphere(rng, 10 ** rng.uniform(-6, 0)) for _ in range(n)]


@family
def few_spheres(rng, n):
    centres = [tuple(rng.random() for _ in range(3)) for _ in range(5)]
    return [on_sphere(rng, 0.4, rng.choice(centres)) for _ in range(n)]


@family
def hairbrush(rng, n):
    side = max(2, math.isqrt(n // 40))
    points = sheet(rng, side * side, 0)
    for x in range(side):
        for y in range(side):
            points += [(x / side, y / side, (i + 1) / 40) for i in range(39)]
    return points[:n]


def write_points(name, n, path):
    rng = random.Random(f"{name} {n}")
    with open(path, "w", encoding="ascii") as out:
        for p in FAMILIES[name](rng, n):
            out.write("%.17g %.17g %.17g\n" % p)


def row_of(name, n, report, seconds):
    if report is None:
        return [name, str(n), "none"] + [""] * 6
    surface = report["surface"]
    is_sound = surface["closed"] and surface["manifold"]
    points = report["input"]["points"] - report["input"]["duplicates"]
    return [name, str(points), "yes" if is_sound else "NO",
            str(len(surface["unused_points"])), str(surface["components"]),
            str(surface["genus"]), str(report["closing"]["conflicts"]),
            f"{seconds:.2f}", f"{1e6 * seconds / points:.0f}"]


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("umbrella")
    parser.add_argument("-n", type=int, action="append")
    parser.add_argument("--family", action="append", choices=FAMILIES)
    parser.add_argument("--timeout", type=float, default=150)
    parser.add_argument("--keep", type=pathlib.Path,
                        help="folder for the points and reports")
    parser.add_argument("--option", action="append", default=[],
                        help="passed on to umbrella reconstruct")
    arguments = parser.parse_args()
    print("| family | points | closed | left out | components | genus |"
          " conflicts | seconds | us |\n" + "|---" * 9 + "|")
    with tempfile.TemporaryDirectory() as scratch:
        folder = arguments.keep or pathlib.Path(scratch)
        for name in arguments.family or FAMILIES:
            for n in arguments.n or [1000, 3000, 10000]:
                points = folder / f"{name}_{n}.xyz"
                if not points.exists():
                    write_points(name, n, points)
                row = row_of(name, n, *reconstruct(
                    arguments.umbrella, points, points.with_suffix(".json"),
                    arguments.option, arguments.timeout))
                print("| " + " | ".join(row) + " |", flush=True)
    return 0


if __name__ == "__main__":
    sys.exit(main())
