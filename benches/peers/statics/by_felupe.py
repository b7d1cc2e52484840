"""A case by FElupe: python by_felupe.py CASE ELEMENT NX,NY,NZ SOLVER ROUNDS

ELEMENT is `tet10`, `hex20` or `hex27`. SOLVER is `scipy` (SuperLU, the default) or `pardiso`. The block is a
`SolidBodyNearlyIncompressible`: one pressure and one volume for each element. Prints value, unknowns and the shortest processor time as JSON.
"""

import json
import sys
import time

import felupe as fem
import numpy as np
import pypardiso
from cases import CASES, Mesh
from scipy.sparse.linalg import spsolve

name, element, cells, solver, rounds = sys.argv[1:]
case = CASES[name]
mesh = Mesh(case, element, [int(n) for n in cells.split(",")])
REGIONS = {"tet10": ("tetra10", fem.RegionQuadraticTetra), "hex20": ("hexahedron20", fem.RegionQuadraticHexahedron), "hex27": ("hexahedron27", fem.RegionTriQuadraticHexahedron)}
cell_type, Region = REGIONS[element]
body = fem.Mesh(mesh.points, mesh.elements, cell_type)
direct = pypardiso.spsolve if solver == "pardiso" else spsolve


def boundaries(field):
    return {str(axis): fem.Boundary(field, mask=mesh.constrained[:, axis], skip=tuple(i != axis for i in range(3))) for axis in range(3)}


def run():
    region = Region(body)
    field = fem.FieldContainer([fem.Field(region, dim=3)])
    if name == "block":
        umat = fem.NeoHooke(mu=case.shear)
        solid = fem.SolidBodyNearlyIncompressible(umat, field, bulk=case.bulk)
    else:
        solid = fem.SolidBody(fem.LinearElastic(case.young, case.poisson), field)
    loaded = np.flatnonzero(np.abs(mesh.forces).sum(1))
    bounds = boundaries(field[0])
    dof0, dof1 = fem.dof.partition(field, bounds)
    load = fem.PointLoad(field, loaded, mesh.forces[loaded])
    result = fem.newtonraphson(items=[solid, load], x0=field, dof0=dof0, dof1=dof1, solver=direct, verbose=0, tol=1e-8, maxiter=30)
    if not result.success:
        sys.exit("error: Newton's method has not converged")
    if name != "le10":
        return field[0].values[mesh.node, 2]
    stress = solid.results.stress[0] if hasattr(solid.results, "stress") else solid.gradient(field)[0]
    return fem.tools.project(stress[1, 1][None], region)[mesh.node, 0]


seconds = []
for _ in range(int(rounds)):
    start = time.process_time()
    value = run()
    seconds.append(time.process_time() - start)
print(json.dumps({"value": float(value), "unknowns": mesh.points.size, "seconds": min(seconds)}))
