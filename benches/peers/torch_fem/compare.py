"""Von Mises plasticity of one element beside torch-fem's, in plane strain.

    pip install -r benches/peers/torch_fem/requirements.txt
    cargo build --release
    python benches/peers/torch_fem/compare.py [PROGRAM] > docs/reference/torch-fem.md

PROGRAM is `finite-elements-3d`, in target/release by default. A square of two triangles gets a homogeneous deformation F(t), all of whose nodes
are prescribed. torch-fem's law has small strains. The law of `[plasticity] model = "j2"` is the same in the logarithmic
strain and the Kirchhoff stress τ = J σ as long as the principal axes of F stay where they are (Simo 1992), however large the strains. So
the first table compares τ for F = Q exp(diag(a, b)) Qᵀ, where torch-fem gets the increments of the logarithmic strain; it has to agree to 1e-8. In the second one the axes
turn: a simple shear, of which torch-fem gets the linear strain, so the difference has to fall with the strain. Exit code 1 otherwise.
"""

import base64
import pathlib
import re
import subprocess
import sys
import tempfile
import time
from importlib.metadata import version

import numpy as np
import torch
from torchfem.materials import IsotropicPlasticityPlaneStrain

ROOT = pathlib.Path(__file__).resolve().parents[3]
YOUNG, POISSON, YIELD, HARDENING = 1e5, 0.3, 1e3, 2e3
ALLOWED = 1e-8
STEPS = 20  # of each stretch of a path


def path(corners):
    """Straight lines between the corners, STEPS points on each, from zero."""
    corners = np.array([np.zeros(len(corners[0])), *corners], dtype=float)
    parts = np.linspace(0, 1, STEPS + 1)[1:, None]
    return np.concatenate([a + parts * (b - a) for a, b in zip(corners, corners[1:])])


COAXIAL = [
    ("tension, unloading, compression, tension", 0, [(0.05, 0), (0.043, 0), (-0.05, 0), (0.08, 0)]),
    ("the same, axes at 30°", 30, [(0.05, 0), (0.043, 0), (-0.05, 0), (0.08, 0)]),
    ("one axis after the other, and back", 30, [(0.04, 0), (0.04, 0.06), (-0.02, 0.06), (0, 0)]),
    ("large strains: 0.4, then −0.3 across", 17, [(0.4, -0.1), (0.1, -0.3), (0.1, 0.3)]),
    ("elastic: 0.4 % and back", 30, [(0.004, -0.002), (-0.003, 0.004), (0, 0)]),
]


def scene(gradients, yield_stress, hardening):
    """A scene in which node X moves to F X at the end of every step; gradients  (n, 2, 2)  are F − 1."""
    text = f"""about = "a square under a prescribed homogeneous deformation"
pipeline = "engine"
[mesh]
rectangle = {{ size = [1, 1], cells_per_unit = 1 }}
[material]
model = "hencky"
young = {YOUNG!r}
poisson = {POISSON!r}
density = 1000.0
[plasticity]
model = "j2"
yield_stress = {yield_stress!r}
hardening = {hardening!r}
[time]
dt = 1.0
integrator = "implicit_euler"
steps = {len(gradients)}
[fixed]
nodes = [0]
"""
    for node, X in [(1, (1, 0)), (2, (0, 1)), (3, (1, 1))]:
        moved = gradients @ np.array(X, dtype=float)
        for axis, name in enumerate("xy"):
            table = ", ".join(f"[{k + 1}.0, {float(u)!r}]" for k, u in enumerate(moved[:, axis]))
            direction = ["[1, 0, 0]", "[0, 1, 0]"][axis]
            text += f"[[prescribed]]\nnodes = [{node}]\ndisplacement = {direction}\ncomponents = [\"{name}\"]\n"
            text += f"curve = {{ table = [[0.0, 0.0], {table}] }}\n"
    return text


def field(vtu, name):
    """Values of a field in the cells of a .vtu, one row for each triangle."""
    coded = re.search(rf'<DataArray[^>]*Name="{name}"[^>]*>\s*([^<\s]+)', vtu).group(1)
    return np.frombuffer(base64.b64decode(coded)[8:], dtype="<f8").reshape(2, -1)


def ours(program, gradients, yield_stress, hardening):
    """Kirchhoff stresses  (n, 3, 3), Pa, and equivalent plastic strains  (n)."""
    with tempfile.TemporaryDirectory() as folder:
        folder = pathlib.Path(folder)
        (folder / "square.toml").write_text(scene(gradients, yield_stress, hardening))
        command = [program, folder / "square.toml", "--headless", "--vtu-series", folder / "series"]
        run = subprocess.run(command, capture_output=True, text=True)
        if run.returncode:
            sys.exit(f"error: {program} ended with {run.returncode}: {run.stderr.strip()}")
        files = sorted((folder / "series").glob("*.vtu"))[1:]
        if len(files) != len(gradients):
            sys.exit(f"error: {len(files)} files of {len(gradients)} steps in the series")
        texts = [file.read_text() for file in files]
    stress = np.array([field(text, "stress") * field(text, "J") for text in texts])
    strain = np.array([field(text, "plastic_strain")[:, 0] for text in texts])
    for values, what in [(stress, "stress"), (strain, "plastic strain")]:
        if np.ptp(values, axis=1).max() > 1e-9 * np.abs(values).max():
            sys.exit(f"error: the two triangles differ in their {what}")
    return stress[:, 0].reshape(-1, 3, 3), strain[:, 0]


