"""A block that rocks on its edges.

      ____
     |    |  th       th'' = -p^2 sin(alpha - th),  p^2 = 3 g/(4 R),  tan(alpha) = b/h
     |    |/          time to the first impact by quadrature; uplift at a = g b/h
     |____|__

Rocking turns a block by much more than the small rotations that the program is linear in: it stops at `rotation_limit`
(0.02 rad). Housner's coefficient of restitution is no outcome of elastic contacts, and not to be tested.

Reference: Housner (1963), Bulletin of the Seismological Society of America 53, 403.
"""

from verification.case import Case, Findings, RequiredFeature


def run() -> Findings:
    """Cannot be run yet."""
    raise RequiredFeature("large rotations")


CASE = Case(
    "rocking-block",
    "A13",
    "A block that rocks on its edges",
    area="Friction and stability",
    run=run,
    no_problems="not built: there is nothing to run",
)
