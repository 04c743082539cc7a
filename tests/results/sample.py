"""A small made-up result: a wall of boxes whose contacts are damaged where a test wants them to be."""

import numpy as np

from geometry.blocks import Blocks, Joints, Specimen, TetMesh
from masonry.laboratory.result import Result
from masonry.rows.columns import UNITS
from masonry.rows.history import Frame, History

SIDES = [[0, 3, 2, 1], [4, 5, 6, 7], [0, 1, 5, 4], [2, 3, 7, 6], [1, 2, 6, 5], [0, 4, 7, 3]]
LENGTH, HEIGHT, DEPTH = 0.25, 0.1, 0.05


def wall(courses: int = 4, units: int = 2, cells: int = 2) -> Blocks:
    """Running bond between two plates, each unit of `cells` x 1 boxes; blocks share no corners."""
    boxes = []
    unit = 0
    for course in range(courses):
        starts = [0.0, *np.arange(0.5 if course % 2 else 1.0, units, 1.0), float(units)]
        for begin, end in zip(starts[:-1], starts[1:], strict=True):
            count = max(round(cells * (end - begin)), 1)
            for k in range(count):
                width = (end - begin) * LENGTH / count
                origin = (begin * LENGTH + k * width, 0.0, course * HEIGHT)
                boxes.append((origin, (width, DEPTH, HEIGHT), unit, 0))
            unit += 1
    for number, x in enumerate((-0.05, units * LENGTH)):
        boxes.append(((x, 0.0, 0.0), (0.05, DEPTH, courses * HEIGHT), unit + number, 1))
    corner = np.array([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0], [0, 0, 1], [1, 0, 1], [1, 1, 1], [0, 1, 1]], float)
    points = np.concatenate([np.array(origin) + corner * size for origin, size, _, _ in boxes])
    faces = np.concatenate([8 * b + np.array(SIDES).ravel() for b in range(len(boxes))])
    return Blocks(
        points=points,
        face_start=np.arange(0, 4 * 6 * len(boxes) + 1, 4),
        face_points=faces,
        block_face_start=np.arange(0, 6 * len(boxes) + 1, 6),
        unit=np.array([box[2] for box in boxes]),
        group=np.array([box[3] for box in boxes]),
        groups=("units", "plates"),
    )


def joints_of(blocks: Blocks) -> Joints:
    """2 x 2 contact points on every overlap of two boxes."""
    low = blocks.points.reshape(-1, 8, 3).min(axis=1)
    high = blocks.points.reshape(-1, 8, 3).max(axis=1)
    rows, patches = [], []
    for a in range(blocks.count):
        for b in range(a + 1, blocks.count):
            begin, end = np.maximum(low[a], low[b]), np.minimum(high[a], high[b])
            thin = np.abs(end - begin) < 1e-9
            if thin.sum() != 1 or (end - begin)[~thin].min() < 1e-9:
                continue
            axis = int(np.argmax(thin))
            p, q = (k for k in range(3) if k != axis)
            normal = np.eye(3)[axis] * np.sign(low[b][axis] + high[b][axis] - low[a][axis] - high[a][axis])
            area = (end - begin)[p] * (end - begin)[q]
            square = []
            for s, t in ((0, 0), (1, 0), (1, 1), (0, 1)):
                place = begin.copy()
                place[p] += s * (end - begin)[p]
                place[q] += t * (end - begin)[q]
                square.append(place)
                inner = begin + 0.5 * (end - begin) + 0.5773 * (place - begin - 0.5 * (end - begin))
                rows.append((a, b, inner, normal, area / 4, len(patches)))
            patches.append(square)
    return Joints(
        block_a=np.array([row[0] for row in rows]),
        block_b=np.array([row[1] for row in rows]),
        node_a=np.full(len(rows), -1),
        node_b=np.full(len(rows), -1),
        point=np.array([row[2] for row in rows]),
        normal=np.array([row[3] for row in rows]),
        area=np.array([row[4] for row in rows]),
        patch=np.array([row[5] for row in rows]),
        patch_start=np.arange(0, 4 * len(patches) + 1, 4),
        patch_points=np.array(patches).reshape(-1, 3),
    )


