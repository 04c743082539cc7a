import subprocess
import sys
import time

import numpy as np
import pytest
from scipy.spatial import Voronoi

from geometry.blocks import GeometryError
from geometry.files.tess import read_tess
from geometry.joints.find import find_joints
from geometry.polyhedra.measures import bounds, face_areas_normals_centroids, volumes
from geometry.polyhedra.validate import require_sound

SIDES = np.array([2.0, 1.0, 0.5])


def voronoi(count, sides, seed=3):
    """Vertices, faces (loops) and cells (signed faces from 1) of a box divided round random seeds, walls by mirrors."""
    dimension = len(sides)
    seeds = np.random.default_rng(seed).random((count, dimension)) * sides
    mirrored = [seeds]
    for axis in range(dimension):
        for wall in (0.0, sides[axis]):
            image = seeds.copy()
            image[:, axis] = 2 * wall - image[:, axis]
            mirrored.append(image)
    diagram = Voronoi(np.concatenate(mirrored))
    loops, cells = [], [[] for _ in range(count)]
    for (a, b), loop in zip(diagram.ridge_points, diagram.ridge_vertices, strict=True):
        if min(a, b) >= count:
            continue
        low, high = min(a, b), max(a, b)
        corners = diagram.vertices[loop]
        if dimension == 3:
            normal = np.cross(corners[1] - corners[0], corners[2] - corners[0])
            if normal @ (diagram.points[high] - diagram.points[low]) < 0:
                loop = loop[::-1]
        loops.append(loop)
        cells[low].append(len(loops))
        if high < count:
            cells[high].append(-len(loops))
    used = np.unique(np.concatenate(loops))
    number = {v: i for i, v in enumerate(used)}
    return diagram.vertices[used], [[number[v] for v in loop] for loop in loops], cells


def tess(vertices, loops, cells=None, state=None, version="3.4", extra="", digits=12):
    """Text of a .tess file; state: face -> (fan, middle) of regularised faces."""
    edges: dict = {}
    lines = []
    for f, loop in enumerate(loops):
        signed = []
        for a, b in zip(loop, [*loop[1:], loop[0]], strict=True):
            number = edges.setdefault((min(a, b), max(a, b)), len(edges) + 1)
            signed.append(number if a < b else -number)
        fan, middle = (state or {}).get(f, (0, (0, 0, 0)))
        lines += [
            f"   {f + 1} {len(loop)} " + " ".join(str(v + 1) for v in loop),
            f"     {len(signed)} " + " ".join(map(str, signed)),
            "    0 0 0 1",
            f"     {int(f in (state or {}))} {fan} " + " ".join(f"{x:.{digits}f}" for x in middle),
        ]
    count = len(loops if cells is None else cells)
    text = ["***tess", " **format", f"   {version}", " **general", f"   {3 if cells else 2} standard", " **cell"]
    text += [f"  {count}", "  *crysym", "   triclinic", "  *ori", "   rodrigues:active", "  0.1 0.2 0.3", extra]
    text += [" **vertex", f" {len(vertices)}"]
    text += [f"  {i + 1} " + " ".join(f"{x:.{digits}f}" for x in v) + " 0" for i, v in enumerate(vertices)]
    text += [" **edge", f" {len(edges)}", *(f"  {n} {a + 1} {b + 1} 0" for (a, b), n in edges.items())]
    text += [" **face", f" {len(loops)}", *lines]
    if cells is not None:
        text += [" **polyhedron", f" {len(cells)}"]
        text += [f"  {i + 1} {len(cell)} " + " ".join(map(str, cell)) for i, cell in enumerate(cells)]
    return "\n".join([*text, " **domain", "  *general", "   cube", "***end", ""])


@pytest.fixture
def write(tmp_path):
    def place(text):
        path = tmp_path / "a.tess"
        path.write_text(text)
        return path

    return place


def test_cells_fill_the_box_and_touch_over_every_shared_face(write):
    vertices, loops, cells = voronoi(30, SIDES)
    imported = read_tess(write(tess(vertices, loops, cells)), unit=0.1)
    blocks = imported.blocks
    require_sound(blocks)
    assert blocks.count == 30
    assert volumes(blocks).sum() == pytest.approx(1e-3, rel=1e-10)
    assert imported.names[3] == "cell 4"
    assert imported.notes == ()
    inside = [f for f in range(len(loops)) if sum(f + 1 in np.abs(cell) for cell in cells) == 2]
    joints = find_joints(blocks)
    area = face_areas_normals_centroids(blocks)[0]
    low, high = bounds(blocks)
    walls = 2 * (SIDES[0] * SIDES[1] + SIDES[1] * SIDES[2] + SIDES[0] * SIDES[2]) * 0.01
    assert joints.area.sum() == pytest.approx((area.sum() - walls) / 2, rel=1e-9)
    assert len(joints.patch_start) - 1 == len(inside)
    assert np.ptp(np.concatenate([low, high]), axis=0) == pytest.approx(0.1 * SIDES, rel=1e-10)


