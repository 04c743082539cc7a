"""`masonry check`, with a line on what `masonry run --error-bar` would refine."""

from typing import TYPE_CHECKING

from masonry.errors import SceneError
from masonry.sweeps.convergence.refinement.resolutions import ALONG, resolutions_of

if TYPE_CHECKING:
    from masonry.laboratory.text import Report
    from masonry.scene import Scene

POINTS = "contact points"


def checked(scene: "Scene") -> "Report":
    """Report on a scene before a run. Raises SceneError or GeometryError."""
    from masonry.laboratory.laboratory import check

    return check(scene) | {"error_bar": error_bar_line(scene)}


def error_bar_line(scene: "Scene") -> str:
    """The command that tells how far its numbers are off, and by what; empty where nothing can be refined, or run."""
    from masonry.assembly.growing_loads import require_axles_to_load

    try:
        require_axles_to_load(scene)
    except SceneError:
        return ""
    names = [resolution.name for resolution in resolutions_of(scene)]
    names = list(dict.fromkeys(POINTS if name.startswith(ALONG) else name for name in names))
    listed = " and ".join([", ".join(names[:-1]), names[-1]] if len(names) > 1 else names)
    return f"masonry run --error-bar says how far its numbers are off by {listed}" if names else ""
