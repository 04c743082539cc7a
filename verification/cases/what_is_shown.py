"""What a run shows of itself: stresses of blocks, fields of a frame, widths of cracks, against what they must be.

    stress of blocks    affine and tets: a gradient of nine different numbers, sigma = lambda tr(e) + 2 mu e;
                        rigid: a block whose six neighbours press it with sigma n, by Love's formula
                        order xx yy zz yz xz xy, and xx yy zz xy yz xz in the file for ParaView
    fields of a frame   a block that slid under compression: displacement of corners, opening -s/kn, slip u,
                        stresses -s and tau(u), damage 1 - exp(-(u - tau_m/ks) c0/G_II)
    areas of a summary  damaged from 5 % on, broken from 95 % on: all of both joints, or nothing
    width of a crack    of faces that opened by 3 um and slid by 4 um: 5 um; closed ones show their slip alone

Reference: by hand; eqs (8), (17) of the paper; Love 1927, art. 123.
"""

from dataclasses import replace

import numpy as np

from masonry import energy
from masonry.contact_stress import contact_stress
from masonry.cracks import crack_lines, front_view
from masonry.model import Model
from masonry.vtkhdf import TO_VTK
from masonry.watch import corner_displacements
from verification.case import Case, Check, Findings
from verification.cases import triplet
from verification.closed_forms import Joint, shear
from verification.rigs import rig, shapes
from verification.rigs.free_motion import glued
from verification.rigs.scene_text import run as run_text

COMPONENTS = ((0, 0), (1, 1), (2, 2), (1, 2), (0, 2), (0, 1))
NAMES = ("xx", "yy", "zz", "yz", "xz", "xy")
IN_PARAVIEW = ("xx", "yy", "zz", "xy", "yz", "xz")
GRADIENT = 1e-5 * np.array([[3.0, 0.7, -1.1], [0.2, -2.0, 0.5], [1.9, -0.4, 1.3]])
STRESS = 1e6 * np.array([[-0.9, 0.1, 0.25], [0.1, 0.4, -0.15], [0.25, -0.15, 0.7]])
GLUE = glued(2e11, 8e10)
SIZE = np.array([0.2, 0.1, 0.08])
ROUNDING = "sums of some products: rounding"


def of_strains(found: Findings) -> None:
    """Affine blocks and tets in uniform strain."""
    lame, mu = rig.STONE.lame()
    strain = 0.5 * (GRADIENT + GRADIENT.T)
    wanted = lame * np.trace(strain) * np.eye(3) + 2.0 * mu * strain
    for kind in ("affine", "tets"):
        blocks = shapes.skewed(
            shapes.stack([0.08, 0.08]), np.array([[1.0, 0.3, 0.0], [0.0, 1.0, 0.2], [0.1, 0.0, 1.0]])
        )
        model = rig.make(shapes.setup(blocks, [kind, kind], mesh_size=0.1), GLUE)
        rig.put(model, rig.positions(model), rig.linear_field(model, np.zeros(3), GRADIENT))
        compare(found, kind, energy.observe(model).stress[1], wanted)
        if kind == "affine":
            corners(found, kind, model, GRADIENT)


def corners(found: Findings, kind: str, model: Model, gradient: np.ndarray) -> None:
    """Displacement of all corners of blocks whose points x move by gradient @ x."""
    place = model.blocks.points
    off = np.abs(corner_displacements(model, None) - place @ gradient.T).max()
    found.checks.append(
        Check(f"{kind}: displacement of the corners, largest deviation", "m", float(off), 0.0, "closed form", 1e-12,
              1e-14, ROUNDING, float(np.abs(place @ gradient.T).max()))
    )  # fmt: skip


def of_contacts(found: Findings) -> None:
    """A rigid block between six others."""
    low = np.zeros(3)
    sides = [sign * SIZE * axis for axis in np.eye(3) for sign in (-1.0, 1.0)]
    blocks = shapes.boxes([(low + shift, low + shift + SIZE) for shift in (np.zeros(3), *sides)])
    model = rig.make(shapes.setup(blocks, ["rigid"] * 7), GLUE)
    joints = model.joints
    model.contacts[4][:] = joints.area[:, None] * (joints.normal @ STRESS)
    compare(found, "rigid", contact_stress(model)[0], STRESS)
    turn = 0.5 * (GRADIENT - GRADIENT.T)
    rig.put(model, rig.positions(model), rig.linear_field(model, np.zeros(3), turn))
    corners(found, "rigid", model, turn)


