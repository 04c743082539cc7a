"""The claims of section 7 of the paper on how walls crack in horizontal bending and how they are held."""

import numpy as np

from masonry.laboratory.result import Result
from verification.paper.bending.runs import ASSUMED, SCENES, SEEDS, STRENGTHS, WEAKER, label, name_of, walls
from verification.paper.bending.strength_map import crack_of
from verification.paper.experiment import Claim, Done, claim

FREE, PRESSED = SCENES
LOST = (
    "the column fT of Table 5 is lost; by hand the straight crack is the weaker one unless units are some six times as "
    "strong as joints, and near that the cells decide"
)


def claims(done: Done) -> list[Claim]:
    """A row for each sentence that can be held against a picture or a number."""
    made = [*modes(done), pattern_changes(done), tension_leads(done), rollers(done), held_below(done)]
    return made if done.quick else [*made, cells(done)]


def modes(done: Done) -> list[Claim]:
    """The two patterns, with the strengths that are shipped, which were chosen for them."""
    rows = (
        ("Without pre-compression the crack is stepped", "7, Fig. 22a", FREE, "stepped"),
        ("Under 0.25 MPa the failure is mixed: cracked units and open head joints", "7, Fig. 22b", PRESSED, "mixed"),
    )
    made = []
    for says, source, sigma, word in rows:
        assumed, other = (crack_of(done, label(pair, sigma)) for pair in (ASSUMED, WEAKER))
        count = "no course" if word == "stepped" else "one or two of six courses"
        check = f"units cracked in {count}, {name_of(ASSUMED)} (chosen for this)"
        measured = f"{assumed.sentence()}. With {name_of(WEAKER)} {other.sentence()}"
        wider = "" if word == "stepped" else ". A straight crack, too, goes through units and head joints"
        made.append(claim(says, source, check, measured, assumed.word == word, LOST + wider))
    return made


def pattern_changes(done: Done) -> Claim:
    """Which of the pairs of strengths give both patterns."""
    tried = (ASSUMED, WEAKER) if done.quick else STRENGTHS
    words = {pair: tuple(crack_of(done, label(pair, sigma)).word for sigma in SCENES) for pair in tried}
    both = [pair for pair, word in words.items() if word == ("stepped", "mixed")]
    return claim("The failure changes from stepped to mixed with the pre-compression", "7, Fig. 22",
                 f"it does with the shipped strengths; {len(tried)} pairs were tried, units 3 to 10 times as strong as "
                 "joints",
                 f"{len(both)} of {len(tried)}: {'; '.join(map(name_of, both)) or 'none'}",
                 ASSUMED in both, LOST)  # fmt: skip


def tension_leads(done: Done) -> Claim:
    """Failure mode of the head joints of the stepped crack."""
    opened = crack_of(done, label(ASSUMED, FREE)).opened
    return claim("In the stepped crack head joints fail by flexural tension", "7, Fig. 22a",
                 f"broken area of head joints that lost more by tension than by shear: > 90 %, {name_of(ASSUMED)}",
                 f"{opened:.0%}",
                 opened > 0.9, "head joints slide as they open")  # fmt: skip


def rollers(done: Done) -> Claim:
    """Force of the rollers at the end."""
    carried, rubbed = [], []
    for sigma in SCENES:
        force, shear, _ = _carried(done[label(ASSUMED, sigma)], "rollers_units")
        final = float(done[label(ASSUMED, sigma)].history.rows["force"][-1])
        carried.append(abs(-force / (2.0 * final) - 1.0))
        rubbed.append(shear / final)
    return claim("Only rollers hold the wall on both sides", "7",
                 "at the end load and support rollers press with twice the force of the drive, within 2 %, and do not "
                 "rub",
                 f"off by {max(carried):.2%}; rubbing {max(rubbed):.0e} of the force",
                 max(carried) < 0.02 and max(rubbed) < 1e-9, "rollers carry another force than the drive")  # fmt: skip


def held_below(done: Done) -> Claim:
    """Stress and shear of the plate under the wall at the end."""
    force, shear, area = _carried(done[label(ASSUMED, PRESSED)], "plate")
    stress = -force / area
    return claim("With pre-compression the bottom is held in its direction, and in no other", "7",
                 "at the end the plate below carries 0.25 MPa within 0.1 %, and no shear",
                 f"{stress * 1e-6:.5f} MPa, shear {shear / abs(force):.0e} of it",
                 abs(stress / 0.25e6 - 1.0) < 1e-3 and shear < 1e-9 * abs(force),
                 "the plate carries something else")  # fmt: skip


def cells(done: Done) -> Claim:
    """Other random cells in the units."""
    same, spread = [], []
    for wall in walls():
        names = [label(*wall), *(label(*wall, f"cells {seed}") for seed in SEEDS)]
        peaks = np.array([done.peak(name) for name in names])
        spread.append(float(np.ptp(peaks) / peaks.mean()))
        same.append(len({crack_of(done, name).word for name in names}) == 1)
    return claim("Peak and pattern are those of the wall, not of its random cells", "7",
                 "three divisions into cells crack in the same way, their peaks within 10 %, in all four walls",
                 f"the same way in {sum(same)} of {len(same)}, peaks within {max(spread):.1%}",
                 all(same) and max(spread) < 0.1, "cells decide where several ways are nearly as weak")  # fmt: skip


def _carried(result: Result, group: str) -> tuple[float, float, float]:
    """Sums over the contacts of a group at the end: normal force (N), shear (N, without direction), area (m2)."""
    of = result.joint_group == result.joint_groups.index(group)
    area, frame = result.joints.area[of], result.history.frames[-1]
    return float(frame.normal_stress[of] @ area), float(np.abs(frame.shear_stress[of]) @ area), float(area.sum())
