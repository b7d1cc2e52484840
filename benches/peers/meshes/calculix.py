"""Runs CalculiX on an `.inp` that this library has written, and the engine on the same bar: linear tetrahedra, two materials that sets of
elements name, a clamped end, forces on the nodes of the other end and a pressure on a surface. Prints both displacements of that end.

    cargo build --release && apt-get install calculix-ccx
    python3 benches/peers/meshes/calculix.py target/release/finite-elements-3d
"""

import json
import os
import subprocess
import sys
import tempfile

HERE = os.path.dirname(os.path.abspath(__file__))
BAR = os.path.join(HERE, "../../../crates/mesh/tests/mesh/other_programs/matrix/tetgen_quality.ele")
PROGRAM = os.path.abspath(sys.argv[1])
# Set 10 is the half at the clamped end, 20 the other one; surface 9 is the free end, of 1 m².
SOFT, STIFF, POISSON = 1e9, 3e9, 0.3
FORCE, PRESSURE = -1.0, 5.0


def run(folder, *command):
    done = subprocess.run(command, cwd=folder, capture_output=True, text=True)
    if done.returncode or "*ERROR" in done.stdout:
        sys.exit(f"{' '.join(command)}\n{done.stdout[-2000:]}{done.stderr}")
    return done.stdout


def nodes(path):
    rows, is_inside = {}, False
    for line in open(path):
        if line.startswith("*"):
            is_inside = line.strip().upper() == "*NODE"
        elif is_inside:
            number, *place = line.split(",")
            rows[int(number)] = tuple(map(float, place))
    return rows


def by_calculix(folder, clamped, loaded):
    lines = ["*INCLUDE, INPUT=bar.inp"]
    for name, young, elements in [("SOFT", SOFT, 10), ("STIFF", STIFF, 20)]:
        lines += [f"*MATERIAL, NAME={name}", "*ELASTIC", f"{young}, {POISSON}", f'*SOLID SECTION, ELSET="{elements}", MATERIAL={name}']
    lines += ["*NSET, NSET=LOADED"] + [str(node) for node in loaded] + ["*BOUNDARY"] + [f"{node}, 1, 3" for node in clamped]
    lines += ["*STEP", "*STATIC", "*CLOAD"] + [f"{node}, 2, {FORCE}" for node in loaded]
    lines += ["*DSLOAD", f'"9", P, {PRESSURE}', "*NODE PRINT, NSET=LOADED", "U", "*END STEP"]
    with open(os.path.join(folder, "deck.inp"), "w") as out:
        out.write("\n".join(lines) + "\n")
    run(folder, "ccx", "deck")
    rows = [line.split() for line in open(os.path.join(folder, "deck.dat"))]
    return {int(row[0]): [float(u) for u in row[1:]] for row in rows if len(row) == 4 and row[0].isdigit()}


def by_engine(folder, loaded):
    with open(os.path.join(folder, "bar.toml"), "w") as out:
        out.write(f"""pipeline = "engine"
[mesh]
file = "bar.inp"
[material]
model = "linear"
young = {SOFT}
poisson = {POISSON}
density = 1000.0
[[materials]]
set = "20"
model = "linear"
young = {STIFF}
poisson = {POISSON}
density = 1000.0
[fixed]
plane = {{ axis = "x", below = 1e-9 }}
[[force]]
nodes = {[node - 1 for node in loaded]}
value = [0, {FORCE}, 0]
[[traction]]
set = "9"
pressure = {PRESSURE}
[time]
integrator = "static"
steps = 1
""")
    run(folder, PROGRAM, "bar.toml", "--headless", "--state", "state.json")
    with open(os.path.join(folder, "state.json")) as state:
        u = json.load(state)["displacements"]
    return {node: u[3 * node - 3 : 3 * node] for node in loaded}


with tempfile.TemporaryDirectory() as folder:
    run(folder, PROGRAM, "mesh", "convert", BAR, "bar.inp")
    places = nodes(os.path.join(folder, "bar.inp"))
    clamped, loaded = ([node for node, place in places.items() if place[0] == x] for x in [0.0, 2.0])
    calculix, engine = by_calculix(folder, clamped, loaded), by_engine(folder, loaded)
print(f"{len(places)} nodes; the free end's {len(loaded)}\n\n| node | CalculiX, m | engine, m |\n|---|---|---|")
for node in loaded:
    row = (" ".join(f"{x:.6e}" for x in u[node]) for u in [calculix, engine])
    print(f"| {node} | " + " | ".join(row) + " |")
largest = max(abs(x) for u in calculix.values() for x in u)
apart = max(abs(a - b) for node in loaded for a, b in zip(calculix[node], engine[node]))
print(f"\nLargest difference over the largest displacement: {apart / largest:.1e}")
