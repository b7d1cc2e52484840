"""Error against run time of bodies under their weight, beside the soft bodies of rapier2d and rapier3d, on one thread.

    cargo build --release -p fem-bench
    cargo build --release --locked --manifest-path benches/peers/rapier/Cargo.toml
    python benches/peers/rapier/compare.py > docs/reference/rapier.md      # about 10 minutes; --quick: the strip with two rounds

Options: `--ours PROGRAM` (fem-bench) and `--theirs PROGRAM` (rapier-peer), `--rounds N` (7).

Every motion runs on the same mesh with the same lumped mass, from rest to the end of the scene. The error is the largest distance of a node at the end from
a reference of the same law, in parts of the body's length. Each method is tried with more and more steps until it
reaches 10 %, 1 % and 0.1 %, implicit ones with looser tolerances of Newton's method and of the solver too; the methods that were fastest then run in turn, round after round, each in a process of its own, and
medians are printed: of the steps alone, and of the whole process with its start, the mesh and the output of the positions.
"""

import argparse
import os
import pathlib
import statistics
import subprocess
import sys
import time

from programs import HERE, PROGRAMS, ROOT, Case, Ours, Theirs, distance

TARGETS = [0.1, 0.01, 0.001]
LONGEST = 8.0  # s of steps in the search; a method that needs longer is left out
LADDER = sorted({round(2 * 2 ** (k / 3)) for k in range(46)})
RAPIER = "0.36.1"
PRECISIONS = ["f64", "f32"]
NEWTON = ["implicit_euler", "implicit_midpoint", "newmark", "generalized_alpha", "bdf2"]
OURS = [
    Ours(integrator, precision)
    for integrator in [*NEWTON, "linearly_implicit_euler", "semi_implicit_euler", "verlet", "rk4"]
    for precision in PRECISIONS
]
# Looser tolerances of a method, which begin with the steps that its own tolerances need.
SOLVERS = [("pcg", "ssor", tolerance) for tolerance in ["1e-3", "1e-2"]]
LOOSER = {
    method: [Ours(method.integrator, method.precision, newton__tolerance=tolerance) for tolerance in ["1e-4", "1e-2"]]
    if method.integrator in NEWTON
    else [
        Ours(method.integrator, method.precision, solver__kind=kind, solver__preconditioner=preconditioner, solver__tolerance=tolerance)
        for kind, preconditioner, tolerance in SOLVERS
    ]
    for method in OURS
    if method.integrator in [*NEWTON, "linearly_implicit_euler"]
}
THEIRS = [Theirs(f"PCG to {tolerance}", tolerance=tolerance) for tolerance in ["1e-5", "1e-3", "1e-2"]]


def references(case, quick):
    """The limits of both for small steps, and how well each is known; rapier's is of first order and extrapolated twice."""
    steps = round(case.duration * 2000)
    method = Ours("rk4", "f64")
    coarse, fine = (method.run(case, count).q for count in [steps, 2 * steps])
    if fine is None or coarse is None:
        sys.exit(f"error: {case.name}: the reference failed with {steps} steps")
    rapier = Theirs("f64", precision="f64", tolerance="1e-9")
    base = round(case.duration * (250 if quick else 500))
    one, two, four = (rapier.run(case, count * base).q for count in [1, 2, 4])
    limit = [(a - 6 * b + 8 * c) / 3 for a, b, c in zip(one, two, four)]
    once = [2 * c - b for b, c in zip(two, four)]
    return {
        "ours": fine,
        "theirs": limit,
        "self": distance(case, coarse, fine),
        "their_self": distance(case, once, limit),
        "between": distance(case, limit, fine),
    }


