"""Are the accelerations of a record differences of noise? A displacement in whole hundredths of a millimetre, taken a
thousand times a second, shakes by several g while it stands still: the noise over the square of the step. With every
second sample noise of a displacement is a quarter, that of a velocity a half, and a motion stays as it is. So where the
peak acceleration is 1.15 times that of every second sample, a sixth of the peak of a displacement is noise, and a
fourth of that of a velocity.

Asked of files of velocities and displacements.
"""

import numpy as np

from masonry.assembly.assemble import Assembly
from masonry.ground.ground_motion import Motion, from_samples
from masonry.judgement.doubt import Doubt
from masonry.quantity import GRAVITY

LIMIT = 1.15
FEWEST = 16
"""Samples of a record that is asked."""


def doubts(assembly: Assembly) -> list[Doubt]:
    """One for each component."""
    raised = []
    for ground in (*assembly.scene.ground, *assembly.scene.waves):
        if ground.record is None or ground.quantity == "acceleration":
            continue
        for axis, motion in ground.motions.items():
            peak = motion.peak_acceleration / GRAVITY
            second = peak_of_every_second_sample(motion, ground.quantity, ground.rate) / GRAVITY
            if peak > LIMIT * second:
                sentence = (
                    f"the {ground.quantity} of {ground.PLACE} along {axis} accelerates by up to {peak:.3g} g, and by "
                    f"{second:.3g} g with every second sample: its differences are noise"
                )
                advice = "filter the record, take fewer samples of it, or give its acceleration"
                raised.append(Doubt("noisy_record", peak / second, LIMIT, sentence, advice))
    return raised


def peak_of_every_second_sample(motion: Motion, quantity: str, rate: float) -> float:
    """m/s2, of a motion that was made of samples (Hz) of a velocity or a displacement; of all where they are few."""
    count = round(motion.duration * rate)
    if count < FEWEST:
        return motion.peak_acceleration
    time = np.linspace(0.0, motion.duration, count + 1)[::2]
    values = motion.velocity_at(time) if quantity == "velocity" else motion.displacement_at(time)
    return from_samples(quantity, time, values, "linear").peak_acceleration
