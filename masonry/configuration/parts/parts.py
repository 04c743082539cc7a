"""The bodies of a model by how they move: the one place that asks for the kind of a body."""

from masonry.configuration.parts.affine_blocks import AffinePart, DeformingPart
from masonry.configuration.parts.meshed_blocks import DeformingTetPart, TetPart
from masonry.configuration.parts.part import MovingPart
from masonry.configuration.parts.rigid_blocks import RigidPart, TurningPart
from masonry.kinematics.affine import Affine
from masonry.kinematics.deforming import Deforming
from masonry.kinematics.deforming_tets import DeformingTets
from masonry.kinematics.rigid import Rigid
from masonry.kinematics.tets import Tets
from masonry.kinematics.turning import Turning
from masonry.model.kinds import KIND
from masonry.model.model import Model

PART: dict[type, type[MovingPart]] = {
    Rigid: RigidPart,
    Affine: AffinePart,
    Tets: TetPart,
    Turning: TurningPart,
    Deforming: DeformingPart,
    DeformingTets: DeformingTetPart,
}
"""What answers for the arrays of each kind of body."""


def parts_of(model: Model) -> list[MovingPart]:
    """The kinds of bodies that a model has, in the order of layout.KINDS; made once for the bodies that it has."""
    if model.parts is None or model.parts[0] is not model.bodies:
        bodies = zip(KIND.values(), model.bodies, strict=True)
        model.parts = model.bodies, [PART[type(body)](model, kind, body) for kind, body in bodies if body is not None]
    parts: list[MovingPart] = model.parts[1]
    return parts
