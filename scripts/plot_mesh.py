#!/usr/bin/env python3
"""Draws OFF meshes side by side into a PNG: scripts/plot_mesh.py OUT.png IN.off...

Needs nothing but Python: depth buffer, flat shading, edges where they are
wide enough to see. Faces seen from behind are drawn red, so that holes and
wrong orientation show.
"""

import math
import struct
import sys
import zlib

SIDE = 560  # pixels of one picture
LIGHT = (0.35, 0.45, 0.82)
FRONT, BACK = (0.55, 0.68, 0.86), (0.85, 0.35, 0.30)


def read_off(path):
    with open(path) as file:
        words = [w for line in file for w in line.split("#")[0].split()]
    n_points, n_faces = int(words[1]), int(words[2])
    numbers = iter(words[4:])
    points = [[float(next(numbers)) for _ in range(3)] for _ in range(n_points)]
    faces = []
    for _ in range(n_faces):
        n = int(next(numbers))
        faces.append([int(next(numbers)) for _ in range(n)])
    return points, faces


def view(points):
    """Turned a little, centred, scaled to pixels; z towards the viewer."""
    a, b = math.radians(25), math.radians(-55)
    turned = []
    for x, y, z in points:
        x, y = x * math.cos(a) - y * math.sin(a), x * math.sin(a) + y * math.cos(a)
        y, z = y * math.cos(b) - z * math.sin(b), y * math.sin(b) + z * math.cos(b)
        turned.append((x, y, z))
    low = [min(p[i] for p in turned) for i in range(3)]
    high = [max(p[i] for p in turned) for i in range(3)]
    scale = 0.92 * SIDE / max(high[0] - low[0], high[1] - low[1])
    middle = [(l + h) / 2 for l, h in zip(low, high)]
    return [
        (
            SIDE / 2 + scale * (p[0] - middle[0]),
            SIDE / 2 - scale * (p[1] - middle[1]),
            scale * p[2],
        )
        for p in turned
    ]


def shade(a, b, c):
    u = [b[i] - a[i] for i in range(3)]
    v = [c[i] - a[i] for i in range(3)]
    # The picture's y axis points down: the normal in (right, up, viewer).
    n = (
        -(u[1] * v[2] - u[2] * v[1]),
        u[2] * v[0] - u[0] * v[2],
        -(u[0] * v[1] - u[1] * v[0]),
    )
    length = math.sqrt(sum(x * x for x in n)) or 1
    side = 1 if n[2] >= 0 else -1
    light = sum(side * x / length * w for x, w in zip(n, LIGHT))
    base = FRONT if side > 0 else BACK
    return tuple(int(255 * min(1, x * (0.35 + 0.75 * max(0, light)))) for x in base)


def draw(points, faces):
    color = [(255, 255, 255)] * (SIDE * SIDE)
    depth = [-math.inf] * (SIDE * SIDE)
    seen = view(points)
    for face in faces:
        a, b, c = (seen[i] for i in face)
        area = (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])
        if area == 0:
            continue
        paint = shade(a, b, c)
        xs, ys = (a[0], b[0], c[0]), (a[1], b[1], c[1])
        for y in range(max(0, math.ceil(min(ys))), min(SIDE, math.floor(max(ys)) + 1)):
            for x in range(max(0, math.ceil(min(xs))), min(SIDE, math.floor(max(xs)) + 1)):
                s = ((b[0] - x) * (c[1] - y) - (b[1] - y) * (c[0] - x)) / area
                t = ((c[0] - x) * (a[1] - y) - (c[1] - y) * (a[0] - x)) / area
                if s < 0 or t < 0 or s + t > 1:
                    continue
                z = s * a[2] + t * b[2] + (1 - s - t) * c[2]
                if z > depth[y * SIDE + x]:
                    depth[y * SIDE + x] = z
                    color[y * SIDE + x] = paint
    return color


def write_png(path, pictures):
    rows = bytearray()
    for y in range(SIDE):
        rows.append(0)
        for picture in pictures:
            for pixel in picture[y * SIDE : (y + 1) * SIDE]:
                rows.extend(pixel)

    def chunk(kind, data):
        body = kind + data
        return struct.pack(">I", len(data)) + body + struct.pack(">I", zlib.crc32(body))

    header = struct.pack(">IIBBBBB", SIDE * len(pictures), SIDE, 8, 2, 0, 0, 0)
    with open(path, "wb") as file:
        file.write(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", header))
        file.write(chunk(b"IDAT", zlib.compress(bytes(rows), 9)) + chunk(b"IEND", b""))


if __name__ == "__main__":
    if len(sys.argv) < 3:
        sys.exit(__doc__)
    write_png(sys.argv[1], [draw(*read_off(path)) for path in sys.argv[2:]])
