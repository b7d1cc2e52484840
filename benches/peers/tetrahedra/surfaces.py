"""Clean surfaces, and twenty dirty ones with the bodies that they mean. Random numbers have fixed seeds."""

import os

import numpy as np


def sphere(centre=(0, 0, 0), radii=(1, 1, 1), levels=3):
    """A sphere or an ellipsoid: an octahedron, each triangle cut in four `levels` times."""
    points = [np.array(p, float) for p in [(1, 0, 0), (-1, 0, 0), (0, 1, 0), (0, -1, 0), (0, 0, 1), (0, 0, -1)]]
    faces = [(0, 2, 4), (2, 1, 4), (1, 3, 4), (3, 0, 4), (2, 0, 5), (1, 2, 5), (3, 1, 5), (0, 3, 5)]
    for _ in range(levels):
        middles, finer = {}, []

        def middle(a, b):
            key = (min(a, b), max(a, b))
            if key not in middles:
                middles[key] = len(points)
                points.append((points[a] + points[b]) / np.linalg.norm(points[a] + points[b]))
            return middles[key]

        for a, b, c in faces:
            ab, bc, ca = middle(a, b), middle(b, c), middle(c, a)
            finer += [(a, ab, ca), (b, bc, ab), (c, ca, bc), (ab, bc, ca)]
        faces = finer
    return np.array(points) * radii + centre, np.array(faces)


def torus(edge, large=1.0, small=0.4):
    """A torus about the axis x, with triangles of about this edge."""
    n, m = max(8, round(2 * np.pi * large / edge)), max(6, round(2 * np.pi * small / edge))
    u, v = np.meshgrid(2 * np.pi * np.arange(n) / n, 2 * np.pi * np.arange(m) / m, indexing="ij")
    ring = large + small * np.cos(v)
    points = np.stack([small * np.sin(v), ring * np.cos(u), ring * np.sin(u)], axis=-1).reshape(-1, 3)
    faces = []
    for i in range(n):
        for j in range(m):
            a, b = i * m + j, ((i + 1) % n) * m + j
            c, d = i * m + (j + 1) % m, ((i + 1) % n) * m + (j + 1) % m
            faces += [(a, d, b), (a, c, d)]
    return outward(points, np.array(faces))


def box(least, largest, cells=6):
    """A box whose sides have cells × cells squares of two triangles."""
    points, faces = [], []
    for axis in range(3):
        for side in range(2):
            first = len(points)
            for i in range(cells + 1):
                for j in range(cells + 1):
                    point = np.zeros(3)
                    point[axis], point[(axis + 1) % 3], point[(axis + 2) % 3] = side, i / cells, j / cells
                    points.append(point)
            for i in range(cells):
                for j in range(cells):
                    a = first + i * (cells + 1) + j
                    b, c, d = a + cells + 1, a + 1, a + cells + 2
                    faces += [(a, b, d), (a, d, c)] if side else [(a, d, b), (a, c, d)]
    points, faces = weld(np.array(points), np.array(faces))
    return points * (np.array(largest) - least) + least, faces


def obj(path):
    points, faces = [], []
    for line in open(path):
        words = line.split()
        if words and words[0] == "v":
            points.append([float(x) for x in words[1:4]])
        elif words and words[0] == "f":
            faces.append([int(word.split("/")[0]) - 1 for word in words[1:4]])
    return np.array(points), np.array(faces)


def outward(points, faces):
    a, b, c = (points[faces[:, i]] for i in range(3))
    return points, faces if np.einsum("ij,ij", a, np.cross(b, c)) > 0 else faces[:, [0, 2, 1]]


def weld(points, faces):
    _, first, inverse = np.unique(np.round(points, 9), axis=0, return_index=True, return_inverse=True)
    return points[first], inverse.reshape(-1)[faces]


def together(*parts):
    points, faces, count = [], [], 0
    for part, triangles in parts:
        points.append(part)
        faces.append(triangles + count)
        count += len(part)
    return np.concatenate(points), np.concatenate(faces)


def without(surface, share, seed):
    points, faces = surface
    return points, faces[np.random.default_rng(seed).random(len(faces)) >= share]


def flipped(surface, share, seed):
    points, faces = surface
    turn = np.random.default_rng(seed).random(len(faces)) < share
    return points, np.where(turn[:, None], faces[:, [0, 2, 1]], faces)


def repeated(surface, share, seed):
    points, faces = surface
    return points, np.concatenate([faces, faces[np.random.default_rng(seed).random(len(faces)) < share]])


def noisy(surface, size, seed):
    points, faces = surface
    return points + np.random.default_rng(seed).normal(0, size, points.shape), faces


