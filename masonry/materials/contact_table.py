"""The contact table of a scene that follows from what is known, as TOML and as settings of a scene."""

import json
from collections.abc import Iterator, Mapping
from typing import Any

from masonry.materials.contact_data import CHARACTERISTIC, MEAN, ContactData
from masonry.materials.joint_values import JointNumbers, JointValue, joint_numbers

DIGITS = 6
TOGETHER = {"shear_stiffness": "normal_stiffness", "tan_residual_friction_angle": "tan_friction_angle"}
"""Keys that a sweep varies with another one."""
HEAD = "# Made by `masonry contact`: look at each line, vary what has a range."


class ContactTable(Mapping[str, Any]):
    """A contact group with the source of each number; prints as TOML. As a mapping it is what `Scene.with_` takes.

    group    name of the contact group
    numbers  its values with their ranges (SI), the modulus of a stack, and notes
    """

    def __init__(self, data: ContactData) -> None:
        """Raises SceneError for what is missing, contradicts itself, or would snap back."""
        self.group: str = data.contact or "unit_unit"
        self.law = data.joint_law
        self.numbers: JointNumbers = joint_numbers(data)
        self.data = data
        self._settings = dict(self._items())
        _require_stable(self)

    @property
    def modulus(self) -> float:
        """Of a stack of such units and joints in the model, Pa."""
        return self.numbers.course.modulus

    @property
    def notes(self) -> tuple[str, ...]:
        """Points to mind, a sentence each."""
        return self.numbers.notes

    @property
    def ranges(self) -> dict[str, tuple[float, float]]:
        """Key -> least and largest value (SI) between which a sensitivity should vary it."""
        values = self.numbers.joint
        return {f"contact.{self.group}.{one.key}": (one.low, one.high) for one in values if one.high > one.low}

    def hypercube(self, samples: int = 10, seed: int = 1) -> dict[str, Any]:
        """Variation of a scene with this table for `masonry.sweep`: a Latin hypercube over its ranges.

        The shear stiffness goes with the normal one, and the residual friction with that of the intact joint, which it
        may not exceed.
        """
        group = f"contact.{self.group}"
        values = {one.key: one for one in self.numbers.joint}
        settings = {
            f"{group}.{key}": {"times": values[key].value / values[of].value, "of": f"{group}.{of}"}
            for key, of in TOGETHER.items()
            if key in values
        }
        spans = {
            f"{group}.{key}": {
                "from": _as_text(one._replace(value=one.low)),
                "to": _as_text(one._replace(value=one.high)),
            }
            for key, one in values.items()
            if key not in TOGETHER and one.high > one.low
        }
        return {"settings": settings, "latin_hypercube": {"samples": samples, "seed": seed, **spans}}

    @property
    def tables(self) -> dict[str, Any]:
        """The tables of a scene, nested as in its file: contact, assumptions, and material where units deform."""
        tables: dict[str, Any] = {"contact": {self.group: self._settings[f"contact.{self.group}"]}}
        if self.numbers.within:
            within = {one.key: _as_text(one) for one in self.numbers.within}
            tables["contact"]["within_units"] = {"law": "elastic", **within}
        if self._material:
            tables["material"] = {"units": self._material}
        return {**tables, "assumptions": self._assumptions}

    def __getitem__(self, key: str) -> Any:
        return self._settings[key]

    def __iter__(self) -> Iterator[str]:
        return iter(self._settings)

    def __len__(self) -> int:
        return len(self._settings)

    def __repr__(self) -> str:
        return "\n".join(self._lines())

    __str__ = __repr__

    def _items(self) -> Iterator[tuple[str, Any]]:
        keys = {one.key: _as_text(one) for one in self.numbers.joint}
        crushing = {} if self.data.crushing is None or self.law == "elastic" else {"crushing": self.data.crushing}
        yield f"contact.{self.group}", {"law": self.law, **keys, **crushing}
        for one in self.numbers.within:  # a scene whose units are divided has the table, with strengths of its own
            yield f"contact.within_units.{one.key}", _as_text(one)
        for key, value in self._material.items():
            yield f"material.units.{key}", value
        for key, source in self._assumptions.items():
            yield f"assumptions.{json.dumps(key)}", source

    @property
    def _material(self) -> dict[str, Any]:
        """Material keys of units that deform."""
        if not self.numbers.course.deforms:
            return {}
        nu = 0.25 if self.data.poisson is None else self.data.poisson
        return {"young_modulus": f"{self.data.unit_modulus / 1e9:.{DIGITS}g} GPa", "poisson_ratio": nu}

    @property
    def _assumptions(self) -> dict[str, str]:
        lines = {f"contact.{self.group}.{one.key}": _source(one) for one in self.numbers.joint}
        lines |= {f"contact.within_units.{one.key}": one.source for one in self.numbers.within}
        if self._material:
            lines["material.units.young_modulus"] = "given"
            nu = "G = 0.4 E" if self.data.poisson is None else "given"
            lines["material.units.poisson_ratio"] = nu
        return lines

    def _lines(self) -> Iterator[str]:
        strengths = self.data.strengths or MEAN
        other = "mean" if strengths == CHARACTERISTIC else "characteristic"
        yield HEAD
        if self.law != "elastic":
            yield f"# Strengths are {strengths} values; beside them stands the {other} one."
        yield f"# A stack of such units and joints has a modulus of {self.modulus / 1e9:.4g} GPa."
        yield from (f"# Mind: {note}." for note in self.notes)
        yield from self._contact(self.group, self.law, self.numbers.joint)
        if self.numbers.within:
            yield from self._contact("within_units", "elastic", self.numbers.within)
        if self._material:
            yield "\n# into [material.units]:"
            yield from (f"# {key} = {json.dumps(value)}" for key, value in self._material.items())
        yield "\n[assumptions]  # where the scene has this table, put the lines below into it"
        lines = {key: text for key, text in self._assumptions.items() if not key.startswith("material")}
        yield from (f"{json.dumps(key)} = {json.dumps(text)}" for key, text in lines.items())

    def _contact(self, group: str, law: str, values: tuple[JointValue, ...]) -> Iterator[str]:
        yield f"\n[contact.{group}]"
        remark = "  # units do not crack; give them strengths where they may" if group != self.group else ""
        yield f'law = "{law}"{remark}'
        if self.data.crushing is not None and group == self.group and law != "elastic":
            yield f'crushing = "{self.data.crushing}"'
        for one in values:
            line = f"{one.key} = {json.dumps(_as_text(one))}"
            remark = ", ".join(filter(None, (_other(one), _range(one))))
            yield f"{line:<50}  # {remark}" if remark else line


