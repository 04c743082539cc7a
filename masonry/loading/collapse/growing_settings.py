"""Settings of a load that grows and of the branch behind its collapse: each number once, with its unit and reason."""

from dataclasses import dataclass

from masonry.rows.rest_criterion import BORNE, RestCriterion


@dataclass(frozen=True)
class GrowingSettings:
    """Settings of a load that grows.

    first      the first increment of the factor: no round one, as what can only just bear a load hardly comes to rest
    coarsest   greatest increment, over the factor that is borne; of a load that goes to and fro it is `of_span` times
               the accuracy, over all that it goes through, and `widest` at most: with increments of 4, 2 and 1 % a dry
               wall dissipated 2.2, 1.1 and 0.5 % too much
    damped     times the accuracy: share of the work of such a load that damping may take; `slows` and `hastens`, most
               and least change of its pace from one increment to the next; `slowest`, times by which one takes longer
    look       steps between two looks
    window     looks of which the motion is averaged, at least
    rest       below which the specimen rests, and each block as well (monitors/unrest.py). `reading`, what a gauge may
               move meanwhile over the farthest that it did
    patient    windows after which a trial that does not rest is let go; then `little`, the most local damping; `left`,
               the share of the swings that a look leaves; `memory`, looks over which the drift is averaged. Where no
               local damping was left, blocks slid that stood in the mechanism; where 0.2 of the swings were left, the
               drift was dragged again: half as many steps again
    gathers    averages, at least and by threes, after which what was let go falls where the last third of them has
               taken it `faster` times as far as the second, and `usual` times as far as any way to a rest
    patience   windows after which a trial that neither rests nor falls counts as one that does not rest
    away       of the smallest block: motion since the last rest that is a fall in itself; `usual`, times the most that
               brought it to rest so far, where that is more. Of a block that moves while the sum over all is at rest
               both are its own
    fall       of the smallest block: motion to which the fall is followed, and `fall_looks`, looks that it may take: it
               shows who moves; `far` and `far_looks` where blocks may turn as far as they like. Where something may
               catch it, it is followed on, for `looks_on` looks at most and with a row in each `row_of`, until it has
               moved by `far`, or `slack` times the largest slack of a bar, where a scene does not say how far. It has
               `stalled` after so many looks in which it came no `onward` share farther
    leaps      of the smallest block: a way to a rest that is a fall, where something bears there that did not before,
               and `usual` is less
    """

    first: float = 0.0103
    coarsest: float = 0.5
    of_span: float = 2.0
    widest: float = 0.05
    damped: float = 2.0
    slows: float = 2.0
    hastens: float = 0.7
    slowest: float = 64.0
    look: int = 50
    window: int = 10
    rest: RestCriterion = BORNE
    reading: float = 1e-3
    patient: float = 2.0
    little: float = 0.1
    left: float = 0.5
    memory: float = 10.0
    gathers: int = 6
    faster: float = 1.2
    patience: int = 99
    away: float = 0.005
    usual: float = 10.0
    fall: float = 0.01
    far: float = 0.3
    fall_looks: int = 200
    far_looks: int = 2000
    looks_on: int = 40_000
    row_of: int = 20
    slack: float = 2.0
    stalled: int = 50
    onward: float = 1e-3
    leaps: float = 5e-4

    def to_and_fro(self, accuracy: float) -> float:
        """The longest increment of a load that goes to and fro, over all that its factor goes through."""
        return min(self.of_span * accuracy, self.widest)


GROWING = GrowingSettings()


@dataclass(frozen=True)
class FallingSettings:
    """Settings of the branch behind the collapse. Rates are those of exponentials and of circular frequencies.

    aim        of the accuracy: share of the collapse factor by which the factor exceeds equilibrium, as the gauge
               gathers pace; `rough`, times that, at which it gathers no more, and begins to slow down
    quick      rate of the servo over that of the fall; `slow`, at most over the slowest swing at first: with 0.1 blocks
               that slide began to flutter, at 0.05 blocks, walls and arches did not
    least      times of the servo that the branch takes, at least
    sampled    share of the servo's time that a look takes at most, and `braked`, of the time of the slowest swing; both
               within `shortest` and `longest` steps. Swings are braked at each look: with 1.7 in place of 0.7 a wall
               whose joints slide began to flutter
    memory     rate at which older moves fade from the drift, over that of the servo
    moves      of the most that anything moves: what the gauge must move in the mechanism, at least
    integral   share with which the gauge's lag moves what is taken for equilibrium: as that falls
               steadily, the gauge would else run ahead by as much as the servo is late
    runs       times the pace: a gauge that is faster leaps where it is ahead, and runs away where the factor is 0
    patience   times the steps that a branch takes where all goes well, after which it is given up
    rows       of the whole branch, or, where the gauge is led further, of as far as the specimen is large
    """

    aim: float = 0.5
    rough: float = 3.0
    quick: float = 10.0
    slow: float = 0.05
    least: float = 50.0
    sampled: float = 0.1
    braked: float = 0.7
    shortest: int = 5
    longest: int = 25
    integral: float = 0.3
    memory: float = 0.5
    moves: float = 0.02
    runs: float = 2.0
    patience: float = 20.0
    rows: int = 200


FALLING = FallingSettings()
