"""Published solids by the engine and by CalculiX, FElupe and scikit-fem: error, degrees of freedom and processor time, one thread each.

    pip install -r benches/peers/statics/requirements.txt && apt-get install calculix-ccx
    cargo build --release -p fem-bench
    taskset -c 1 python benches/peers/statics/compare.py [PROGRAM [ROUNDS [CASE…]]] > docs/reference/statics.md

PROGRAM is `fem-bench`, in target/release by default. The runs take turns, ROUNDS times (3 by default), and the fastest of each counts. All of it takes a quarter of an
hour. Exit code 1 if a program's finest runs of a case are not near its converged value.
"""

import json
import os
import pathlib
import subprocess
import sys
import time
from importlib.metadata import version

HERE = pathlib.Path(__file__).resolve().parent
PROGRAM = sys.argv[1] if len(sys.argv) > 1 else str(HERE.parents[2] / "target/release/fem-bench")
ROUNDS = int(sys.argv[2]) if len(sys.argv) > 2 else 3
ONE_THREAD = {name: "1" for name in ["RAYON_NUM_THREADS", "OMP_NUM_THREADS", "MKL_NUM_THREADS", "CCX_NPROC_EQUATION_SOLVER"]}
SLOW = 3  # seconds of a run that is not repeated
LIMIT = 300  # seconds of a process, after which a run is left out

# Of each case: title, converged value, largest difference of the finest runs from it, levels of error, and the runs: program, element, further arguments, meshes.
CASES = {
    "le10": (
        "NAFEMS LE10: σ_yy at (2, 0, 0.6), Pa", -5.424e6, 2.5e-2, [3e-2, 1e-2, 5e-3],
        [
            ("ours", "quadratic tetrahedra", [], ["3,12,2", "6,24,2", "6,16,4", "6,24,4", "8,24,4", "9,36,6"]),
            ("ours", "quadratic tetrahedra", ["--solver", "ssor"], ["3,12,2", "6,24,2", "6,16,4", "6,24,4", "8,24,4", "9,36,6"]),
            ("calculix", "hex20", ["spooles"], ["3,6,2", "4,8,2", "6,8,4", "6,12,4", "8,16,4", "9,18,6"]),
            ("calculix", "tet10", ["spooles"], ["3,12,2", "6,16,4", "6,24,4", "9,36,6"]),
            ("felupe", "hex27", ["pardiso"], ["3,6,2", "4,8,2", "6,8,4", "6,12,4", "8,16,4", "9,18,6"]),
            ("scikit_fem", "hex27", ["pardiso"], ["3,6,2", "4,8,2", "6,8,4", "6,12,4", "8,16,4"]),
            ("scikit_fem", "tet10", ["pardiso"], ["3,12,2", "6,16,4", "6,24,4", "9,36,6"]),
            ("scikit_fem", "hex27", ["scipy"], ["6,12,4", "8,16,4"]),
        ],
    ),
    "twisted": (
        "MacNeal and Harder's twisted beam: displacement of the end along its long side, m", 0.0054237, 2e-3, [1e-2, 3e-3, 1e-3],
        [
            ("ours", "quadratic tetrahedra", [], ["12,2,1", "16,2,1", "24,2,1", "24,2,2", "24,4,2", "32,4,2", "36,6,3", "48,8,4"]),
            ("calculix", "hex20", ["spooles"], ["6,2,1", "12,2,1", "16,2,1", "24,2,1", "12,2,2", "24,2,2", "24,4,2", "32,4,2", "36,6,3"]),
            ("calculix", "tet10", ["spooles"], ["12,2,1", "24,2,2", "24,4,2", "36,6,3"]),
            ("felupe", "hex20", ["pardiso"], ["6,2,1", "12,2,1", "16,2,1", "24,2,1", "12,2,2", "24,2,2", "24,4,2", "32,4,2", "36,6,3"]),
            ("felupe", "tet10", ["pardiso"], ["12,2,1", "24,2,2", "24,4,2", "36,6,3"]),
            ("scikit_fem", "hex27", ["pardiso"], ["6,2,1", "12,2,1", "12,2,2", "18,3,2", "24,4,2"]),
            ("scikit_fem", "tet10", ["pardiso"], ["12,2,1", "24,2,2", "24,4,2", "36,6,3"]),
            ("scikit_fem", "tet10", ["scipy"], ["24,4,2"]),
        ],
    ),
    "block": (
        "Block, ν = 0.4999, under 160 MPa: displacement of the top's centre, mm", -21.26, 1e-2, [1e-2, 5e-3, 2.5e-3],
        [
            ("ours", "linear tetrahedra, mixed", ["--order", "1", "--volumetric", "mixed"], ["4,4,4", "6,6,6", "8,8,8", "12,12,12", "16,16,16"]),
            ("ours", "quadratic tetrahedra, mixed", ["--volumetric", "mixed"], ["2,2,2", "4,4,4", "6,6,6", "8,8,8"]),
            ("ours", "quadratic tetrahedra, averaged", ["--volumetric", "averaged"], ["4,4,4", "6,6,6", "8,8,8"]),
            ("calculix", "hex20", ["spooles"], ["2,2,2", "4,4,4", "6,6,6", "8,8,8"]),
            ("calculix", "tet10", ["spooles"], ["2,2,2", "4,4,4", "6,6,6"]),
            ("felupe", "hex20", ["pardiso"], ["2,2,2", "4,4,4", "6,6,6", "8,8,8", "10,10,10"]),
            ("felupe", "tet10", ["pardiso"], ["2,2,2", "4,4,4", "6,6,6", "8,8,8"]),
            ("scikit_fem", "tet10", ["pardiso"], ["2,2,2", "4,4,4", "6,6,6"]),
            ("scikit_fem", "hex27", ["pardiso"], ["2,2,2", "4,4,4"]),
        ],
    ),
}  # fmt: skip


