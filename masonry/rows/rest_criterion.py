"""Whether a specimen is at rest."""

LEAST_STORED = 1e-6
"""Share of the external work that counts as stored at least, where kinetic energy is held against what is stored."""

LONE = 10.0
"""Times by which the force on one block may exceed the share that is asked of the sum over all, and by its square the
energy: where all swing together some swing more than the mean; what falls alone exceeds that within some looks."""


def still_moving(terms: dict[str, float]) -> float:
    """Kinetic energy over what the specimen stores, by its ledger (J)."""
    stored = abs(terms["elastic_blocks"] + terms["elastic_contacts"])
    return abs(terms["kinetic"]) / max(stored, LEAST_STORED * abs(terms["external_work"]), 1e-300)
