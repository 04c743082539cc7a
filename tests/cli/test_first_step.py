"""What a user waits for before the first step: nothing is imported that only some scenes or the results need."""

import subprocess
import sys
from types import SimpleNamespace

import numpy as np
import pytest
from scipy.sparse import coo_array
from scipy.sparse.csgraph import connected_components

from geometry.joints.find import connected

LATER = "gmsh matplotlib vtk pyvista meshio skfem h5py rich scipy.spatial scipy.sparse scipy.optimize scipy.stats"
BUILT = (
    "from masonry import scene; from masonry.laboratory import laboratory; laboratory.assemble(scene.load('couplet'))"
)


@pytest.mark.parametrize("code", ["import masonry", BUILT])
def test_what_some_scenes_or_the_results_need_is_not_imported_before_the_first_step(code):
    ask = f"import sys; {code}; print(*set(sys.argv[1:]) & sys.modules.keys())"
    done = subprocess.run([sys.executable, "-c", ask, *LATER.split()], capture_output=True, text=True, check=True)
    assert done.stdout.split() == []


@pytest.mark.parametrize(("blocks", "joints"), [(1, 0), (5, 2), (200, 90), (200, 190), (200, 800)])
def test_blocks_that_hang_together_have_one_number_in_order_of_their_first(blocks, joints):
    a, b = np.random.default_rng(joints).integers(0, blocks, (2, joints))
    link = coo_array((np.ones(joints), (a, b)), shape=(blocks, blocks))
    number = connected(SimpleNamespace(count=blocks), SimpleNamespace(block_a=a, block_b=b))
    assert np.array_equal(number, connected_components(link, directed=False)[1])


def test_a_run_of_numbers_hangs_together_in_any_order():
    row = np.random.default_rng(0).permutation(3000)
    number = connected(SimpleNamespace(count=3000), SimpleNamespace(block_a=row[:-1], block_b=row[1:]))
    assert number.max() == 0
