"""A scene: specimen, properties, supports, loading and solver, checked and in SI."""

from collections.abc import Iterator
from typing import Any, Self

from pydantic import BaseModel, model_validator

from masonry.errors import did_you_mean, nearest
from masonry.rows.columns import ELEMENT_UNITS, EXCESS, FACTOR, GROUND, INPUT_ENERGY, OFF_BALANCE, TILT, UNITS
from masonry.scene.fitting_keys import require_fit
from masonry.scene.schema import SceneKeys
from masonry.scene.tables.dynamics.ground import Ground
from masonry.scene.tables.gauge import Curve
from masonry.scene.tables.scatter import require_contacts
from masonry.scene.tables.standard import Standard
from masonry.scene.tables.types import KeyedError


class SceneData(SceneKeys):
    """The keys of a scene, which fit together. Scene adds what a user does with it."""

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
        for where, name in (*named, *self.bar_columns):
            if name in names:
                raise KeyedError(where, f"'{name}' is a column of the results already; take another")
            names.append(name)
        gauges = [gauge.name for gauge in self.gauge]
        if self.curve is not None:
            self._curve_draws(self.curve, gauges, [name for _, name in self.bar_columns])
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