def compare(found: Findings, kind: str, had: np.ndarray, wanted: np.ndarray) -> None:
    """Six components, each relative to the largest."""
    found.checks += [
        Check(f"{kind}: stress {name}", "Pa", float(had[k]), float(wanted[i, j]), "closed form", 1e-12, 1e-14, ROUNDING,
              float(np.abs(wanted).max()))
        for k, (name, (i, j)) in enumerate(zip(NAMES, COMPONENTS, strict=True))
    ]  # fmt: skip


def in_order(found: Findings) -> None:
    """Where the file for ParaView has each component."""
    had = [NAMES[k] for k in TO_VTK]
    found.checks.append(
        Check("components that stand where ParaView looks for them", "1", sum(a == b for a, b in zip(had, IN_PARAVIEW,
              strict=True)), 6.0, "closed form", 1e-14, 0.0, "names: exact")
    )  # fmt: skip


def of_a_frame(found: Findings) -> None:
    """The last frame of the triplet whose middle unit has slid by 1 mm, and the cracks drawn of it."""
    joint, s = Joint(), triplet.S
    result = found.note("triplet", run_text(triplet.SCENE))
    frame, blocks, joints = result.history.frames[-1], result.specimen.blocks, result.joints
    slip, upwards = frame.displacement, joints.normal[:, 2]
    owner = np.unique(blocks.face_points[blocks.face_start[blocks.block_face_start[1]] :][:24])
    tau = float(shear("exponential", joint, slip, s))
    harm = 1.0 - np.exp(-(slip - float(joint.peak(s)) / joint.ks) * joint.c0 / float(joint.mode_2_energy(s)))
    pairs = (
        ("displacement of the middle unit's corners along x", "m", frame.corners[owner, 0], slip, slip),
        ("opening of the joints", "m", frame.opening, -s / joint.kn, s / joint.kn),
        ("slip of the joints", "m", frame.slip, slip, slip),
        ("normal stress", "Pa", frame.normal_stress, -s, s),
        ("shear stress", "Pa", frame.shear_stress, tau, tau),
        ("damage in shear", "1", frame.damage_shear, harm, 1.0),
        ("damage", "1", frame.damage, harm, 1.0),
        ("damage in tension", "1", frame.damage_tension, 0.0, 1.0),
    )
    for name, unit, values, wanted, scale in pairs:
        worst = values[int(np.argmax(np.abs(values - wanted)))]
        found.checks.append(
            Check(f"frame: {name}, where it is furthest off", unit, float(worst), float(wanted), "closed form", 1e-12,
                  4e-13, "what the settled compression still swings by, and rounding", scale)
        )  # fmt: skip
    view = front_view(blocks.points)
    for words, opening, width in (("open", 3e-6, 5e-6), ("pressed", -3e-6, 4e-6)):
        apart = replace(frame, opening=np.full(len(upwards), opening), slip=np.full(len(upwards), 4e-6))
        shown = crack_lines(joints, apart, view).opening
        found.checks.append(
            Check(f"width of a crack, {words}, where it is furthest off", "m",
                  float(shown[int(np.argmax(np.abs(shown - width)))]), width, "closed form", 1e-13, 1e-15, ROUNDING)
        )  # fmt: skip


def of_a_summary(found: Findings) -> None:
    """Areas that count as damaged (5 % and more) and broken (95 %), on both sides of each threshold."""
    joint, s = Joint(), triplet.S
    both = 2.0 * triplet.AREA
    for damage, broken, damaged in ((0.04, 0.0, 0.0), (0.06, 0.0, both), (0.94, 0.0, both), (0.96, both, both)):
        slip = float(joint.peak(s) / joint.ks - np.log1p(-damage) * joint.mode_2_energy(s) / joint.c0)
        few = {"drive.displacement": f"{slip!r} m", "drive.steps": 4000, "solver.rows": 20}
        summary = found.note(f"triplet, damage {damage:g}", run_text(triplet.SCENE, few)).summary
        for name, wanted in (("broken", broken), ("damaged", damaged)):
            found.checks.append(
                Check(f"{name} area at a damage of {damage:g}", "m2", sum(summary[f"{name}_area_m2"].values()), wanted,
                      "closed form", 1e-13, 1e-15, "a sum of areas: rounding", both)
            )  # fmt: skip


def run() -> Findings:
    """All of the above."""
    found = Findings()
    for part in (of_strains, of_contacts, in_order, of_a_frame, of_a_summary):
        part(found)
    return found


CASE = Case(
    "what-is-shown",
    "A22",
    "Stresses of blocks, fields of frames and widths of cracks",
    area="Elastic assemblies",
    run=run,
    quick=True,
    scene=triplet.SCENE,
    no_ladders="what is read off a state: exact",
)
