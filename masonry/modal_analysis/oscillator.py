"""Masses and tangent stiffness of a scene at its undeformed state, the stiffness as a sum of squares.

The elastic energy is |B u|^2 / 2: three rows of B for each contact (its jump along and across the normal, times roots
of stiffness and area), seven for each strain of a block (its trace and deviator), and one for each spring of an
element. So no digit of a slow mode is lost among stiffnesses that are 10^12 times larger, and what no joint resists is
told from what is soft.
"""

from dataclasses import dataclass
from functools import cached_property

import numpy as np
import scipy.sparse as sparse

from geometry.blocks import Joints, Specimen
from masonry.assembly.assemble import fabric_of
from masonry.assembly.conditions import conditions_of
from masonry.assembly.growing_loads import gravity_of
from masonry.laws.building import factory
from masonry.laws.state import JointProperties
from masonry.model.element_plan import ElementPlan, Springs
from masonry.model.kinds import KIND
from masonry.model.layout import DOFS, KINDS, Layout, real_masses, tet_gradients, tet_volumes
from masonry.model.loads import Conditions, Load, add_gravity
from masonry.model.model import side_of
from masonry.model.stable_step import BETWEEN, CHUNK, Side
from masonry.scene import Scene

PER_CONTACT, PER_STRAIN = 3, 7
"""Rows of B."""


