"""Tables of a scene for faces at which waves leave, and for a wave that comes in through them."""

from typing import Annotated, ClassVar

from masonry.scene.tables.dynamics.ground import GivenMotion
from masonry.scene.tables.types import Density, Given, Selector, Table

WaveSpeed = Annotated[float, Given("velocity", "(0, 1e5]")]


class IncomingWave(GivenMotion):
    """A motion that comes in through faces."""

    PLACE: ClassVar[str] = "quiet.wave"


class QuietBoundary(Table):
    """Faces of blocks that deform behind which the same goes on without an end.

    density, p_speed, s_speed  kg/m3 and m/s of what goes on, those of the blocks' material where not given
    wave  motion of a wave that comes in, along x, y, z as a point far inside of it would move: keys of [ground]
    """

    on: Selector
    density: Density | None = None
    p_speed: WaveSpeed | None = None
    s_speed: WaveSpeed | None = None
    wave: IncomingWave | None = None
