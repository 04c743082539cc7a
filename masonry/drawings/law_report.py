"""Which laws there are and where they come from; of one, its parameters, energies and portrait."""

import inspect
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any, get_args

from masonry.errors import SceneError, nearest
from masonry.laws import law_names
from masonry.laws.building.entry_points import plugins
from masonry.laws.building.plugins import all_law_names, plugin_law

if TYPE_CHECKING:
    from masonry.drawings.law_portrait import Portrait

COUPLET, GROUP = "couplet", "contact.unit_unit"
SHOWN = {
    "stress": (1e-6, "MPa"),
    "stiffness": (1e-9, "GPa/m"),
    "length": (1e3, "mm"),
    "energy": (1.0, "N/m"),
    "energy per stress": (1e6, "N/m/MPa"),
    "angle": (57.29577951308232, "deg"),
}
"""Factor and unit in which a kind of quantity is shown; others in SI."""
CRUSHING = ("compressive_strength", "fracture_energy_compression", "closing_at_peak", "cap_shear_factor")
AGREE = 0.01
"""How far `tension_area` may be off the integral of `tension_intact`."""


@dataclass(frozen=True, repr=False)
class LawReport:
    """Report on a law: its name, a table in words, and its portrait, which has the curves and their areas."""

    name: str
    table: list[tuple[str, list[str]]]
    portrait: "Portrait"

    def draw(self, path: Path) -> Path:
        """Write the picture. Raises OSError."""
        from masonry.drawings.law_picture import draw_law

        return draw_law(self.name, self.portrait, path)

    def __repr__(self) -> str:
        from masonry.runtime.tables import aligned

        return aligned(self.table)


def report_of(name: str, changes: list[str]) -> LawReport:
    """Of a law by its name, with some keys of the contact changed: "cohesion=0.6 MPa". Raises SceneError."""
    from masonry.drawings.law_portrait import COMPRESSIONS, portrait
    from masonry.laws.building.factory import build

    contact = _contact(name, changes)
    parameters, joint = build("unit_unit", contact.properties(), (0.0, *COMPRESSIONS))
    measured = portrait(parameters, joint)
    return LawReport(name, [*_about(name, contact, parameters), *_energies(contact, measured)], measured)


def list_of_laws() -> list[str]:
    """A line for each law: name, where it comes from, what it is or what is wrong with it."""
    from masonry.laws.building.factory import module_of
    from masonry.runtime.tables import columns

    rows = [(name, "masonry", _first_line(module_of(name))) for name in law_names()]
    for name, several in plugins("masonry.laws").items():
        origin = " and ".join(one.origin for one in several)
        try:
            if name in law_names():
                raise SceneError("not used: masonry has a law of this name; give it another name in the entry point")
            rows.append((name, origin, _first_line(module_of(name))))
        except SceneError as error:
            rows.append((name, origin, f"DOES NOT WORK: {error}"))
    return columns(rows)


def _first_line(module: Any) -> str:
    return (inspect.getdoc(module) or "").partition("\n")[0]


def _contact(name: str, changes: list[str]) -> Any:
    """The contact of the couplet with this law, its examples and the changes."""
    from masonry.scene import load

    own = None if name in law_names() else plugin_law(name)
    if own is None and name not in law_names():
        raise SceneError(f"there is no law '{name[:60]}'; {nearest(name, all_law_names())}")
    example = {} if own is None else {f"{GROUP}.{key}": value for key, value in own.example.items()}
    strengths = {}
    for text in changes:
        key, equals, value = (part.strip() for part in text.partition("="))
        if not equals or not key.isidentifier():
            raise SceneError(f"--set {text[:80]}: write KEY=VALUE with a key of a contact: --set cohesion='0.6 MPa'")
        strengths[f"{GROUP}.{key}"] = value
    return load(COUPLET, {"law": name, **example, **strengths}).contact["unit_unit"]


