"""The runs that are killed: every kind of pace, motion and memory, on one thread and on two."""

from dataclasses import dataclass

EVERY = "0.02 s"
"""Between two checkpoints: a kill then finds many of them, and often hits one as it is written."""


@dataclass(frozen=True)
class Trial:
    """A scene, what is set in it, and threads before and after the kill."""

    name: str
    scene: str
    settings: tuple[str, ...] = ()
    threads: tuple[int, int] = (1, 1)

    def words(self, out: object, every: str = EVERY) -> list[str]:
        """The command that runs it into a folder."""
        set_words = [word for setting in self.settings for word in ("--set", setting)]
        how = ["--threads", str(self.threads[0]), "--checkpoint-every", every]
        return ["run", self.scene, *set_words, "--out", str(out), *how]


SMALL = ("specimen.divisions=[4, 2]",)
TETS = (*SMALL, "drive.rate=400 mm/s", "solver.rows=100", "kinematics=tets", "specimen.mesh_size=60 mm")
BENDING = (
    *("specimen.divisions=[2, 1, 1]", "scatter.unit_unit.cohesion=0.3"),
    *("drive.displacement=0.05 mm", "drive.accuracy=10 %"),
)

TRIALS = (
    Trial("couplet at a rate", "couplet", ("drive.steps=20000", "solver.rows=100")),
    Trial("wall to an accuracy", "wallette-mode-1", (*SMALL, "drive.accuracy=3 %"), (1, 2)),
    Trial("wall of affine units", "wallette-mode-1", (*SMALL, "drive.accuracy=10 %", "kinematics=affine"), (2, 1)),
    Trial("wall of tets", "wallette-mode-1", TETS, (2, 1)),
    Trial("scatter and a gauge", "bending-0", BENDING),
)
