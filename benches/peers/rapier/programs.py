"""Both programs: a scene, its run by either of them, and the distance between two motions."""

import json
import os
import pathlib
import subprocess
import sys
import tempfile
import time
import tomllib

ROOT = pathlib.Path(__file__).resolve().parents[3]
HERE = pathlib.Path(__file__).resolve().parent
# Paths of fem-bench and rapier-peer, which the command line sets.
PROGRAMS = {}


class Case:
    """A scene of this folder with a law."""

    def __init__(self, scene, law):
        self.scene, self.law = HERE / scene, law
        table = tomllib.loads(self.scene.read_text())
        shape = table["mesh"].get("rectangle") or table["mesh"]["box"]
        self.size, self.cells, self.material = shape["size"], shape["cells_per_unit"], table["material"]
        self.gravity, self.length = table["gravity"]["acceleration"], max(shape["size"])
        self.duration = table["time"]["dt"] * table["time"]["steps"]
        self.name = f"{self.scene.stem}, `{law}`"


class Run:
    """Final positions  (3n)  m, seconds of the steps and of the whole process; no positions where the run failed."""

    def __init__(self, q, steps_seconds, process_seconds, failure=""):
        self.q, self.physics, self.process, self.failure = q, steps_seconds, process_seconds, failure


def call(command):
    environment = {**os.environ, "RAYON_NUM_THREADS": "1"}
    start = time.perf_counter()
    done = subprocess.run([str(part) for part in command], capture_output=True, text=True, env=environment)
    return done, time.perf_counter() - start


class Ours:
    """An integrator of the engine, with further keys of the scene such as tolerances."""

    def __init__(self, integrator, precision, **keys):
        self.integrator, self.precision = integrator, precision
        self.keys = [f"{name.replace('__', '.')}={value}" for name, value in keys.items()]
        self.name = ", ".join([f"`{integrator}`", precision, *(f"`{key}`" for key in self.keys)])

    def is_known(self, case):
        """Whether the program has the integrator and the keys."""
        done, _ = call(self.command(case, 100))
        return done.returncode != 2

    def command(self, case, steps):
        keys = [
            f"material.model={case.law}",
            f"material.young={case.material['young']!r}",
            f"time.integrator={self.integrator}",
            f"time.precision={self.precision}",
            f"time.dt={case.duration / steps!r}",
            *self.keys,
        ]
        command = [PROGRAMS["ours"], "run", case.scene, "--steps", steps, "--data", ROOT / "data"]
        return command + [part for key in keys for part in ("--set", key)]

    def run(self, case, steps):
        done, seconds = call(self.command(case, steps))
        if done.returncode == 2:
            sys.exit(f"error: {done.stderr.strip()}")
        if done.returncode:
            return Run(None, None, None, done.stderr.strip())
        found = json.loads(done.stdout)
        if found["unconverged_steps"]:
            return Run(None, None, None, f"{found['unconverged_steps']} steps have not converged")
        return Run(found["positions"], found["wall_per_step"] * found["steps"], seconds)


class Theirs:
    """rapier's solver `Fem` with some of its settings."""

    def __init__(self, name, **settings):
        self.name, self.settings = name, {"damping": 0, "iterations": 2000, "max_dense": 0, "substeps": 1, **settings}

    def run(self, case, steps):
        material = case.material
        options = {
            "size": ",".join(map(str, case.size)),
            "gravity": ",".join(map(str, case.gravity)),
            "cells": case.cells,
            "law": case.law,
            "dt": repr(case.duration / steps),
            "steps": steps,
            **{key: material[key] for key in ["young", "poisson", "density"]},
            **self.settings,
        }
        with tempfile.NamedTemporaryFile(suffix=".json") as state:
            pairs = [("--" + key.replace("_", "-"), value) for key, value in [*options.items(), ("state", state.name)]]
            done, seconds = call([PROGRAMS["theirs"], *(part for pair in pairs for part in pair)])
            if done.returncode:
                sys.exit(f"error: {done.stderr.strip()}")
            found = json.loads(done.stdout)
            if not found["finite"]:
                return Run(None, None, None, "not finite")
            return Run(json.loads(pathlib.Path(state.name).read_text())["q"], found["seconds"], seconds)


def distance(case, a, b):
    """The largest distance of a node, in parts of the body's length; infinite if a number is not finite."""
    if a is None:
        return float("inf")
    squares = (sum((a[i + c] - b[i + c]) ** 2 for c in range(3)) for i in range(0, len(a), 3))
    largest = max((square if square == square else float("inf")) for square in squares)
    return largest**0.5 / case.length