def _as_text(one: JointValue) -> str | float:
    """As a scene has it: a text with its unit, or a plain number."""
    if not one.unit.name:
        return float(f"{one.value:.{DIGITS}g}")
    return _shown(one, one.value, DIGITS)


def _shown(one: JointValue, value: float, digits: int = 3) -> str:
    return f"{_rounded(value / one.unit.size, digits)} {one.unit.name}".rstrip()


def _rounded(value: float, digits: int = 3) -> str:
    """Without a power of ten where the number is large."""
    return f"{value:.0f}" if abs(value) >= 10**digits else f"{value:.{digits}g}"


def _range(one: JointValue) -> str:
    if one.high <= one.low:
        return ""
    return f"vary {_rounded(one.low / one.unit.size)} to {_shown(one, one.high)}"


def _other(one: JointValue) -> str:
    if one.mean is not None:
        return f"mean {_shown(one, one.mean)}"
    return "" if one.characteristic is None else f"characteristic {_shown(one, one.characteristic)}"


def _source(one: JointValue) -> str:
    remarks = [("assumed: " if one.is_assumed else "") + one.source, _other(one), _range(one)]
    return "; ".join(filter(None, remarks))


def _require_stable(table: ContactTable) -> None:
    """Raise SceneError where the curve of the law would snap back without compression or at 1 MPa."""
    from masonry.laws.building.factory import build
    from masonry.scene.tables.contact_group import Contact

    contact = Contact.model_validate(table[f"contact.{table.group}"])
    build(table.group, contact.properties(), (0.0, 1e6))
