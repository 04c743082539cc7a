"""Growing loads with slack, gaps and stops, and what is known of them by hand."""

from dataclasses import dataclass
from math import cos, hypot, radians, sin

from scipy.optimize import brentq

from masonry.scene import Scene
from tests.loading.caught.scenes import AREA, DENSITY, GRAVITY, MODULUS, Bar, Boxed, push, scene

TILT = 'pattern = "tilt"\nabout = "-y"'


@dataclass(frozen=True)
class Case:
    """A scene and what it is known to do.

    moves    factor at which it first moves     bears  the greatest that it bears in the end; None: it does not fall
    travels  m, of each fall that comes to rest; none where nothing catches it     slow  seconds rather than one
    """

    name: str
    scene: Scene
    moves: float
    bears: float | None
    travels: tuple[float, ...]
    slow: bool = False


def leaning(wall: Boxed, height: float, slack: float, force: float) -> tuple[float, tuple[float]]:
    """Factor at which a wall that leans about its toe is pushed over against a bar, and by how far it came to that.

    The bar is level at first, at a height on the far face from the toe, and 2 m long.
    """
    length, (width, _, high) = 2.0, wall.size

    def along(turn: float) -> tuple[float, float]:
        """m, of the bar: to the side, and up."""
        x = -width * cos(turn) + height * sin(turn)
        return x + width + length, width * sin(turn) + height * cos(turn) - height

    def turned(stretch: float) -> float:
        """Rad, at which the bar is longer by so much (m)."""
        return brentq(lambda turn: hypot(*along(turn)) - length - stretch, 0.0, 0.3)

    turn = turned(slack + force * (length + slack) / (MODULUS * AREA))
    (x, z), long = along(turn), hypot(*along(turn))
    moment = force * ((z + height) * x - (x - width - length) * z) / long
    arm, rise = 0.5 * (width * cos(turn) - high * sin(turn)), 0.5 * (width * sin(turn) + high * cos(turn))
    size = (wall.weight / (DENSITY * GRAVITY)) ** (1 / 3)
    return (wall.weight * arm + moment) / (wall.weight * rise), (turned(slack) * hypot(0.5 * width, 0.5 * high, size),)


def sliding() -> list[Case]:
    """One block that slides until a chain bears."""
    b, skew = Boxed("b", (0.0, 0.0, 0.0), (0.4, 1.0, 0.4)), Boxed("b", (0.2, -0.4, 0.0), (0.7, 0.5, 0.3))
    huge, w = Boxed("b", (0.0, 0.0, 0.0), (2.0, 2.0, 1.5)), b.weight
    low = Bar((0.0, 0.5, 0.05), (-2.0, 0.5, 0.05), 0.005, 1500.0)
    side = Bar((0.55, 0.1, 0.04), (0.55, 1.9, 0.04), 0.02, 900.0)
    rises, spread = radians(20.0), radians(30.0)
    up = Bar((0.0, 0.5, 0.05), (-2.0 * cos(rises), 0.5, 0.05 + 2.0 * sin(rises)), 0.01, 1200.0)
    oblique = [
        Bar((0.0, y, 0.1), (-2.0 * cos(spread), y + side * 2.0 * sin(spread), 0.1), 0.012, 800.0)
        for y, side in ((0.2, -1.0), (0.8, 1.0))
    ]
    pair = [Bar((0.0, y, 0.05), (-2.0, y, 0.05), slack, 600.0) for y, slack in ((0.5, 0.005), (0.5, 0.012))]
    long = Bar((0.0, 0.5, 0.05), (-2.0, 0.5, 0.05), 0.05, 1100.0)
    little = Bar((0.0, 1.0, 0.1), (-2.0, 1.0, 0.1), 0.004, 30e3)
    ahead = Bar((0.4, 0.5, 0.05), (2.4, 0.5, 0.05), 0.005, 1500.0)
    down = Bar((0.2, 0.5, 0.1), (0.2, 0.5, -1.0), 0.006, 2000.0)
    caught, tilted = 0.5 + 1500.0 / w, brentq(lambda f: (f - 0.5) / hypot(1.0, f) - 600.0 / w, 0.5, 3.0)
    along_y = 'pattern = "weight"\ndirection = "-y"'
    rising = 0.5 + 1200.0 * (cos(rises) + 0.5 * -sin(rises)) / w
    return [
        Case("chain at the foot", scene(b, friction=0.5, bars=[low]), 0.5, caught, (0.005,)),
        Case("affine block", scene(b, friction=0.5, bars=[low], kinematics="affine"), 0.5, caught, (0.005,)),
        Case(
            "pushed along -y",
            scene(skew, friction=0.35, bars=[side], limit=along_y),
            *(0.35, 0.35 + 900.0 / skew.weight, (0.02,)),
        ),
        Case("chain that rises", scene(b, friction=0.5, bars=[up]), 0.5, rising, (0.01 / cos(rises),)),
        Case(
            "two chains that spread",
            scene(b, friction=0.4, bars=oblique),
            *(0.4, 0.4 + 2 * 800.0 * cos(spread) / w, (0.012 / cos(spread),)),
        ),
        Case(
            "one chain after the other",
            scene(b, friction=0.5, bars=pair),
            *(0.5, 0.5 + 2 * 600.0 / w, (0.005, 0.007)),
        ),
        Case("tilted", scene(b, friction=0.5, bars=[pair[0]], limit=TILT), 0.5, tilted, (0.005,)),
        Case("no friction", scene(b, friction=0.0, bars=[low]), 0.0, 1500.0 / w, (0.005,)),
        Case(
            "much block, little slack",
            scene(huge, friction=0.6, bars=[little]),
            0.6,
            0.6 + 30e3 / huge.weight,
            (0.004,),
        ),
        Case("chain on the far side", scene(b, friction=0.5, bars=[ahead]), 0.5, 0.5, ()),
        Case("a fall of 4 mm", scene(b, friction=0.5, bars=[low], more='travel = "4 mm"'), 0.5, 0.5, ()),
        Case("a fall of 6 mm", scene(b, friction=0.5, bars=[low], more='travel = "6 mm"'), 0.5, caught, (0.005,)),
        Case(
            "lifted until a chain holds it down",
            scene(b, friction=0.5, bars=[down], limit=push(b, z=1.0)),
            *(1.0, 1.0 + 2000.0 / w, (0.006,)),
        ),
        Case("chain, large", scene(b, friction=0.5, bars=[low], large=True), 0.5, caught, (0.005,), True),
        Case(
            "slack of 50 mm, large",
            scene(b, friction=0.5, bars=[long], large=True),
            0.5,
            0.5 + 1100.0 / w,
            (0.05,),
            True,
        ),
        Case(
            "tilted, large", scene(b, friction=0.5, bars=[pair[0]], limit=TILT, large=True), 0.5, tilted, (0.005,), True
        ),
    ]


