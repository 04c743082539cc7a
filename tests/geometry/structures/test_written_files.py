"""Every structure is written as STEP, a solid for each block, and as tets that fill it."""

import re

import meshio
import numpy as np
import pytest

from geometry.blocks import Specimen
from geometry.cells.request import CellRequest
from geometry.files.export import export
from geometry.polyhedra.measures import volumes
from geometry.structures.arch import arch
from geometry.structures.column import column
from geometry.structures.dome import dome
from geometry.structures.multi_leaf import multi_leaf
from geometry.structures.openings import Opening
from geometry.structures.vault import vault
from geometry.structures.wall import wall

CORE = CellRequest(total=12, space=True, regularise=False)
WALL = {
    "length": 3.0,
    "height": 1.44,
    "thickness": 0.12,
    "unit_length": 0.24,
    "unit_height": 0.08,
    "joint_thickness": 0.01,
}
BUILT = {
    "arch": lambda: arch(1.0, np.pi, 7, 0.2, 0.3, 1, "skewbacks"),
    "arch with facets": lambda: arch(1.0, np.pi, 7, 0.2, 0.3, 3),
    "vault": lambda: vault(1.0, np.pi, 7, 0.2, 1.0, 2),
    "dome": lambda: dome(1.0, 0.2, 3, 5, 0.2),
    "column": lambda: column(0.6, 2.0, 3, 8, 0.5, 0.2, 0.2),
    "wall": lambda: wall(**WALL, opening=[Opening("w", 1.0, 1.0, 0.54, 0.45, "flat arch")], base=0.1),
    "multi-leaf": lambda: multi_leaf(1.2, 0.6, 0.12, 0.2, 0.4, 0.1, CORE, headers=0.2),
}


@pytest.mark.parametrize("name", BUILT)
def test_a_structure_is_written_as_solids_and_as_tets(name, tmp_path):
    specimen: Specimen = BUILT[name]()
    export(tmp_path / "a.step", specimen)
    text = (tmp_path / "a.step").read_text(encoding="ascii")
    assert len(re.findall(r"MANIFOLD_SOLID_BREP", text)) == specimen.blocks.count
    if "keystone" in specimen.sets and len(specimen.sets["keystone"]) == 1:
        assert "keystone'" in text
    export(tmp_path / "a.vtu", specimen)
    mesh = meshio.read(tmp_path / "a.vtu")
    corners = mesh.points[mesh.cells_dict["tetra"]]
    six = np.linalg.det(corners[:, 1:] - corners[:, :1])
    assert six.min() > 0.0
    assert six.sum() / 6 == pytest.approx(volumes(specimen.blocks).sum(), rel=1e-9)
