"""A scene file or a packaged scene -> `Scene`, checked and in SI; and back to TOML that gives the same scene."""

import os
import tomllib
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import tomli_w
from pydantic import ValidationError

from masonry.errors import SceneError
from masonry.quantity import parse
from masonry.scene.checked import SceneData
from masonry.scene.messages import explain
from masonry.scene.overrides import Overrides, apply
from masonry.scene.portrait import portrait_html, portrait_text
from masonry.scene.source import Source, of_tables, read
from masonry.scene.tables.law_keys import law_there
from masonry.scene.unit_weights import note_unit_weights


class Scene(SceneData):
    """A scene, checked and in SI: change it (`with_`), run it (`masonry.run`), print it."""

    def with_(self, settings: Mapping[str, Any] | None = None, /, **top_level: Any) -> "Scene":
        """Another scene with some keys set anew; this one stays as it is. Same rules as `--set`.

        settings   by dotted key: scene.with_({"drive.accuracy": "0.5 %", "contact.unit_unit.cohesion": "0.6 MPa"})
        top_level  keys without a dot, for short: scene.with_(law="linear", confinement="0.1 MPa")
        Raises SceneError: one message with the key, what is wrong, and what is allowed.
        """
        if settings is not None and not isinstance(settings, Mapping):
            raise SceneError(f"with_({settings!r:.60}): give a dictionary of dotted keys, or keys by name")
        for key in top_level:
            if key in (settings or {}):
                raise SceneError(f"{key} is given twice: in the settings and by itself")
        return changed(self, {**(settings or {}), **top_level})

    def __repr__(self) -> str:
        return portrait_text(self)

    __str__ = __repr__

    def _repr_html_(self) -> str:
        return portrait_html(self)


def load(scene: str | Path | Mapping[str, Any], overrides: Overrides = ()) -> Scene:
    """The scene of a file, of a packaged name such as "couplet", or of a dictionary: its tables, as a file has them,
    and dotted keys.

    overrides  {"law": "linear", "drive.steps": 5000} or ["law=linear", "drive.steps=5000"], by dotted key
    Raises SceneError: one message with file and line, key, what is wrong, and what is allowed.
    """
    if isinstance(scene, Mapping):
        dotted = {key: value for key, value in scene.items() if isinstance(key, str) and "." in key}
        source = of_tables({key: value for key, value in scene.items() if key not in dotted})
        apply(source, dotted)
    elif isinstance(scene, str | os.PathLike) and isinstance(os.fspath(scene), str):
        source = read(scene if isinstance(scene, str) else Path(scene))
    else:
        raise SceneError(
            f"{scene!r:.60} is no scene: give the name of a packaged one, the path of a file, or its tables"
        )
    apply(source, overrides)
    return _checked(source)


def changed(scene: Scene, settings: Overrides) -> Scene:
    """Another scene: this one with some keys set anew, as `load` does. Raises SceneError as `load` does."""
    source = Source(scene.name, scene.name, "", tomllib.loads(to_toml(scene)))
    apply(source, settings)
    return _checked(source)


def _checked(source: Source) -> Scene:
    """The scene that stands in the raw values."""
    confinement = source.raw.get("confinement")
    if confinement is not None:
        place = source.place(("confinement",))
        where = place if place.split()[-1] == "confinement" else f"{place}: confinement"
        confinement = parse(confinement, "stress", where, "[0, 1e15]")
    law = source.raw.get("law")
    try:
        known = law is None or law_there(law)
    except SceneError as error:
        raise SceneError(f"{source.place(('law',))}: {error}") from None
    note_unit_weights(source.raw)
    context = {"confinement": confinement, "law": law if known else "elastic", "known": known}
    try:
        return Scene.model_validate({"name": source.stem, **source.raw}, context=context)
    except ValidationError as error:
        raise explain(error, source) from None


def to_toml(scene: Scene) -> str:
    """The resolved scene as a TOML file; `load` of it gives the same scene bit by bit."""
    return tomli_w.dumps(scene.resolved())
