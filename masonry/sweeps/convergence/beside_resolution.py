"""Differences that are no error of resolution, told beside it and never mixed in: what is drawn at random, a stiffness
that stands for rigid, and runs that differ in nothing and yet go apart."""

import re
from collections.abc import Sequence
from dataclasses import dataclass
from statistics import mean, stdev
from typing import Any

from masonry.scene import Scene
from masonry.sweeps.convergence.refinement.answers import Answer, value_of
from masonry.sweeps.convergence.refinement.campaign import APART, BASE, DRAWN, RIGID, SCATTER, Refinement
from masonry.sweeps.convergence.refinement.extrapolation import FLAT, Estimate
from masonry.sweeps.convergence.refinement.numerical_errors import Ended

STIFFER, DRAWS = 4.0, 2
"""Factor of a stiffness that stands for rigid; draws besides that of the scene."""
ORDERS = (0.5, 1.0)
"""Powers of a flexibility by which its effect falls: a half where a joint stands on a strip at its edge, whose width
goes with the root of it, and one where it stays closed."""
NEGLIGIBLE = 1e-4
"""Relative difference of which no more is said."""
WORD = re.compile(r"\brigid\b")
"""By which [assumptions] says that a stiffness stands for rigid."""


def runs_beside(scene: Scene) -> list[Refinement]:
    """Runs of a scene that tell no resolution: other draws, and stiffer joints where a stiffness stands for rigid."""
    runs = [Refinement(DRAWN, 1.0, settings) for number in range(DRAWS) if (settings := drawn_again(scene, number + 1))]
    stiffer = stiffened(scene, STIFFER)
    return [*runs, *([Refinement(RIGID, STIFFER, stiffer, STIFFER**0.5)] if stiffer else [])]


def drawn_again(scene: Scene, number: int) -> dict[str, Any]:
    """Settings of all that is drawn by seed, with other ones; empty where nothing is."""
    seeds = {}
    for key, part in (("specimen", scene.specimen), ("specimen.mortar", getattr(scene.specimen, "mortar", None))):
        cells = getattr(part, "cells", None)
        if cells is not None and cells.sites is None:
            seeds[f"{key}.cells.seed"] = cells.seed
    if scene.scatter is not None:
        seeds["scatter.seed"] = scene.scatter.seed
    many = len(scene.ground) > 1  # a single ground is a table, and no list of them
    grounds = [(f"ground.{k}.made" if many else "ground.made", ground.made) for k, ground in enumerate(scene.ground)]
    waves = [(f"quiet.{k}.wave.made", quiet.wave and quiet.wave.made) for k, quiet in enumerate(scene.quiet)]
    seeds |= {f"{key}.seed": made.seed for key, made in (*grounds, *waves) if made}
    return {key: seed + number for key, seed in seeds.items()}


def stiffened(scene: Scene, factor: float) -> dict[str, Any]:
    """Stiffnesses of dry joints of which [assumptions] says that they stand for rigid, times a factor; a measured
    stiffness is none of these."""
    settings = {}
    for group, contact in scene.contact.items():
        notes = [scene.assumptions.get(f"contact.{group}{key}", "") for key in ("", ".normal_stiffness")]
        is_dry = not contact.tensile_strength and not contact.cohesion and contact.law != "elastic"
        if is_dry and WORD.search(" ".join(notes)):
            name = group if group.replace("_", "").isalnum() else f'"{group}"'
            for key in ("normal_stiffness", "shear_stiffness"):
                settings[f"contact.{name}.{key}"] = f"{factor * getattr(contact, key)!r} Pa/m"
    return settings


@dataclass(frozen=True)
class BesideResolution:
    """Of one number, all in SI.

    answer   which number           value  of the scene as it is
    drawn    by other seeds, the scene's among them; empty where nothing is drawn
    rigid    with stiffness without end less that of the scene, and its interval; None where none stands for rigid
    chaotic  of runs that differ in nothing of meaning, or by less than that; empty where these do not go apart
    """

    answer: Answer
    value: float
    drawn: tuple[float, ...]
    rigid: Estimate | None
    chaotic: tuple[float, ...]

    def as_data(self) -> dict[str, Any]:
        """The entries of convergence.json, and the columns of convergence.csv."""
        rigid = (None, None) if self.rigid is None else self.rigid[:2]
        return {
            "drawn_runs": len(self.drawn) or None,
            "drawn_deviation": stdev(self.drawn) if self.drawn else None,
            "rigid_difference": rigid[0],
            "rigid_half_width": rigid[1],
            "chaotic_runs": len(self.chaotic) or None,
            "chaotic_mean": mean(self.chaotic) if self.chaotic else None,
            "chaotic_deviation": stdev(self.chaotic) if self.chaotic else None,
            "chaotic_lowest": min(self.chaotic, default=None),
            "chaotic_highest": max(self.chaotic, default=None),
        }


