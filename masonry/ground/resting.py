"""A record brought to rest: neither velocity nor displacement is left at its end."""

import numpy as np

from masonry.ground.ground_motion import from_acceleration


def residuals(time: np.ndarray, acceleration: np.ndarray) -> tuple[float, float]:
    """Velocity (m/s) and displacement (m) at the end of an acceleration that is straight between its samples."""
    motion = from_acceleration(time, acceleration)
    return motion.residual_velocity, motion.residual_displacement


def at_rest(time: np.ndarray, acceleration: np.ndarray, envelope: np.ndarray) -> np.ndarray:
    """The record less the envelope times a straight line in time that leaves no velocity and no displacement."""
    middle = time - time.mean()
    shapes = (envelope, envelope * middle / time[-1])
    over = np.transpose([residuals(time, shape) for shape in shapes])
    factors = np.linalg.solve(over, residuals(time, acceleration))
    rest: np.ndarray = acceleration - factors[0] * shapes[0] - factors[1] * shapes[1]
    return rest


def rounded(acceleration: np.ndarray, digit: float) -> np.ndarray:
    """Samples of equal steps, 0 at both ends, as multiples of `digit` that leave no velocity and no displacement.

    Whole numbers n_i of equal steps leave neither where their sum and that of i n_i are 0: the velocity is their sum
    times the step, each sample a triangle about its time. What rounding leaves of the two sums is taken away one by
    one.
    """
    whole = np.rint(acceleration / digit).astype(np.int64)
    whole[0] = whole[-1] = 0
    last = len(whole) - 2
    places = np.arange(len(whole))
    excess = int(whole.sum())
    spread = np.linspace(1, last, abs(excess) + 2).astype(int)[1:-1]
    np.add.at(whole, spread, -int(np.sign(excess)))
    moment = int((places * whole).sum())
    width = last - 1
    pairs, rest = divmod(abs(moment), width)
    sign = int(np.sign(moment))
    for number in range(pairs + (rest > 0)):  # one less at i, one more before it
        length = width if number < pairs else rest
        whole[1 + length] -= sign
        whole[1] += sign
    return whole * digit
