"""Three solids, each the image of a unit box: those of `fem-bench statics` (benches/src/statics.rs), as meshes of hexahedra and tetrahedra.

Numbers of nodes within an element follow VTK, which for C3D20 and C3D10 is also the order of Abaqus and CalculiX. Nodes at the middles of
edges lie on the curved solid.
"""

from itertools import permutations

import numpy as np

# Of the node of each element, in halves of a cell: corners, edges, faces, centre.
HEX27 = np.array(
    [(0, 0, 0), (2, 0, 0), (2, 2, 0), (0, 2, 0), (0, 0, 2), (2, 0, 2), (2, 2, 2), (0, 2, 2)]
    + [(1, 0, 0), (2, 1, 0), (1, 2, 0), (0, 1, 0), (1, 0, 2), (2, 1, 2), (1, 2, 2), (0, 1, 2)]
    + [(0, 0, 1), (2, 0, 1), (2, 2, 1), (0, 2, 1), (0, 1, 1), (2, 1, 1), (1, 0, 1), (1, 2, 1), (1, 1, 0), (1, 1, 2), (1, 1, 1)]
)
EDGES = [(0, 1), (1, 2), (2, 0), (0, 3), (1, 3), (2, 3)]


def le10(place):
    x, y, z = place
    return np.array([(2 + 1.25 * x) * np.cos(np.pi / 2 * y), (1 + 1.75 * x) * np.sin(np.pi / 2 * y), 0.6 * z])


def twisted(place):
    x, y, z = 12 * place[0], 1.1 * (place[1] - 0.5), 0.32 * (place[2] - 0.5)
    c, s = np.cos(np.pi / 2 * place[0]), np.sin(np.pi / 2 * place[0])
    return np.array([x, c * y - s * z, s * y + c * z])


class Case:
    def __init__(self, map, constrained, is_loaded, axis, traction, point, young, poisson):
        self.map, self.constrained, self.is_loaded, self.axis = map, constrained, is_loaded, axis
        self.traction, self.point, self.young, self.poisson = np.array(traction), point, young, poisson
        self.shear = young / (2 + 2 * poisson)
        self.bulk = young / (3 - 6 * poisson)


ones, zeros = np.ones, np.zeros
CASES = {
    "le10": Case(
        le10,
        lambda x, y, z: np.array([(x == 1) | (y == 1), (x == 1) | (y == 0), (x == 1) & (z == 0.5)]),
        lambda x, y, z: z == 1, 2, (0, 0, -1e6), (0, 0, 1), 210e9, 0.3,
    ),
    "twisted": Case(
        twisted,
        lambda x, y, z: np.array([x == 0] * 3),
        lambda x, y, z: x == 1, 0, (0, 0, 1 / (1.1 * 0.32)), (1, 0.5, 0.5), 29e6, 0.22,
    ),
    "block": Case(
        lambda place: 50 * place,
        lambda x, y, z: np.array([(x == 0) | (z == 1), (y == 0) | (z == 1), z == 0]),
        lambda x, y, z: (z == 1) & (x <= 0.5) & (y <= 0.5), 2, (0, 0, -160.0), (0, 0, 1), 240.565, 0.4999,
    ),
}  # fmt: skip
# As benches/src/statics.rs has them, to the last digit.
CASES["block"].shear, CASES["block"].bulk = 2 * 40.0969, 2 * 200471.6


class Mesh:
    """Nodes of `hex20`, `hex27` or `tet10`: places in the box (n, 3), points (n, 3), elements (m, nodes), nodal forces (n, 3)."""

    def __init__(self, case, element, cells):
        shape = 2 * np.array(cells) + 1
        number = np.arange(shape.prod()).reshape(shape)
        origins = np.stack(np.meshgrid(*(np.arange(0, 2 * n, 2) for n in cells), indexing="ij"), -1).reshape(-1, 3)
        pick = lambda local: number[tuple(np.moveaxis(origins[:, None] + np.array(local)[None], -1, 0))]
        if element == "tet10":
            elements = np.concatenate([pick(kuhn(order)) for order in permutations(range(3))])
        else:
            elements = pick(HEX27[: int(element[3:])])
        kept, elements = np.unique(elements, return_inverse=True)
        self.elements = elements.reshape(-1, int(element[3:]))
        lattice = np.stack(np.unravel_index(kept, shape), -1)
        self.places = lattice / (shape - 1)
        self.points = case.map(self.places.T).T
        self.constrained = case.constrained(*self.places.T).T
        self.node = int(np.argmin(((self.places - case.point) ** 2).sum(1)))
        self.forces = nodal_forces(case, element, self)


def kuhn(order):
    """The tetrahedron of a cube along the axes in this order, its edges' middles after its corners."""
    steps = np.eye(3, dtype=int)[list(order)]
    corners = np.concatenate([[[0, 0, 0]], 2 * np.cumsum(steps, 0)])
    if np.linalg.det(steps) < 0:
        corners[[1, 2]] = corners[[2, 1]]
    return [*corners, *((corners[a] + corners[b]) // 2 for a, b in EDGES)]


def nodal_forces(case, element, mesh):
    """∫ N t dA over the loaded faces, with curved edges."""
    forces = np.zeros_like(mesh.points)
    local = np.array(kuhn((0, 1, 2)) if element == "tet10" else HEX27[: int(element[3:])])
    is_on = case.is_loaded(*mesh.places.T)[mesh.elements]
    nodes_of_face = {"tet10": 6, "hex20": 8, "hex27": 9}[element]
    loaded = is_on.sum(1) == nodes_of_face
    for element_nodes, on in zip(mesh.elements[loaded], is_on[loaded]):
        face = element_nodes[on]
        # Coordinates of the face itself: its places, from −1 to 1 or in the unit triangle.
        flat = np.delete(mesh.places[face], case.axis, 1)
        low, high = flat.min(0), flat.max(0)
        reference = 2 * (flat - low) / (high - low) - 1
        basis = monomials(nodes_of_face)
        coefficients = np.linalg.inv(basis(reference))
        for point, weight in quadrature(nodes_of_face, reference):
            value = basis(point[None])[0] @ coefficients
            gradient = np.array([(basis((point + d)[None])[0] - basis((point - d)[None])[0]) / 2e-4 for d in 1e-4 * np.eye(2)]) @ coefficients
            a, b = gradient @ mesh.points[face]
            forces[face] += weight * np.linalg.norm(np.cross(a, b)) * np.outer(value, case.traction)
    return forces


def monomials(nodes):
    powers = {6: "00 10 01 20 11 02", 8: "00 10 01 20 11 02 21 12", 9: "00 10 01 20 11 02 21 12 22"}[nodes].split()
    return lambda x: np.stack([x[:, 0] ** int(p) * x[:, 1] ** int(q) for p, q in powers], -1)


def quadrature(nodes, reference):
    """Points and weights on the square from −1 to 1, or on the half of it with these nodes."""
    s, w = np.polynomial.legendre.leggauss(4)
    if nodes != 6:
        return [(np.array([a, b]), u * v) for a, u in zip(s, w) for b, v in zip(s, w)]
    corners = reference[np.isin(np.abs(reference).sum(1), [2]) & (np.abs(reference).min(1) == 1)]
    t, w = (1 + s) / 2, w / 2
    area = 2 * 2
    return [
        (corners[0] + a * (corners[1] - corners[0]) + a * b * (corners[2] - corners[1]), area * u * v * a)
        for a, u in zip(t, w) for b, v in zip(t, w)
    ]  # fmt: skip