def command(case, program, element, further, cells):
    if program == "ours":
        return [PROGRAM, "statics", case, "--cells", cells, "--rounds", "1", *further]
    return [sys.executable, str(HERE / f"by_{program}.py"), case, element, cells, *further, "1"]


def solver_of(program, further):
    """The name of a linear solver; of ours "" for the one that the engine chooses."""
    if program != "ours":
        return further[0]
    return further[further.index("--solver") + 1] if "--solver" in further else ""


def answer(arguments):
    """What a run prints, or None if it fails or takes too long."""
    try:
        done = subprocess.run(arguments, capture_output=True, text=True, timeout=LIMIT, env=os.environ | ONE_THREAD)
    except subprocess.TimeoutExpired:
        print(f"more than {LIMIT} s: {' '.join(arguments)}", file=sys.stderr)
        return None
    if done.returncode:
        print(f"{' '.join(arguments)}: {done.stderr.strip()[-300:]}", file=sys.stderr)
        return None
    return json.loads(done.stdout.splitlines()[-1])


def measured(case, runs):
    """(program, element, solver, cells) → answer with the shortest time; a run of which one try fails is left out."""
    found = {}
    for turn in range(ROUNDS):
        for program, element, further, meshes in runs:
            solver = solver_of(program, further)
            for cells in meshes:
                key = (program, element, solver, cells)
                # Slow runs vary little.
                if turn > 0 and (found[key] is None or found[key]["seconds"] > SLOW):
                    continue
                this = answer(command(case, program, element, further, cells))
                if turn == 0 or this is not None and this["seconds"] < found[key]["seconds"]:
                    found[key] = this
    return {key: this for key, this in found.items() if this}


def milliseconds(seconds):
    return f"{1e3 * seconds:.3g}"


def main():
    print("# Equilibria beside CalculiX, FElupe and scikit-fem\n")
    versions = ", ".join(f"{name} {version(name)}" for name in ["felupe", "scikit-fem", "scipy", "pypardiso"])
    ccx = subprocess.run(["ccx", "-v"], capture_output=True, text=True).stdout.split()[-1]
    cpu = next(line.split(":")[1].strip() for line in open("/proc/cpuinfo") if line.startswith("model name"))
    print(f"Measured on {time.strftime('%Y-%m-%d')}, {cpu}, one thread: CalculiX {ccx}, {versions}; load {os.getloadavg()[0]:.1f} at the start.\n")
    print("Milliseconds of processor time from the mesh in memory to the value, of CalculiX from the deck; the fastest of", ROUNDS, "runs in turn; what takes more than 3 s is run once. Errors are relative to the value that is named; unknowns count constrained displacements too. FElupe, scikit-fem and CalculiX have curved edges, ours are straight.")
    wrong = []
    for case in sys.argv[3:] or CASES:
        title, value, allowed, levels, runs = CASES[case]
        found = measured(case, runs)
        error = lambda key: abs(found[key]["value"] / value - 1)
        print(f"\n## {title}\n\nConverged value: {value:g}\n\n| program | element | solver | cells | unknowns | value | error (%) | ms | before the solution |\n|---|---|---|---|---:|---:|---:|---:|---:|")
        for key, this in found.items():
            print(f"| {' | '.join(key)} | {this['unknowns']} | {this['value']:.6g} | {100 * (this['value'] / value - 1):+.3f} | {milliseconds(this['seconds'])} | {milliseconds(this['seconds_setup']) if 'seconds_setup' in this else ''} |")
        print("\nThe fastest run of each program with an error of at most so much, as has every finer run of the series:\n")
        print("| error (%) | program | element | cells | unknowns | ms | its time over ours |\n|---:|---|---|---|---:|---:|---:|")
        for level in levels:
            fastest = {}
            for program, element, further, meshes in runs:
                solver = solver_of(program, further)
                series = [key for key in ((program, element, solver, cells) for cells in meshes) if key in found]
                wrong_ones = [i for i, key in enumerate(series) if error(key) > level]
                for key in series[max(wrong_ones, default=-1) + 1 :]:
                    if program not in fastest or found[key]["seconds"] < found[fastest[program]]["seconds"]:
                        fastest[program] = key
            for program, key in fastest.items():
                ratio = found[key]["seconds"] / found[fastest["ours"]]["seconds"] if "ours" in fastest else float("nan")
                print(f"| {100 * level:g} | {program} | {key[1]} | {key[3]} | {found[key]['unknowns']} | {milliseconds(found[key]['seconds'])} | {ratio:.2f} |")
        for program in ["ours", "calculix", "felupe", "scikit_fem"]:
            finest = {key[:3]: key for key in found if key[0] == program}.values()  # of each series
            nearest = min(finest, key=error, default=None)
            if nearest is None or not error(nearest) <= allowed:
                wrong.append(f"{case}: {program} does not come within {100 * allowed:g} %")
        sys.stdout.flush()
    if wrong:
        sys.exit("error: " + "; ".join(wrong))


if __name__ == "__main__":
    main()
