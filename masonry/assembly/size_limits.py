"""Sizes are capped before anything is built: a slip of a unit must not fill the memory or run for a year."""

from masonry.errors import SceneError
from masonry.scene import Scene
from masonry.scene.tables.point_counts import DENSITIES

BLOCKS, CONTACT_POINTS, TETS = 5e5, 5e6, 5e6
"""The most that a scene may ask for; about 10 GB of memory each."""
TETS_PER_CUBE = 8.0
"""Tets in a cube of the mesh size (6 to 7 were measured)."""
TETS_PER_FAN = 45
"""Tets in a block that is filled with a fan (12 in a box, 36 to 44 in a cell of space)."""


def require_sane_size(scene: Scene) -> None:
    """Refuse a scene whose estimated size is beyond what a machine can hold; says which key to change."""
    spec = scene.specimen
    blocks, volume = spec.blocks_and_volume
    _require(blocks, BLOCKS, "blocks", spec.key_of_amount)
    _require_few_points(scene, blocks, volume)
    meshed = any(map(scene.is_meshed, scene.kinematics))
    if meshed and spec.mesh == "fan":
        _require(TETS_PER_FAN * blocks, TETS, "tets", "specimen.mesh")
    elif meshed and spec.mesh_size is not None:
        edge = min(spec.mesh_size, volume ** (1 / 3))
        _require(TETS_PER_CUBE * volume / edge**3 if edge**3 > 0 else float("inf"), TETS, "tets", "specimen.mesh_size")


def _require_few_points(scene: Scene, blocks: float, volume: float) -> None:
    """Three faces of each block lie in a joint."""
    spec = scene.specimen
    key = next(key for key in DENSITIES if getattr(spec, key) is not None)
    if scene.points_per_edge is not None:
        x, y, z = scene.points_per_edge
        points = x * y + y * z + z * x
    elif spec.points_per_face is not None:
        points = 3 * spec.points_per_face
    else:
        assert spec.contact_spacing is not None
        points = 3 * max(1.0, 1.6 * (volume / blocks) ** (1 / 3) / spec.contact_spacing) ** 2
    _require(blocks * points, CONTACT_POINTS, "contact points", f"specimen.{key}")


def _require(count: float, most: float, what: str, key: str) -> None:
    if not count <= most:
        raise SceneError(f"{key}: this would make about {count:.2g} {what}; at most {most:.0e} are allowed")
