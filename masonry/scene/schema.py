"""The keys of a scene: specimen, properties, supports, loading and solver, in SI; and what follows from several."""

from typing import Annotated, Any, Literal

from pydantic import AfterValidator, BeforeValidator, Field, WrapSerializer, model_validator

from masonry.scene.tables.contact_group import Contact, MaterialTable
from masonry.scene.tables.dynamics.added_mass import AddedMass
from masonry.scene.tables.dynamics.ground import GivenMotion, Ground, as_tables, as_written
from masonry.scene.tables.dynamics.quiet_boundary import QuietBoundary
from masonry.scene.tables.dynamics.swing import DampingTable
from masonry.scene.tables.gauge import Curve, GaugeTable
from masonry.scene.tables.gravity_and_floor import Floor, Gravity, InitialMotion
from masonry.scene.tables.law_keys import AnyContact
from masonry.scene.tables.limit import LimitLoad
from masonry.scene.tables.loads_and_supports import Drive, Fill, Settle, Solver, Support, Traction
from masonry.scene.tables.point_counts import DENSITIES, PerAxis
from masonry.scene.tables.road.vehicle import Vehicle
from masonry.scene.tables.scatter import Scatter
from masonry.scene.tables.specimen import Specimen
from masonry.scene.tables.specimens.bar import BarTable
from masonry.scene.tables.standard import Standard
from masonry.scene.tables.types import Law, Motion, ReadOnly, Strength, Table
from masonry.scene.variant import LIMITS

SAMPLING = 200.0
"""Rows a second of a scene whose ground moves: gauges of accelerations are good up to a fifth of it."""
TURNED = {"x": "yz", "y": "xz", "z": "xy"}
"""Along which axes what is turned about one acts."""
INVENTED = "a placeholder that the import made up: put in your own"
"""What `masonry import` notes in [assumptions] of a key that the file does not hold."""


def _by_group(value: Any) -> Any:
    """One kinematics for all groups, or a table of them."""
    return {"default": "rigid", **value} if isinstance(value, dict) else {"default": value}