def opened(blocks: Blocks, joints: Joints, amount: float, step: int, damaged: bool = True) -> Frame:
    """Units whose centre is in the right half have moved by `amount` along x; what lies between is broken."""
    centre = _unit_centres(blocks)
    right = centre[blocks.unit][:, 0] > LENGTH
    corners = np.zeros_like(blocks.points)
    corners[np.repeat(right, 8), 0] = amount
    parted = right[joints.block_a] != right[joints.block_b]
    head = np.abs(joints.normal[:, 0]) > 0.5
    zero = np.zeros(len(joints.area))
    damaged = damaged and amount > 0
    return Frame(
        step=step,
        time=1e-4 * step,
        displacement=amount,
        corners=corners,
        nodes=np.zeros((0, 3)),
        opening=np.where(parted & head, amount, 0.0),
        slip=np.where(parted & ~head, amount, 0.0),
        normal_stress=np.where(parted & head, 1e5, 0.0),
        shear_stress=zero,
        damage_tension=np.where(parted & head & damaged, 0.95, 0.0),
        damage_shear=np.where(parted & ~head & damaged, 0.6, 0.0),
        stress=np.arange(6.0) * np.ones((blocks.count, 1)),
    )


def _unit_centres(blocks: Blocks) -> np.ndarray:
    centres = blocks.points.reshape(-1, 8, 3).mean(axis=1)
    return np.array([centres[blocks.unit == unit].mean(axis=0) for unit in range(int(blocks.unit.max()) + 1)])


def rows(count: int = 101, last: float = 2e-4) -> dict[str, np.ndarray]:
    """A softening curve with a peak of 0.19 MPa, and a ledger that closes."""
    u = np.linspace(0.0, last, count)
    stress = np.where(u < 0.2 * last, 0.19e6 * u / (0.2 * last), 0.19e6 * np.exp(-4 * (u / last - 0.2)))
    work = np.concatenate([[0.0], np.cumsum(0.5 * (stress[1:] + stress[:-1]) * np.diff(u))]) * 0.02
    elastic = 0.02 * stress * u / 4
    lost = work - elastic
    columns = {name: np.zeros(count) for name in UNITS}
    columns |= {
        "step": np.linspace(0, 10 * (count - 1), count),
        "time": 1e-4 * np.linspace(0, 10 * (count - 1), count),
        "displacement": u,
        "stress": stress,
        "support_stress": stress * (1 + 0.01 * np.sin(u / last * 60)),
        "external_work": work,
        "elastic_blocks": 0.3 * elastic,
        "elastic_contacts": 0.7 * elastic,
        "fracture_mode_1": 0.5 * lost,
        "fracture_mode_2": 0.3 * lost,
        "friction": 0.15 * lost,
        "damping": 0.05 * lost,
        "contact_work": 0.9 * work,
    }
    return columns


SUMMARY = {
    "scene": "sample",
    "law": "exponential",
    "kinematics": "rigid",
    "steps": 1000,
    "seconds_run": 1.25,
    "seconds_compile": 12.5,
    "peak_stress_pa": 190000.0,
    "displacement_at_peak_m": 4e-5,
    "final_stress_pa": 7744.123456789012,
    "reaction_mismatch_max": 0.01,
    "kinetic_over_internal_max": 1e-3,
    "energy_imbalance": 1e-13,
    "energy_j": {"friction": 0.1},
    "broken_area_m2": {"unit_unit": 0.01},
}


def sample(damaged: bool = True) -> Result:
    """Three frames: at rest, at the peak and at the end."""
    blocks = wall()
    joints = joints_of(blocks)
    frames = [opened(blocks, joints, amount, step, damaged) for amount, step in ((0.0, 0), (4e-5, 200), (2e-4, 1000))]
    return Result(
        summary=dict(SUMMARY),
        history=History(rows(), frames),
        specimen=Specimen(blocks, {"left plate": np.array([blocks.count - 2])}, 0.02, "wallette"),
        joints=joints,
        joint_group=np.zeros(len(joints.area), dtype=np.int64),
        joint_groups=("unit_unit",),
        mesh=None,
        scene_toml='title = "A wall for tests, not $physics$"\nlaw = "exponential"\n',
        log=["first", "second"],
    )


def with_tets(result: Result) -> Result:
    """The same with five tets in block 0, its corners as nodes, and the last frame's nodes displaced with them."""
    blocks = result.specimen.blocks
    tets = np.array([[0, 1, 2, 5], [0, 2, 3, 7], [0, 5, 7, 4], [2, 7, 5, 6], [0, 2, 7, 5]])
    after = np.ones(blocks.count, dtype=np.int64)
    result.mesh = TetMesh(
        nodes=blocks.points[:8].copy(),
        node_start=np.concatenate([[0], 8 * after]),
        tets=tets,
        tet_start=np.concatenate([[0], 5 * after]),
    )
    result.history.frames = [
        Frame(**{**vars(frame), "nodes": frame.corners[:8] + 1e-6}) for frame in result.history.frames
    ]
    return result
