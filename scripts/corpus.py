#!/usr/bin/env python3
"""Reconstructs closed meshes from their vertices, and compares.

    scripts/corpus.py UMBRELLA [--half choose|report] [--markdown] MESH...
    scripts/corpus.py build/release/bin/umbrella data/real/*.off

A mesh counts if `umbrella check` finds it closed and manifold, as it stands or
with equal vertices merged (OFF files only). Its vertices go through `umbrella
reconstruct`; the table says what came out, and whether genus and number of
components are the mesh's own. Of the meshes as they stand every second by name
belongs to the half that choices in the closing were made on; all others belong
to the half that tells what they are worth. Seconds are processor time of the whole run.
"""

import argparse
import json
import pathlib
import subprocess
import sys
import tempfile

from timed_reconstruct import reconstruct

COLUMNS = ["set", "half", "points", "closed", "manifold", "components",
           "genus", "dropped", "seconds", "verdict"]


def check(umbrella, mesh):
    """The certificate of a mesh."""
    run = subprocess.run([umbrella, "check", mesh, "--json"],
                         capture_output=True, text=True)
    return json.loads(run.stdout)["surface"] if run.stdout else None


def merged(mesh, folder):
    """A copy of an OFF file in which equal vertices are one."""
    words = [word for line in mesh.read_text().splitlines()
             for word in line.split("#")[0].split()]
    n_points, n_faces = int(words[1]), int(words[2])
    rows, row_of_vertex, at = {}, [], 4
    for _ in range(n_points):
        point = tuple(map(float, words[at:at + 3]))
        row_of_vertex.append(rows.setdefault(point, len(rows)))
        at += 3
    faces = []
    for _ in range(n_faces):
        n = int(words[at])
        faces.append([row_of_vertex[int(v)] for v in words[at + 1:at + 1 + n]])
        at += 1 + n
    copy = pathlib.Path(folder) / mesh.name
    copy.write_text("\n".join(
        [f"OFF\n{len(rows)} {len(faces)} 0"] +
        [" ".join(map(repr, point)) for point in rows] +
        [" ".join(map(str, [len(face), *face])) for face in faces]) + "\n")
    return copy


def is_sound(certificate):
    return bool(certificate and certificate["closed"] and
                certificate["manifold"])


def chosen(umbrella, meshes):
    """Each mesh that counts, with its half and certificate."""
    n_halved = 0
    for mesh in sorted(meshes, key=lambda path: path.name):
        own = check(umbrella, mesh)
        if is_sound(own):
            yield mesh, "report" if n_halved % 2 else "choose", own
            n_halved += 1
        elif own and mesh.suffix == ".off":
            with tempfile.TemporaryDirectory() as folder:
                own = check(umbrella, merged(mesh, folder))
            if is_sound(own):
                yield mesh, "report", own


def row_of(mesh, half, own, report, seconds):
    """A line of the table, by column."""
    row = {"set": mesh.name, "half": half, "seconds": f"{seconds:.2f}"}
    if report is None:
        return row | {"points": own["vertices"], "verdict": "timeout"}
    ours = report["surface"]
    is_whole = is_sound(ours) and not ours["unused_points"]
    is_right = is_whole and (ours["genus"] == own["genus"] and
                             ours["components"] == own["components"])
    return row | {
        "points": report["input"]["points"],
        "closed": "yes" if ours["closed"] else "no",
        "manifold": "yes" if ours["manifold"] else "no",
        "components": f'{ours["components"]} / {own["components"]}',
        "genus": f'{ours["genus"]} / {own["genus"]}',
        "dropped": len(ours["unused_points"]),
        "verdict": "right" if is_right else "closed" if is_whole
                   else "points left out" if is_sound(ours) else "open"}


def total(rows):
    """How many rows are right, closed through all points, and so on."""
    def count(*verdicts):
        n = sum(row["verdict"] in verdicts for row in rows)
        return f"{n} ({100 * n / len(rows):.0f} %)"
    seconds = sum(float(row["seconds"]) for row in rows)
    return (f"{len(rows)} sets: {count('right', 'closed')} closed through all "
            f"points, {count('right')} right, "
            f"{count('points left out')} closed without some points, "
            f"{count('open', 'timeout')} open; {seconds:.1f} s")


def show(row, markdown):
    cells = [str(row.get(column, "-")) for column in COLUMNS]
    if markdown:
        print("| " + " | ".join(cells) + " |", flush=True)
    else:
        widths = [28, 6, 6, 6, 8, 10, 9, 7, 7, 8]
        print(" ".join(c.ljust(w) for c, w in zip(cells, widths)), flush=True)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("umbrella")
    parser.add_argument("mesh", nargs="+", type=pathlib.Path)
    parser.add_argument("--half", choices=["choose", "report"])
    parser.add_argument("--timeout", type=float, default=120)
    parser.add_argument("--markdown", action="store_true")
    parser.add_argument("--option", action="append", default=[],
                        help="passed on to umbrella reconstruct")
    arguments = parser.parse_args()

    show({column: column for column in COLUMNS}, arguments.markdown)
    if arguments.markdown:
        print("|" + "---|" * len(COLUMNS))
    rows = []
    with tempfile.TemporaryDirectory() as folder:
        report = pathlib.Path(folder) / "report.json"
        for mesh, half, own in chosen(arguments.umbrella, arguments.mesh):
            if arguments.half not in (None, half):
                continue
            rows.append(row_of(mesh, half, own, *reconstruct(
                arguments.umbrella, mesh, report, arguments.option,
                arguments.timeout)))
            show(rows[-1], arguments.markdown)
    print()
    for half in ("choose", "report"):
        part = [row for row in rows if row["half"] == half]
        if part:
            print(f"{half}: {total(part)}")
    print(f"all: {total(rows)}")
    return 0


if __name__ == "__main__":
    sys.exit(main())
