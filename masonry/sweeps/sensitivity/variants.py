"""The ways in which a scene is run again: each changes one choice that its author may not have thought of as one."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from masonry.assembly.assemble import Assembly
from masonry.errors import SceneError, nearest
from masonry.laboratory.cost import expected
from masonry.scene import Scene
from masonry.scene.tables.types import ALSO

FINER, LEAST = 3.0, 1e-4
"""How many times finer an accuracy is made, and the finest that there is."""
SLOWEST = 20_000
"""The least steps of a drive that was paced by its error and is run at a constant rate."""
STRENGTHS = ("tensile_strength", "cohesion")
MOTIONS = {"rigid": "rigid blocks", "affine": "affine blocks", "tets": "blocks of tets"}


@dataclass(frozen=True)
class Variant:
    """One way to run a scene: of a kind, named in plain words, with what it sets by dotted key."""

    kind: str
    name: str
    settings: dict[str, Any]


BASE = Variant("base", "as it is", {})


def damping(assembly: Assembly) -> list[Variant]:
    """Half the local damping, and half of what it lacks to 1; half of it at a constant rate where an error paces."""
    scene, xi = assembly.scene, assembly.scene.solver.damping
    if xi == 0.0:
        return []
    if scene.is_controlled:
        settings = {"drive.steps": _many(assembly), "solver.damping": xi / 2}
        return [Variant("damping", f"constant rate, damping {xi / 2:.3g}", settings)]
    return [Variant("damping", f"damping {value:.3g}", {"solver.damping": value}) for value in (xi / 2, (1.0 + xi) / 2)]


def pace(assembly: Assembly) -> list[Variant]:
    """A finer accuracy, and a constant rate; or half the rate, or twice the steps."""
    scene, drive = assembly.scene, assembly.scene.drive
    if drive is None:
        steps = 2 * scene.settle.steps if scene.settle is not None else 0
        return [Variant("pace", "twice the steps to settle", {"settle.steps": steps})] if steps else []
    if drive.accuracy is not None:
        finer = drive.accuracy / FINER
        finer = finer if finer >= LEAST else drive.accuracy * FINER
        steps = _many(assembly)
        return [
            Variant("pace", f"accuracy {100 * finer:.2g} %", {"drive.accuracy": finer}),
            Variant("pace", f"constant rate, {steps} steps", {"drive.steps": steps}),
        ]
    if drive.rate is not None:
        given = scene.solver.duration
        longer = {} if given is None else {"solver.duration": f"{2 * given!r} s"}  # no run ends before its drive
        return [Variant("pace", "half the rate", {"drive.rate": f"{drive.rate / 2!r} m/s", **longer})]
    if drive.steps is not None:
        return [Variant("pace", f"twice the steps, {2 * drive.steps}", {"drive.steps": 2 * drive.steps})]
    if scene.solver.masses == "real":  # the times of its history are those of the motion
        return []
    steps = 2 * (expected(assembly).steps - assembly.plan.settle)
    return [Variant("pace", f"twice the steps, {steps}", {"drive.steps": steps})]


def _many(assembly: Assembly) -> int:
    """Steps of a drive at a constant rate that is to be as good as one that was paced by its error."""
    return max(2 * expected(assembly).steps, SLOWEST)


def coupling(assembly: Assembly) -> list[Variant]:
    """Tension and cohesion lost together, or each by itself."""
    return _options(assembly, "coupling", "coupling", {"combined": "combined", "independent": "independent"}, STRENGTHS)


def unloading(assembly: Assembly) -> list[Variant]:
    """Unloading in tension back to the origin, or with the elastic stiffness."""
    return _options(
        assembly, "unloading", "unloading", {"secant": "secant", "elastic": "elastic"}, STRENGTHS[:1], ("brittle",)
    )


def softening(assembly: Assembly) -> list[Variant]:
    """Softening in shear over total slip, or over accumulated plastic slip."""
    words = {"displacement": "over total slip", "plastic": "over plastic slip"}
    return _options(assembly, "softening", "softening_variable", words, (), ("brittle", "friction"))


def _options(
    assembly: Assembly, kind: str, key: str, words: dict[str, str], needs: Sequence[str], without: Sequence[str] = ()
) -> list[Variant]:
    """Each word that not all groups which soften, and have the strengths it needs, have: set for all of them."""
    contact = assembly.scene.contact
    groups = [
        name
        for name in assembly.model.group_names
        if name in contact
        and contact[name].law not in ("elastic", *without)
        and all(getattr(contact[name], need) for need in needs)
    ]
    return [
        Variant(kind, f"{kind} {text}", {f"contact.{_quoted(name)}.{key}": word for name in groups})
        for word, text in words.items()
        if any(contact[name].properties(assembly.scene.turns_back).value(key) != word for name in groups)
    ]


def kinematics(assembly: Assembly) -> list[Variant]:
    """The blocks between supports and drive move otherwise; plates that are held or driven whole stay what they are."""
    scene = assembly.scene
    groups = _loose_groups(assembly)
    elastic = all(None not in (scene.material[g].young_modulus, scene.material[g].poisson_ratio) for g in groups)
    sized = scene.specimen.mesh == "fan" or scene.specimen.mesh_size is not None
    possible = {"rigid": True, "affine": elastic, "tets": elastic and sized}
    return [
        Variant("kinematics", words, {f"kinematics.{_quoted(g)}": motion for g in groups})
        for motion, words in MOTIONS.items()
        if possible[motion] and any(scene.kinematics_of(g) != motion for g in groups)
    ]


def _loose_groups(assembly: Assembly) -> list[str]:
    """Groups of blocks of which not all are held or driven; all groups where there is no other. A floor is held."""
    scene, specimen = assembly.scene, assembly.specimen
    blocks = specimen.blocks
    held = np.zeros(blocks.count, dtype=bool)
    selectors = [s.on for s in scene.support] + ([scene.drive.on] if scene.drive else [])
    for name in (name for selector in selectors for name in selector.split(ALSO)):
        held[specimen.sets.get(name, np.zeros(0, dtype=np.int64))] = True
    groups = [(g, name) for g, name in enumerate(blocks.groups) if not scene.is_floor(name)]
    loose = [name for g, name in groups if not held[blocks.group == g].all()]
    return loose or [name for _, name in groups]


def plates(assembly: Assembly) -> list[Variant]:
    """A rigid plate or beam that may turn is held against it, and the other way round."""
    scene, specimen = assembly.scene, assembly.specimen
    variants = []
    for k, support in enumerate(scene.support):
        members = specimen.sets.get(support.on, np.zeros(0, dtype=np.int64))
        groups = {specimen.blocks.groups[g] for g in specimen.blocks.group[members]}
        rigid = groups and not any(scene.deforms(g) for g in groups)
        fixed = set(support.fix)
        is_plate = "plate" in support.on or support.on == "beam"
        if not is_plate or not rigid or {"x", "y", "z", "rotation"} <= fixed:
            continue
        straight = [word for word in support.fix if not word.startswith("rotation")]
        rotates = len(straight) == len(support.fix)
        name = f"{support.on} {'upright' if rotates else 'free to turn'}"
        variants.append(Variant("plates", name, {f"support.{k}.fix": [*straight, "rotation"] if rotates else straight}))
    return variants


def cells(assembly: Assembly) -> list[Variant]:
    """Other seeds of random cells, or as many random cells in place of a grid; other seeds of scattered properties."""
    scene, spec = assembly.scene, assembly.scene.specimen
    variants = []
    for key, part in (("specimen", spec), ("specimen.mortar", getattr(spec, "mortar", None))):
        given, divisions = getattr(part, "cells", None), getattr(part, "divisions", None)
        if given is not None and given.sites is None:
            seeds = (given.seed + 1, given.seed + 2)
            variants += [Variant("cells", f"cells of seed {s}", {f"{key}.cells.seed": s}) for s in seeds]
        elif given is None and not spec.made_elsewhere and _is_plane_grid(divisions):
            total = _blocks_of(assembly, "mortar" if key.endswith("mortar") else "units")
            cut = {f"{key}.cells.total": total}
            variants += [
                Variant("cells", f"{total} random cells, seed {s}", {**cut, f"{key}.cells.seed": s})
                for s in (1, 2)
                if total > 1
            ]
    if scene.scatter is not None:
        seeds = (scene.scatter.seed + 1, scene.scatter.seed + 2)
        variants += [Variant("cells", f"scatter of seed {s}", {"scatter.seed": s}) for s in seeds]
    return variants


def patches(assembly: Assembly) -> list[Variant]:
    """Points of dry contacts spread over their patches, or at the corners alone, in large displacement; where they do
    not crush, and no number of points is given."""
    spread, along = assembly.scene.specimen.patch_points == "spread", assembly.scene.specimen.patch_points_per_edge
    if not assembly.model.dry or along is not None or assembly.model.crushes:
        return []
    other, words = ("corners", "at their corners") if spread else ("spread", "spread")
    return [Variant("patches", f"points of patches {words}", {"specimen.patch_points": other})]


def _is_plane_grid(divisions: tuple[int, ...] | None) -> bool:
    """Whether units are cut in the plane x-z, and nowhere else."""
    if divisions is None or max(divisions) == 1:
        return False
    return len(divisions) == 2 or divisions[1] == 1


def _blocks_of(assembly: Assembly, group: str) -> int:
    blocks = assembly.specimen.blocks
    return int(np.sum(blocks.group == blocks.groups.index(group))) if group in blocks.groups else 0


KINDS: dict[str, Callable[[Assembly], list[Variant]]] = {
    "damping": damping,
    "pace": pace,
    "coupling": coupling,
    "kinematics": kinematics,
    "unloading": unloading,
    "softening": softening,
    "plates": plates,
    "cells": cells,
    "patches": patches,
}
SLOW = ("kinematics", "cells")
"""Kinds that `quick` leaves out, besides the second variant of each other: they cost several times the base."""


def variants(assembly: Assembly, only: Sequence[str] = (), quick: bool = False) -> list[Variant]:
    """The base, and each variant that makes sense for it. Raises SceneError for a kind that does not exist.

    only   the kinds wanted, all of them where none is named
    quick  one variant of each kind, and none of the SLOW kinds unless named in `only`
    """
    for kind in only:
        if kind not in KINDS:
            raise SceneError(f"--only {kind[:60]}: no such kind of variant; {nearest(kind[:60], KINDS)}")
    rows = [BASE]
    for kind, make in KINDS.items():
        if (only and kind not in only) or (quick and kind in SLOW and kind not in only):
            continue
        made = [variant for variant in make(assembly) if _is_allowed(assembly.scene, variant)]
        rows += made[:1] if quick else made
    return rows


def _is_allowed(scene: Scene, variant: Variant) -> bool:
    """Whether a scene takes the settings: real masses cannot be paced, tets cannot be held by a face, and so on."""
    try:
        scene.with_(variant.settings)
    except SceneError:
        return False
    return True


def _quoted(name: str) -> str:
    return name if name.replace("_", "").isalnum() else f'"{name}"'
