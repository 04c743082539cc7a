"""Files of many blocks that touch with noise, or that hold a block twice: what is wrong is said soon."""

import time

import numpy as np
import pytest

import masonry
from geometry.blocks import GeometryError
from masonry.importing.import_words import settings_of
from masonry.importing.importing import import_file
from tests.geometry.files.surface_files import obj

QUADS = [[1, 2, 4, 3], [5, 7, 8, 6], [1, 5, 6, 2], [3, 4, 8, 7], [1, 3, 7, 5], [2, 6, 8, 4]]


def dome(rings, sectors, noise):
    """Corners (8, 3) m of voussoirs of half a sphere, each corner of each block off by up to `noise` m along each axis,
    so that every face is bent and neighbours gape or overlap."""
    draw, blocks = np.random.default_rng(3), []
    for ring in range(rings):
        polar = np.deg2rad(90.0 - 75.0 * np.array([ring, ring + 1]) / rings)
        for sector in range(sectors):
            round_ = 2.0 * np.pi * (np.array([sector, sector + 1]) + 0.37 * (ring % 2)) / sectors
            r, a, q = np.meshgrid([3.0, 3.25], polar, round_, indexing="ij")
            places = np.stack([r * np.sin(a) * np.cos(q), r * np.sin(a) * np.sin(q), r * np.cos(a)], axis=-1)
            blocks.append(places.reshape(8, 3) + noise * draw.uniform(-1.0, 1.0, (8, 3)))
    return blocks


def written(folder, blocks):
    return obj(folder / "own.obj", *blocks, faces=QUADS, head="o b{0}")


def test_a_dome_of_399_blocks_with_noise_takes_as_long_as_so_many_blocks_do(tmp_path):
    """Against a dome of a fourth of them: where pairs are looked at one by one, both take minutes."""
    seconds = {}
    for rings in (5, 19):
        file, told = written(tmp_path, dome(rings, 21, 3e-4)), []
        began = time.process_time()
        with pytest.raises(GeometryError, match="larger than the tolerance of 0.1 mm"):
            import_file(file, None, settings_of({"unit": "m"}), tell=told.append)
        seconds[rings] = time.process_time() - began
        assert told[0] == f"{21 * rings} blocks: looks for gaps and overlaps, up to 0.1 mm"
    assert seconds[19] < 12.0 * seconds[5]


@pytest.mark.parametrize("noise", [0.0, 2e-5])
def test_a_block_that_is_there_twice_is_named_as_such(tmp_path, noise):
    blocks = dome(3, 9, 0.0)
    blocks.append(blocks[11] + noise * np.random.default_rng(1).uniform(-1.0, 1.0, (8, 3)))
    with pytest.raises(GeometryError, match="'b11' and 'b27' are the same block twice: leave one of them out"):
        masonry.import_blocks(written(tmp_path, blocks), unit="m")
    blocks[-1] = blocks[11] + [0.03, 0.0, 0.0]
    with pytest.raises(GeometryError, match="'b11' and 'b27' overlap by .* mm"):
        masonry.import_blocks(written(tmp_path, blocks), unit="m")


def test_a_file_far_from_its_origin_that_is_refused_says_how_far(tmp_path):
    corners = dome(3, 9, 0.0)[4] + [512_000.3, 5_200_000.7, 0.0]
    with pytest.raises(GeometryError, match="lie 5.2e.06 m from the origin.*: export them nearer to the origin"):
        masonry.import_blocks(obj(tmp_path / "own.obj", corners, faces=QUADS[:5]), unit="m")
    with pytest.raises(GeometryError, match="is not closed(?!.*origin)"):
        masonry.import_blocks(obj(tmp_path / "own.obj", dome(3, 9, 0.0)[4], faces=QUADS[:5]), unit="m")