def test_cells_turned_inside_out_as_a_whole_are_turned_back(write):
    vertices, loops, cells = voronoi(6, SIDES)
    turned = [[-f for f in cell] for cell in cells]
    one, two = (read_tess(write(tess(vertices, loops, c))).blocks for c in (cells, turned))
    assert np.all(volumes(two) > 0)
    assert np.allclose(volumes(one), volumes(two), rtol=1e-14)


@pytest.mark.parametrize("way", ["barycentre", "corner", "unknown"])
def test_bent_faces_become_triangles_that_both_cells_share(write, way):
    vertices, loops, cells = voronoi(20, SIDES)
    count = {f: sum(f in np.abs(cell) for cell in cells) for f in range(1, len(loops) + 1)}
    wall = {v for f, loop in enumerate(loops) if count[f + 1] == 1 for v in loop}
    vertex = next(v for loop in loops for v in loop if v not in wall)
    vertices[vertex] += 0.004
    around = [f for f, loop in enumerate(loops) if vertex in loop and len(loop) > 3]
    state = {f: (0 if way == "barycentre" else 2, vertices[loops[f]].mean(axis=0)) for f in around}
    if way == "unknown":
        state = {}
    imported = read_tess(write(tess(vertices, loops, cells, state)))
    require_sound(imported.blocks)
    assert volumes(imported.blocks).sum() == pytest.approx(1.0, rel=1e-10)
    assert f"{len(around)} of {len(loops)} faces are bent" in imported.notes[0]
    joints = find_joints(imported.blocks)
    area = face_areas_normals_centroids(imported.blocks)[0].sum()
    assert joints.area.sum() == pytest.approx((area - 7.0) / 2, rel=1e-9)


def test_a_plane_tessellation_is_drawn_out_through_the_thickness(write):
    vertices, loops, cells = voronoi(12, SIDES[:2])
    loops_of_cells = []
    for cell in cells:
        corner = np.unique([loops[abs(f) - 1] for f in cell])
        arm = vertices[corner] - vertices[corner].mean(axis=0)
        loops_of_cells.append(corner[np.argsort(np.arctan2(arm[:, 1], arm[:, 0]))].tolist())
    loops_of_cells[0] = loops_of_cells[0][::-1]
    flat = np.column_stack([vertices, np.zeros(len(vertices))])
    path = write(tess(flat, loops_of_cells))
    with pytest.raises(GeometryError, match="thickness is needed"):
        read_tess(path)
    blocks = read_tess(path, thickness=0.25).blocks
    require_sound(blocks)
    assert volumes(blocks).sum() == pytest.approx(0.5, rel=1e-10)
    assert bounds(blocks)[1].max(axis=0) == pytest.approx([2, 0.25, 1], rel=1e-10)


def test_a_plane_cell_with_a_notch_is_cut_into_convex_faces(write):
    vertices = np.array([[0, 0], [2, 0], [2, 1], [1, 0.4], [0, 1.0]])
    roof = np.array([[2, 2.0], [0, 2]])
    flat = np.column_stack([np.concatenate([vertices, roof]), np.zeros(7)])
    imported = read_tess(write(tess(flat, [[0, 1, 2, 3, 4], [4, 3, 2, 5, 6]])), thickness=1.0)
    assert volumes(imported.blocks) == pytest.approx([1.4, 2.6], rel=1e-12)
    assert "not convex" in imported.notes[0]
    assert find_joints(imported.blocks).area.sum() == pytest.approx(2 * np.hypot(1, 0.6), rel=1e-12)


def test_groups_and_numbers_of_the_file_are_kept(write):
    vertices, loops, cells = voronoi(4, SIDES)
    imported = read_tess(write(tess(vertices, loops, cells, extra="  *id\n   7 8\n  9 11\n  *group\n 2 1 1 2")))
    assert imported.names == ("cell 7", "cell 8", "cell 9", "cell 11")
    assert imported.blocks.groups == ("group1", "group2")
    assert imported.blocks.group.tolist() == [1, 0, 0, 1]


@pytest.mark.parametrize("version", ["2.0", "3.5", "4.0", "4.5.0"])
def test_formats_from_2_to_4_are_read(write, version):
    assert read_tess(write(tess(*voronoi(3, SIDES), version=version))).blocks.count == 3


