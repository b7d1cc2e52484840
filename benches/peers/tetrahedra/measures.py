"""Shapes of tetrahedra, and the distance between a mesh's boundary and a body."""

import numpy as np
import pyvista

FACES = np.array([(1, 2, 3), (0, 3, 2), (0, 1, 3), (0, 2, 1)])


def oriented(points, tetrahedra):
    """All tetrahedra turned the way of most of them, as formats differ."""
    return tetrahedra if np.sum(volumes(points, tetrahedra)) > 0 else tetrahedra[:, [0, 1, 3, 2]]


def volumes(points, tetrahedra):
    a, b, c, d = (points[tetrahedra[:, i]] for i in range(4))
    return np.einsum("ij,ij->i", np.cross(b - a, c - a), d - a) / 6


def dihedral_angles(points, tetrahedra):
    """Six for each tetrahedron, degrees."""
    corners = points[tetrahedra]
    normals = [np.cross(corners[:, j] - corners[:, i], corners[:, k] - corners[:, i]) for i, j, k in FACES]
    angles = []
    for i in range(4):
        for j in range(i):
            sine = np.linalg.norm(np.cross(normals[i], normals[j]), axis=1)
            angles.append(180 - np.degrees(np.arctan2(sine, np.einsum("ij,ij->i", normals[i], normals[j]))))
    return np.array(angles)


def boundary(tetrahedra):
    faces = tetrahedra[:, FACES].reshape(-1, 3)
    _, first, count = np.unique(np.sort(faces, axis=1), axis=0, return_index=True, return_counts=True)
    return faces[first[count == 1]]


def surface(points, faces):
    return pyvista.PolyData(np.ascontiguousarray(points, float), np.insert(faces, 0, 3, axis=1).ravel())


def samples(points, faces, count=20000, seed=0):
    """Points spread evenly over triangles."""
    random = np.random.default_rng(seed)
    a, b, c = (points[faces[:, i]] for i in range(3))
    areas = np.linalg.norm(np.cross(b - a, c - a), axis=1)
    chosen = random.choice(len(faces), count, p=areas / areas.sum())
    u, v = random.random((2, count, 1))
    u, v = np.where(u + v > 1, 1 - u, u), np.where(u + v > 1, 1 - v, v)
    return a[chosen] + u * (b - a)[chosen] + v * (c - a)[chosen]


def distance(to, points):
    """Signed distance from a surface; negative inside."""
    cloud = pyvista.PolyData(points)
    cloud.compute_implicit_distance(surface(*to), inplace=True)
    return np.asarray(cloud["implicit_distance"])


def hausdorff(points, tetrahedra, body):
    """Largest distance between the boundary of a mesh and that of the union of closed surfaces, by samples of both."""
    faces = boundary(tetrahedra)
    own = samples(points, faces)
    there = np.min([np.abs(distance(part, own)) for part in body], axis=0).max()
    back = 0.0
    for i, part in enumerate(body):
        cloud = samples(*part)
        is_bare = np.ones(len(cloud), bool)
        for other in body[:i] + body[i + 1 :]:
            # A surface that is turned inwards bounds a cavity, whose points are in the boundary all the same.
            if volume(*other) > 0 and volume(*part) > 0:
                is_bare &= distance(other, cloud) > -1e-9
        back = max(back, np.abs(distance((points, faces), cloud[is_bare])).max())
    return max(there, back)


def volume(points, faces):
    a, b, c = (points[faces[:, i]] for i in range(3))
    return np.einsum("ij,ij", a, np.cross(b, c)) / 6
