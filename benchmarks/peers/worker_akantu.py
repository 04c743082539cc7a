"""Steps of Akantu, timed in its own Python: `python worker_akantu.py tets|loose|cohesive`.

A cube of linear elastic tets, explicit steps with lumped masses. `tets`: neighbours share nodes. `loose`: every tet has
nodes of its own. `cohesive`: as loose, with a bilinear cohesive element in every face between two tets. Steps go in on
standard input, a number a line; seconds of processor come out on lines that begin with PEER, after one line of JSON
that says what there is. The cube stretches fast enough that joints soften.
"""

import itertools
import json
import sys
import tempfile
import time
from pathlib import Path

import akantu
import numpy as np

CUBES, SIDE = 8, 0.01
SOLID = """material elastic [
  name = solid
  rho = 1900
  E = 10e9
  nu = 0.2
]
"""
JOINT = """material cohesive_bilinear [
  name = joint
  sigma_c = 0.3e6
  beta = 1
  kappa = 1
  G_c = 10
  delta_0 = 1e-6
  penalty = 1e12
]
"""


def grid() -> tuple[np.ndarray, np.ndarray]:
    """Nodes (N, 3) m and tets (T, 4): every cube is cut into six along its diagonal."""
    axis = np.arange(CUBES + 1)
    nodes = np.stack(np.meshgrid(axis, axis, axis, indexing="ij"), axis=-1).reshape(-1, 3)
    number = np.arange(len(nodes)).reshape((CUBES + 1,) * 3)
    tets = []
    for order in itertools.permutations(range(3)):
        path = np.concatenate([np.zeros((1, 3), dtype=int), np.cumsum(np.eye(3, dtype=int)[list(order)], axis=0)])
        corners = [number[x : x + CUBES, y : y + CUBES, z : z + CUBES].ravel() for x, y, z in path]
        upright = np.linalg.det(np.diff(path, axis=0)) > 0
        tets.append(np.stack(corners if upright else [corners[k] for k in (1, 0, 2, 3)], axis=1))
    return nodes * (SIDE / CUBES), np.concatenate(tets)


def write_mesh(path: Path, nodes: np.ndarray, tets: np.ndarray) -> None:
    """A Gmsh file of version 2.2."""
    lines = ["$MeshFormat", "2.2 0 8", "$EndMeshFormat", "$Nodes", str(len(nodes))]
    lines += [f"{i} {x!r} {y!r} {z!r}" for i, (x, y, z) in enumerate(nodes.tolist(), 1)]
    lines += ["$EndNodes", "$Elements", str(len(tets))]
    lines += [f"{i} 4 2 1 1 {a} {b} {c} {d}" for i, (a, b, c, d) in enumerate((tets + 1).tolist(), 1)]
    path.write_text("\n".join([*lines, "$EndElements", ""]))


def model_of(kind: str) -> tuple[akantu.Mesh, akantu.SolidMechanicsModel]:
    """A model ready to step, and its mesh, which must live as long."""
    nodes, tets = grid()
    if kind == "loose":
        nodes, tets = nodes[tets.ravel()], np.arange(tets.size).reshape(-1, 4)
    with tempfile.TemporaryDirectory() as folder:
        write_mesh(Path(folder, "cube.msh"), nodes, tets)
        Path(folder, "materials.dat").write_text(SOLID + (JOINT if kind == "cohesive" else ""))
        akantu.parseInput(str(Path(folder, "materials.dat")))
        mesh = akantu.Mesh(3)
        mesh.read(str(Path(folder, "cube.msh")))
    if kind == "cohesive":
        model = akantu.SolidMechanicsModelCohesive(mesh)
        model.initFull(_analysis_method=akantu._explicit_lumped_mass, _is_extrinsic=False)
    else:
        model = akantu.SolidMechanicsModel(mesh)
        model.initFull(_analysis_method=akantu._explicit_lumped_mass)
    model.setTimeStep(0.3 * model.getStableTimeStep())
    model.getVelocity()[:, 0] = 20.0 * mesh.getNodes()[:, 0] / SIDE
    return mesh, model


def main(kind: str) -> None:
    mesh, model = model_of(kind)
    points = 0
    if kind == "cohesive":
        points = model.getMaterial(1).getInternalReal("damage")(akantu._cohesive_3d_6).size
    tets = mesh.getNbElement(type=akantu._tetrahedron_4)
    print("PEER", json.dumps({"version": akantu.__version__, "tets": tets, "points": points}), flush=True)
    for line in sys.stdin:
        begun = time.process_time()
        for _ in range(int(line)):
            model.solveStep()
        print("PEER", time.process_time() - begun, flush=True)


main(sys.argv[1])
