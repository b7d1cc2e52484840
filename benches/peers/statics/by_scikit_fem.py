"""A case by scikit-fem: python by_scikit_fem.py CASE ELEMENT NX,NY,NZ SOLVER ROUNDS

ELEMENT is `tet10` or `hex27`. SOLVER is `scipy` (SuperLU, the default of `skfem.solve`) or `pardiso`. The block has Taylor–Hood elements, as in scikit-fem's
example 36: linear pressures beside the displacements. Prints value, unknowns and the shortest processor time as JSON.
"""

import dataclasses
import json
import sys
import time

import numpy as np
import pypardiso
from cases import CASES
from scipy.sparse import bmat
from skfem import Basis, BilinearForm, ElementHex1, ElementHex2, ElementTetP1, ElementTetP2, ElementVector, FacetBasis, LinearForm
from skfem import MeshHex, MeshHex2, MeshTet, MeshTet2, solve
from skfem.helpers import ddot, det, grad, inv, mul, sym_grad, trace, transpose
from skfem.models.elasticity import lame_parameters, linear_elasticity

name, kind, cells, solver, rounds = sys.argv[1:]
case, cells, rounds = CASES[name], [int(n) for n in cells.split(",")], int(rounds)
Straight, Curved, Quadratic, Linear = {"tet10": (MeshTet, MeshTet2, ElementTetP2, ElementTetP1), "hex27": (MeshHex, MeshHex2, ElementHex2, ElementHex1)}[kind]
direct = pypardiso.spsolve if solver == "pardiso" else None
TOLERANCE = 1e-9  # of the residual of the block, relative to the load


def linear_solve(A, b):
    if direct is None:
        return solve(A, b)
    return direct(A.tocsr(), b)


def setting(unit, mesh):
    """Displacements, the constrained ones among them, the nodal forces, and a function for the vertical displacement of the case's point."""
    basis = Basis(mesh, ElementVector(Quadratic()), intorder=4)
    X = np.round(Basis(unit, basis.elem).doflocs, 12)
    component = np.zeros(basis.N, dtype=int)
    for i in range(3):
        component[basis.get_dofs(elements=True).all([f"u^{i + 1}"])] = i
    fixed = np.flatnonzero(case.constrained(*X)[component, np.arange(basis.N)])
    facets = unit.facets_satisfying(lambda x: case.is_loaded(*np.round(x, 12)), boundaries_only=True)
    load = LinearForm(lambda v, w: sum(t * v[i] for i, t in enumerate(case.traction)))
    distance = np.linalg.norm(X - np.array(case.point, float)[:, None], axis=0)
    vertical = lambda u: u[np.flatnonzero((distance < 1e-9) & (component == 2))[0]]
    return basis, fixed, load.assemble(FacetBasis(mesh, basis.elem, facets=facets, intorder=4)), vertical


def elastic(unit, mesh):
    basis, fixed, b, vertical = setting(unit, mesh)
    A = linear_elasticity(*lame_parameters(case.young, case.poisson)).assemble(basis)
    free = np.setdiff1d(np.arange(basis.N), fixed)
    u = np.zeros(basis.N)
    u[free] = linear_solve(A[free][:, free], b[free])
    if name == "twisted":
        return vertical(u), basis.N
    # The stress is projected onto continuous quadratic functions.
    lam, mu = lame_parameters(case.young, case.poisson)
    scalar = basis.with_element(Quadratic())
    e = sym_grad(basis.interpolate(u))
    stress = solve_projection(scalar, lam * trace(e) + 2 * mu * e[1, 1])
    corner = np.linalg.norm(np.round(Basis(unit, Quadratic()).doflocs, 12) - np.array(case.point, float)[:, None], axis=0).argmin()
    return stress[corner], basis.N


def solve_projection(scalar, values):
    mass = BilinearForm(lambda u, v, w: u * v).assemble(scalar)
    right = LinearForm(lambda v, w: w["values"] * v).assemble(scalar, values=values)
    return linear_solve(mass, right)


@BilinearForm
def stiffness(u, v, w):
    F, FiT, J, dF, dv = w["F"], w["FiT"], w["J"], grad(u), grad(v)
    a, b = ddot(FiT, dF), ddot(FiT, dv)
    back = ddot(mul(mul(FiT, transpose(dF)), FiT), dv)
    deviatoric = w["scale"] * (ddot(dF, dv) - 2 / 3 * (a * ddot(F, dv) + b * ddot(F, dF)) + w["square"] * (2 / 9 * a * b + back / 3))
    return deviatoric + w["p"] * J * (a * b - back)


@BilinearForm
def coupling(u, q, w):
    return q * w["J"] * ddot(w["FiT"], grad(u))


@BilinearForm
def compliance(p, q, w):
    return -p * q / case.bulk


@LinearForm
def forces(v, w):
    F, FiT, dv = w["F"], w["FiT"], grad(v)
    return w["scale"] * (ddot(F, dv) - w["square"] / 3 * ddot(FiT, dv)) + w["p"] * w["J"] * ddot(FiT, dv)


@LinearForm
def volumes(q, w):
    return q * (w["J"] - 1 - w["p"] / case.bulk)


def block(unit, mesh):
    basis, fixed, external, vertical = setting(unit, mesh)
    pressure = basis.with_element(Linear())
    n = basis.N
    free = np.setdiff1d(np.arange(n + pressure.N), fixed)
    u, p = np.zeros(n), np.zeros(pressure.N)
    mass = compliance.assemble(pressure)
    for iteration in range(30):
        F = grad(basis.interpolate(u)) + np.eye(3)[:, :, None, None]
        J = det(F)
        state = {"F": F, "FiT": transpose(inv(F)), "J": J, "p": pressure.interpolate(p)}
        state |= {"square": ddot(F, F), "scale": case.shear * J ** (-2 / 3)}
        residual = np.concatenate([external - forces.assemble(basis, **state), -volumes.assemble(pressure, **state)])[free]
        if np.linalg.norm(residual) < TOLERANCE * np.linalg.norm(external):
            break
        B = coupling.assemble(basis, pressure, **state)
        K = bmat([[stiffness.assemble(basis, **state), B.T], [B, mass]], "csr")
        change = np.zeros(n + pressure.N)
        change[free] = linear_solve(K[free][:, free], residual)
        u, p = u + change[:n], p + change[n:]
    else:
        sys.exit("error: Newton's method has not converged")
    return vertical(u), n + pressure.N


unit = Straight.init_tensor(*(np.linspace(0, 1, n + 1) for n in cells))
curved = Curved.from_mesh(unit)
curved = dataclasses.replace(curved, doflocs=case.map(np.round(curved.doflocs, 14)))
if name == "block":
    curved = dataclasses.replace(unit, doflocs=case.map(unit.doflocs))
seconds = []
for _ in range(rounds):
    start = time.process_time()
    value, unknowns = (block if name == "block" else elastic)(unit, curved)
    seconds.append(time.process_time() - start)
print(json.dumps({"value": float(value), "unknowns": int(unknowns), "seconds": min(seconds)}))
