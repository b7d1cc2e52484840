"""Triangles of the seven pictures beside Triangle (-q30) and Gmsh, with the same boundary and about the same count.

    pip install -r benches/peers/triangles/requirements.txt
    cargo build --release -p fem-mesh --features pictures --example mesh_pictures
    python benches/peers/triangles/compare.py [EDGE [ITERATIONS [TARGET]]]

Times are the fastest of 25 runs in one process each, without reading the picture. Triangle and Gmsh get the boundary of our mesh; the first
column of times begins there: ours with the choice of the points on the boundary, the search of the count, the meshing and the smoothing. The
second begins at the pixels: contours, corners, sizes. The area bound of Triangle and the size of Gmsh are searched until their count
is within 3 % of ours; that search is not timed.
"""

import pathlib
import subprocess
import sys
import tempfile
import time
from importlib.metadata import version

import gmsh
import numpy as np
import triangle

ROOT = pathlib.Path(__file__).resolve().parents[3]
NAMES = ["donut", "armadillo", "bunny", "triangle", "square", "letter", "gear"]


def ratios(points, triangles):
    corners = points[triangles]
    sides = np.stack([np.linalg.norm(corners[:, (i + 1) % 3] - corners[:, i], axis=1) for i in range(3)])
    u, v = corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]
    area = 0.5 * np.abs(u[:, 0] * v[:, 1] - u[:, 1] * v[:, 0])
    ratio = np.sort(sides.prod(axis=0) / (4 * area) / sides.min(axis=0))
    return [ratio[-1], ratio[int(np.ceil(0.99 * len(ratio))) - 1], ratio[(len(ratio) - 1) // 2]]


def polygons(file):
    """Points, closed chains of their numbers, and a point in each hole."""
    edges = np.loadtxt(file, delimiter=",").reshape(-1, 2, 2)
    numbers, points, following = {}, [], {}
    for ends in edges:
        a, b = (numbers.setdefault(tuple(x), len(numbers)) for x in ends)
        following[a] = b
    points = np.array(list(numbers))
    chains = []
    while following:
        chain = [next(iter(following))]
        while chain[-1] in following:
            chain.append(following.pop(chain[-1]))
        chains.append(chain[:-1])
    holes = []
    for chain in chains:
        x = points[chain]
        if np.sum(x[:, 0] * np.roll(x[:, 1], -1) - x[:, 1] * np.roll(x[:, 0], -1)) < 0:
            holes.append(x.mean(axis=0))
    return points, chains, holes


def by_triangle(points, chains, holes, area):
    segments = [[a, b] for chain in chains for a, b in zip(chain, chain[1:] + chain[:1])]
    data = {"vertices": points, "segments": segments}
    if holes:
        data["holes"] = holes
    found = triangle.triangulate(data, f"pq30a{area:.12f}")
    return found["vertices"], found["triangles"]


def by_gmsh(points, chains, holes, area):
    size = (4 * area / 3**0.5) ** 0.5
    gmsh.clear()
    add = gmsh.model.geo
    nodes = [add.addPoint(x, y, 0, size) for x, y in points]
    loops = []
    for chain in sorted(chains, key=len, reverse=True):
        lines = [add.addLine(nodes[a], nodes[b]) for a, b in zip(chain, chain[1:] + chain[:1])]
        [gmsh.model.geo.mesh.setTransfiniteCurve(line, 2) for line in lines]
        loops.append(add.addCurveLoop(lines))
    add.addPlaneSurface(loops)
    add.synchronize()
    gmsh.option.setNumber("Mesh.MeshSizeMax", size)
    gmsh.model.mesh.generate(2)
    tags, x, _ = gmsh.model.mesh.getNodes()
    numbers = np.zeros(int(tags.max()) + 1, int)
    numbers[tags.astype(int)] = np.arange(len(tags))
    elements = gmsh.model.mesh.getElementsByType(2)[1].astype(int).reshape(-1, 3)
    return x.reshape(-1, 3)[:, :2], numbers[elements]


def at_count(mesher, shape, count, area):
    """The mesh whose count is as near as a search of the area gets, with the fastest of the times."""
    best = None
    for _ in range(12):
        points, triangles = mesher(*shape, area)
        ratio = len(triangles) / count
        if best is None or abs(np.log(ratio)) < best[0]:
            best = (abs(np.log(ratio)), area, points, triangles)
        if abs(ratio - 1) < 0.03:
            break
        area *= ratio
    seconds = []
    for _ in range(25):
        start = time.perf_counter()
        mesher(*shape, best[1])
        seconds.append(time.perf_counter() - start)
    return best[2], best[3], min(seconds)


def main():
    edge = float(sys.argv[1]) if len(sys.argv) > 1 else 0.012
    iterations = sys.argv[2] if len(sys.argv) > 2 else "5"
    target = pathlib.Path(sys.argv[3]) if len(sys.argv) > 3 else ROOT / "target"
    gmsh.initialize()
    gmsh.option.setNumber("General.Terminal", 0)
    gmsh.option.setNumber("Mesh.MeshSizeExtendFromBoundary", 0)
    print(f"triangle {version('triangle')} (-q30), gmsh {version('gmsh')} (Frontal-Delaunay), edges of {edge} m, {iterations} iterations\n")
    print("| picture | program | triangles | R/l worst | 99 % | median | ms from the boundary | over Triangle | ms from the pixels |\n|---|---|---:|---:|---:|---:|---:|---:|---:|")
    with tempfile.TemporaryDirectory() as folder:
        pictures = [ROOT / "data/pictures" / f"{name}.png" for name in NAMES]
        program = target / "release/examples/mesh_pictures"
        lines = subprocess.run([program, folder, str(edge), iterations, *pictures], check=True, capture_output=True, text=True).stdout
        for line in lines.splitlines():
            name, count, _, *measures, seconds, whole, _ = line.split(",")
            shape = polygons(pathlib.Path(folder) / f"{name}.poly.csv")
            found = [at_count(mesher, shape, int(count), 0.7 * edge * edge) for mesher in [by_triangle, by_gmsh]]
            bar = found[0][2]
            row(name, "ours", int(count), map(float, measures), float(seconds), bar, f"{1000 * float(whole):.1f}")
            for program, (points, triangles, seconds) in zip(["triangle", "gmsh"], found):
                row("", program, len(triangles), ratios(points, triangles), seconds, bar, "")
    gmsh.finalize()


def row(name, program, count, found, seconds, bar, whole):
    measures = " | ".join(f"{x:.3f}" for x in found)
    print(f"| {name} | {program} | {count} | {measures} | {1000 * seconds:.1f} | {seconds / bar:.2f} | {whole} |")


main()