def turning() -> list[Case]:
    """Walls that turn about their toe until a chain bears."""
    wall, slender = Boxed("b", (0.0, 0.0, 0.0), (0.4, 1.0, 2.0)), Boxed("b", (0.3, -0.2, 0.0), (0.25, 0.8, 1.5))
    high = Bar((0.0, 0.5, 1.5), (-2.0, 0.5, 1.5), 0.004, 4000.0)
    loose = Bar((0.0, 0.5, 1.5), (-2.0, 0.5, 1.5), 0.02, 4000.0)
    other = Bar((0.3, 0.2, 0.9), (-1.7, 0.2, 0.9), 0.008, 2500.0)
    drawn = (wall.weight * 0.2 + 4000.0 * 1.5) / wall.weight
    travel = 0.004 / 1.5 * hypot(0.2, 1.0, 0.8 ** (1 / 3))
    return [
        Case("wall on a chain", scene(wall, friction=0.7, bars=[high]), 0.2, drawn, (travel,)),
        *(
            Case(
                f"{name}, large",
                scene(one, friction=0.7, bars=[bar], large=True),
                one.size[0] / one.size[2],
                *known,
                True,
            )
            for name, one, bar, known in (
                ("wall on a chain", wall, loose, leaning(wall, 1.5, 0.02, 4000.0)),
                ("slender wall on a chain", slender, other, leaning(slender, 0.9, 0.008, 2500.0)),
            )
        ),
    ]


def stacked() -> list[Case]:
    """Two blocks on each other."""
    lower = Boxed("lower", (0.0, 0.0, 0.0), (0.6, 0.6, 0.3), "low")
    upper = Boxed("upper", (0.1, 0.1, 0.3), (0.4, 0.4, 0.2), "top")
    weak = Bar((0.1, 0.3, 0.35), (-1.9, 0.3, 0.35), 0.008, 120.0)
    strong = Bar((0.1, 0.3, 0.35), (-1.9, 0.3, 0.35), 0.008, 2000.0)
    between = Bar((0.1, 0.3, 0.35), (0.0, 0.3, 0.3), 0.006, 5000.0, fixed=False)
    rough, smooth = ({"low_top": 0.25, "low_units": ground} for ground in (0.6, 0.3))
    share = upper.weight / lower.weight
    weakly = 0.25 + 120.0 / upper.weight
    return [
        Case("upper block on a chain", scene(lower, upper, friction=rough, bars=[weak]), 0.25, weakly, (0.008,)),
        Case(
            "lower block slides from under",
            scene(lower, upper, friction=smooth, bars=[strong]),
            *(0.25, 0.3 + (0.3 + 0.25) * share, (0.008,)),
        ),
        Case(
            "chain between both",
            scene(lower, upper, friction={"low_top": 0.25, "low_units": 0.4}, bars=[between]),
            *(0.25, 0.4, (0.006 * hypot(0.1, 0.05) / 0.1,)),
        ),
        Case(
            "upper block on a chain, large",
            scene(lower, upper, friction=rough | {"top_units": 0.5}, bars=[weak], large=True),
            *(0.25, weakly, (0.008,), True),
        ),
    ]