def search(case, method, reference, longest):
    """For each target the steps, the error and the run with the fewest steps of the ladder that reach it, or None if they take too long."""
    known, found = {}, []

    def at(place):
        if place not in known:
            run = method.run(case, LADDER[place])
            known[place] = (distance(case, run.q, reference), run)
        return known[place]

    place = 0
    for target in TARGETS:
        jump = 1
        while place < len(LADDER) and at(place)[0] > target:
            error, run = at(place)
            if run.physics is not None and run.physics > longest:
                place = len(LADDER)
                break
            # Far above the target, a method of first order needs twice the steps for half the error.
            jump = 3 if 2.5 * target < error < float("inf") else 1
            place += jump
        while jump > 1 and 0 < place < len(LADDER) and at(place - 1)[0] <= target:
            place -= 1
        found.append((LADDER[place], *at(place)) if place < len(LADDER) else None)
    return found


def repeat(case, method, reference, found):
    """The fewest steps with which another method reaches the targets, beginning with the steps that the first one needs."""

    def tried(place):
        run = method.run(case, LADDER[place])
        return LADDER[place], distance(case, run.q, reference), run

    def again(entry, target):
        if not entry:
            return None
        place, best = LADDER.index(entry[0]), None
        while place >= 0 and (now := tried(place))[1] <= target:
            best, place = now, place - 1
        if not best and place + 1 < len(LADDER) and (now := tried(place + 1))[1] <= target:
            best = now
        return best

    return [again(entry, target) for entry, target in zip(found, TARGETS)]


def known(case):
    """Our methods, and the looser tolerances of each, that the program has."""
    ours = [method for method in OURS if method.is_known(case)]
    for method in sorted({method.integrator for method in OURS} - {method.integrator for method in ours}):
        print(f"note: fem-bench has no {method}", file=sys.stderr)
    return ours, {method: [looser for looser in LOOSER.get(method, []) if looser.is_known(case)] for method in ours}


def study(case, rounds, quick):
    """Prints the rows of a case and returns the row of its references."""
    reference = references(case, quick)
    ours, looser = known(case)
    every = ours + [method for methods in looser.values() for method in methods]
    of = {method: reference["ours" if isinstance(method, Ours) else "theirs"] for method in every + THEIRS}
    # The corotated laws are the same: one reference for both.
    if case.law == "corotated":
        of = {method: reference["ours"] for method in of}
    tight = search(case, THEIRS[0], of[THEIRS[0]], LONGEST)
    reached = {THEIRS[0]: tight, **{method: repeat(case, method, of[method], tight) for method in THEIRS[1:]}}
    slowest = max((entry[2].physics for entry in tight if entry), default=LONGEST)
    for method in ours:
        reached[method] = search(case, method, of[method], 1.5 * slowest)
        reached |= {other: repeat(case, other, of[other], reached[method]) for other in looser[method]}
    defaults = Theirs("defaults: 1/60 s, 4 substeps, 20 iterations, damping 1", damping=1, iterations=20, max_dense=600, substeps=4)
    frames = round(case.duration * 60)
    contenders = [(defaults, frames, distance(case, defaults.run(case, frames).q, of[THEIRS[0]]), None)]
    for number, target in enumerate(TARGETS):
        for group, count in [(every, 2), (THEIRS, 1)]:
            able = [(reached[method][number][2].physics, method) for method in group if reached[method][number]]
            for _, method in sorted(able, key=lambda pair: pair[0])[:count]:
                contenders.append((method, *reached[method][number][:2], target))
    times = [[] for _ in contenders]
    for _ in range(rounds):
        for (method, steps, *_), seconds in zip(contenders, times):
            run = method.run(case, steps)
            seconds.append((run.physics, run.process))
    rows(case, contenders, [[statistics.median(column) for column in zip(*seconds)] for seconds in times])
    name = case.name
    return f"| {name} | {reference['self']:.0e} | {reference['their_self']:.0e} | {reference['between']:.1e} |"


