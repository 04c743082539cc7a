"""Properties that a scene lets differ from joint to joint: what is drawn, and the laws that come of it."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from geometry.blocks import Blocks, Joints
from masonry.errors import SceneError, nearest
from masonry.laws.building import factory
from masonry.laws.building.contact_properties import ContactProperties
from masonry.laws.state import JointProperties
from masonry.model.draws import PROPERTIES, correlated, lognormal, pairs_of, standard_normals
from masonry.scene.tables.scatter import Scatter
from masonry.simd.rows import aligned

UNITS = {key: (1e-6, "MPa") for key in ("tensile_strength", "cohesion", "compressive_strength")}
"""Factor and unit in which drawn values are shown; energies in N/m."""


@dataclass(frozen=True)
class Drawn:
    """Values drawn for a group of contacts.

    pairs   (J, 2) numbers of the two units of each joint; within a unit both are the same
    joint   (c,) the joint of each contact of the group
    point   (c, 3) m, where the contacts are
    values  (J,) SI, by the scene's key
    """

    group: str
    pairs: np.ndarray
    joint: np.ndarray
    point: np.ndarray
    values: dict[str, np.ndarray]

    def words(self, j: int) -> str:
        """A joint in words, to blame it in a message."""
        a, b = self.pairs[j]
        what = f"unit {a}" if a == b else f"the joint of units {a} and {b}"
        place = ", ".join(f"{x:.4g}" for x in self.point[self.joint == j].mean(axis=0))
        return f"{what} at ({place}) m"

    def summary(self) -> dict[str, dict[str, float]]:
        """Number of draws, least, mean and greatest value (SI) by key."""
        return {
            key: {
                "draws": len(v),
                "least": float(v.min()),
                "mean": float(v.mean()),
                "greatest": float(v.max()),
            }
            for key, v in self.values.items()
        }

    def lines(self) -> list[str]:
        """The same in words, a line for each key."""
        within = self.pairs[:, 0] == self.pairs[:, 1]
        what = "units" if within.all() else "joints"
        lines = []
        for key, numbers in self.summary().items():
            factor, unit = UNITS.get(key, (1.0, "N/m"))
            least, mean, greatest = (f"{numbers[name] * factor:.4g}" for name in ("least", "mean", "greatest"))
            lines.append(
                f"{self.group}.{key}: {least} to {greatest} {unit}, mean {mean}, over {numbers['draws']} {what}"
            )
        return lines


def draw(scatter: Scatter, contact: Mapping[str, Any], group: str, blocks: Blocks, joints: Joints, own: slice) -> Drawn:
    """The draws of a group whose contacts are `own` among the joints; raises SceneError for what its law does not read.

    contact  the scene's tables by group
    """
    scattered, law = scatter.groups[group], contact[group].law
    read = (*factory.properties_of(law), *(factory.CRUSHING if contact[group].crushing else ()))
    for key in scattered.variations:
        if key not in read:
            raise SceneError(
                f"scatter.{group}.{key}: law '{law}' does not read it; {nearest(key, set(read) & set(PROPERTIES))}"
            )
    pairs, joint = pairs_of(blocks.unit[joints.block_a[own]], blocks.unit[joints.block_b[own]])
    normals = standard_normals(scatter.seed, group, pairs)
    values = {
        key: lognormal(getattr(contact[group], key), scattered.variations[key], normal)
        for key, normal in correlated(normals, list(scattered.variations), scattered.correlation).items()
    }
    return Drawn(group, pairs, joint, joints.point[own], values)


def laws_of(drawn: Drawn, properties: ContactProperties, compressions: Sequence[float]) -> tuple[Any, JointProperties]:
    """(parameters, joint) of a group with an array (c,) for each parameter that differs; raises SceneError.

    properties, compressions  as for laws.building.factory.build; the properties that are drawn give the mean
    """
    laws: list[tuple[Any, JointProperties]] = []
    for j in range(len(drawn.pairs)):
        values: dict[str, Any] = {key: float(values[j]) for key, values in drawn.values.items()}
        try:
            laws.append(factory.made(drawn.group, replace(properties, **values), compressions))
        except SceneError as error:
            raise SceneError(f"{error}, as [scatter.{drawn.group}] draws it for {drawn.words(j)}") from None
    _require_no_snap_back(drawn, properties, laws, compressions)
    parameters, joint = (_together([law[k] for law in laws], drawn.joint) for k in (0, 1))
    return parameters, joint


def _require_no_snap_back(
    drawn: Drawn, properties: ContactProperties, laws: list[tuple[Any, JointProperties]], compressions: Sequence[float]
) -> None:
    """Raise SceneError for the draw that lacks most, if any snaps back."""
    refused = {}
    for j, (parameters, joint) in enumerate(laws):
        lack = factory.refusal(parameters, joint, compressions)
        if lack is not None:
            value = drawn.values[lack.key][j] if lack.key in drawn.values else properties.value(lack.key)
            refused[j] = lack.bound / value, value, lack
    if not refused:
        return
    worst = max(refused, key=lambda j: refused[j][0])
    _, value, lack = refused[worst]
    raise SceneError(
        f"contact.{drawn.group}.{lack.key} = {value:.6g} (SI), as [scatter.{drawn.group}] draws it for "
        f"{drawn.words(worst)}, does not work with law '{properties.law}': it must be above {lack.wanted}; "
        f"{lack.why}; {len(refused)} of {len(laws)} draws are refused, this one lacks most: raise "
        f"contact.{drawn.group}.{lack.key}, lower the coefficients of variation, or choose law exponential"
    )


def _together(tuples: list[Any], joint: np.ndarray) -> Any:
    """One NamedTuple for all joints: what differs between them as an array over the contacts (c,)."""
    columns = zip(*tuples, strict=True)
    return type(tuples[0])(*(_number_or_array(column, joint) for column in columns))


def _number_or_array(column: tuple[Any, ...], joint: np.ndarray) -> Any:
    if all(value == column[0] for value in column):
        return column[0]
    return aligned(np.array(column)[joint])
