"""A scene: specimen, properties, supports, loading and solver, checked and in SI."""

from collections.abc import Iterator
from typing import Annotated, Any, Literal, Self

from pydantic import AfterValidator, BaseModel, BeforeValidator, Field, WrapSerializer, model_validator

from masonry.errors import did_you_mean, nearest
from masonry.rows.columns import ELEMENT_UNITS, EXCESS, FACTOR, GROUND, INPUT_ENERGY, OFF_BALANCE, TILT, UNITS
from masonry.scene.motion_checks import LIMITS, require_fit
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
from masonry.scene.tables.scatter import Scatter, require_contacts
from masonry.scene.tables.specimen import Specimen
from masonry.scene.tables.specimens.bar import BarTable
from masonry.scene.tables.standard import Standard
from masonry.scene.tables.types import KeyedError, Law, Motion, ReadOnly, Strength, Table

SAMPLING = 200.0
"""Rows a second of a scene whose ground moves: gauges of accelerations are good up to a fifth of it."""
TURNED = {"x": "yz", "y": "xz", "z": "xy"}
"""Along which axes what is turned about one acts."""
INVENTED = "a placeholder that the import made up: put in your own"
"""What `masonry import` notes in [assumptions] of a key that the file does not hold."""


def _by_group(value: Any) -> Any:
    """One kinematics for all groups, or a table of them."""
    return {"default": "rigid", **value} if isinstance(value, dict) else {"default": value}


class SceneData(Table):
    """All that a run needs, in SI; `name` is the file's unless it gives one. Scene adds what a user does with it."""

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

    @model_validator(mode="after")
    def _fits_together(self) -> Self:
        loads = self.has_dead_loads
        if self.settle is not None and not loads:
            raise KeyedError("settle", "there is no traction and no gravity to settle; leave this table out")
        moved_by = (self.drive, self.motion, self.ground, self.waves)
        if not loads and not self.grows and not any(moved_by):
            raise KeyedError("drive", "missing; without a drive, traction, gravity or load that grows nothing happens")
        if self.is_controlled and self.solver.masses == "real" and not self.ground:
            raise KeyedError(
                "solver.masses", "real masses move in real time; give drive.rate, or leave masses = 'scaled'"
            )
        for k, traction in enumerate(self.traction):
            if traction.history is not None and self.is_controlled:
                raise KeyedError(
                    f"traction.{k}.history", "an accuracy controls the drive only; give drive.steps or drive.rate"
                )
        require_fit(self)
        self._kinematics_have_what_they_need()
        if self.scatter is not None:
            require_contacts(self.scatter, self.contact)
        self._gauges_have_names_of_their_own()
        keys = set(dotted_keys(self))
        for key in self.assumptions:
            if key not in keys:
                raise KeyedError("assumptions", _no_such(key, sorted(keys)))
        return self

    def _gauges_have_names_of_their_own(self) -> None:
        names = [*UNITS, *ELEMENT_UNITS, TILT, FACTOR, OFF_BALANCE, EXCESS, INPUT_ENERGY, *GROUND.values()]
        named = [(f"gauge.{k}.name", gauge.name) for k, gauge in enumerate(self.gauge)]
        bars = [(f"bar.{k}.name", name) for k, bar in enumerate(self.bar) for name in bar.names]
        for where, name in (*named, *bars):
            if name in names:
                raise KeyedError(where, f"'{name}' is a column of the results already; take another")
            names.append(name)
        gauges = [gauge.name for gauge in self.gauge]
        if self.curve is not None:
            self._curve_draws(self.curve, gauges, [name for _, name in bars])
        if self.standard is not None:
            self._standard_reads(self.standard, gauges)
        led = None if self.limit is None else self.limit.control
        if led is not None and led not in gauges:
            there = nearest(led, gauges) if gauges else "there is none: give the scene a table [[gauge]]"
            raise KeyedError("limit.control", f"'{led[:60]}' is no gauge; {there}")
        if self.limit is not None and self.limit.history is not None and not gauges:
            raise KeyedError("gauge", "missing; the loops of limit.history are drawn over one: give a table [[gauge]]")

    def _curve_draws(self, curve: Curve, gauges: list[str], bars: list[str]) -> None:
        """Check that all names in a curve are there; over the time those of bars, for their force, as well."""
        tilts = self.gravity is not None and self.gravity.tilt is not None
        across = ["displacement", "time", *([TILT] if tilts else []), *gauges]
        if curve.x not in across:
            raise KeyedError("curve.x", f"'{curve.x[:60]}' is no gauge; allowed: {', '.join(across)}")
        if curve.measured is not None and (curve.x == TILT or self.drive is None):
            raise KeyedError("curve.measured", "is drawn beside the curve of a [drive], over its way or a gauge")
        for name in curve.gauges:
            if name not in (*gauges, *bars):
                allowed = ", ".join(["stress", "force", *gauges, *bars])
                raise KeyedError("curve.y", f"'{name[:60]}' is no gauge; allowed: {allowed}")
            if curve.x != "time":
                raise KeyedError("curve.y", "a gauge is drawn over the time only: give curve.x = 'time'")

    def _standard_reads(self, standard: Standard, gauges: list[str]) -> None:
        """The gauges that it names are there, and something is driven."""
        for key, name in (("shortening", standard.shortening), ("extension", standard.extension)):
            if name is not None and name not in ("displacement", *gauges):
                raise KeyedError(f"standard.{key}", f"'{name[:60]}' is no gauge; {nearest(name, gauges)}")
        if self.drive is None:
            raise KeyedError("standard", "a test needs a table [drive], which presses the specimen")

    def _kinematics_have_what_they_need(self) -> None:
        if self.deforms("floor") and self.is_floor("floor") and "floor" not in self.material:
            raise KeyedError("kinematics.floor", "a floor that is not rigid needs its own table [material.floor]")
        for group, material in self.material.items():
            for key in ("young_modulus", "poisson_ratio"):
                if self.deforms(group) and getattr(material, key) is None:
                    motion = self.kinematics_of(group)
                    raise KeyedError(f"material.{group}.{key}", f"missing; kinematics '{motion}' of {group} needs it")
            sized = self.specimen.mesh == "fan" or self.specimen.mesh_size is not None
            if self.is_meshed(group) and not sized and not self.specimen.made_elsewhere:
                raise KeyedError(
                    "specimen.mesh_size",
                    f"missing; kinematics 'tets' of {group} needs it: mesh_size = '25 mm', or mesh = 'fan'",
                )


def _no_such(key: str, keys: list[str]) -> str:
    return f"'{key[:100]}' is no key of this scene{did_you_mean(key, keys)}"


def dotted_keys(value: Any, path: str = "") -> Iterator[str]:
    """Every key that the scene has, "contact.unit_unit.cohesion", tables and numbered list items included."""
    if path:
        yield path
    items: Any = ()
    if isinstance(value, BaseModel):
        items = ((name, below) for name, below in value if name != "assumptions")
    elif hasattr(value, "_asdict"):
        items = value._asdict().items()
    elif isinstance(value, dict):
        items = value.items()
    elif isinstance(value, tuple) and len(value) == 1 and isinstance(value[0], Ground):
        items = ((name, below) for name, below in value[0])
    elif isinstance(value, tuple):
        items = enumerate(value)
    for name, below in items:
        yield from dotted_keys(below, f"{path}.{name}" if path else str(name))