def soup(surface, size, seed):
    """Every triangle with corners of its own, moved at random."""
    points, faces = surface
    return noisy((points[faces].reshape(-1, 3), np.arange(3 * len(faces)).reshape(-1, 3)), size, seed)


def debris(count, radius, seed):
    """Small triangles in a ball."""
    random = np.random.default_rng(seed)
    centres = random.normal(0, 1, (count, 1, 3))
    centres *= radius * random.random((count, 1, 1)) / np.linalg.norm(centres, axis=2, keepdims=True)
    return (centres + random.normal(0, 0.05, (count, 3, 3))).reshape(-1, 3), np.arange(3 * count).reshape(-1, 3)


def split_edges(surface, share, seed):
    """T-junctions: triangles cut in two at the middle of an edge, which their neighbours do not have."""
    points, faces = surface
    points, out = list(points), []
    for chance, (a, b, c) in zip(np.random.default_rng(seed).random(len(faces)), faces):
        if chance < share:
            points.append(0.5 * (points[a] + points[b]))
            out += [(a, len(points) - 1, c), (len(points) - 1, b, c)]
        else:
            out.append((a, b, c))
    return np.array(points), np.array(out)


def flat(surface, count, seed):
    """Triangles without area added: copies of an edge."""
    points, faces = surface
    some = faces[np.random.default_rng(seed).choice(len(faces), count, replace=False)]
    return points, np.concatenate([faces, some[:, [0, 1, 0]]])


def armadillo():
    here = os.path.dirname(os.path.abspath(__file__))
    return obj(os.path.join(here, "../../../data/own/armadillo_own_37k.obj"))


def dirty():
    """Name, dirty surface, and the clean closed surfaces whose union is the body."""
    ball, ring, cube = sphere(levels=4), torus(0.12), box((0, 0, 0), (1, 1, 1))
    other = sphere((0.9, 0.3, 0.2), (0.7, 0.7, 0.7), 4)
    hollow = (sphere(radii=(0.5, 0.5, 0.5))[0], sphere(radii=(0.5, 0.5, 0.5))[1][:, [0, 2, 1]])
    fin = (np.array([(1, 0.5, 0.2), (1, 0.5, 0.8), (1.4, 0.5, 0.8), (1.4, 0.5, 0.2)]), np.array([(0, 1, 2), (0, 2, 3)]))
    by_edge, by_corner = box((1, 1, 0), (2, 2, 1)), box((1, 1, 1), (2, 2, 2))
    plate = box((0, 0, 0), (1, 1, 0.06), 12)
    figure = armadillo()
    crossing = torus(0.12, 1.0, 0.4)
    crossing = (crossing[0] * (1, 1, 1) + (0.3, 0.8, 0), crossing[1])
    return [
        ("ball, 5 % of triangles missing", without(ball, 0.05, 1), [ball]),
        ("ball, 30 % flipped", flipped(ball, 0.3, 2), [ball]),
        ("ball, 20 % twice", repeated(ball, 0.2, 3), [ball]),
        ("two balls through each other", together(ball, other), [ball, other]),
        ("torus, loose triangles, moved by 1e-4", soup(ring, 1e-4, 4), [ring]),
        ("torus, noise of 1 %", noisy(ring, 0.01, 5), [ring]),
        ("two tori through each other", together(ring, crossing), [ring, crossing]),
        ("hollow ball", together(ball, hollow), [ball, hollow]),
        ("ball with 60 stray triangles inside", together(ball, debris(60, 0.7, 6)), [ball]),
        ("cube with T-junctions", split_edges(cube, 0.3, 7), [cube]),
        ("cube with a fin without thickness", together(cube, fin), [cube]),
        ("two cubes that share an edge", weld(*together(cube, by_edge)), [cube, by_edge]),
        ("two cubes that share a corner", weld(*together(cube, by_corner)), [cube, by_corner]),
        ("ball through a torus", together(ring, sphere((0, 1, 0), (0.6, 0.6, 0.6))), [ring, sphere((0, 1, 0), (0.6, 0.6, 0.6))]),
        ("ball inside a ball, both outward", together(ball, sphere(radii=(0.5, 0.5, 0.5))), [ball]),
        ("thin plate, 10 % missing", without(plate, 0.1, 8), [plate]),
        ("ball with 50 triangles without area", flat(ball, 50, 9), [ball]),
        ("armadillo, 2 % missing", without(figure, 0.02, 10), [figure]),
        ("armadillo, loose triangles, 10 % flipped", flipped(soup(figure, 1e-5, 11), 0.1, 12), [figure]),
        ("torus: missing, flipped, twice, noise", repeated(flipped(without(noisy(ring, 0.004, 13), 0.03, 14), 0.1, 15), 0.1, 16), [ring]),
    ]