def theirs(strains, yield_stress, hardening):
    """The same of torch-fem for linear strains  (n, 2, 2), increment by increment."""
    material = IsotropicPlasticityPlaneStrain(
        YOUNG, POISSON, lambda q: yield_stress + hardening * q, lambda q: hardening * torch.ones_like(q), tolerance=1e-10
    ).vectorize(1)
    stress, state = torch.zeros(1, 2, 2), torch.zeros(1, 2)
    F, none, length = torch.eye(2)[None], torch.zeros(1, 2, 2), torch.ones(1, 1)
    stresses, plastic, before = [], [], np.zeros((2, 2))
    for strain in strains:
        stress, state, _ = material.step(torch.tensor(strain - before)[None], F, stress, state, none, length, 0)
        before = strain
        full = np.zeros((3, 3))
        full[:2, :2] = stress[0].numpy()
        full[2, 2] = POISSON * (full[0, 0] + full[1, 1]) - YOUNG * float(state[0, 1])
        stresses.append(full)
        plastic.append(float(state[0, 0]))
    return np.array(stresses), np.array(plastic)


def difference(a, b):
    largest = np.abs(b).max()
    return np.abs(a - b).max() / largest if largest > 0 else np.abs(a).max()


def coaxial(program):
    print("| path of the principal logarithmic strains | steps | largest τ, Pa | plastic strain α at the end | difference of τ | of α |")
    print("|---|---:|---:|---:|---:|---:|")
    worst = 0.0
    for name, degrees, corners in COAXIAL:
        c, s = np.cos(np.radians(degrees)), np.sin(np.radians(degrees))
        Q = np.array([[c, -s], [s, c]])
        strains = path(corners)
        gradients = np.array([Q @ np.diag(np.expm1(e)) @ Q.T for e in strains])
        tau, alpha = ours(program, gradients, YIELD, HARDENING)
        expected, plastic = theirs(np.array([Q @ np.diag(e) @ Q.T for e in strains]), YIELD, HARDENING)
        found = difference(tau, expected), difference(alpha, plastic)
        worst = max(worst, *found)
        print(f"| {name} | {len(strains)} | {np.abs(expected).max():.6g} | {plastic[-1]:.6f} | {found[0]:.1e} | {found[1]:.1e} |")
    return worst


def shear(program):
    print("| largest shear γ | difference of τ | of α |\n|---:|---:|---:|")
    found = []
    for scale in [1e-2, 1e-3, 1e-4, 1e-5]:
        gradients = np.array([[[0, g[0]], [0, 0]] for g in path([(scale,), (-scale,), (scale,)])])
        yield_stress = 0.3 * YOUNG * scale
        tau, alpha = ours(program, gradients, yield_stress, HARDENING)
        expected, plastic = theirs(gradients, yield_stress, HARDENING)
        found.append(difference(tau, expected))
        print(f"| {scale:g} | {found[-1]:.1e} | {difference(alpha, plastic):.1e} |")
    return found


def main():
    torch.set_default_dtype(torch.float64)
    program = pathlib.Path(sys.argv[1]) if len(sys.argv) > 1 else ROOT / "target/release/finite-elements-3d"
    if not program.is_file():
        sys.exit(f"error: {program}: no such program; build it with cargo build --release, or give its path")
    print("# Plasticity of one element beside torch-fem\n")
    print(f"Measured on {time.strftime('%Y-%m-%d')}: torch-fem {version('torch-fem')} (`IsotropicPlasticityPlaneStrain`), torch {version('torch')}; E = {YOUNG:g} Pa, ν = {POISSON}, yield stress {YIELD:g} Pa, hardening {HARDENING:g} Pa.")
    print("`python benches/peers/torch_fem/compare.py` prints this page. Differences are the largest over all steps and components, in parts of the largest value.\n")
    print("Principal axes that stay where they are: torch-fem gets the logarithmic strain, and its stress is compared with τ = J σ. Both laws are then the same at any strain.\n")
    worst = coaxial(program)
    print("\nSimple shear to γ, −γ and γ, whose axes turn; the yield stress is 0.3 E γ. torch-fem gets the linear strain, so the laws differ by the order of the strain.\n")
    falls = shear(program)
    if not worst <= ALLOWED:
        sys.exit(f"error: the stresses of coaxial paths differ by {worst:.1e}; {ALLOWED:.0e} is allowed")
    if not all(b <= 0.2 * a for a, b in zip(falls, falls[1:])):
        sys.exit("error: the difference in simple shear does not fall with the strain")


main()
