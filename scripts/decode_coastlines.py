#!/usr/bin/env python3
"""Writes the rings of a TopoJSON file as points, one `x y` a line:
scripts/decode_coastlines.py IN.json OUT.xyz

A line `# ring N` stands before the N points of each ring. A ring's last point
is joined to its first; the point that closes it is not repeated.
"""

import json
import sys


def arcs_of(topology):
    """The arcs as lists of points; they are stored as steps on a grid."""
    (sx, sy), (tx, ty) = (topology["transform"][k] for k in ("scale", "translate"))
    arcs = []
    for steps in topology["arcs"]:
        x = y = 0
        arc = []
        for dx, dy in steps:
            x, y = x + dx, y + dy
            arc.append((x * sx + tx, y * sy + ty))
        arcs.append(arc)
    return arcs


def rings_of(geometry):
    """Lists of arc numbers; ~i is arc i backwards."""
    if geometry["type"] == "GeometryCollection":
        for part in geometry["geometries"]:
            yield from rings_of(part)
    elif geometry["type"] == "Polygon":
        yield from geometry["arcs"]
    elif geometry["type"] == "MultiPolygon":
        for polygon in geometry["arcs"]:
            yield from polygon


def points_of(ring, arcs):
    points = []
    for i in ring:
        arc = arcs[i] if i >= 0 else arcs[~i][::-1]
        points.extend(arc[:-1])  # the last is the next one's first
    return points


def main(source, target):
    with open(source) as file:
        topology = json.load(file)
    arcs = arcs_of(topology)
    with open(target, "w") as out:
        for geometry in topology["objects"].values():
            for ring in rings_of(geometry):
                points = points_of(ring, arcs)
                out.write(f"# ring {len(points)}\n")
                out.writelines(f"{x!r} {y!r}\n" for x, y in points)


if __name__ == "__main__":
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    main(*sys.argv[1:])