@dataclass(frozen=True)
class Oscillator:
    """Blocks and joints of a scene as an oscillator of n dofs: those of rigid blocks, affine blocks, nodes, one after
    another.

    first       by kind, the number of its first dof
    mass        (n,) kg, kg m2
    free        (n,) which dofs no support holds
    normal, shear  (C,) N/m, stiffnesses of the contacts times their areas
    properties  of each contact group      group  (C,) which one a contact belongs to
    load        (n,) N, weight and other dead loads
    elements    between points of the blocks, or beside them
    """

    scene: Scene
    specimen: Specimen
    joints: Joints
    layout: Layout
    group_names: tuple[str, ...]
    group: np.ndarray
    properties: tuple[JointProperties, ...]
    normal: np.ndarray
    shear: np.ndarray
    lame: np.ndarray
    mass: np.ndarray
    free: np.ndarray
    load: np.ndarray
    elements: tuple[ElementPlan, ...] = ()

    @cached_property
    def first(self) -> dict[str, int]:
        sizes = [self.layout.rows(kind) * DOFS[kind] for kind in KINDS]
        return dict(zip(KINDS, np.cumsum([0, *sizes])[:-1].tolist(), strict=True))

    @cached_property
    def strain_matrix(self) -> sparse.csr_array:
        """(R, n) root of N/m: the matrix B of all contacts, closed, and of the strains of all blocks and of the
        elements behind them."""
        return sparse.csr_array(sparse.vstack([self._jumps(), *self._strains(), *self._lengths()], format="csr"))

    def closed(self, which: np.ndarray) -> sparse.csr_array:
        """(R, n) the same where only some contacts (C,) are closed."""
        count = self.strain_matrix.shape[0] - PER_CONTACT * len(which)
        rows = np.concatenate([np.repeat(which, PER_CONTACT), np.ones(count, dtype=bool)])
        return sparse.csr_array(sparse.diags_array(rows.astype(float)) @ self.strain_matrix)

    def forces(self, scaled: np.ndarray) -> np.ndarray:
        """(C, 3) N of the contacts, where B times the dofs is `scaled` (R,)."""
        count = len(self.joints.area)
        root = np.sqrt(np.column_stack([self.normal, self.shear, self.shear]))
        across = scaled[: PER_CONTACT * count].reshape(count, PER_CONTACT) * root
        return np.asarray(np.einsum("ck,cki->ci", across, _frames(self.joints.normal)))

    def by_kind(self, values: np.ndarray) -> dict[str, np.ndarray]:
        """Values (n,) as rows of dofs, kind by kind."""
        return {
            kind: values[self.first[kind] :][: self.layout.rows(kind) * DOFS[kind]].reshape(-1, DOFS[kind])
            for kind in KINDS
        }

    def along(self, axis: int) -> np.ndarray:
        """(n,) the motion of all by 1 along x, y or z."""
        unit = {kind: np.zeros((self.layout.rows(kind), DOFS[kind])) for kind in KINDS}
        for rows in unit.values():
            rows[:, axis] = 1.0
        return _flat(unit)

    def _jumps(self) -> sparse.csr_array:
        """(3 C, n) how far the sides of contacts move apart along the normal and across it, times roots of N/m."""
        joints, sides = self.joints, tuple(side_of(self.layout, self.joints, which) for which in "ab")
        root = np.sqrt(np.column_stack([self.normal, self.shear, self.shear]))
        frame = _frames(joints.normal) * root[:, :, None]
        rows, dofs, values = [], [], []
        for sign, side in zip((-1.0, 1.0), sides, strict=True):
            for form in np.unique(side.form).tolist():
                chosen = np.flatnonzero(side.form == form)
                for first in range(0, len(chosen), CHUNK):
                    which = chosen[first : first + CHUNK]
                    own, move = self._moves(side, form, which)
                    rows.append(
                        np.broadcast_to(_places(which, PER_CONTACT)[:, :, None], (*own.shape[:1], 3, own.shape[1]))
                    )
                    dofs.append(np.broadcast_to(own[:, None, :], rows[-1].shape))
                    values.append(sign * frame[which] @ move)
        return _gathered(rows, dofs, values, (PER_CONTACT * len(joints.area), len(self.mass)))

    def _lengths(self) -> list[sparse.csr_array]:
        """(K, n) each: by how much springs of elements become longer, times roots of N/m."""
        each = (plan.springs(self.layout) for plan in self.elements)
        return [self._stretches(springs) for springs in each if springs is not None]

    def _stretches(self, springs: Springs) -> sparse.csr_array:
        ends = springs.ends
        rows, dofs, values = [], [], []
        for form in np.unique(ends.side.form).tolist():
            which = np.flatnonzero(ends.side.form == form)
            own, move = self._moves(ends.side, form, which)
            values.append(springs.root[which][:, None] * np.einsum("ni,nij->nj", springs.axis[which], move))
            rows.append(np.broadcast_to(ends.force[which][:, None], own.shape))
            dofs.append(own)
        return _gathered(rows, dofs, values, (ends.total, len(self.mass)))

    def _moves(self, side: Side, form: int, which: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """The dofs (c, m) that a side of contacts moves by, and its displacement (c, 3, m) for a unit of each."""
        move = side.columns(form, which)
        if form == BETWEEN:
            assert side.corner is not None
            return self.first["tets"] + _places(side.corner[which], 3).reshape(len(which), 9), move
        kind = KINDS[form]
        move[:, :, 3:] *= KIND[kind].lengths(side.length[which])[:, None]
        return self.first[kind] + _places(side.row[which], DOFS[kind]), move

    def _strains(self) -> list[sparse.csr_array]:
        """(7 m, n) each: strains of affine blocks and of tets, times roots of N m."""
        layout, parts = self.layout, []
        if len(which := layout.members["affine"]):
            gradient = np.einsum("ai,bjk->baikj", np.eye(3), layout.axes[which]).transpose(0, 1, 3, 2, 4)
            dofs = self.first["affine"] + _places(np.arange(len(which)), 12)[:, 3:]
            parts.append(self._squares(gradient.reshape(-1, 9, 3, 3), layout.volume[which], self.lame[which], dofs))
        if (mesh := layout.mesh) is not None:
            lame = np.repeat(self.lame, np.diff(mesh.tet_start), axis=0)
            gradients, volume = tet_gradients(mesh), tet_volumes(mesh)
            for first in range(0, len(volume), CHUNK):
                some = slice(first, first + CHUNK)
                gradient = np.einsum("im,taj->tamij", np.eye(3), gradients[some]).reshape(-1, 12, 3, 3)
                dofs = self.first["tets"] + _places(mesh.tets[some], 3).reshape(-1, 12)
                parts.append(self._squares(gradient, volume[some], lame[some], dofs))
        return parts

    def _squares(
        self, gradient: np.ndarray, volume: np.ndarray, lame: np.ndarray, dofs: np.ndarray
    ) -> sparse.csr_array:
        """(7 m, n) rows of strains; gradient (m, d, 3, 3) of the displacement for a unit of each dof (m, d)."""
        strain = 0.5 * (gradient + gradient.transpose(0, 1, 3, 2))
        trace = np.einsum("mdii->md", strain)
        diagonal = np.einsum("mdii->mid", strain) - trace[:, None] / 3.0
        across = np.sqrt(2.0) * np.stack([strain[:, :, i, j] for i, j in ((1, 2), (0, 2), (0, 1))], axis=1)
        bulk, mu = np.sqrt(volume * (lame[:, 0] + lame[:, 1] * 2.0 / 3.0)), np.sqrt(2.0 * volume * lame[:, 1])
        values = np.concatenate(
            [(bulk[:, None] * trace)[:, None], mu[:, None, None] * diagonal, mu[:, None, None] * across], axis=1
        )
        rows = _places(np.arange(len(volume)), PER_STRAIN)[:, :, None]
        return _gathered(
            [np.broadcast_to(rows, values.shape)],
            [np.broadcast_to(dofs[:, None], values.shape)],
            [values],
            (PER_STRAIN * len(volume), len(self.mass)),
        )


def oscillator_of(scene: Scene) -> Oscillator:
    """Masses and stiffnesses of a scene; real masses, also where a run scales them. Raises SceneError."""
    fabric = fabric_of(scene)
    specimen, joints, layout, density = fabric.specimen, fabric.joints, fabric.layout, fabric.density
    blocks, names, group, materials = specimen.blocks, fabric.contact_groups, fabric.group, fabric.materials
    conditions = conditions_of(scene.model_copy(update={"motion": ()}), specimen, layout, joints, density)
    properties = tuple(factory.made(name, scene.contact_of(name).properties(scene.turns_back))[1] for name in names)
    stiffness = np.array([(joint.normal_stiffness, joint.shear_stiffness) for joint in properties]).reshape(-1, 2)
    lame = np.array([materials[name].lame() if scene.deforms(name) else (0.0, 0.0) for name in blocks.groups])
    return Oscillator(
        scene=scene,
        specimen=specimen,
        joints=joints,
        layout=layout,
        group_names=names,
        group=group,
        properties=properties,
        normal=stiffness[group, 0] * joints.area,
        shear=stiffness[group, 1] * joints.area,
        lame=lame[blocks.group],
        mass=_flat(real_masses(layout, fabric.moving_density)),
        free=~_flat(conditions.supported),
        load=_dead_load(scene, layout, conditions, density),
        elements=tuple(conditions.elements),
    )


def _dead_load(scene: Scene, layout: Layout, conditions: Conditions, density: np.ndarray) -> np.ndarray:
    """(n,) N: all loads that do not vary, and the whole weight."""
    weight: Load = dict.fromkeys(KINDS)
    add_gravity(layout, weight, density, gravity_of(scene))
    total = {kind: np.zeros((layout.rows(kind), DOFS[kind])) for kind in KINDS}
    varying = [id(load) for load in conditions.varying]
    steady = [load for name, load in conditions.each_load.items() if not name.startswith("gravity")]
    for load in (weight, *(load for load in steady if id(load) not in varying)):
        for kind in KINDS:
            if (rows := load[kind]) is not None:
                total[kind] += rows
    return _flat(total)


def _flat(by_kind: dict[str, np.ndarray]) -> np.ndarray:
    return np.concatenate([by_kind[kind].ravel() for kind in KINDS])


def _places(row: np.ndarray, width: int) -> np.ndarray:
    """(..., width) numbers of what stands in rows (...)."""
    return np.asarray(width * row.astype(np.int64)[..., None] + np.arange(width))


def _frames(normal: np.ndarray) -> np.ndarray:
    """(C, 3, 3) three directions at right angles, in rows; the first is the normal (C, 3)."""
    least = np.eye(3)[np.abs(normal).argmin(axis=1)] if len(normal) else np.zeros((0, 3))
    along = np.cross(normal, least)
    along /= np.linalg.norm(along, axis=1, keepdims=True)
    return np.stack([normal, along, np.cross(normal, along)], axis=1)


def _gathered(
    rows: list[np.ndarray], dofs: list[np.ndarray], values: list[np.ndarray], shape: tuple[int, int]
) -> sparse.csr_array:
    if not values:
        return sparse.csr_array(shape)
    place = tuple(np.concatenate([part.ravel() for part in parts]) for parts in (rows, dofs))
    return sparse.csr_array((np.concatenate([part.ravel() for part in values]), place), shape=shape)