def stiff():
    """Prints the deflection of a stiff strip at rest: our equilibrium, and rapier's after 5 s with its damping."""
    case = Case("strip.toml", "corotated")
    tip = 3 * round(case.size[0] * case.cells) + 1
    case.duration = 5.0
    case.material["young"] = 1e9
    print("| method | deflection of the tip, m | steps alone, ms |\n|---|---:|---:|")
    tries = [("ours: `static`", Ours("static", "f64"), 1)]
    for what, settings in [
        ("defaults: 4 substeps, at most 20 iterations", {"substeps": 4, "iterations": 20}),
        ("12 substeps, at most 20 iterations", {"substeps": 12, "iterations": 20}),
        ("4 substeps, iterations without a bound", {"substeps": 4, "iterations": 100000}),
    ]:
        tries.append((f"rapier: {what}", Theirs(what, damping=1, max_dense=600, **settings), 300))
    for name, method, steps in tries:
        run = method.run(case, steps)
        if run.q is None:
            sys.exit(f"error: {name}: {run.failure}")
        print(f"| {name} | {-run.q[tip]:.4f} | {1e3 * run.physics:.1f} |", flush=True)


def rows(case, contenders, medians):
    best = {}
    for (method, _, _, target), times in zip(contenders, medians):
        if isinstance(method, Theirs) and target:
            best[target] = times
    for (method, steps, error, target), (physics, process) in zip(contenders, medians):
        who = "ours" if isinstance(method, Ours) else "rapier"
        ratios = "" if target is None else "– | –"
        if who == "ours" and target in best:
            ratios = f"{best[target][0] / physics:.1f} | {best[target][1] / process:.1f}"
        elif target is None:
            ratios = " | "
        wanted = "" if target is None else f"{100 * target:g} %"
        print(f"| {case.name} | {wanted} | {who}: {method.name} | {steps} | {100 * error:.3f} % | {1e3 * physics:.1f} | {1e3 * process:.1f} | {ratios} |", flush=True)


def text_of(command):
    try:
        return subprocess.run(command, capture_output=True, text=True, cwd=ROOT).stdout.strip()
    except OSError:
        return "unknown"


def machine():
    cpu = next((line.split(":")[1].strip() for line in open("/proc/cpuinfo") if line.startswith("model name")), "unknown")
    commit, rustc = text_of(["git", "rev-parse", "--short", "HEAD"]), text_of(["rustc", "--version"])
    return f"Measured on {time.strftime('%Y-%m-%d')}: rapier {RAPIER}, finite-elements-3d at {commit}, {rustc}, RUSTFLAGS=\"{os.environ.get('RUSTFLAGS', '')}\", {cpu}, one thread."


def main():
    targets = pathlib.Path(os.environ.get("CARGO_TARGET_DIR", ROOT / "target"))
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--ours", type=pathlib.Path, default=targets / "release/fem-bench")
    parser.add_argument("--theirs", type=pathlib.Path, default=HERE / "target/release/rapier-peer")
    parser.add_argument("--rounds", type=int, default=7)
    parser.add_argument("--quick", action="store_true")
    arguments = parser.parse_args()
    PROGRAMS.update(ours=arguments.ours, theirs=arguments.theirs)
    for program in PROGRAMS.values():
        if not program.is_file():
            parser.error(f"{program}: no such program; build it as the first lines of --help say, or give its path")
    cases = [Case("strip.toml", "corotated"), Case("strip.toml", "stable_neo_hookean"), Case("beam.toml", "corotated"), Case("beam.toml", "stable_neo_hookean")]
    if arguments.quick:
        cases, arguments.rounds = cases[:1], 2
    print((HERE / "page.md").read_text().format(machine=machine(), rounds=arguments.rounds))
    print("| scene | error at most | method | steps | error | steps alone, ms | whole process, ms | rapier's time / ours, steps | process |\n|---|---|---|---:|---:|---:|---:|---:|---:|")
    found = [study(case, arguments.rounds, arguments.quick) for case in cases]
    print("\n## References\n\nDistances in parts of the body's length.\n")
    print("| scene | ours: RK4 at 0.5 ms and at 0.25 ms | rapier: extrapolated once and twice | between both limits |\n|---|---:|---:|---:|")
    print("\n".join(found))
    print("\n## A stiff strip\n\nThe strip with E = 1e9 Pa in equilibrium; rapier's after 5 s in frames of 1/60 s, with its damping, which does not change an equilibrium.\n")
    stiff()


main()
