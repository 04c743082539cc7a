"""Conditions that a scene cannot say: its model built again with other dofs held or driven."""

from collections.abc import Callable
from dataclasses import replace

import numpy as np

from masonry.assembly.assemble import Assembly
from masonry.assembly.conditions import conditions_of
from masonry.assembly.masses import density_of
from masonry.model import model
from masonry.model.layout import DOFS, KINDS, Layout, Material
from masonry.model.loads import Conditions

ROTATION_DOFS = {"x": 3, "y": 4, "z": 5}


def rebuilt(assembly: Assembly, change: Callable[[Conditions, Layout], None]) -> Assembly:
    """The assembly with its conditions changed; its drive goes in steps or at a rate, if there is one."""
    scene, layout, old = assembly.scene, assembly.model.layout, assembly.model
    assert not scene.is_controlled
    materials = {
        name: Material(m.density, m.young_modulus, m.poisson_ratio)
        for name, m in scene.material.items()
        if name in assembly.specimen.blocks.groups
    }
    density = density_of(scene, assembly.specimen, assembly.joints, materials)
    conditions = conditions_of(scene, assembly.specimen, layout, assembly.joints, density)
    change(conditions, layout)
    laws = {
        name: (parameters, joint)
        for name, parameters, joint in zip(old.group_names, old.groups.parameters, old.groups.properties, strict=True)
    }
    solver = scene.solver
    stepping = model.Stepping(solver.masses, solver.time_step, solver.step_fraction, solver.damping)
    blocks, joints = assembly.specimen.blocks, assembly.joints
    built = model.build(blocks, joints, materials, laws, stepping, conditions, layout, None, density)
    return replace(assembly, model=built)


def turned(assembly: Assembly, axis: str) -> Assembly:
    """The assembly with its drive about an axis (the blocks' own, as boxes have): "displacement" then counts rad.

    The scene's drive takes hold of rigid blocks; along its direction they are free now. Force and stress of the history
    are the moment about the blocks' centroids (N m), over the section where it is a stress.
    """

    def rotate(conditions: Conditions, layout: Layout) -> None:
        moved = conditions.driven["rigid"]
        assert moved is not None
        row, along = np.divmod(moved, DOFS["rigid"])
        conditions.prescribed["rigid"][row, along] = conditions.supported["rigid"][row, along]
        conditions.prescribed["rigid"][row, ROTATION_DOFS[axis]] = True
        conditions.driven = dict.fromkeys(KINDS) | {"rigid": DOFS["rigid"] * row + ROTATION_DOFS[axis]}

    return rebuilt(assembly, rotate)