def _about(name: str, contact: Any, parameters: Any) -> list[tuple[str, list[str]]]:
    from masonry.laws.building.factory import module_of, properties_of

    own = None if name in law_names() else plugin_law(name)
    module = module_of(name)
    above_0 = [key for field, key in module.PARAMETERS.items() if field not in parameters._field_defaults]
    read = properties_of(name)
    residual = ("residual_cohesion", "tan_residual_friction") if "cohesion" in read else ()
    keys = ["normal_stiffness", "shear_stiffness", *read, *residual]
    if contact.crushing is not None:
        keys += [key for key in CRUSHING if getattr(contact, key) is not None]
    return [
        ("law", [f"{name}, of {'masonry' if own is None else own.origin}: {_first_line(module)}"]),
        ("parameters", [_parameter(contact, key) for key in (keys if name != "elastic" else keys[:2])]),
        ("refuses", [_refuses(getattr(module, "refuse", None), above_0)]),
    ]


def _refuses(refuse: Any, above_0: list[str]) -> str:
    """Values that a law refuses, in the words of its function; without one, those out of range, as for every law."""
    if refuse is None:
        more = f", or not above 0: {', '.join(above_0)}" if above_0 else ""
        return f"only what is out of the range of its key (docs/scene.md){more}"
    return (
        (inspect.getdoc(refuse) or "some values")
        .partition("\n")[0]
        .removesuffix(".")
        .removesuffix(": a Refusal or None")
    )


def _parameter(contact: Any, key: str) -> str:
    value = getattr(contact, key)
    factor, unit = SHOWN.get(_kind(type(contact), key), (1.0, ""))
    return f"{key} = {'not given' if value is None else f'{value * factor:.6g} {unit}'.rstrip()}"


def _kind(table: Any, key: str) -> str:
    """The kind of quantity that a key of a contact holds."""
    from masonry.scene.tables.types import Given

    def marks(annotation: Any) -> list[Any]:
        return [mark for part in get_args(annotation) for mark in ([part] if isinstance(part, Given) else marks(part))]

    field = table.model_fields.get(key)
    metadata = [*field.metadata, *marks(field.annotation)] if field is not None else []
    return next((mark.kind for mark in metadata if isinstance(mark, Given)), "number")


def _energies(contact: Any, measured: Any) -> list[tuple[str, list[str]]]:
    """Measured energies against the given ones."""
    from masonry.laws.building.factory import properties_of

    rows = []
    read = properties_of(contact.law)
    mode_1, mode_2, slope = (
        getattr(contact, key) if key in read else None
        for key in ("fracture_energy_mode_1", "fracture_energy_mode_2", "fracture_energy_mode_2_slope")
    )
    if measured.mode_1 is not None:
        rows.append(("G_I, measured", [_energy(measured.mode_1, mode_1)]))
        if abs(measured.mode_1.booked - measured.mode_1.whole) > AGREE * measured.mode_1.whole:
            rows.append(
                (
                    "WARNING",
                    [
                        f"the law books {measured.mode_1.booked:.4g} N/m where the curve takes "
                        f"{measured.mode_1.whole:.4g}: "
                        "its tension_area is not the integral of its tension_intact"
                    ],
                )
            )
    rows += _crushing(measured.crushing)
    lines = []
    for compression, energy in measured.mode_2.items():
        expected = None if mode_2 is None else mode_2 + (slope or 0.0) * compression
        lines.append(f"at {compression * 1e-6:g} MPa: {_energy(energy, expected)}")
    return [*rows, ("G_II, measured", lines)] if lines else rows


def _crushing(crushing: Any) -> list[tuple[str, list[str]]]:
    """The areas of the curve of compression beside the closed forms, and a warning where they differ."""
    if crushing is None or crushing.areas is None:
        return []
    areas = crushing.areas
    lines = [
        f"{areas.softening:.4g} N/m of softening, above what is left in the end; given: {areas.softening_wanted:.4g}"
    ]
    off = abs(areas.softening / areas.softening_wanted - 1.0)
    if areas.hardening_wanted:
        lines.append(f"{areas.hardening:.4g} N/m of hardening; closed form: {areas.hardening_wanted:.4g}")
        off = max(off, abs(areas.hardening / areas.hardening_wanted - 1.0))
    rows = [("G_c, measured", lines)]
    return rows if off <= AGREE else [*rows, ("WARNING", ["the areas are not those of the closed form"])]


def _energy(energy: Any, expected: float | None) -> str:
    compared = "" if expected is None else f"; given: {expected:.4g}"
    return f"{energy.beyond:.4g} N/m beyond the peak, {energy.whole:.4g} with the elastic part{compared}"
