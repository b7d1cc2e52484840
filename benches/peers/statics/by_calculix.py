"""A case by CalculiX: python by_calculix.py CASE ELEMENT NX,NY,NZ SOLVER ROUNDS

ELEMENT is `tet10` (C3D10) or `hex20` (C3D20R); SOLVER is that of *STATIC, such as `spooles`. The processor time is that of the process less that of one whose
deck has *NO ANALYSIS, which starts, reads and checks alone. Prints value, unknowns and the shortest processor time as JSON.
"""

import json
import pathlib
import re
import resource
import subprocess
import sys
import tempfile

from cases import CASES, Mesh

name, element, cells, solver, rounds = sys.argv[1:]
case = CASES[name]
mesh = Mesh(case, element, [int(n) for n in cells.split(",")])
TYPES = {"tet10": "C3D10", "hex20": "C3D20R"}


def deck(is_solved):
    lines = ["*NODE, NSET=ALL"] + [f"{i + 1}, {x:.11g}, {y:.11g}, {z:.11g}" for i, (x, y, z) in enumerate(mesh.points)]
    lines += [f"*ELEMENT, TYPE={TYPES[element]}, ELSET=SOLID"]
    for i, nodes in enumerate(mesh.elements + 1):
        numbers = [str(i + 1), *map(str, nodes)]
        lines += [", ".join(numbers[:11]) + ("," if len(numbers) > 11 else "")]
        lines += [", ".join(numbers[11:])] if len(numbers) > 11 else []
    lines += ["*NSET, NSET=POINT", str(mesh.node + 1), "*MATERIAL, NAME=M"]
    is_large = name == "block"
    # W = C10 (I1 − 3) + (J − 1)²/D1
    lines += ["*HYPERELASTIC, NEO HOOKE", f"{case.shear / 2:.11g}, {2 / case.bulk:.11g}"] if is_large else ["*ELASTIC", f"{case.young}, {case.poisson}"]
    lines += ["*SOLID SECTION, ELSET=SOLID, MATERIAL=M", "*BOUNDARY"]
    lines += [f"{i + 1}, {axis + 1}, {axis + 1}" for i, row in enumerate(mesh.constrained) for axis in range(3) if row[axis]]
    lines += ["*STEP, NLGEOM, INC=200" if is_large else "*STEP", f"*STATIC, SOLVER={solver}"] + (["0.25, 1.0, 1e-5, 0.25"] if is_large else [])
    lines += [] if is_solved else ["*NO ANALYSIS"]
    lines += ["*CLOAD"] + [f"{i + 1}, {axis + 1}, {f:.11g}" for i, row in enumerate(mesh.forces) for axis, f in enumerate(row) if f != 0]
    lines += ["*NODE PRINT, NSET=POINT, FREQUENCY=1000", "U"]
    lines += ["*EL FILE, NSET=POINT", "S"] if name == "le10" else []
    return "\n".join([*lines, "*END STEP", ""])


def processor_seconds():
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    return used.ru_utime + used.ru_stime


def seconds(folder, is_solved):
    """Processor time of a run, and its iterations."""
    (folder / "deck.inp").write_text(deck(is_solved))
    start = processor_seconds()
    done = subprocess.run(["ccx", "deck"], cwd=folder, capture_output=True, text=True)
    taken = processor_seconds() - start
    # *NO ANALYSIS ends with the code 201.
    if "*ERROR" in done.stdout or done.returncode and is_solved:
        sys.exit(f"error: ccx\n{done.stdout[-2000:]}{done.stderr}")
    return taken, done.stdout.count("\n iteration ")


with tempfile.TemporaryDirectory() as folder:
    folder = pathlib.Path(folder)
    reading = min(seconds(folder, False)[0] for _ in range(int(rounds)))
    times = [seconds(folder, True) for _ in range(int(rounds))]
    if name == "le10":
        # Rows of a result in .frd are fixed columns: node, then xx yy zz xy yz zx.
        rows = re.search(r"STRESS.*?\n( -1.*?)\n -3", (folder / "deck.frd").read_text(), re.S).group(1).splitlines()
        row = next(row for row in rows if row.startswith(" -1") and int(row[3:13]) == mesh.node + 1)
        value = float(row[25:37])
    else:
        rows = [line.split() for line in (folder / "deck.dat").read_text().splitlines()]
        value = float([row for row in rows if len(row) == 4 and row[0].isdigit()][-1][3])
print(json.dumps({"value": value, "unknowns": mesh.points.size, "newton_iterations": times[0][1], "seconds": min(times)[0] - reading, "reading": reading}))