GOOD = tess(*voronoi(4, SIDES))
BAD = {
    "empty": ("", "empty"),
    "no tessellation": ("solid x\n", "line 1"),
    "binary": ("\x80\x04\x00" * 999, "line 1"),
    "torn": (GOOD[: len(GOOD) // 2], "line|ends"),
    "unknown format": (GOOD.replace("3.4", "9.1"), "format"),
    "one dimension": (GOOD.replace("3 standard", "1 standard"), "dimension"),
    "no faces": (GOOD.replace("**face", "**other"), r"\*\*face is missing"),
    "a word": (GOOD.replace("**vertex\n", "**vertex\n hundred "), "line 15: 'hundred' is no number"),
    "huge count": (GOOD.replace("**vertex\n ", "**vertex\n 99999999999999999999 "), "announced|whole"),
    "many cells": (GOOD.replace("**cell\n  4", "**cell\n  400000000000"), "cells are announced"),
    "negative count": (GOOD.replace("**face\n ", "**face\n -"), "announced"),
    "not finite": (GOOD.replace("**vertex\n", "**vertex\n", 1).replace("0.500000000000", "inf", 1), "not finite"),
    "fractions": (GOOD.replace("**polyhedron\n 4\n  1 ", "**polyhedron\n 4\n  1.5 "), "whole number"),
    "twice": (GOOD.replace(" **polyhedron", " **vertex\n 0\n **polyhedron"), "second section"),
    "unknown corner": (GOOD.replace("**face\n", "**face\n").replace("   1 4 ", "   1 4 9", 1), "corners"),
    "wrong order": (GOOD.replace("**polyhedron\n 4\n  1 ", "**polyhedron\n 4\n  2 "), "expected here"),
    "other count": (GOOD.replace("**cell\n  4", "**cell\n  3"), "there are 4"),
    "a long line": (GOOD.replace("**vertex\n", "**vertex\n" + " " * 2**21), "longer"),
}


@pytest.mark.parametrize("name", BAD)
def test_a_bad_file_is_refused_in_one_sentence(write, name):
    text, words = BAD[name]
    with pytest.raises(GeometryError, match=words) as caught:
        read_tess(write(text))
    assert "\n" not in str(caught.value)


def test_faces_that_do_not_close_a_cell_are_refused(write):
    vertices, loops, cells = voronoi(4, SIDES)
    with pytest.raises(GeometryError, match="not closed"):
        read_tess(write(tess(vertices, loops, [[-cells[0][0], *cells[0][1:]], *cells[1:]])))


@pytest.mark.parametrize("order", [[0, 2, 4, 1, 3], [0, 1, 3, 2, 4]])
def test_faces_whose_edges_cross_are_refused(write, order):
    turn = 2 * np.pi * np.arange(5) / 5
    star = np.stack([np.cos(turn), np.sin(turn), 0 * turn], axis=1)
    with pytest.raises(GeometryError, match="face 1: a face whose edges cross"):
        read_tess(write(tess(star, [order])), thickness=1.0)


def test_a_file_cut_anywhere_or_with_letters_changed_never_crashes_the_reader(write):
    rng = np.random.default_rng(5)
    content = np.frombuffer(GOOD.encode(), dtype=np.uint8)
    for _ in range(150):
        torn = content[: rng.integers(1, len(content))].copy() if rng.random() < 0.3 else content.copy()
        torn[rng.integers(0, len(torn), 3)] = rng.choice(np.frombuffer(b"0123456789-.* \ne", dtype=np.uint8), 3)
        try:
            read_tess(write(torn.tobytes().decode()))
        except GeometryError as error:
            assert "\n" not in str(error)


def test_a_file_that_announces_much_takes_no_memory(write):
    path = write(GOOD.replace("**vertex\n ", "**vertex\n 3000000000 "))
    code = f"""
import resource
resource.setrlimit(resource.RLIMIT_AS, (3 * 2**30, 3 * 2**30))
from geometry.blocks import GeometryError
from geometry.files.tess import read_tess
try:
    read_tess({str(path)!r})
except GeometryError as error:
    print(error)
own = next(int(line.split()[1]) for line in open("/proc/self/status") if line.startswith("VmHWM"))
print(max(own, resource.getrusage(resource.RUSAGE_CHILDREN).ru_maxrss))  # ru_maxrss of its own begins with its parent's
"""
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True)
    assert "announced" in done.stdout, done.stderr
    assert int(done.stdout.split()[-1]) < 2**21


def test_a_thousand_cells_are_read_in_a_second(write):
    path = write(tess(*voronoi(1000, SIDES)))
    begun = time.process_time()
    assert read_tess(path).blocks.count == 1000
    assert time.process_time() - begun < 3.0