def beside(answer: Answer, ended: Ended) -> BesideResolution | None:
    """Of a number of the scene as it is; None where it has none."""
    values = [(trial, value.middle) for trial, row in ended if (value := value_of(row, answer)) is not None]
    if not values or values[0][0].name != BASE:
        return None
    base = values[0][1]
    drawn = [number for trial, number in values if trial.name == DRAWN]
    stiffer = [number for trial, number in values if trial.name == RIGID]
    alike = [(trial.name, number) for trial, number in values if trial.name not in (DRAWN, RIGID)]
    return BesideResolution(
        answer,
        base,
        (base, *drawn) if drawn else (),
        _without_end(stiffer[0] - base) if stiffer else None,
        tuple(number for _, number in alike) if _go_apart(alike) else (),
    )


def _without_end(difference: float) -> Estimate:
    """Of a stiffness without end, from the difference that STIFFER times of it makes."""
    remainders = [difference / (STIFFER**order - 1.0) for order in ORDERS]
    return Estimate(difference + mean(remainders), abs(difference))


def _go_apart(values: Sequence[tuple[str, float]]) -> bool:
    """Whether runs that differ in nothing differ by more than their step or pace does, and refined ones hardly by more
    than they: an answer that converges changes many times as much by half the step as by a step that is a hundredth
    shorter. The scene as it is comes first."""
    base = values[0][1]
    scatter = max((abs(number - base) for name, number in values if name == SCATTER), default=0.0)
    refined = max((abs(number - base) for name, number in values if name != SCATTER), default=0.0)
    return scatter > APART * abs(base) > 0.0 and refined <= FLAT * scatter


def sentences(besides: Sequence[BesideResolution], ended: Ended, in_time: bool) -> list[str]:
    """Sentences of the table; none where nothing is beside the errors.

    in_time  whether the run is a motion in real time
    """
    said = []
    if drawn := [item for item in besides if item.drawn]:
        keys = next(", ".join(trial.settings) for trial, _ in ended if trial.name == DRAWN)
        parts = ", ".join(f"{item.answer.words} {_share(stdev(item.drawn), item, sign='±')}" for item in drawn)
        said.append(
            f"Scatter of what is drawn by seed ({keys}; {len(drawn[0].drawn)} draws, standard deviation): {parts}. "
            "It is in no bar, and no refinement makes it smaller."
        )
    stiff = [(item, item.rigid) for item in besides if item.rigid is not None]
    if stiff:
        parts = ", ".join(
            f"{item.answer.words} {_share(rigid.change, item)} (±{_share(rigid.half_width, item, sign='')})"
            for item, rigid in stiff
            if abs(rigid.change) + rigid.half_width > NEGLIGIBLE * abs(item.value)
        )
        said.append(
            "The stiffness of dry joints stands for rigid here, and is in no bar; joints that are rigid would change "
            f"{parts or 'nothing'}."
        )
    for item in (item for item in besides if item.chaotic):
        what = "The motion is chaotic" if in_time else "Runs that differ in nothing go apart"
        numbers = (min(item.chaotic), mean(item.chaotic), max(item.chaotic))
        lowest, middle, highest = (f"{number * item.answer.factor:.4g}" for number in numbers)
        unit = f" {item.answer.unit}" if item.answer.unit else ""
        said.append(
            f"{what}: the {item.answer.words} is {lowest} to {highest}{unit}, {middle}{unit} in the mean of "
            f"{len(item.chaotic)} runs, finer ones among them. It has no value without end but that distribution."
        )
    return said


def _share(part: float, item: BesideResolution, sign: str = "+") -> str:
    """In per cent of the number of the scene."""
    if not item.value:
        return f"{part * item.answer.factor:+.2g}"
    text = f"{100.0 * part / abs(item.value):+.2g} %"
    return text if sign == "+" else sign + text.lstrip("+-")
