"""Delaunay meshes of random points beside scipy (Qhull), TetGen and Triangle.

    pip install -r benches/peers/delaunay/requirements.txt
    cargo build --release -p fem-mesh --example time_delaunay
    python benches/peers/delaunay/compare.py [TARGET]

All get the same points, evenly distributed in the unit square or cube. Times are the fastest of five runs at 10⁵ points and of three at
10⁶, in one process for each program, without reading and writing. The meshes are compared element by element up to 10⁵ points and by
their number of elements beyond.
"""

import pathlib
import subprocess
import sys
import tempfile
import time
from importlib.metadata import version

import numpy as np

ROOT = pathlib.Path(__file__).resolve().parents[3]
PROGRAMS = {2: ["ours", "scipy", "triangle"], 3: ["ours", "scipy", "tetgen"]}


def by_scipy(points):
    from scipy.spatial import Delaunay

    return Delaunay(points).simplices


def by_triangle(points):
    import triangle

    return triangle.triangulate({"vertices": points}, "Q")["triangles"]


def by_tetgen(points):
    import tetgen

    class Points(tetgen.TetGen):
        # Reading the markers of faces crashes where there are none.
        triface_markers = None

    # The package asks for faces; without the switch -p TetGen ignores them.
    mesher = Points(points, np.array([[0, 1, 2]], np.int32))
    mesher.tetrahedralize(switches="Q")
    return mesher.elem


def peer(name, points, repeats):
    """Runs in a process of its own: the fastest time, s, and the elements."""
    mesher = {"scipy": by_scipy, "triangle": by_triangle, "tetgen": by_tetgen}[name]
    mesher(points[:100])  # imports
    seconds = []
    for _ in range(repeats):
        start = time.perf_counter()
        elements = mesher(points)
        seconds.append(time.perf_counter() - start)
    return min(seconds), elements


def sorted_elements(elements):
    elements = np.sort(elements, axis=1)
    return elements[np.lexsort(elements.T[::-1])]


def measure(name, dimensions, points, repeats, folder, target):
    out = folder / f"{name}.elements"
    if name == "ours":
        program = [target / "release/examples/time_delaunay"]
    else:
        program = [sys.executable, __file__, "--peer", name]
    words = [str(word) for word in [dimensions, repeats, points, out]]
    text = subprocess.run([*program, *words], check=True, capture_output=True, text=True).stdout
    return float(text.split()[-1]), np.fromfile(out, np.uint32).reshape(-1, dimensions + 1)


def compare(dimensions, count, folder, target):
    points = folder / "points"
    np.random.default_rng(count).random((count, dimensions)).tofile(points)
    found = {name: measure(name, dimensions, points, 5 if count <= 100_000 else 3, folder, target) for name in PROGRAMS[dimensions]}
    own = found["ours"]
    for name, (seconds, elements) in found.items():
        is_same = len(elements) == len(own[1])
        if is_same and count <= 100_000:
            is_same = np.array_equal(sorted_elements(elements), sorted_elements(own[1]))
        words = [f"{dimensions}", f"{count}", name, f"{len(elements)}", "yes" if is_same else "no"]
        print("| " + " | ".join(words) + f" | {seconds:.2f} | {seconds / own[0]:.2f} |", flush=True)


def main():
    if sys.argv[1:2] == ["--peer"]:
        name, dimensions, repeats, points, out = sys.argv[2:]
        seconds, elements = peer(name, np.fromfile(points).reshape(-1, int(dimensions)), int(repeats))
        np.asarray(elements, np.uint32).tofile(out)
        print(seconds)
        return
    target = pathlib.Path(sys.argv[1]) if len(sys.argv) > 1 else ROOT / "target"
    print(", ".join(f"{name} {version(name)}" for name in ["scipy", "tetgen", "triangle"]) + "\n")
    print("| dimensions | points | program | elements | same mesh | s | over ours |\n|---:|---:|---|---:|---|---:|---:|")
    for dimensions in PROGRAMS:
        for count in [100_000, 1_000_000]:
            with tempfile.TemporaryDirectory() as folder:
                compare(dimensions, count, pathlib.Path(folder), target)


main()
