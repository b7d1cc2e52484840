"""Twenty dirty surfaces: ours beside tetgen and pytetwild. Prints the table; about ten minutes on two cores.

    cargo build --release
    python -m venv peers && peers/bin/pip install -r benches/peers/tetrahedra/requirements.txt
    peers/bin/python benches/peers/tetrahedra/dirty.py
"""

import importlib.metadata
import sys

import numpy as np

from measures import dihedral_angles, hausdorff, volumes
from meshers import mesh
from surfaces import dirty

NAMES = ["ours", "tetgen", "pytetwild"]


def judged(found, body, edge, limit):
    """Number of tetrahedra, seconds, extreme angles, distance over the edge; and whether the mesh is one of the body: no element is
    inverted and the distance is below a limit."""
    points, tetrahedra, seconds = found
    angles, far = dihedral_angles(points, tetrahedra), hausdorff(points, tetrahedra, body) / edge
    is_good = volumes(points, tetrahedra).min() > 0 and far < limit
    text = f"{len(tetrahedra)}, {seconds:.2f} s, {angles.min():.1f}° … {angles.max():.1f}°, {far:.2f}"
    return (text if is_good else f"**wrong** ({text})"), is_good, seconds, angles.min(), angles.max(), far


def main():
    versions = ", ".join(f"{name} {importlib.metadata.version(name)}" for name in NAMES[1:])
    print(f"{versions}; each cell: tetrahedra, seconds of processor time, extreme dihedral angles, distance to the body over the edge\n")
    print("| surface | " + " | ".join(NAMES) + " |\n|---|" + "---|" * len(NAMES))
    totals = {name: [] for name in NAMES}
    for title, (points, faces), body in dirty():
        # Thin parts need shorter edges.
        edge = np.linalg.norm(np.ptp(body[0][0], axis=0)) / (45 if "plate" in title or "armadillo" in title else 16)
        limit = 1.5
        if "armadillo" in title:
            # The tips of its claws are thinner than an edge; a clean surface has the same distance.
            limit = max(limit, 1.05 * hausdorff(*mesh("ours", *body[0], edge)[0][:2], body) / edge)
        cells = []
        for name in NAMES:
            found, reason = mesh(name, points, faces, edge)
            text, *figures = judged(found, body, edge, limit) if found else (f"**failed**: {reason}", False)
            cells.append(text)
            totals[name].append(figures)
        print(f"| {title} | " + " | ".join(cells) + " |")
        sys.stdout.flush()
    print()
    for name, rows in totals.items():
        good = [figures[1:] for figures in rows if figures[0]]
        seconds, least, most, far = (np.array(column) for column in zip(*good))
        print(f"{name}: {len(rows) - len(good)} of {len(rows)} failed; of the others median {np.median(seconds):.2f} s, "
              f"angles {least.min():.1f}° … {most.max():.1f}°, largest distance {far.max():.2f} edges")


main()
