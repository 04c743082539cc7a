"""Results of the increments of a drive so far."""

from typing import NamedTuple

from masonry.configuration.energy import Seen
from masonry.loading.drive.borne import BorneForce
from masonry.rows.columns import CRUSHING, stored_in
from masonry.runtime.state_file import Remembering


class DriveRow(NamedTuple):
    """Data of a row for a drive: forces of drive and support (N), what contacts show, and energies (J): stored,
    dissipated by fracture and crushing, of motion, and what damping took; and what of the force (N) is not borne."""

    force: float
    support: float
    seen: Seen
    stored: float
    broken: float
    kinetic: float
    damped: float
    excess: float = 0.0

    @classmethod
    def of(cls, force: float, support: float, seen: Seen, terms: dict[str, float], excess: float) -> "DriveRow":
        """From the ledger (J)."""
        broken = terms["fracture_mode_1"] + terms["fracture_mode_2"] + terms.get(CRUSHING, 0.0)
        return cls(force, support, seen, stored_in(terms), broken, terms["kinetic"], terms["damping"], excess)


class Increments(Remembering):
    """The last increment, and the most that all of them brought.

    count                        how many there were
    made                         m, by the last one
    stored, broken, damped       J at its end, see DriveRow
    place, force                 m, signed, and N: of the drive, when it was seen last
    most_stored, most_force      the most so far (J, N); farthest: of the places (m)
    work                         J, of the drive; work back counts as well
    settled_force                N, signed, before the drive moved
    borne                        what of the force counts for the peak
    """

    REMEMBERED = (
        *("count", "made", "stored", "broken", "damped", "place", "force"),
        *("most_stored", "most_force", "farthest", "work", "settled_force"),
    )

    def __init__(self, borne: BorneForce) -> None:
        self.borne, self.count = borne, 0
        self.made = self.stored = self.broken = self.damped = self.place = self.force = 0.0
        self.most_stored = self.most_force = self.farthest = self.work = self.settled_force = 0.0

    def begin(self, row: DriveRow) -> None:
        """The dead loads have settled."""
        self.stored = self.most_stored = row.stored
        self.force = self.settled_force = row.force
        self.borne.begin(row.force)

    def book(self, made: float) -> None:
        """Another one sets out, of so much (m)."""
        self.made = made
        self.count += 1

    def see(self, row: DriveRow) -> None:
        """Update of the extremes and the work by a row."""
        self.most_stored = max(self.most_stored, row.stored, 1e-300)
        self.most_force = max(self.most_force, abs(row.force), 1e-300)
        self.work += abs(row.force) * self.made

    def close(self, row: DriveRow, damped: float) -> None:
        """The next one is measured from here."""
        self.stored, self.broken, self.damped = row.stored, row.broken, damped

    def parts(self) -> dict[str, BorneForce]:
        """Force that is borne, by its name as a part."""
        return {"borne": self.borne}