class SceneKeys(Table):
    """All that a run needs, in SI; `name` is the file's unless it gives one. `SceneData` has them fit together."""

    name: Annotated[str, Field(pattern=r"^[^/\\\x00]{1,200}$")]
    title: Annotated[str, Field(max_length=500)] = ""
    law: Law | None = None
    displacements: Literal["small", "large"] = "small"
    kinematics: Annotated[dict[str, Motion], BeforeValidator(_by_group), AfterValidator(ReadOnly)] = ReadOnly(
        default="rigid"
    )
    confinement: Strength | None = None
    specimen: Specimen
    material: Annotated[dict[str, MaterialTable], Field(min_length=1), AfterValidator(ReadOnly)]
    contact: Annotated[dict[str, AnyContact], Field(min_length=1), AfterValidator(ReadOnly)]
    scatter: Scatter | None = None
    support: tuple[Support, ...] = ()
    drive: Drive | None = None
    traction: tuple[Traction, ...] = ()
    fill: tuple[Fill, ...] = ()
    vehicle: Vehicle | None = None
    mass: tuple[AddedMass, ...] = ()
    bar: tuple[BarTable, ...] = ()
    gravity: Gravity | None = None
    motion: tuple[InitialMotion, ...] = ()
    floor: Floor | None = None
    quiet: tuple[QuietBoundary, ...] = ()
    ground: Annotated[tuple[Ground, ...], BeforeValidator(as_tables), WrapSerializer(as_written)] = ()
    damping: DampingTable | None = None
    settle: Settle | None = None
    solver: Solver = Solver()
    gauge: tuple[GaugeTable, ...] = ()
    curve: Curve | None = None
    standard: Standard | None = None
    limit: LimitLoad | None = None
    assumptions: Annotated[dict[str, str], AfterValidator(ReadOnly)] = ReadOnly()

    def kinematics_of(self, group: str) -> str:
        """ "rigid", "affine" or "tets": how the blocks of a group move."""
        return self.kinematics.get(group, "rigid" if self.is_floor(group) else self.kinematics["default"])

    def deforms(self, group: str) -> bool:
        """Whether the blocks of a group are not rigid."""
        return self.kinematics_of(group) != "rigid"

    def is_meshed(self, group: str) -> bool:
        """Whether the blocks of a group are made of tets."""
        return self.kinematics_of(group) == "tets"

    def is_floor(self, group: str) -> bool:
        """Whether a group of blocks is the floor that the scene lays below its specimen."""
        return self.floor is not None and group == "floor"

    def contact_of(self, group: str) -> Contact:
        """Table of a group of contacts: its own, or [contact.default]. KeyError where there is neither."""
        return self.contact[group if group in self.contact else "default"]

    @property
    def is_large(self) -> bool:
        """Whether blocks may turn and slide as far as they like, and contacts are found anew."""
        return self.displacements == "large"

    @property
    def contact_points(self) -> str:
        """Where points sit in a joint: at its edges where blocks turn about them as far as they like."""
        return self.specimen.contact_points or ("vertex" if self.is_large else "gauss")

    @property
    def points_per_edge(self) -> PerAxis | None:
        """By axis; None where there are so many on a face, or so far apart. Points at the edges need four, as two alone
        make a joint three times as strong in bending as its elastic limit. An edge that crushes needs more of them: in
        the plane of a wall, and through its thickness where something acts along y; cells are small enough."""
        if self.chooses_points:
            return self.specimen.points_per_edge
        at_edges, crushes = self.contact_points == "vertex", any(one.crushing for one in self.contact.values())
        if crushes and not self.specimen.has_cells:
            along, across = (10, 4) if at_edges else (6, 2)
            return PerAxis(along, along if self.acts_along_y else across, along)
        return PerAxis(4, 4, 4) if self.is_large and at_edges else self.specimen.points_per_edge

    @property
    def acts_along_y(self) -> bool:
        """Whether the drive, a load or the ground acts along y, so that joints bend across the edges along it."""
        limit, gravity = self.limit, self.gravity
        along = [limit.direction, limit.about and TURNED[limit.about[-1]]] if limit is not None else []
        along += [self.drive.direction] if self.drive is not None else []
        along += [TURNED[gravity.tilt.about]] if gravity is not None and gravity.tilt is not None else []
        parts = [bool(traction.stress.y) for traction in self.traction] + [bool(motion.y) for motion in self.ground]
        parts += [gravity.y != 0.0] if gravity is not None else []
        parts += [bool(part.y) for part in (limit.force, limit.stress) if part] if limit is not None else []
        return any("y" in word for word in along if word) or any(parts)

    @property
    def chooses_points(self) -> bool:
        """Whether the scene says how many contact points there are."""
        return bool(self.specimen.model_fields_set & set(DENSITIES))

    @property
    def must_stand(self) -> bool:
        """Whether all of it must be held: what falls in large displacement lands, and a given time ends a flight."""
        return not self.is_large and self.solver.duration is None and not self.quiet

    @property
    def moves_in_time(self) -> bool:
        """Whether a run with real masses is a motion in time: large displacement, damping of its own after the
        settling, or a duration where nothing is driven."""
        return self.is_large or self.swings or (self.solver.duration is not None and self.drive is None)

    @property
    def has_dead_loads(self) -> bool:
        """Whether there is a traction, gravity or a bar with pretension: they settle before the drive moves."""
        return bool(self.traction) or self.gravity is not None or any(bar.pretension for bar in self.bar)

    @property
    def shaken(self) -> Ground | None:
        """The ground in whose frame forces of inertia act; None without."""
        return next((ground for ground in self.ground if not ground.moves_supports), None)

    @property
    def moved_grounds(self) -> tuple[Ground, ...]:
        """Those that move supports."""
        return tuple(ground for ground in self.ground if ground.moves_supports)

    @property
    def settles(self) -> bool:
        """Whether dead loads settle before anything else moves."""
        return self.has_dead_loads and (self.settle is None or self.settle.steps > 0)

    @property
    def swings(self) -> bool:
        """Whether other damping acts once the dead loads have settled: that of [damping], else none."""
        return self.damping is not None or bool(self.ground) or bool(self.quiet)

    @property
    def waves(self) -> tuple[GivenMotion, ...]:
        """Motions that come in through quiet boundaries."""
        return tuple(quiet.wave for quiet in self.quiet if quiet.wave is not None)

    @property
    def comes_in_layers(self) -> bool:
        """Whether the weight comes on layer by layer, and not all at once."""
        return self.gravity is not None and self.gravity.layers > 1

    @property
    def is_controlled(self) -> bool:
        """Whether the drive is paced by its error, and motion is damped against what is expected."""
        return self.drive is not None and self.drive.accuracy is not None

    @property
    def grows(self) -> bool:
        """Whether a run lets the load of [limit] grow until nothing balances it."""
        return self.limit is not None and self.limit.run_accuracy is not None

    @property
    def turns_back(self) -> bool:
        """Whether the drive turns, or a load that varies: contacts then soften over the plastic slip by default."""
        loads = [path for traction in self.traction for path in traction.paths]
        if self.gravity is not None and self.gravity.tilt is None:
            loads += self.gravity.paths
        paths = [path.turning_points() for path in loads]
        paths += [] if self.limit is None or self.limit.history is None else [self.limit.history]
        if self.ground or self.waves:
            return True
        return any(len(path) > 1 for path in paths) or (self.drive is not None and len(self.drive.reversals) > 1)

    @property
    def sampling(self) -> float | None:
        """Rows a second, equally spaced in time; None where their number is given. Where the ground moves that is the
        rate of its record, SAMPLING at least, unless the scene says something else."""
        if self.solver.sampling is not None or not self.ground or "rows" in self.solver.model_fields_set:
            return self.solver.sampling
        return max(SAMPLING, *(ground.rate for ground in self.ground))

    @property
    def samples(self) -> bool:
        """Whether rows must be equally spaced in time from the end of the settling on."""
        return (
            self.solver.sampling is not None
            or bool(self.ground)
            or any(gauge.quantity != "displacement" for gauge in self.gauge)
        )

    @property
    def bar_columns(self) -> list[tuple[str, str]]:
        """Of each bar that has one, the key of its name, and the name: the column of its force."""
        return [(f"bar.{k}.name", name) for k, bar in enumerate(self.bar) for name in bar.names]

    @property
    def loops_over(self) -> str | None:
        """The gauge over which loops of a load that goes to and fro are drawn: that of the curve, else the first."""
        if self.limit is None or self.limit.history is None:
            return None
        names = [gauge.name for gauge in self.gauge]
        return self.curve.x if self.curve is not None and self.curve.x in names else names[0]

    def resolved(self) -> dict[str, Any]:
        """The scene as plain values with SI units, defaults written out; loading it gives the same scene bit by bit.

        What depends on the top-level law and confinement still names them, so both can be set anew; what depends on
        `displacements` (the number of contact points, limits) is left out where the scene leaves it open.
        """
        data = self.model_dump(exclude_none=True, context={"law": self.law, "confinement": self.confinement})
        if not self.chooses_points:
            data["specimen"].pop("points_per_edge", None)
        if not self.specimen.slab:
            del data["specimen"]["slab"]
        for key in LIMITS:
            if self.is_large or key not in self.solver.model_fields_set:
                del data["solver"][key]
        if self.samples and "rows" not in self.solver.model_fields_set:
            del data["solver"]["rows"]
        if self.sampling is not None:  # it says how many rows there are
            data["solver"].pop("rows", None)
        if not self.is_large:
            del data["displacements"]
        return {key: value for key, value in data.items() if value not in ((), {}) or key == "floor"}

    @model_validator(mode="before")
    @classmethod
    def _ground_moves_real_masses(cls, data: Any) -> Any:
        """Where the ground moves, or waves leave, masses are the real ones unless a scene says otherwise."""
        if (
            isinstance(data, dict)
            and (data.get("ground") or data.get("quiet"))
            and isinstance(solver := data.get("solver", {}), dict)
        ):
            return {**data, "solver": {"masses": "real", **solver}}
        return data
