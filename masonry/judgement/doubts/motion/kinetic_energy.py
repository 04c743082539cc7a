"""Is the kinetic energy small beside the energy that the specimen took up? The largest ratio of all rows that count.

5 to 10 % is the usual limit of quasi-static analyses by explicit integration; the lower one counts.
"""

from masonry.judgement.doubt import Criterion
from masonry.judgement.doubts.motion.quasi_static import acts_slowly, slower

LIMIT = 0.05
KINETIC_ENERGY = Criterion(
    name="kinetic_energy",
    measure=lambda evidence: evidence.number("kinetic_over_internal_max"),
    limit=LIMIT,
    sentence="not quasi-static: the kinetic energy reaches {value:.2g} of the internal energy (should be under "
    "{limit:g})",
    advice=slower,
    asked_of=acts_slowly("kinetic_over_internal_max"),
    unknown="the kinetic energy is not known",
)