def stopped() -> list[Case]:
    """Blocks that meet stops and other blocks, in large displacement."""
    b = Boxed("b", (0.0, 0.0, 0.0), (0.4, 1.0, 0.4))
    high = Boxed("stop", (0.41, 0.0, 0.0), (0.3, 1.0, 0.5), is_support=True)
    far = Boxed("stop", (2.4, 0.0, 0.0), (0.3, 1.0, 0.5), is_support=True)
    tall, low = (
        Boxed("b", (0.0, 0.0, 0.0), (0.4, 1.0, 0.6), "free"),
        Boxed("stop", (0.406, 0.0, 0.0), (0.3, 1.0, 0.1), "stops", True),
    )
    one = Boxed("one", (0.0, 0.0, 0.0), (0.4, 0.5, 0.3), "smooth")
    two = Boxed("two", (0.412, 0.0, 0.0), (0.5, 0.5, 0.4), "rough")
    three = [
        Boxed(name, (x, 0.0, 0.0), (0.4, 0.5, 0.3), name)
        for name, x in (("one", 0.0), ("two", 0.405), ("three", 0.812))
    ]
    along = Boxed("b", (0.0, 0.0, 0.0), (0.4, 1.0, 0.4), "free")
    wall = Boxed("wall", (0.41, -1.0, 0.0), (0.3, 4.0, 0.5), "stops", True)
    skew = radians(50.0)
    seat = Boxed("seat", (0.0, 0.0, 0.0), (1.0, 0.4, 0.3), is_support=True)
    pillar = Boxed("pillar", (1.2, 0.0, 0.0), (0.2, 0.4, 0.292), is_support=True)
    beam = Boxed("beam", (0.0, 0.0, 0.3), (1.6, 0.4, 0.2))
    leans = Boxed("leans", (0.0, 0.0, 0.0), (0.2, 0.5, 0.8), "slender")
    holds = Boxed("holds", (0.21, 0.0, 0.0), (0.6, 0.5, 0.9), "squat")
    together = (0.3 * one.weight + 0.6 * two.weight) / (one.weight + two.weight)
    turn, slide = 0.01 / 0.8, 0.5 * holds.weight
    leaning_on = (slide + leans.weight * (0.125 - 0.5 * turn)) / (holds.weight + 0.5 * leans.weight)
    return [
        Case("high stop", scene(b, high, friction=0.5, large=True, more="up_to = 3"), 0.5, None, (0.01,), True),
        Case("stop out of reach", scene(b, far, friction=0.5, large=True), 0.5, 0.5, (), True),
        Case(
            "tips over a low stop",
            scene(tall, low, friction={"free_units": 0.3, "free_stops": 0.0, "stops_units": 0.3}, large=True),
            *(0.3, (0.2 + 0.3 * 0.1) / 0.2, (0.006,), True),
        ),
        Case(
            "pushes another block",
            scene(one, two, friction={"smooth_units": 0.3, "rough_units": 0.6, "rough_smooth": 0.0}, large=True),
            *(0.3, together, (0.012,), True),
        ),
        Case(
            "three blocks in a row",
            scene(
                *three,
                friction={"one_units": 0.2, "two_units": 0.3, "three_units": 0.6, "default": 0.0},
                large=True,
            ),
            *(0.2, 1.1 / 3.0, (0.005, 0.007), True),
        ),
        Case(
            "along a wall, askew",
            scene(
                along,
                wall,
                friction={"free_units": 0.5, "free_stops": 0.2, "stops_units": 0.5},
                limit=push(along, x=cos(skew), y=sin(skew)),
                large=True,
            ),
            *(0.5, 0.5 / (sin(skew) - 0.2 * cos(skew)), (0.01 / cos(skew),), True),
        ),
        Case(
            "beam comes down on a pillar",
            scene(seat, pillar, beam, friction=0.6, limit=push(beam, (1.55, 0.2, 0.3), z=-1.0), large=True),
            *(0.2 / 0.55, (0.6 - 0.1 * 0.02) / 0.15, (0.02 * hypot(0.2, 0.1, 0.03125 ** (1 / 3)),), True),
        ),
        Case(
            "leans on a block",
            scene(
                leans,
                holds,
                friction={"slender_units": 0.6, "squat_units": 0.5, "slender_squat": 0.0},
                large=True,
            ),
            *(0.25, leaning_on, (turn * hypot(0.1, 0.4, 0.08 ** (1 / 3)),), True),
        ),
    ]


CASES = [*sliding(), *turning(), *stacked(), *stopped()]
